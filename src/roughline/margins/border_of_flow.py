"""What the border of a map does to what flows, where no more than that holds an interval open."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.engineering.rule import Answer
from roughline.engineering.sealing import Fluid
from roughline.facts.fact import Fact
from roughline.fluid.gap import Along
from roughline.margins.larger_surface import LargerSurface

COUNTED_RATIO = 1.2  # upper over lower end from which on a cause is told
_END_ROUNDING = 1 - 1e-9  # of an end of an interval, to rounding


@dataclass(frozen=True, eq=False)
class _Border:
    """Apertures along one direction as the border across it is held, over the loads."""

    along: Along
    repeated: Real  # as the map repeats [m]
    with_flow: Real  # with the flow given there [m]
    with_pressure: Real  # with the pressure held even [m]
    over: Real  # by how much their logarithms differ where they are an end of the interval, else 0
    has_interval: bool

    def at(self, load: int) -> Fact:
        """All three under a load."""
        names = ("repeated", "with_flow", "with_pressure")
        apertures = {name: float(getattr(self, name)[load]) for name in names}
        return Fact("flow_at_border", along=self.along, **apertures)


def what_borders_do(
    sealing: Fluid | None,
    larger: LargerSurface | None,
    answers: Mapping[str, Answer],
    headings: Sequence[str],
) -> list[Fact]:
    """Say what flows with the pressure held along the border of a map, and with the flow given.

    That is said of each direction in which one of them is an end of the interval, or there is none,
    under the load where they differ most.
    """
    if sealing is None or larger is None:
        return []
    borders = _borders(sealing, larger, answers)
    found = [each for each in borders if (each.over > 0).any()]
    if not found:
        return []
    load = int(np.argmax(np.maximum.reduce([each.over for each in found])))
    differing = [each for each in found if each.over[load] > 0]
    numbers = {"directions": tuple(each.at(load) for each in differing)}
    is_in_interval = all(each.has_interval for each in differing)
    return [
        Fact("border_moves_flow", load=headings[load], is_in_interval=is_in_interval, **numbers)
    ]


def _borders(
    sealing: Fluid, larger: LargerSurface, answers: Mapping[str, Answer]
) -> Iterator[_Border]:
    """What the border does along each direction that is asked for."""
    for along in sealing.directions:
        key = f"hydraulic_aperture_{along}"
        answer = answers.get(key) or answers.get("hydraulic_aperture")
        measure = larger.measures.get(key)
        values = None if measure is None else measure.values_at_border
        if values is None or answer is None:
            continue
        with_flow, with_pressure = values
        apertures = np.stack([answer.values, with_flow, with_pressure])
        least, most = apertures.min(axis=0), apertures.max(axis=0)
        low, high = answer.ends or (least, most)
        with np.errstate(divide="ignore", invalid="ignore"):
            of_border = np.nan_to_num(np.log(most / least), nan=0.0)
        is_end = (low >= least * _END_ROUNDING) | (high <= most / _END_ROUNDING)
        over = np.where(is_end & (of_border > math.log(COUNTED_RATIO)), of_border, 0.0)
        yield _Border(along, answer.values, with_flow, with_pressure, over, answer.ends is not None)
