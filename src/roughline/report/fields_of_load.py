"""What the fields of one load say: gap, pressure and contact patches, drawn and in a table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from roughline.plot.distributions import draw_distribution, draw_patches
from roughline.plot.style import PAGE, new_figure, save
from roughline.report.contact_figures import load_with_fields
from roughline.report.page import Picture, Section, Table
from roughline.units import decimal, engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.contact.fields import Fields

_DIGITS = 3  # of statistics of one map
_CAPTION = (
    "Density of the gap over the nominal area, without the points in contact, and of the pressure "
    "in contact, without the points at the hardness (bins chosen by the data: Freedman and "
    "Diaconis); number of contact patches of at least an area. Points that meet at a corner belong "
    "to one patch. Values of the map, on its grid: waves finer than its pixels would part the "
    "patches further and raise the pressures."
)


def write_fields(assessment: Assessment, folder: Path) -> tuple[list[Section], list[Path]]:
    """Write the figure of the load whose fields are kept; returns its section and the files.

    There are none where no fields are kept.
    """
    load = load_with_fields(assessment.curve)
    if load is None:
        return [], []
    fields = assessment.curve.fields[load]
    assert fields is not None
    files = save(fields_figure(fields), folder, "distributions")
    force = engineering(assessment.curve.force[load] * assessment.scale, "N")
    section = Section(
        f"Gap, pressure and contact patches at {force}",
        tables=[Table(*fields_table(fields))],
        pictures=[Picture(files[0], "Distributions", _CAPTION)],
        behind="how far the bodies are apart, and where the load is borne",
    )
    return [section], files


def fields_figure(fields: Fields) -> Figure:
    """Three panels: the distributions of gap and pressure, and the patches; lengths in metres."""
    figure = new_figure(PAGE, 2.6)
    left, middle, right = figure.subplots(1, 3)
    draw_distribution(left, fields, "gap", "m")
    draw_distribution(middle, fields, "pressure", "m")
    draw_patches(right, fields, "m")
    return figure


def fields_table(fields: Fields) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of what the figure shows in numbers; lengths in metres."""
    gap, pressure = fields.distribution("gap"), fields.distribution("pressure")
    rows = [
        ["mean gap", engineering(gap.mean, "m", _DIGITS)],
        ["standard deviation of the gap", engineering(gap.std, "m", _DIGITS)],
        ["largest gap", engineering(gap.edges[-1], "m", _DIGITS)],
    ]
    patches = fields.patches()
    if patches.count:
        in_contact = pressure.mean / (1 - pressure.at_zero)
        share = 100 * patches.forces[0] / patches.forces.sum()
        largest = engineering(patches.areas[0], "m²", _DIGITS)
        rows += [
            ["mean pressure in contact", engineering(in_contact, "Pa", _DIGITS)],
            ["highest pressure", engineering(fields.pressure.max(), "Pa", _DIGITS)],
            ["contact patches", str(patches.count)],
            ["largest patch", f"{largest}, bears {decimal(share, _DIGITS)}% of the force"],
        ]
    return ["", "value on the map"], rows
