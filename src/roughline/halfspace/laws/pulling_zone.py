"""How well a grid resolves bodies that pull each other.

About a contact a zone pulls whose width is E* w / (pi sigma_0²), with the work of adhesion w and
the largest pull sigma_0. Laws are in units in which E* is 1 and a cell has unit area, so this is a
number of cells.
"""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import Real
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw

RESOLVED_FROM = 4.0
"""Cells across the zone that pulls, from which on a grid resolves it."""
_POORLY_FROM = 2.0  # cells, with which a pull-off is resolved at least


def pulled_length(law: ContactLaw) -> float:
    """Return the work of adhesion over the largest pull. [length]"""
    return float(law.work_beyond(np.zeros(1))[0])


def zone(law: ContactLaw) -> float:
    """Return the width of the zone that pulls about a contact. [cells]"""
    pull = Bounds.of(law).largest_pull
    return pulled_length(law) / (math.pi * pull) if pull else math.inf


def resolves_pull_off(law: ContactLaw) -> bool:
    """Whether the zone that pulls has cells enough for a pull-off."""
    return zone(law) >= _POORLY_FROM


def resolution(law: ContactLaw) -> dict[str, float]:
    """Return what is told with a result of how well the grid resolves a law."""
    return {} if law.only_pushes else {"pulling_zone_cells": zone(law)}


def remarks(law: ContactLaw, separation: Real) -> tuple[str, ...]:
    """Say where the grid does not resolve the pull, and where all of the bodies is pulled."""
    if law.only_pushes:
        return ()
    found, width = [], zone(law)
    if width < RESOLVED_FROM:
        wider = math.ceil(100 * math.sqrt(RESOLVED_FROM / width)) / 100
        cells = f"{width:.2g}"
        if float(cells) >= RESOLVED_FROM:
            cells = f"{math.floor(100 * width) / 100:g}"
        found.append(
            f"the zone that pulls about a contact, E* w / (pi sigma_0²), is {cells} "
            f"cells wide, and {RESOLVED_FROM:.0f} are needed: "
            + ("" if resolves_pull_off(law) else "no pull-off is given; ")
            + f"give a range {wider:.3g} times as large, or a finer grid"
        )
    if pulled_length(law) >= separation.max():
        found.append(
            "the range of the pull is larger than all heights: bodies in contact are pulled "
            "everywhere"
        )
    return tuple(found)
