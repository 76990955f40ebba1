"""Pictures of bodies: their heights, and at one load where they touch and with which pressure."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from roughline.computing.arrays import Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.status import Status
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.plot.pixels import draw_map, thinned
from roughline.plot.style import drawing_on, in_unit, say
from roughline.topography.body import Body, Surface
from roughline.units import decimal, digits_known, in_words

_GAP_ELASTIC_PLASTIC = ListedColormap(["white", "black", "tab:red"])
_TITLE_SIZE = 8  # [pt]


@public
def topography(body: Body, axes: Axes | None = None) -> Axes:
    """Draw the heights of a body about their mean.

    Parameters
    ----------
    body : Surface or Line
        What is drawn; a surface from above, in colours, x to the right and y from the top
        downwards, as instruments' software shows it.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        The axes that were drawn on.
    """
    with drawing_on(axes) as drawn:
        draw_heights(drawn, body, body.unit)
    return drawn


def draw_heights(axes: Axes, body: Body, unit: str | None) -> None:
    """Draw heights about their mean, where lengths have a given unit."""
    deviation = body.heights - body.heights.mean()
    label, factor = in_unit("height", deviation, unit)
    if isinstance(body, Surface):
        _draw_scale(axes, deviation * factor, body.sizes, unit, label)
        return
    along, size = in_unit("x", body.length, unit)
    x = (np.arange(deviation.size) + 0.5) * body.spacing * size
    axes.plot(x, deviation * factor, color="k", linewidth=0.6)
    axes.set(xlabel=along, ylabel=label)


def _draw_scale(
    axes: Axes,
    values: Real,
    sizes: tuple[float, float],
    unit: str | None,
    label: str,
    cmap: str = "cividis",
) -> None:
    """Draw values on a map with a colour bar."""
    image = draw_map(axes, thinned(values), sizes, unit, cmap=cmap)
    assert axes.figure is not None
    axes.figure.colorbar(image, ax=axes, label=label, shrink=0.85)


@public
def contact(curve: SurfaceCurve, load: int = -1, axes: Axes | None = None) -> Axes:
    """Draw the real contact area at one load: black, and red where points are at the hardness.

    Parameters
    ----------
    curve : SurfaceCurve
        Of a surface, pressed with ``fields=True``.
    load : int, optional
        Number of the load, from 0; negative ones count from the last.
    axes : Axes, optional
        Where to draw; default: those of a new figure.

    Returns
    -------
    Axes
        What was drawn on. Of a load that was not solved it says so.

    Raises
    ------
    InputError
        If the curve has no fields, or no such load.
    """
    return drawn_at(curve, load, axes, _draw_contact_with_key)


@public
def pressure(curve: SurfaceCurve, load: int = -1, axes: Axes | None = None) -> Axes:
    """Draw the pressure at one load; white where the bodies do not touch.

    Parameters
    ----------
    curve, load, axes
        As of :func:`roughline.plot.contact`, with what it returns and refuses.
    """
    return drawn_at(curve, load, axes, draw_pressure)


def draw_contact(axes: Axes, fields: Fields, unit: str | None) -> None:
    """Draw where bodies touch, and where they yield, where lengths have a given unit."""
    marks = fields.contact.astype(int) + fields.plastic
    look: Any = {"cmap": _GAP_ELASTIC_PLASTIC, "vmin": 0, "vmax": 2, "interpolation": "nearest"}
    draw_map(axes, marks, fields.sizes, unit, **look)


def _draw_contact_with_key(axes: Axes, fields: Fields, unit: str | None) -> None:
    """Draw where bodies touch, and explain red in the title."""
    draw_contact(axes, fields, unit)
    axes.set_title(axes.get_title() + yield_key(fields), fontsize=_TITLE_SIZE)


def draw_pressure(axes: Axes, fields: Fields, unit: str | None) -> None:
    """Draw the pressure where bodies touch."""
    of_pressure = "Pa" if unit == "m" else None
    label, factor = in_unit("pressure $p$", fields.pressure, of_pressure)
    pressure = np.where(fields.contact, fields.pressure * factor, np.nan)
    _draw_scale(axes, pressure, fields.sizes, unit, label, "viridis_r")


def drawn_at(
    curve: SurfaceCurve,
    load: int,
    axes: Axes | None,
    draw: Callable[[Axes, Fields, str | None], None],
) -> Axes:
    """Draw the fields of a load under its title, or say why there are none."""
    fields = _at_load(curve, load)
    with drawing_on(axes) as drawn:
        if fields is None:
            number = load % curve.status.size
            say(drawn, f"load {number} was not solved\n{Status(curve.status[load]).reason}")
        else:
            drawn.set_title(_title(curve, load), fontsize=_TITLE_SIZE)
            draw(drawn, fields, curve.unit)
    return drawn


def yield_key(fields: Fields) -> str:
    """Return the line of a title that explains red; empty where nothing yields."""
    return "\nred: at the hardness" if fields.plastic.any() else ""


def _title(curve: SurfaceCurve, load: int) -> str:
    force = in_words(float(curve.force[load]), "N" if curve.unit == "m" else None)
    area, errors = float(curve.area_fraction_corrected[load]), curve.area_fraction_error
    digits = digits_known(area, None if errors is None else float(errors[load]))
    share = decimal(100 * area, digits)
    return f"corrected area {share}% at $F$ = {force}"


def _at_load(curve: SurfaceCurve, load: int) -> Fields | None:
    """Return the fields of a load; None where it was not solved."""
    if not curve.fields:
        raise InputError("this curve has no fields: press with fields=True")
    count = len(curve.fields)
    if not -count <= load < count:
        raise InputError(f"load is {load}; the curve has loads 0 to {count - 1}")
    return curve.fields[load]
