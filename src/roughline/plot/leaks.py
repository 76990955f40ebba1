"""How much a contact lets through over its load, and where it seals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import cycle, product
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import SurfaceCurve
from roughline.errors import InputError
from roughline.errors.checks import refuse, several
from roughline.errors.public import public
from roughline.plot.curves import rising
from roughline.plot.style import MARKERS, OPEN, colours, drawing_on, in_unit

_APERTURE_LABEL = "hydraulic aperture $u_h$"
_MARK_ROW_HEIGHT = 0.035  # at the foot of axes, over theirs
_DASHES = (":", "-.")


@public
def hydraulic_aperture(
    curves: SurfaceCurve | Sequence[SurfaceCurve],
    theories: Sequence[Any] = (),
    labels: Sequence[str] = (),
    measure: str = "hydraulic_aperture_x",
    axes: Axes | None = None,
) -> Axes:
    """Draw how much a contact lets through over its load, and where it seals.

    The left axis is the hydraulic aperture u_h, the gap of two flat plates that let as much
    through; the right one is u_h³, to which a leak is proportional.

    Parameters
    ----------
    curves : SurfaceCurve or sequence of SurfaceCurve
        Of surfaces, pressed with ``measures=[rl.hydraulic_aperture("x")]``.
    theories : sequence of TheoryCurve, optional
        What :func:`roughline.theory` gives for "critical-junction" and "bruggeman".
    labels : sequence of str, optional
        What the curves are called; those of the same name look alike.
    measure : str, optional
        Name of the measure, such as "hydraulic_aperture_y".
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on, with logarithmic scales. Lines are dashed, with open
        marks, after a larger load. Sealed loads, which have no place on such a scale, are marked at
        the foot of the axes, in a row for each kind of curve. A theory is drawn as far down as the
        curves, and its first sealed load is marked. The pressure is over E* where the bodies are
        not in metres.

    Raises
    ------
    InputError
        If a curve has no such measure, curves are in different units, a theory gives no hydraulic
        aperture, or there are not as many labels as curves.

    Examples
    --------
    >>> import roughline as rl
    >>> aperture = rl.hydraulic_aperture("x")
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> loads = [0.02, 0.04, 0.08, 0.04, 0.02]
    >>> curve = rl.press(surface, E_star=1.0, forces=loads, periodic=True, measures=[aperture])
    >>> theory = rl.theory("critical-junction", surface, 1.0, loads[:3])
    >>> axes = rl.plot.hydraulic_aperture(curve, theories=[theory])
    """
    every = _checked(curves, measure, theories, labels)
    pressures = [curve.force / curve.length**2 for curve in every]
    apertures = [curve.measured[measure].values for curve in every]
    x_label, x = _axis_of_pressure(every[0], np.concatenate(pressures))
    y_label, y = in_unit(_APERTURE_LABEL, np.concatenate(apertures), every[0].unit)
    looks = _looks(labels or range(len(every)))
    lines = [
        _ApertureCurve(pressure * x, aperture * y, rising(curve), look)
        for curve, pressure, aperture, look in zip(every, pressures, apertures, looks, strict=True)
    ]
    with drawing_on(axes, height=4.4) as drawn:
        drawn.set(xscale="log", yscale="log", xlabel=x_label, ylabel=y_label)
        for line in lines:
            line.draw(drawn)
        lines += _drawn_theories(drawn, theories, (x, y), lines)
        _mark_sealed(drawn, lines)
        _explain(drawn, lines)
        _add_leak(drawn, y_label.removeprefix(_APERTURE_LABEL))
    return drawn


def _axis_of_pressure(curve: SurfaceCurve, pressures: Real) -> tuple[str, float]:
    """Label of the axis, and the factor from mean pressures to it; over E* without a unit."""
    if curve.unit == "m":
        return in_unit("mean pressure $p$", pressures, "Pa")
    return in_unit("mean pressure $p/E^*$", pressures, None, 1 / curve.E_star)


@dataclass(frozen=True)
class _ApertureCurve:
    """Hydraulic apertures over pressures, in the order of the loads."""

    pressure: Real
    aperture: Real
    rising: Mask
    look: dict[str, Any]

    def draw(self, axes: Axes) -> None:
        """Draw what is not sealed; dashed and open after a larger load."""
        positive = np.where(self.aperture > 0, self.aperture, np.nan)
        axes.plot(self.pressure[self.rising], positive[self.rising], **self.look)
        after = {**self.look, "linestyle": "--", "label": None, **OPEN}
        edges = np.flatnonzero(np.diff(self.rising, append=True))
        for last, end in zip(edges[::2], edges[1::2], strict=True):
            part = slice(last, end + 1)  # from the last rising load on, which has its own mark
            axes.plot(self.pressure[part], positive[part], markevery=slice(1, None), **after)

    def sealed(self, rising: bool) -> Real:
        """Pressures under which it is sealed, of rising loads or of those after a larger one."""
        return self.pressure[(self.aperture == 0) & (self.pressure > 0) & (self.rising == rising)]


def _looks(names: Sequence[Any]) -> list[dict[str, Any]]:
    """Looks of curves: those of the same name look alike; texts stand in the legend."""
    kinds = list(dict.fromkeys(names))
    of_kind = {
        kind: {"color": colour, "marker": mark, "label": kind if isinstance(kind, str) else None}
        for kind, colour, mark in zip(kinds, colours(len(kinds)), cycle(MARKERS), strict=False)
    }
    return [of_kind[name] for name in names]


def _drawn_theories(
    axes: Axes,
    theories: Sequence[Any],
    factors: tuple[float, float],
    curves: Sequence[_ApertureCurve],
) -> list[_ApertureCurve]:
    """Draw theories as far down as curves; of what is sealed they have the first pressure alone."""
    least = axes.get_ylim()[0] if any((each.aperture > 0).any() for each in curves) else 0.0
    lines = []
    for theory, dashes in zip(theories, cycle(_DASHES), strict=False):
        pressure, aperture = theory.pressure * factors[0], theory.hydraulic_aperture * factors[1]
        is_drawn = (aperture > least) | ((aperture == 0) & (np.cumsum(aperture == 0) == 1))
        look = {"color": "k", "linestyle": dashes, "label": theory.name}
        lines.append(
            _ApertureCurve(
                pressure[is_drawn], aperture[is_drawn], np.full(is_drawn.sum(), True), look
            )
        )
        lines[-1].draw(axes)
    return lines


def _mark_sealed(axes: Axes, lines: Sequence[_ApertureCurve]) -> None:
    """Mark sealed loads at the foot of axes, each kind of line in rows of its own."""
    rows: dict[Any, tuple[list[Real], dict[str, Any]]] = {}
    for line, rises in product(lines, (True, False)):
        if (sealed := line.sealed(rises)).size:
            open_mark = {} if rises else OPEN
            look = {"marker": "x", **line.look, "linestyle": "none", "label": None, **open_mark}
            rows.setdefault((line.look["label"], line.look["color"], rises), ([], look))[0].append(
                sealed
            )
    bottom, top = axes.get_ylim()
    axes.set_ylim(top * (bottom / top) ** (1 / (1 - _MARK_ROW_HEIGHT * (len(rows) + 0.5))), top)
    for place, (pressures, look) in zip(range(len(rows), 0, -1), rows.values(), strict=True):
        x = np.concatenate(pressures)
        axes.plot(
            x,
            np.full(x.size, _MARK_ROW_HEIGHT * place),
            transform=axes.get_xaxis_transform(),
            **look,
        )


def _explain(axes: Axes, lines: Sequence[_ApertureCurve]) -> None:
    """Say below the axes which line is which, and what dashes and marks at the foot mean."""
    if any(not line.rising.all() for line in lines):
        axes.plot([], [], "o--", color="0.4", label="after a larger load", **OPEN)
    if any((line.aperture == 0).any() for line in lines):
        axes.plot([], [], " ", label="marks at the foot: sealed")
    handles, texts = axes.get_legend_handles_labels()
    each_once = dict(zip(texts, handles, strict=True))
    if each_once:
        below: Any = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.17), "ncols": 2}
        axes.legend(each_once.values(), each_once.keys(), **below)


def _add_leak(axes: Axes, of_length: str) -> None:
    """Add an axis at the right for the cube of the left one."""
    axes.tick_params(which="both", right=False)
    cubed = axes.secondary_yaxis("right", functions=(lambda u: np.power(u, 3), np.cbrt))
    cubed.set_ylabel(f"leak, in proportion to $u_h^3${of_length.replace(']', '³]')}")


def _checked(curves: Any, measure: str, theories: Any, labels: Any) -> list[SurfaceCurve]:
    """Curves that have a measure; theories of something else and other labels are refused."""
    every = [curves] if isinstance(curves, SurfaceCurve) else several(curves)
    if not every or not all(isinstance(curve, SurfaceCurve) for curve in every):
        refuse("curves", curves, "one or several curves, as rl.press returns them, are needed")
    if any(measure not in curve.measured for curve in every):
        raise InputError(
            f'a curve has no measure "{measure}": press with measures=[rl.hydraulic_aperture("x")]'
        )
    if len({curve.unit for curve in every}) > 1:
        raise InputError("curves are in different units: press bodies in the same unit")
    if not isinstance(theories, list | tuple) or any(
        getattr(each, "hydraulic_aperture", None) is None for each in theories
    ):
        known = '"critical-junction" and "bruggeman"'
        refuse("theories", theories, f"a list of what rl.theory gives for {known} is needed")
    texts = isinstance(labels, list | tuple) and all(isinstance(label, str) for label in labels)
    if not texts or len(labels) not in (0, len(every)):
        refuse("labels", labels, f"a list of {len(every)} texts is needed, one for each curve")
    return every
