"""Bodies that stick: what it takes to draw them apart once their largest load was on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.separation import Separation
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Rule, always
from roughline.engineering.symbols import nominal_area
from roughline.facts.fact import Fact
from roughline.halfspace.laws.adhesive import Adhesive
from roughline.units import engineering

_FULL_PULL_SHARE = 0.99  # of the largest pull over the nominal area, from which on it is all of it
_AFTER = "after the largest load, slowly, so that nothing swings"


def _found(of: Callable[[Separation, Pressed], Real], pressed: Pressed) -> Real | None:
    """What was found after the largest load, the same under all loads, in rows.

    There is no interval where the grid chose the range: it holds the error of that grid at that
    range, and another grid chooses another.
    """
    separation = pressed.sought.separation
    if pressed.attraction is None:
        return None
    if separation is None:
        return np.full(pressed.curve.status.size, np.nan)
    rows = of(separation, pressed)
    if pressed.attraction.range is None or not np.isfinite(rows).all():
        rows = rows[:1]
    return np.where(pressed.curve.converged, rows[:, np.newaxis], np.nan)


def _why_unknown(pressed: Pressed) -> Fact | None:
    """Say why it is not known what it takes to draw bodies apart."""
    separation = pressed.sought.separation
    return Fact("largest_load_unsolved") if separation is None else separation.unsolved


def _work_ratio(separation: Separation, pressed: Pressed) -> Real:
    """Work of separation over that of smooth bodies, in a row. [1]"""
    assert pressed.attraction is not None
    return np.array([separation.work / (pressed.attraction.work * pressed.area)])


def _range_texts(name: str, pressed: Pressed) -> Mapping[str, str]:
    """Of which attraction an answer is, and of which surface."""
    law, attraction = pressed.curve.law, pressed.attraction
    if attraction is None or not isinstance(law, Adhesive):
        return {}
    reach = engineering(law.range, "m")
    place = ""
    if pressed.interface is not None:
        place = "of this piece alone, a punch with its outline; "
    if pressed.joint is not None:
        place = "of the map, which is one place of the joint; "
    work = f"w = {engineering(attraction.work, 'J')}/m² ({attraction.source})"
    validity = f"{place}{_AFTER}; {work}, range {reach}"
    if attraction.range is not None:
        return {"validity": validity}
    return {"name": f"{name} at a range of {reach}", "validity": validity}


def _branch(pressed: Pressed) -> Fact | None:
    """Say which branch the other answers are of, and which range was taken."""
    law, attraction = pressed.curve.law, pressed.attraction
    if attraction is None or not isinstance(law, Adhesive) or pressed.sought.separation is None:
        return None
    if attraction.range is not None:
        return Fact("on_the_way_in", shortest_range=None, heights=None)
    heights = law.range / pressed.rms_height if pressed.rms_height else None
    return Fact("on_the_way_in", shortest_range=law.range, heights=heights)


def _set_by_the_range(pressed: Pressed) -> Fact | None:
    """Say where the pull-off is the largest pull over all of the area, whatever the roughness."""
    law, separation = pressed.curve.law, pressed.sought.separation
    if separation is None or not isinstance(law, Adhesive):
        return None
    share = float(separation.pull_off[0] / (law.largest_pull * pressed.area))
    return Fact("set_by_the_range", share=share) if share >= _FULL_PULL_SHARE else None


def _rule(name: str, **others: Any) -> Rule:
    """A rule about bodies that stick; where no range was given, its answer's name says which."""
    return Rule(
        name=name,
        group="adhesion",
        source="Maugis 1992",
        unknown=_why_unknown,
        differing=partial(_range_texts, name),
        **others,
    )


ADHESION = (
    _rule(
        key="pull_off_force",
        name="pull-off force",
        symbol="F_po",
        unit="N",
        formula="largest pull under a load that is taken off and turned into a pull",
        value=partial(_found, lambda separation, pressed: separation.pull_off * pressed.scale),
        facts=lambda pressed: (_set_by_the_range(pressed), _branch(pressed)),
        answers_question=always,
        is_extensive=True,
    ),
    _rule(
        key="pull_off_pressure",
        name="pull-off pressure",
        symbol="p_po",
        unit="Pa",
        formula="F_po / A_0",
        symbols=lambda pressed: [nominal_area(pressed)],
        value=partial(_found, lambda separation, pressed: separation.pull_off / pressed.area),
    ),
    _rule(
        key="area_without_load",
        name="contact area without load",
        symbol="A_0F/A_0",
        unit="1",
        formula="share of the nominal area that still touches once the load is off",
        value=partial(_found, lambda separation, _pressed: np.minimum(separation.area_fraction, 1)),
        limits=lambda _pressed: (0.0, 1.0),
        in_per_cent=True,
    ),
    _rule(
        key="work_of_separation",
        name="work of separation over that of smooth bodies",
        symbol="W_s/(w A_0)",
        unit="1",
        formula="integral of the pull over the depth from no load until apart, to about 3 %",
        value=partial(_found, _work_ratio),
        in_per_cent=True,
    ),
)
"""Answers about bodies that stick, in their order."""
