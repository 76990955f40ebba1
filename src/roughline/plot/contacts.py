"""Pictures of one load: where the bodies touch, and with which pressure."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from roughline.contact.curve import Curve
from roughline.contact.fields import Fields
from roughline.contact.status import Status
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.plot.bodies import draw_map, extent, label_sides
from roughline.plot.style import drawing_on
from roughline.plot.units import in_unit
from roughline.topography.body import Surface
from roughline.units import decimal, digits_known, in_words

_GAP_ELASTIC_PLASTIC = ListedColormap(["white", "black", "tab:red"])
_TITLE = 8  # font size [pt]


@public
def contact(curve: Curve, load: int = -1, axes: Axes | None = None) -> Axes:
    """Draw the real contact area at one load: black, and red where points are at the hardness.

    Parameters
    ----------
    curve : Curve
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
    surface, fields = _at_load(curve, load)
    with drawing_on(axes) as drawn:
        if fields is None:
            _say_unsolved(drawn, curve, load)
        else:
            draw_contact(drawn, surface, fields, surface.unit)
            drawn.set_title(_title(curve, load, fields), fontsize=_TITLE)
    return drawn


@public
def pressure(curve: Curve, load: int = -1, axes: Axes | None = None) -> Axes:
    """Draw the pressure at one load; white where the bodies do not touch.

    Parameters
    ----------
    curve : Curve
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
    surface, fields = _at_load(curve, load)
    with drawing_on(axes) as drawn:
        if fields is None:
            _say_unsolved(drawn, curve, load)
        else:
            label, factor = in_unit("pressure $p$", fields.pressure, _unit_of_pressure(surface))
            shown = np.where(fields.contact, fields.pressure * factor, np.nan)
            draw_map(drawn, surface, surface.unit, shown, label, "viridis_r")
            drawn.set_title(_title(curve, load, fields), fontsize=_TITLE)
    return drawn


def draw_contact(axes: Axes, surface: Surface, fields: Fields, unit: str | None) -> None:
    """Draw where bodies touch, and where they yield, where lengths have a given unit."""
    axes.imshow(
        fields.contact.T.astype(int) + fields.plastic.T,
        origin="lower",
        extent=extent(surface, unit),
        cmap=_GAP_ELASTIC_PLASTIC,
        vmin=0,
        vmax=2,
        interpolation="nearest",
    )
    label_sides(axes, surface, unit)


def _say_unsolved(axes: Axes, curve: Curve, load: int) -> None:
    """Write on empty axes that a load was not solved, and why."""
    number = load % curve.status.size
    say(axes, f"load {number} was not solved\n{Status(curve.status[load]).reason}")


def say(axes: Axes, text: str) -> None:
    """Write a text in the middle of axes."""
    axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes, wrap=True)


def yield_key(fields: Fields) -> str:
    """Return the line of a title that explains red; empty where nothing yields."""
    return "\nred: at the hardness" if fields.plastic.any() else ""


def _title(curve: Curve, load: int, fields: Fields) -> str:
    assert curve.area_fraction_corrected is not None
    force = in_words(float(curve.force[load]), "N" if curve.unit == "m" else None)
    area, errors = float(curve.area_fraction_corrected[load]), curve.area_fraction_error
    digits = digits_known(area, None if errors is None else float(errors[load]))
    share = decimal(100 * area, digits)
    return f"corrected area {share}% at $F$ = {force}{yield_key(fields)}"


def _unit_of_pressure(surface: Surface) -> str | None:
    return "Pa" if surface.unit == "m" else None


def _at_load(curve: Curve, load: int) -> tuple[Surface, Fields | None]:
    """Return the surface of a curve and the fields of a load; None where it was not solved."""
    if curve.surface is None:
        raise InputError(
            "this curve is of a line: the reduced model gives no contact area and no pressure"
        )
    if not curve.fields:
        raise InputError("this curve has no fields: press with fields=True")
    count = len(curve.fields)
    if not -count <= load < count:
        raise InputError(f"load is {load}; the curve has loads 0 to {count - 1}")
    return curve.surface, curve.fields[load]
