"""What the fields of one load say: where a fluid goes; gap, pressure and contact patches."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from roughline.contact.selection import loads_with_fields
from roughline.plot.distributions import draw_distribution, draw_patches
from roughline.plot.flows import draw_flow
from roughline.plot.sliding import draw_loop, draw_stick_and_slip
from roughline.plot.style import PAGE, new_figure, save
from roughline.report.page import Picture, Section, Table
from roughline.report.values import length
from roughline.units import decimal, engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.contact.fields import Fields
    from roughline.engineering.slip import ShearCycles

_DIGITS = 3  # of statistics of one map
_FLOW_CAPTION = (
    "Flux over its mean, on the gap of the map; black: contact. A ring marks where the fluid is "
    "throttled most, near sealing the last channel."
)
_SIDES_IN_WORDS = {
    "periodic": "The map repeats along both sides.",
    "closed": "The other two sides are closed.",
    "x": "The map repeats along x; along y it has an inlet and an outlet, or is closed.",
    "y": "The map repeats along y; along x it has an inlet and an outlet, or is closed.",
}
_DISTRIBUTIONS_CAPTION = (
    "Density of the gap over the nominal area, without the points in contact, and of the pressure "
    "in contact, without the points at the hardness (bins chosen by the data: Freedman and "
    "Diaconis); number of contact patches of at least an area. Points that meet at a corner belong "
    "to one patch. Values of the map, on its grid: waves finer than its pixels would part the "
    "patches further and raise the pressures."
)


def write_fields(assessment: Assessment, folder: Path) -> tuple[list[Section], list[Path]]:
    """Write figures of the load whose fields are kept; returns their sections and the files.

    There are none where no fields are kept.
    """
    pressed = loads_with_fields(assessment.curve)
    if not pressed:
        return [], []
    load, fields = pressed[-1]
    force = engineering(assessment.curve_over_loads.force[load] * assessment.scale, "N")
    files = save(fields_figure(fields), folder, "distributions")
    sections = [
        Section(
            f"Gap, pressure and contact patches at {force}",
            tables=[Table(*fields_table(fields))],
            pictures=[Picture(files[0], "Distributions", _DISTRIBUTIONS_CAPTION)],
            behind="how far the bodies are apart, and where the load is borne",
        )
    ]
    if assessment.flows:
        files += save(flow_figure(assessment), folder, "flow")
        of_flow = Section(
            f"Where the fluid goes at {force}",
            pictures=[Picture(files[2], "Flow", _flow_caption(assessment, load))],
            behind="where it goes, and where it is throttled",
        )
        sections.insert(0, of_flow)
    if (sheared := assessment.sought.sheared) is not None:
        drawn = save(shear_figure(sheared), folder, "stick_and_slip")
        shear = engineering(sheared.amplitude * assessment.scale, "N")
        of_shear = Section(
            f"Stick and slip at {force}, sheared by {shear}",
            pictures=[Picture(drawn[0], "Stick and slip", _shear_caption(assessment, sheared))],
            behind="the loop of shear force and slide, and where the contact slips",
        )
        sections, files = [of_shear, *sections], [*files, *drawn]
    return sections, files


def _shear_caption(assessment: Assessment, sheared: ShearCycles) -> str:
    """Say what the pictures of a shear force show."""
    of_map = " on the map" if assessment.question.joint is not None else ""
    return (
        f"Left: shear force{of_map} along x over the slide of the first body, to and fro; what the "
        "last cycle dissipates is filled. Right: black where the contact never slips in it, orange "
        "where it does, white where the bodies are apart; if all of the contact lies in a small "
        "piece of the map, that is shown; arrows along the last slip, one for each place, "
        f"the longest {engineering(_last_slip(sheared), 'm', _DIGITS)}."
    )


def _last_slip(sheared: ShearCycles) -> float:
    """The longest slip of a point in the last load. [m]"""
    fields = sheared.fields
    return 0.0 if fields is None else float(np.hypot(*np.moveaxis(fields.slip, -1, 0)).max())


def shear_figure(sheared: ShearCycles) -> Figure:
    """Two panels: the loop of shear force and slide, and where the contact sticks and slips."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    curve, fields, never = sheared.curve, sheared.fields, sheared.never_slips
    draw_loop(left, curve.slide[:, 0], curve.shear_force[:, 0], sheared.per_cycle)
    if fields is not None and never is not None:
        draw_stick_and_slip(right, fields, never, "m")
    return figure


def _flow_caption(assessment: Assessment, load: int) -> str:
    """Say what the pictures of the flow show."""
    text = f"{_FLOW_CAPTION} {_SIDES_IN_WORDS[assessment.flows[0].sides]}"
    text += " Apertures are those of the map, to three digits whatever is open of them."
    sealing = assessment.question.sealing
    if sealing is not None and sealing.free_path:
        of_map = {
            each.along: assessment.measured[f"hydraulic_aperture_{each.along}"].values[load]
            for each in assessment.flows
        }
        apertures = [f"{engineering(u, 'm', _DIGITS)} along {along}" for along, u in of_map.items()]
        gas = sealing.medium.name
        text += (
            f" They are those of {gas} at its mean pressure: u_s is the gap of flat "
            "plates between which as much of a liquid would flow; between which as much of the gas "
            f"flows along the seal, it is {' and '.join(apertures)}."
        )
    if assessment.fields_of_gap is not assessment.fields:
        text += " The map is pressed repeated on all sides here, as for the answers about its gap."
    return text


def flow_figure(assessment: Assessment) -> Figure:
    """One panel for each direction in which a fluid flows; lengths in metres."""
    figure = new_figure(PAGE, 3.2)
    for axes, flow in zip(figure.subplots(1, 2), assessment.flows, strict=False):
        draw_flow(axes, flow, "m")
    for empty in figure.axes[len(assessment.flows) : 2]:
        empty.set_axis_off()
    return figure


def fields_figure(fields: Fields) -> Figure:
    """Three panels: the distributions of gap and pressure, and the patches; lengths in metres."""
    figure = new_figure(PAGE, 2.6)
    left, middle, right = figure.subplots(1, 3)
    draw_distribution(left, fields, "m", "gap")
    draw_distribution(middle, fields, "m", "pressure")
    draw_patches(right, fields, "m")
    return figure


def fields_table(fields: Fields) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of what the figure shows in numbers; lengths in metres."""
    gap, pressure = fields.distribution("gap"), fields.distribution("pressure")
    rows = [
        ["mean gap", length(gap.mean, _DIGITS)],
        ["standard deviation of the gap", length(gap.std, _DIGITS)],
        ["largest gap", length(gap.edges[-1], _DIGITS)],
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
