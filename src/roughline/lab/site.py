"""The lab as a server serves it."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from roughline.lab.page import login_page, page
from roughline.lab.server.site import Site
from roughline.lab.tasks import TASKS


def site() -> Site:
    """Return the lab: its page, parts and tasks."""
    return Site(
        page=page,
        login_page=login_page,
        parts=Path(str(files("roughline.lab").joinpath("static"))),
        tasks=TASKS,
        warm="roughline.lab.warm",
    )
