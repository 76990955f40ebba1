"""From a file, two materials and loads to answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughline.answers import answers, elastic_warnings, saturated_stiffness
from roughline.characterisation import ALIKE, isotropy
from roughline.contact import press
from roughline.curve import Curve
from roughline.errors import InputError, Interrupted
from roughline.estimates import estimate
from roughline.interface import plasticity_index
from roughline.isotropic import isotropic_spectrum
from roughline.line_scan import press_scan
from roughline.materials import Interface, Material
from roughline.missing import Missing
from roughline.preparation import Preparation
from roughline.report.folder import make_folder
from roughline.report.loading import (
    DEFAULT_LOADS,
    Loading,
    default_forces,
    nominal_area,
    with_curve,
)
from roughline.report.pressed import Ends, Pressed, Real
from roughline.report.source import Source, notes_on_parts, read_parts, together
from roughline.theories import TheoryCurve, moments, refuse_unknown, theory
from roughline.topography import Body, Line, Surface

Announce = Callable[[str], None]
Progress = Callable[[int, int], None]

_LARGE = 2**20  # points from which on the cost is told
_COARSENED_FROM = 64  # points a side from which on a report estimates the grid's error


def press_file(
    source: Source,
    loading: Loading,
    *,
    E_star: float | None = None,
    materials: tuple[Material, Material] | None = None,
    against: Source | None = None,
    preparation: Preparation | None = None,
    periodic: bool = False,
    grid_error: bool = False,
    frequency: float | None = None,
    theories: Sequence[str] = (),
    whole_curve: bool = False,
    out: Path | None = None,
    announce: Announce,
    progress: Progress | None = None,
) -> Pressed:
    """Read a file, prepare it, press it and work out what follows.

    Parameters
    ----------
    source : Source
        The topography.
    loading : Loading
        Loads.
    E_star : float, optional
        Contact modulus, unless materials are given. [Pa]
    materials : tuple of Material, optional
        Of both bodies.
    against : Source, optional
        Topography of the second body; without it, that one is smooth.
    preparation : Preparation, optional
        Of each topography; default: the tilt of measured ones is removed.
    periodic, grid_error
        As for :func:`roughline.press`.
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    theories : sequence of str
        As for :func:`roughline.theories.theory`.
    whole_curve : bool
        Whether loads from a thousandth of the largest one on are added, for figures.
    out : Path, optional
        Folder that will be written to.
    announce : callable
        Told what a large run will cost, before it starts.
    progress : callable, optional
        Called with (loads done, loads in all).

    Raises
    ------
    InputError
        If the question does not fit together.
    """
    if (E_star is None) == (materials is None):
        raise InputError("give either a contact modulus (--modulus) or two materials (--materials)")
    for name in theories:
        refuse_unknown(name)
    pair = Interface(*materials) if materials else None
    modulus = pair.E_star if pair else E_star
    assert modulus is not None
    sources = [each for each in (source, against) if each is not None]
    parts = read_parts(sources, preparation)
    body = together(parts)
    if theories and not _has_spectrum(body):
        raise InputError("theories are evaluated for a rough surface of 8 x 8 points or more")
    if whole_curve and isinstance(body, Surface) and min(body.shape) >= _COARSENED_FROM:
        grid_error, body = True, _trimmed(body)
    if out is not None:
        make_folder(out)  # a folder that cannot be written is said before the work, not after
    asked = loading.forces(nominal_area(body)) or []
    if isinstance(body, Line) and body.kind == "profile":
        if periodic or grid_error or loading.depths:
            raise InputError(
                "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
                "loads, through its spectrum"
            )
        forces = asked or default_forces(body, modulus, loading.count or DEFAULT_LOADS)
        forces = with_curve(forces) if whole_curve else forces
        second = parts[1] if len(parts) > 1 else None
        assert second is None or isinstance(second, Line)
        scan = press_scan(body, E_star=modulus, forces=forces, against=second)
        result = Pressed(source, parts, body, scan.curve, _indices(forces, asked, len(forces)))
        result = replace(result, stiffness_interval=(scan.low, scan.high))
    else:
        forces = with_curve(asked) if whole_curve and asked else asked
        wish = _Wish(modulus, forces, loading.heights() or [], loading.count, periodic, grid_error)
        if isinstance(body, Surface) and body.heights.size >= _LARGE:
            cost = estimate(body.shape, wish.count, periodic=periodic)
            announce(f"{body.shape[0]} x {body.shape[1]} points, {wish.count} loads: {cost}")
        shown = forces.index(asked[-1]) if asked else 3 * wish.count // 4
        curve, interrupted = wish.press(body, [shown] if out is not None else False, progress)
        indices = _indices(forces, asked, curve.status.size)
        result = Pressed(source, parts, body, curve, indices, interrupted=interrupted)
        result = _with_intervals(result, wish, sources, preparation, progress)
    notes = [
        *loading.meaning(body),
        *notes_on_parts(parts),
        *result.notes,
        *result.curve.warnings,
    ]
    result = replace(result, pair=pair, notes=notes)
    return _answered(result, modulus, periodic, frequency, theories)


def _trimmed(surface: Surface) -> Surface:
    """The surface without the last rows and columns that cannot be coarsened twice."""
    nx, ny = (n - n % 4 for n in surface.shape)
    return surface if (nx, ny) == surface.shape else surface.cropped((0, nx), (0, ny))


def _has_spectrum(body: Body) -> bool:
    """Whether it is a surface with enough points and some roughness."""
    return isinstance(body, Surface) and min(body.shape) >= 8 and body.rms_height > 0


@dataclass(frozen=True)
class _Wish:
    """Loads and settings, for the body and for the same body filled otherwise."""

    E_star: float
    forces: list[float]
    depths: list[float]
    n_loads: int | None
    periodic: bool
    grid_error: bool

    @property
    def count(self) -> int:
        """Number of loads."""
        return len(self.forces) or len(self.depths) or self.n_loads or 0

    def press(
        self, body: Body, fields: list[int] | bool, progress: Progress | None
    ) -> tuple[Curve, bool]:
        """Press a body; loads that fail are marked. Gives whether Ctrl-C came as well."""
        try:
            curve = press(
                body,
                E_star=self.E_star,
                n_loads=self.n_loads,
                forces=self.forces or None,
                depths=self.depths or None,
                periodic=self.periodic,
                fields=fields if isinstance(body, Surface) else False,
                grid_error=self.grid_error,
                throw=False,
                progress=progress,
            )
        except Interrupted as stop:
            return stop.curve, True
        return curve, False


def _indices(forces: list[float], asked: list[float], count: int) -> NDArray[np.intp]:
    """Which of the loads were asked for; all if none was named."""
    return np.flatnonzero(np.isin(forces, asked)) if asked else np.arange(count)


def _with_intervals(
    pressed: Pressed,
    wish: _Wish,
    sources: Sequence[Source],
    preparation: Preparation | None,
    progress: Progress | None,
) -> Pressed:
    """Add what the grid leaves open, and what another way to fill missing points changes."""
    curve, body = pressed.curve, pressed.body
    errors = [curve.stiffness_error, curve.area_fraction_error]
    most_area = curve.area_fraction  # whole cells overstate, and finer waves take away
    filled = any(part.settings.get("missing_points") for part in pressed.parts)
    if filled and not pressed.interrupted and isinstance(body, Surface):
        filling = Missing(pressed.source.missing).other
        other = together(read_parts(sources, preparation, filling))
        assert isinstance(other, Surface)
        if other.shape != body.shape:
            other = _trimmed(other)
        moved, interrupted = wish.press(other, False, progress)
        assert most_area is not None
        assert curve.area_fraction_corrected is not None
        assert moved.area_fraction_corrected is not None
        changes = [
            np.abs(moved.stiffness - curve.stiffness),
            np.abs(moved.area_fraction_corrected - curve.area_fraction_corrected),
        ]
        with np.errstate(invalid="ignore", divide="ignore"):
            shares = [
                float(np.nanmax(change / value, initial=0.0))
                for change, value in zip(
                    changes, (curve.stiffness, curve.area_fraction_corrected), strict=True
                )
            ]
        note = (
            f"filled by {filling} instead: stiffness moves by up to {100 * shares[0]:.2g}%, "
            f"area by {100 * shares[1]:.2g}%"
        )
        errors = [
            change if error is None else np.hypot(error, change)
            for error, change in zip(errors, changes, strict=True)
        ]
        most_area = most_area + changes[1]
        pressed = replace(pressed, notes=[note], interrupted=interrupted)
    return replace(
        pressed,
        stiffness_interval=_ends(curve.stiffness, errors[0]),
        area_interval=_ends(curve.area_fraction_corrected, errors[1], most_area),
    )


def _ends(value: Real | None, error: Real | None, most: Real | None = None) -> Ends | None:
    """Both ends of an interval; nothing that is positive gets below zero."""
    if value is None or error is None:
        return None
    high = value + error
    with np.errstate(invalid="ignore"):
        return value / (1 + error / value), high if most is None else np.minimum(high, most)


def _answered(
    pressed: Pressed,
    E_star: float,
    periodic: bool,
    frequency: float | None,
    theories: Sequence[str],
) -> Pressed:
    """Add theories, answers and what the answers warn of."""
    body, curve = pressed.body, pressed.curve
    found = None
    lines: list[TheoryCurve] = []
    notes = pressed.notes
    if isinstance(body, Surface) and _has_spectrum(body):
        alike = isotropy(body)
        if theories and alike < ALIKE:
            notes = [
                *notes,
                f"theories assume equal directions; slopes differ, least {alike:.2f} "
                "of the largest",
            ]
        spectrum = isotropic_spectrum(body)
        found = moments(spectrum)
        pressures = curve.force[curve.converged] / body.area
        if pressures.size:
            lines = [theory(name, spectrum, E_star, pressures) for name in theories]
    if pressed.pair is None:
        return replace(pressed, theories=lines, notes=notes)
    saturated = None
    if isinstance(body, Line):
        saturated = E_star * body.length
    elif not periodic:
        saturated = saturated_stiffness(body, E_star)
    given = answers(
        curve,
        pressed.area,
        pressed.pair,
        saturated=saturated,
        rms_height=body.rms_height,
        rms_slope=found.rms_slope if found else None,
        frequency=frequency,
        stiffness_interval=pressed.stiffness_interval,
        area_interval=pressed.area_interval,
    )
    index = None
    if found is not None and pressed.pair.hardness is not None:
        index = plasticity_index(
            E_star, pressed.pair.hardness, (found.summit_deviation, found.summit_radius)
        )
    notes = [*notes, *elastic_warnings(given, index)]
    if frequency is not None and pressed.pair.both("impedance") is None:
        notes.append("no reflection: the density of both materials is needed")
    return replace(pressed, answers=given, theories=lines, notes=notes)
