"""The lab as a server serves it: its page, and its tasks by the names that the page knows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from functools import cache
from importlib.resources import files
from pathlib import Path

import jinja2

import roughline as rl
from roughline.engineering.fluids import fluids
from roughline.engineering.materials import materials
from roughline.lab import tasks
from roughline.lab.explore import controls as explore
from roughline.lab.explore import physics
from roughline.lab.measured import controls as measured
from roughline.lab.measured.examples import EXAMPLES
from roughline.lab.measured.panels import PANELS as MEASURED
from roughline.lab.published import controls as published
from roughline.lab.published.panels import PANELS as PUBLISHED
from roughline.lab.server.tasks import Place, Site
from roughline.report.typeset import typeset

_PANELS = {"measured": MEASURED, "published": PUBLISHED}


TASKS: Mapping[str, Place] = {
    "explore.coarse": Place(tasks.explore, "coarse", is_quick=True),
    "explore.full": Place(tasks.explore, "full"),
    "explore.curve": Place(tasks.explore, "curve"),
    "explore.further": Place(tasks.explore, "further"),
    "explore.code": Place(tasks.explore, "code", is_quick=True),
    "explore.download": Place(tasks.explore_downloads, "download"),
    "measured.look": Place(tasks.measured, "look", reads_files=True),
    "measured.maps": Place(tasks.measured, "maps", reads_files=True),
    "measured.prepare": Place(tasks.measured, "prepare", reads_files=True),
    "measured.bodies": Place(tasks.measured, "bodies", is_quick=True),
    "measured.answer": Place(tasks.measured, "answer", reads_files=True),
    "measured.compare": Place(tasks.measured, "compare", reads_files=True),
    "measured.report": Place(tasks.measured_documents, "report", reads_files=True),
    "measured.code": Place(tasks.measured_documents, "code", reads_files=True),
    "published.fits": Place(tasks.published, "fits", is_quick=True),
    "published.point": Place(tasks.published, "point", is_quick=True),
}
"""All tasks by name."""


def site() -> Site:
    """Return the lab: its page, parts and tasks."""
    return Site(
        page=page,
        door=_door,
        parts=Path(str(files("roughline.lab").joinpath("static"))),
        tasks=TASKS,
    )


@cache
def page() -> str:
    """Return the page; it is the same for everyone."""
    template = _environment().get_template("index.html.jinja")
    return template.render(
        version=rl.__version__,
        explore=explore,
        physics=physics,
        measured=measured,
        published=published,
        panels={view: {each.key: each for each in some} for view, some in _PANELS.items()},
        declared={
            "explore": physics.declared(),
            **{view: {"panels": list(map(asdict, some))} for view, some in _PANELS.items()},
        },
        examples=EXAMPLES,
        materials=list(materials()),
        fluids=list(fluids()),
    )


def _door(complaint: str) -> str:
    """Return the page that asks for the token, with a word on what was wrong."""
    return _environment().get_template("door.html.jinja").render(complaint=complaint)


@cache
def _environment() -> jinja2.Environment:
    folder = str(files("roughline.lab").joinpath("templates"))
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder), autoescape=True, undefined=jinja2.StrictUndefined
    )
    environment.filters |= {"typeset": typeset}
    return environment
