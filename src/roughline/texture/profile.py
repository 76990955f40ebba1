"""Parameters of profiles that look at sections, and at hills and dales one after another."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.texture.found import Found
from roughline.units import in_words

SECTIONS = 5
"""Sections of the evaluation length that ISO 21920-3 takes by default."""

_FEWEST_POINTS = 8  # points of a section, below which its peak and pit tell of where the points lie
_ELEMENT = 0.1  # of Rp and of Rv, beyond which a hill and a dale count


@dataclass(frozen=True)
class Sections:
    """The points of a profile that are evaluated, and how they are parted."""

    points: slice
    count: int
    length: float  # of a section [length]

    @classmethod
    def of(cls, points: int, spacing: float, cutoff: float | None) -> Sections:
        """Return five sections: as long as the cutoff of the L-filter, or a fifth of the profile.

        Where fewer of them fit, as many as do are taken; they lie in the middle.
        """
        count = min(SECTIONS, points)
        if cutoff is None:
            return cls(slice(0, points), count, points * spacing / count)
        count = min(count, max(1, math.floor(points * spacing / cutoff * (1 + 1e-9))))
        points_in_all = min(points, max(count, round(count * cutoff / spacing)))
        first = (points - points_in_all) // 2
        return cls(slice(first, first + points_in_all), count, points_in_all * spacing / count)

    def in_words(self, unit: str | None) -> str:
        """Say how many sections of which length there are."""
        plural = "s" if self.count > 1 else ""
        return f"{self.count} section{plural} of {in_words(self.length, unit)}"


def section_parameters(heights: Real, count: int) -> Found:
    """Return Rp, Rv and Rz, means over sections, of mean-free heights."""
    sections = np.array_split(heights, count)
    if heights.size < _FEWEST_POINTS * count:
        cause = f"a section has less than {_FEWEST_POINTS} points"
        return {"Rp": cause, "Rv": cause, "Rz": cause}
    peaks = float(np.mean([each.max() for each in sections]))
    pits = float(np.mean([0.0 - each.min() for each in sections]))
    return {"Rp": peaks, "Rv": pits, "Rz": peaks + pits}


def mean_spacing(heights: Real, spacing: float, peaks: float, pits: float) -> float | str:
    """Return RSm of mean-free heights, with their Rp and Rv.

    An element is a hill with the dale after it, or a dale with the hill after it: from one crossing
    of the mean line to the next but one. Hills and dales count beyond 10 % of Rp and of Rv.
    """
    hill, dale = max(0.0, _ELEMENT * peaks), max(0.0, _ELEMENT * pits)  # sections differ by a point
    sides = np.where(heights > hill, 1, np.where(heights < -dale, -1, 0))
    counted = np.flatnonzero(sides)
    turns = np.flatnonzero(np.diff(sides[counted]))
    crossings = [_crossing(heights, counted[turn], counted[turn + 1]) for turn in turns]
    widths = [crossings[i + 2] - crossings[i] for i in range(len(crossings) - 2)]
    if not widths:
        return "there are fewer than two hills or dales, so no profile element is whole"
    return float(np.mean(widths)) * spacing


def _crossing(heights: Real, before: int, after: int) -> float:
    """Where heights pass the mean line between two points on its sides, the last time. [points]"""
    between = heights[before : after + 1]
    sign = math.copysign(1.0, between[-1])
    last = int(np.flatnonzero(sign * between <= 0)[-1])
    here, there = between[last], between[last + 1]
    return before + last + float(here / (here - there))
