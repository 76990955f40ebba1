"""The lab as a server serves it: its page, and its tasks by the names that the page knows."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path

from roughline.lab.page import login_page, page
from roughline.lab.server.tasks import Place, Site


def _place(
    module: str, function: str, *, is_quick: bool = False, reads_files: bool = False
) -> Place:
    """The place of a task in this package."""
    return Place(f"roughline.lab.{module}", function, is_quick, reads_files)


TASKS: Mapping[str, Place] = {
    "explore.reduced": _place("explore.pictures", "reduced", is_quick=True),
    "explore.coarse": _place("explore.pictures", "coarse", is_quick=True),
    "explore.full": _place("explore.pictures", "full"),
    "explore.curve": _place("explore.pictures", "curve"),
    "explore.unloading": _place("explore.pictures", "unloading"),
    "explore.code": _place("explore.code", "code", is_quick=True),
    "explore.download": _place("explore.downloads", "download"),
    "measured.look": _place("measured.file", "look", reads_files=True),
    "measured.maps": _place("measured.part", "maps", reads_files=True),
    "measured.prepare": _place("measured.file", "prepare", reads_files=True),
    "measured.bodies": _place("measured.bodies", "bodies", is_quick=True),
    "measured.answer": _place("measured.answers", "answer", reads_files=True),
    "measured.compare": _place("measured.answers", "compare", reads_files=True),
    "measured.report": _place("measured.documents", "report", reads_files=True),
    "measured.code": _place("measured.documents", "code", reads_files=True),
    "published.curves": _place("published.stiffness", "curves", is_quick=True),
    "published.fits": _place("published.stiffness", "fits", is_quick=True),
    "published.exponents": _place("published.laws", "exponents", is_quick=True),
    "published.area": _place("published.laws", "area", is_quick=True),
    "published.trust": _place("published.trust", "trust", is_quick=True),
    "published.point": _place("published.trust", "point", is_quick=True),
    "published.claims": _place("published.laws", "claims"),
    "published.studies": _place("published.laws", "studies", is_quick=True),
    "published.body": _place("published.bodies", "body"),
}
"""All tasks by name."""


def site() -> Site:
    """Return the lab: its page, parts and tasks."""
    return Site(
        page=page,
        login_page=login_page,
        parts=Path(str(files("roughline.lab").joinpath("static"))),
        tasks=TASKS,
        warm="roughline.lab.warm",
    )
