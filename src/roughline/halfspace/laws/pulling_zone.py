"""How well a grid resolves bodies that pull each other.

About a contact a zone pulls whose width is E* w / (pi sigma_0²), with the work of adhesion w and
the largest pull sigma_0. Laws are in units in which E* is 1 and a cell has unit area, so this is a
number of cells.
"""

from __future__ import annotations

import math

import numpy as np

from roughline.errors import InputError
from roughline.facts.fact import Fact
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import LEAST_SHARE, ContactLaw

RESOLVED_FROM = 4.0
"""Cells across the zone that pulls, from which on a grid resolves it."""
_PULL_OFF_FROM = 2.0  # cells across that zone, from which on a grid resolves a pull-off
# Half of the ramp over what the pull on a cell displaces it: so a cell at the edge of the reach has
# one place, and a circle on cells pulls as a circle does (benchmarks/pull_off.py).
_RAMP_WIDTH = 4.0


def farthest_pulled(law: ContactLaw, least: float = LEAST_SHARE) -> float:
    """Return the gap beyond which nothing is pulled. [length]

    It is the cutoff, or twice that where the pull ends by a jump, as no ramp goes beyond; of a pull
    without an end, it is the gap that leaves the least share.
    """
    if law.only_pushes:
        return 0.0
    if math.isinf(law.cutoff):
        return float(law.gap_at(np.array([least]))[0])
    return 2 * law.cutoff if jump(law) else law.cutoff


def jump(law: ContactLaw) -> float:
    """Return the share of the pull that ends at the cutoff; zero where it ends evenly. [1]"""
    if math.isinf(law.cutoff):
        return 0.0
    share = float(law.share_at(np.array([law.cutoff]))[0])
    return share if share > LEAST_SHARE else 0.0


def narrowest_ramp(law: ContactLaw, compliance: float) -> float:
    """Return half of the width that the ramp has at least over which a pull ends. [length]

    The compliance is the displacement of a cell by unit pressure on it alone. [length / pressure]
    """
    return _RAMP_WIDTH * Bounds.of(law).largest_pull * compliance


def refuse_end_within_a_cell(law: ContactLaw, compliance: float) -> None:
    """Refuse a pull that would end by a jump within a cell of such a compliance."""
    ramp = narrowest_ramp(law, compliance)
    if jump(law) and ramp > law.cutoff:
        enough = 1.01 * np.sqrt(ramp / law.cutoff)  # rounded to three digits, too
        raise InputError(
            "is too short for the grid: the pull w / h_0 would end within a cell. Give at "
            f"least {enough:.3g} times as much, with the same work, or a finer grid",
            "range",
        )


def pulled_length(law: ContactLaw) -> float:
    """Return the work of adhesion over the largest pull. [length]"""
    return float(law.work_beyond(np.zeros(1))[0])


def zone(law: ContactLaw) -> float:
    """Return the width of the zone that pulls about a contact. [cells]"""
    pull = Bounds.of(law).largest_pull
    return pulled_length(law) / (math.pi * pull) if pull else math.inf


def resolves_pull_off(law: ContactLaw) -> bool:
    """Whether the zone that pulls has cells enough for a pull-off."""
    return zone(law) >= _PULL_OFF_FROM


def resolution(law: ContactLaw) -> dict[str, float]:
    """Return what is told with a result of how well the grid resolves a law."""
    return {} if law.only_pushes else {"pulling_zone_cells": zone(law)}


def facts_of_pull(law: ContactLaw, farthest: float) -> tuple[Fact, ...]:
    """Say where the grid does not resolve the pull, and where all of the bodies is pulled.

    The farthest points of bodies that touch in one are this far from each other.
    """
    if law.only_pushes:
        return ()
    found, width = [], zone(law)
    if width < RESOLVED_FROM:
        wider = math.ceil(100 * math.sqrt(RESOLVED_FROM / width)) / 100
        cells = f"{width:.2g}"
        if float(cells) >= RESOLVED_FROM:
            cells = f"{math.floor(100 * width) / 100:g}"
        numbers = {"cells": cells, "needed": RESOLVED_FROM, "wider": wider}
        has_pull_off = resolves_pull_off(law)
        found.append(Fact("pulling_zone_unresolved", **numbers, has_pull_off=has_pull_off))
    if pulled_length(law) >= farthest:
        found.append(Fact("pulled_everywhere"))
    return tuple(found)
