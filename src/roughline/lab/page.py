"""The page as HTML, made from templates and from the declared controls."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

import jinja2

from roughline._version import __version__
from roughline.engineering.materials import materials
from roughline.lab.explore import controls as explore
from roughline.lab.measured import controls as measured


@cache
def page() -> str:
    """Return the page; it is the same for everyone."""
    return (
        _environment()
        .get_template("index.html.jinja")
        .render(
            version=__version__, explore=explore, measured=measured, materials=list(materials())
        )
    )


def login_page(complaint: str) -> str:
    """Return the page that asks for the password, with a word on what was wrong."""
    return _environment().get_template("login.html.jinja").render(complaint=complaint)


@cache
def _environment() -> jinja2.Environment:
    folder = str(files("roughline.lab").joinpath("templates"))
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder), autoescape=True, undefined=jinja2.StrictUndefined
    )
