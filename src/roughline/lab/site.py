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
    "explore.reduced": Place(tasks.load_explore_pictures, "reduced", is_quick=True),
    "explore.coarse": Place(tasks.load_explore_pictures, "coarse", is_quick=True),
    "explore.full": Place(tasks.load_explore_pictures, "full"),
    "explore.curve": Place(tasks.load_explore_pictures, "curve"),
    "explore.further": Place(tasks.load_explore_pictures, "further"),
    "explore.code": Place(tasks.load_explore_code, "code", is_quick=True),
    "explore.download": Place(tasks.load_explore_downloads, "download"),
    "measured.look": Place(tasks.load_measured_file, "look", reads_files=True),
    "measured.maps": Place(tasks.load_measured_part, "maps", reads_files=True),
    "measured.prepare": Place(tasks.load_measured_file, "prepare", reads_files=True),
    "measured.bodies": Place(tasks.load_measured_bodies, "bodies", is_quick=True),
    "measured.answer": Place(tasks.load_measured_answers, "answer", reads_files=True),
    "measured.compare": Place(tasks.load_measured_answers, "compare", reads_files=True),
    "measured.report": Place(tasks.load_measured_documents, "report", reads_files=True),
    "measured.code": Place(tasks.load_measured_documents, "code", reads_files=True),
    "published.fits": Place(tasks.load_published_fits, "fits", is_quick=True),
    "published.point": Place(tasks.load_published_trust, "point", is_quick=True),
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
