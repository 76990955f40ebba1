"""Where a fluid goes through the gap under one load, drawn."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from roughline.plot.flows import draw_flow
from roughline.plot.style import PAGE, new_figure, save
from roughline.report.contact_figures import load_with_fields
from roughline.report.page import Picture, Section
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment

_CAPTION = (
    "Flux over its mean, on the gap of the map; black: contact. A ring marks where the fluid is "
    "throttled most, near sealing the last channel."
)


def write_flow(assessment: Assessment, folder: Path) -> tuple[list[Section], list[Path]]:
    """Write the figure of the load whose fields are kept; returns its section and the files.

    There are none without a fluid, and where no fields are kept.
    """
    load = load_with_fields(assessment.curve)
    if load is None or not assessment.flows:
        return [], []
    files = save(flow_figure(assessment), folder, "flow")
    force = engineering(assessment.curve.force[load] * assessment.scale, "N")
    sides = f"The other two sides are {assessment.flows[0].sides}."
    section = Section(
        f"Where the fluid goes at {force}",
        pictures=[Picture(files[0], "Flow", f"{_CAPTION} {sides}")],
        behind="where it goes, and where it is throttled",
    )
    return [section], files


def flow_figure(assessment: Assessment) -> Figure:
    """One panel for each direction that is asked for."""
    figure = new_figure(PAGE, 3.2)
    for axes, flow in zip(figure.subplots(1, 2), assessment.flows, strict=False):
        draw_flow(axes, flow, "m")
    for empty in figure.axes[len(assessment.flows) : 2]:
        empty.set_axis_off()
    return figure
