"""Pictures of how gap and pressure are distributed at one load, and of the contact's patches."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Literal

import numpy as np
from matplotlib.axes import Axes

from roughline.contact.curve import SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.quantities import QUANTITIES
from roughline.errors.checks import allowed_choice
from roughline.errors.public import public
from roughline.plot.bodies import drawn_at
from roughline.plot.style import in_unit, label_decades, say
from roughline.units import decimal, in_words

_BAR_COLOUR = "0.75"
_DIGITS = 3  # of what is written in a picture
_TITLE_SIZE = 8  # [pt]


@public
def distribution(
    curve: SurfaceCurve, of: Literal["gap", "pressure"], load: int = -1, axes: Axes | None = None
) -> Axes:
    """Draw how the gap at one load is distributed over the area, or the pressure in contact.

    The picture shows the density of :meth:`Fields.distribution`, that of the pressure over its
    share in contact; with that share, and the share of it at the hardness, in words.

    Parameters
    ----------
    curve, load, axes
        As of :func:`roughline.plot.contact`, with what it returns and refuses.
    of : {"gap", "pressure"}
        What is distributed.
    """
    allowed_choice("of", of, ("gap", "pressure"))
    return drawn_at(curve, load, axes, partial(draw_distribution, of=of))


@public
def patches(curve: SurfaceCurve, load: int = -1, axes: Axes | None = None) -> Axes:
    """Draw how many contact patches at one load are at least so large, over their area.

    Parameters
    ----------
    curve, load, axes
        As of :func:`roughline.plot.contact`, with what it returns and refuses.
    """
    return drawn_at(curve, load, axes, draw_patches)


def draw_distribution(
    axes: Axes, fields: Fields, unit: str | None, of: Literal["gap", "pressure"]
) -> None:
    """Draw the density of the gap, or of the pressure in contact, where lengths have a unit."""
    found, declared = fields.distribution(of), QUANTITIES[of]
    own = declared.unit_in(unit)
    label, factor = in_unit(f"{of} ${declared.symbol}$", found.edges, own)
    in_contact = found.at_zero if of == "gap" else 1 - found.at_zero
    if not in_contact and of == "pressure":
        say(axes, "no contact")
        return
    area = 1.0 if of == "gap" else in_contact
    density = found.density / area / factor
    axes.stairs(density, found.edges * factor, fill=True, color=_BAR_COLOUR)
    axes.stairs(density, found.edges * factor, color="k", linewidth=0.8)
    axes.axvline(found.mean / area * factor, color="tab:blue", linestyle="--")
    mean = in_words(found.mean / area, own if "[" in label else None, _DIGITS)
    remarks = [f"dashed: mean {mean}", f"{_percent(in_contact)} of the cells in contact"]
    if found.at_hardness:
        remarks.append(f"{_percent(found.at_hardness / in_contact)} of them at the hardness")
    _tell(axes, remarks)
    where = "" if of == "gap" else " in contact"
    axes.set(xlabel=label, ylabel=f"density{where}{_per(label)}")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)


def draw_patches(axes: Axes, fields: Fields, unit: str | None) -> None:
    """Draw the number of patches of at least an area, where lengths have a given unit."""
    found = fields.patches()
    if not found.count:
        say(axes, "no contact")
        return
    square = None if unit is None else f"{unit}²"
    label, factor = in_unit("area of a patch", found.areas, square)
    # the last of equal patches tells how many there are
    areas, fewer = np.unique(-found.areas, return_index=True)
    at_least = np.append(fewer[1:], found.count)
    axes.loglog(-areas * factor, at_least, "o", color="k")
    label_decades(axes)
    share = _percent(found.forces[0] / found.forces.sum())
    many = f"{found.count} patches; the largest" if found.count > 1 else "1 patch, which"
    _tell(axes, [many, f"bears {share} of the force"])
    axes.set(xlabel=label, ylabel="patches at least as large")


def _tell(axes: Axes, lines: Sequence[str]) -> None:
    """Write lines above axes, below a title that they have."""
    title = axes.get_title()
    axes.set_title("\n".join([title] * bool(title) + [*lines]), fontsize=_TITLE_SIZE)


def _percent(share: float) -> str:
    return f"{decimal(100 * share, _DIGITS)}%"


def _per(label: str) -> str:
    """The unit of a density over the unit in a label; empty without one."""
    _, bracket, unit = label.partition(" [")
    return f" [1/{unit}" if bracket else ""
