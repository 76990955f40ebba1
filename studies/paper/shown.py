"""What the lab shows of the paper's study that does not change: Figures 1 and 2, and the claims."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import xarray
from matplotlib.figure import Figure

from roughline.paper.claims import judge_claims
from roughline.paper.claims_section import HOW_JUDGED
from roughline.paper.figures import body_figure, body_name, indented_figure
from roughline.paper.results import PaperResults
from roughline.paper.studies import StudyPicture, StudySummary

_BASIS = "Window, averaging, grid"
_BODY, _LINE = (880, 840), (700, 480)  # sizes of the pictures [pixel]


def summary(results: PaperResults) -> StudySummary:
    """Return the claims with their verdicts, and the words of the pictures."""
    header = ("The paper says", "Found here", "95 % interval", "Allowed", _BASIS, "Verdict")
    rows = [
        (each.statement, each.found, each.interval, each.allowed, each.basis, each.cases)
        for each in judge_claims(results)
    ]
    gallery = _gallery(results)
    bodies = [_body(gallery, row) for row in range(gallery.sizes["fractal_dimension"])]
    pictures = [*bodies, _indented(gallery)]
    return StudySummary("paper", "The paper's claims", HOW_JUDGED, header, rows, pictures)


def drawings(results: PaperResults) -> list[Callable[[], Figure]]:
    """Return how the pictures are drawn, in the order of the summary."""
    gallery = _gallery(results)
    rows = range(gallery.sizes["fractal_dimension"])
    return [
        *(partial(body_figure, gallery, row) for row in rows),
        partial(indented_figure, gallery),
    ]


def _gallery(results: PaperResults) -> xarray.Dataset:
    assert results.gallery is not None
    return results.gallery


def _body(gallery: xarray.Dataset, row: int) -> StudyPicture:
    """Tell what a row of Figure 1 shows."""
    body = gallery.isel(fractal_dimension=row)
    contact, deepest = float(body.contact.mean()), float(body.displacement.max())
    return StudyPicture(
        f"paper-{row}",
        f"Figure 1 {body_name(gallery, row)}",
        "Rough line, topography, real contact area and deflection of the half-space under the "
        f"force F̄ = {gallery.attrs['force_bar']:g}: {contact:.1%} of {gallery.attrs['n']}² points "
        f"touch (dark: squares of 1/128 of the side with some contact), and the deflection reaches "
        f"{deepest:.2f} h.",
        f"Four pictures of one body: its line has heights from {float(body.line_heights.min()):.2f}"
        f" to {float(body.line_heights.max()):.2f} h, its surface from "
        f"{float(body.heights.min()):.2f} to {float(body.heights.max()):.2f} h; the contact is "
        f"{contact:.1%} of the area, in patches that are the finer the larger the fractal "
        f"dimension is; the deflection is largest, {deepest:.2f} h, where the contact is.",
        _BODY,
    )


def _indented(gallery: xarray.Dataset) -> StudyPicture:
    """Tell what Figure 2 shows."""
    body = gallery.isel(fractal_dimension=1)
    level = float(body.line_heights.max() - body.line_depth)
    share = float((body.line_heights > level).mean())
    return StudyPicture(
        "paper-line",
        "Figure 2: the indented line",
        "Springs under the parts above the level are in contact (bars); their total length gives "
        "the stiffness, the shaded area the force.",
        f"The line of Figure 1 {body_name(gallery, 1)} and a level at z = {level:.2f} h, "
        f"{float(body.line_depth):.2f} h below the highest point: {share:.1%} of the springs "
        "touch.",
        _LINE,
    )
