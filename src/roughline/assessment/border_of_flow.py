"""What the border of a map does to what flows, where no more than that holds an interval open."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.computing.arrays import Real
from roughline.fluid.gap import Along
from roughline.units import engineering

_COUNTED_RATIO = 1.2  # largest over least aperture of what is said
_END_ROUNDING = 1 - 1e-9  # of an end of an interval, to rounding


@dataclass(frozen=True, eq=False)
class _Border:
    """Apertures along one direction as the border across it is held, over the loads."""

    along: Along
    of_map: Real  # as it repeats [m]
    with_flow: Real  # with the flow given there [m]
    with_pressure: Real  # with the pressure held even [m]
    over: Real  # by how much their logarithms differ where they are an end of the interval, else 0
    has_interval: bool

    def words(self, load: int) -> str:
        """All three under a load."""
        of_map, with_flow, with_pressure = (
            engineering(float(each[load]), "m", 3)
            for each in (self.of_map, self.with_flow, self.with_pressure)
        )
        return (
            f"along {self.along} u_h is {of_map} as the map repeats, {with_pressure} with the "
            f"pressure held even along the border, and {with_flow} with the flow given there"
        )


def what_borders_do(result: Assessment) -> list[str]:
    """Say what flows with the pressure held along the border of a map, and with the flow given.

    That is said of each direction in which one of them is an end of the interval, or there is none,
    under the load where they differ most.
    """
    found = [each for each in _borders(result) if (each.over > 0).any()]
    if not found:
        return []
    load = int(np.argmax(np.maximum.reduce([each.over for each in found])))
    differing = [each for each in found if each.over[load] > 0]
    rest = (
        "leaves open more than all else does"
        if all(each.has_interval for each in differing)
        else "moves what flows, and no interval holds that"
    )
    listed = "; ".join(each.words(load) for each in differing)
    return [f"under {result.headings[load]} the border of the map {rest}: {listed}"]


def _borders(result: Assessment) -> Iterator[_Border]:
    """What the border does along each direction that is asked for."""
    sealing, larger = result.question.sealing, result.larger
    if sealing is None or larger is None:
        return
    for along in sealing.directions:
        key = f"hydraulic_aperture_{along}"
        answer = result.answers.get(key) or result.answers.get("hydraulic_aperture")
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
        over = np.where(is_end & (of_border > math.log(_COUNTED_RATIO)), of_border, 0.0)
        yield _Border(along, answer.values, with_flow, with_pressure, over, answer.ends is not None)
