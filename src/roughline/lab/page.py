"""The page as HTML, made from templates and from the declared controls."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

import jinja2
from markupsafe import Markup, escape

import roughline as rl
from roughline.engineering.materials import materials
from roughline.lab.explore import controls as explore
from roughline.lab.measured import controls as measured
from roughline.lab.measured.examples import EXAMPLES
from roughline.lab.published import controls as published
from roughline.paper.studies import study_summaries

_SUBSCRIPT = re.compile(r"_(\w)")


@cache
def page() -> str:
    """Return the page; it is the same for everyone."""
    template = _environment().get_template("index.html.jinja")
    return template.render(
        version=rl.__version__,
        explore=explore,
        measured=measured,
        published=published,
        examples=EXAMPLES,
        materials=list(materials()),
        studies=study_summaries(),
    )


def login_page(asks_token: bool, complaint: str, leads_to: str) -> str:
    """Return the page that asks for the token or password, with a word on what was wrong."""
    template = _environment().get_template("login.html.jinja")
    return template.render(asks_token=asks_token, complaint=complaint, leads_to=leads_to)


@cache
def _environment() -> jinja2.Environment:
    folder = str(files("roughline.lab").joinpath("templates"))
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder), autoescape=True, undefined=jinja2.StrictUndefined
    )
    environment.filters["subscripts"] = _subscripts
    return environment


def _subscripts(symbol: str) -> Markup:
    """A symbol such as D_f or λ_r/L, with its letters after an underscore set low."""
    return Markup(_SUBSCRIPT.sub(r"<sub>\1</sub>", str(escape(symbol))))
