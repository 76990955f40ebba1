"""Pictures of curves: their quantities over each other, and the real contact area."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.quantities import OVER_LOADS, QUANTITIES, RESOLVED_FROM
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.plot.style import FORCE_LABEL, OPEN, drawing_on, in_unit, label_decades, say

_ELASTIC_COLOUR, _AFTER_LARGER_COLOUR = "k", "tab:blue"


@public
def curve(
    curve: Curve, x: str | None = None, y: str | None = None, axes: Axes | None = None
) -> Axes:
    """Draw one quantity of a curve over another.

    Parameters
    ----------
    curve : Curve
        Of a surface or a line.
    x, y : str, optional
        Names of quantities over the loads, such as "depth", "force_bar" or "stiffness_bar".
        Default: the stiffness over the force, and, of bodies that were pulled, the force over the
        depth.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on, with logarithmic scales. They are linear where a value is
        negative, and where depths are drawn of loads that fall, to show loading and unloading.
        Marks are open where fewer than ten springs or cells touch, so that the grid decides, and
        blue after a larger load, or, of bodies that stick, as they go apart. The number of loads
        that were not solved is written in the picture, and of those at zero, which logarithmic
        scales cannot show.

    Raises
    ------
    InputError
        If the curve has no such quantity.
    """
    is_pulled = bool((curve.force < 0).any())
    x = x or ("depth" if is_pulled else "force")
    y = y or ("force" if is_pulled else "stiffness")
    over, values = _values(curve, x), _values(curve, y)
    falls = not bool(rising(curve).all())
    linear = (falls and "depth" in (x, y)) or bool((over < 0).any() or (values < 0).any())
    with drawing_on(axes) as drawn:
        x_label, x_factor = _label(curve, x, over)
        y_label, y_factor = _label(curve, y, values)
        draw_loads(drawn, over * x_factor, values * y_factor, curve, linear=linear)
        drawn.set(xlabel=x_label, ylabel=y_label)
        _explain(drawn, curve)
    return drawn


@public
def area(curve: Curve, axes: Axes | None = None) -> Axes:
    """Draw the real contact area over the force, corrected for the steps of its outline.

    Parameters
    ----------
    curve : Curve
        Of a surface.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on; scales and marks as in :func:`curve`. The band reaches
        from the corrected area up to the area of the cells that touch.

    Raises
    ------
    InputError
        If the curve is of a line: the reduced model predicts no contact area.
    """
    corrected, cells = (
        _values(curve, name) for name in ("area_fraction_corrected", "area_fraction")
    )
    label, factor = _label(curve, "force", curve.force)
    with drawing_on(axes) as drawn:
        drawn.plot(
            [], [], "o", color=_ELASTIC_COLOUR, label="corrected for the steps of its outline"
        )
        is_pulled = bool((curve.force < 0).any())
        draw_loads(drawn, curve.force * factor, corrected, curve, linear=is_pulled)
        loaded = rising(curve)
        drawn.fill_between(
            curve.force[loaded] * factor,
            corrected[loaded],
            cells[loaded],
            color="0.35",
            alpha=0.2,
            linewidth=0,
            label="up to the area in cells",
        )
        drawn.set(xlabel=label, ylabel="real contact area $A/A_0$")
        _explain(drawn, curve)
    return drawn


def draw_loads(axes: Axes, x: Real, y: Real, curve: Curve, *, linear: bool = False) -> None:
    """Draw the loads of a curve in their order; those after a larger one in blue.

    How many of them logarithmic scales leave out is told in the legend.
    """
    loaded, resolved = rising(curve), curve.resolved | (curve.force == 0)
    # on logarithmic scales bodies just apart have no place
    is_drawn = np.isfinite(x * y) if linear else (x > 0) & (y > 0)
    draw = axes.plot if linear else axes.loglog
    draw(x[is_drawn], y[is_drawn], color="0.5", linewidth=0.8)
    for when, colour in ((loaded, _ELASTIC_COLOUR), (~loaded, _AFTER_LARGER_COLOUR)):
        for which, look in ((resolved, {}), (~resolved, OPEN)):
            points = is_drawn & when & which
            draw(x[points], y[points], "o", color=colour, **look)
    if not linear:
        label_decades(axes)
    if left_out := int((curve.converged & ~is_drawn).sum()):
        text = f"{left_out} of {is_drawn.size} loads not shown, at zero or infinite"
        axes.plot([], [], linestyle="", label=text)
        axes.legend()


def rising(curve: Curve) -> Mask:
    """Which loads are no smaller than one before them; of bodies that stick, those on approach.

    Loads that were not solved count as such.
    """
    if _sticks(curve):
        return curve.on_approach | ~curve.converged
    return ~(curve.force < np.fmax.accumulate(curve.force))


def _sticks(curve: Curve) -> bool:
    return curve.law is not None and not curve.law.only_pushes


def _explain(axes: Axes, curve: Curve) -> None:
    """Say what marks mean where they differ, and how many loads were not solved."""
    solved = curve.converged
    if not solved.any():
        say(axes, "no load was solved")
        return
    marks: list[tuple[str, dict[str, Any]]] = []
    if (solved & ~curve.resolved & (curve.force != 0)).any():
        text = f"fewer than {RESOLVED_FROM} {_cells(curve)} touch"
        marks.append((text, {"marker": "o", "color": _ELASTIC_COLOUR, **OPEN}))
    if (solved & ~rising(curve)).any():
        text = "as the bodies go apart" if _sticks(curve) else "after a larger load"
        marks.append((text, {"marker": "o", "color": _AFTER_LARGER_COLOUR}))
    if missing := int((~solved).sum()):
        marks.append((f"{missing} of {solved.size} loads not solved", {}))
    for text, look in marks:
        axes.plot([], [], linestyle="", label=text, **look)
    # of several curves on the same axes, each kind of mark is explained once
    explained = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    if explained:
        axes.legend(explained.values(), explained.keys())


def _cells(curve: Curve) -> str:
    return "cells" if isinstance(curve, SurfaceCurve) else "springs"


def _values(curve: Curve, name: str) -> Real:
    """Return a quantity of a curve over its loads."""
    quantity_name(name)
    values: Real | None = getattr(curve, name, None)
    if values is None:
        raise InputError(
            f"this curve has no {name}: the glossary says which model gives which quantity"
        )
    return values.astype(np.float64)


def _label(curve: Curve, name: str, values: Real) -> tuple[str, float]:
    """Return the label of a quantity's axis, and the factor to the unit in it."""
    return in_unit(quantity_name(name), values, QUANTITIES[name].unit_in(curve.unit))


def quantity_name(quantity: str) -> str:
    """Name a quantity over the loads in words, with its symbol."""
    known = [
        name
        for name, declared in QUANTITIES.items()
        if declared.dims == OVER_LOADS and declared.dimension is not None
    ]
    if quantity not in known:
        raise InputError(
            f"there is no quantity {quantity!r} over the loads; allowed are {', '.join(known)}"
        )
    if quantity == "force_bar":
        return FORCE_LABEL
    symbol = QUANTITIES[quantity].symbol
    words = quantity.removesuffix("_bar").replace("_", " ")
    return f"{words} ${symbol}$" if symbol else words
