"""What pressing all variants of a case will cost: memory and time."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.arguments import yielding_law
from roughline.contact.estimates import (
    Estimate,
    duration,
    estimate,
    expected_area_fraction,
    gigabytes,
    memory_for,
)
from roughline.contact.loads import Loads
from roughline.errors.words import called
from roughline.margins.causes import causes
from roughline.margins.variant import Variant
from roughline.question.case import Case
from roughline.topography.body import Surface

Announce = Callable[[str], None]
"""Called with the cost of a large run in words, before it starts."""

_ANNOUNCED_POINTS = 2**20  # points from which on the cost is announced
_ANNOUNCED_LOADS = 1000  # loads from which on the cost is announced
# Memory of whole commands on 1024² and 2048² points, as measured. [bytes], and per point
_BYTES_TO_READ = 30_000_000  # beside that of a press
_BYTES_OF_OTHER_CURVES = 30  # with materials
_BYTES_TO_DRAW, _BYTES_OF_FIGURES = 410_000_000, 145  # once the press is over, of the process
_LOADS_TO_SEAL = 45  # that both are sought with, quarters and coarser grids included
_SECONDS_OF_FLOW, _POWER_OF_FLOW = 1e-7, 1.25  # of points, as measured from 256² to 1024²
_BYTES_TO_ANSWER = 45_000_000  # beside either, with materials


def announce_cost(case: Case, variants: Sequence[Variant], announce: Announce | None) -> None:
    """Refuse variants for the interface alone that do not fit into memory; tell of large runs."""
    body = case.body
    if not isinstance(body, Surface):
        return
    large, yielding = body.heights.size >= _ANNOUNCED_POINTS, case.hardness is not None
    share = _expected_share(case, body) if large else None
    for each in variants:
        if each.purpose == "interface":
            refuse_beyond_memory(
                memory_for(each.shape, True, 0, yielding=yielding, area_fraction=share),
                f"pressing {body.shape[0]} x {body.shape[1]} points periodically, for the "
                "interface alone,",
                f"take a smaller piece or every other point, or {called('E_star')} instead of "
                "materials",
            )
    if announce is None or not (large or case.loads.count >= _ANNOUNCED_LOADS):
        return
    costs = [(each, _estimated(case, each, share)) for each in variants]
    memory = _most_memory(case, body, max(cost.memory for _, cost in costs))

    def seconds(purpose: str) -> float:
        return sum(each.share * cost.seconds for each, cost in costs if each.purpose == purpose)

    text = f"about {gigabytes(memory)} and {duration(seconds('as asked'))}"
    if of_interface := seconds("interface") + seconds("punch"):
        text += f", then {duration(of_interface)} for the interface"
    if of_shear := seconds("shear"):
        text += f", {duration(of_shear)} for the shear force"
    if of_flow := _seconds_of_flow(case, variants):
        text += f", {duration(of_flow)} for what flows"
    if case.question.fluid is not None and case.question.fluid.closure:
        of_load = seconds("as asked") / case.loads.count
        text += f", {duration(_LOADS_TO_SEAL * of_load)} for the pressure that seals"
    for cause in causes:
        if of_cause := seconds(cause.name):
            text += f", {duration(of_cause)} {cause.takes}"
    announce(f"{body.shape[0]} x {body.shape[1]} points, {case.loads.count} loads: {text}")


def _estimated(case: Case, variant: Variant, share: float | None) -> Estimate:
    """Return what a variant costs if all of it is pressed, with so much in contact."""
    keeps_fields = ("as asked",) if case.question.sealing is None else ("as asked", "interface")
    pressing = estimate(
        variant.shape,
        n_loads=case.loads.count,
        periodic=variant.periodic,
        fields=[0] if case.question.fields and variant.purpose in keeps_fields else False,
        yielding=case.hardness is not None,
        area_fraction=share,
    )
    half_space = case.question.sheared_half_space if variant.rubs else None
    if half_space is None:
        return pressing
    rubbing = estimate(
        variant.shape,
        n_loads=2,  # whose fields are kept, of both ends of its last cycle
        periodic=variant.periodic,
        fields=True,
        area_fraction=share,
        friction="coupled" if half_space.is_coupled else True,
    )
    return Estimate(rubbing.memory, pressing.seconds)


def _seconds_of_flow(case: Case, variants: Sequence[Variant]) -> float:
    """Return about how long all flows take: one for each load and direction, two of a rare gas."""
    sealing = case.question.sealing
    if sealing is None:
        return 0.0
    is_repeated = case.loads.periodic or case.is_repeated_for_interface
    taken = [
        each.share * math.prod(each.shape) ** _POWER_OF_FLOW
        for each in variants
        if each.periodic == is_repeated and each.purpose not in ("punch", "slip") and not each.rubs
    ]
    apertures = len(sealing.directions) * (1 if sealing.rarefied.is_even(0.0) else 2)
    return _SECONDS_OF_FLOW * case.loads.count * apertures * math.fsum(taken)


def _most_memory(case: Case, body: Surface, pressing: int) -> int:
    """Return the most memory of the process: while it presses, or while it draws. [bytes]"""
    points, answers = body.heights.size, case.pair is not None
    most = pressing + _BYTES_TO_READ + (_BYTES_OF_OTHER_CURVES * points if answers else 0)
    if case.question.fields:
        most = max(most, _BYTES_TO_DRAW + _BYTES_OF_FIGURES * points)
    return most + (_BYTES_TO_ANSWER if answers else 0)


def _expected_share(case: Case, body: Surface) -> float | None:
    """Return about what share comes into contact at most; None for spaced loads."""
    loads = case.loads
    if loads.n_loads is not None:
        return None
    spaced = Loads("forces" if loads.forces else "depths", np.array(loads.forces or loads.depths))
    return expected_area_fraction(body, loads.half_space, spaced, yielding_law(loads.hardness))
