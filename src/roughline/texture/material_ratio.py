"""The material ratio curve, and the parameters of stratified surfaces and of volumes.

The curve is the heights, sorted: the k-th highest of n stands from (k - 1) / n to k / n. Points of
equal height are counted as they are, so that the plateaus of stepped heights are kept.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.texture.parameters import PEAKS, PITS

_CORE = 0.4  # share of the points through which the line of the core is laid
_HEIGHT_ROUNDING = 1e-10  # of the maximum height; heights and falls are equal within it


@dataclass(frozen=True)
class Layers:
    """Core, hills and dales of a surface: Sk, Spk, Svk [length], Smrk1 and Smrk2 [1]."""

    core: float
    peaks: float
    pits: float
    first: float
    second: float


@dataclass(frozen=True)
class Volumes:
    """Material and void volumes over the area: Vmp, Vmc, Vvc, Vvv. [length]"""

    peaks: float
    core: float
    void_of_core: float
    void_of_pits: float


def material_ratio_curve(heights: Real) -> Real:
    """Return all heights, the highest first."""
    return np.sort(heights, axis=None)[::-1]


def compute_layers(curve: Real) -> Layers:
    """Return the parameters of stratified surfaces.

    The line of the core is the least-squares line through the 40 % of the curve whose secant is
    least steep, the first of several. Where nothing is above the core at 0 %, or below it at 100 %,
    there are no hills or no dales. A core without height is crossed at one ratio, which is both.
    """
    n = curve.size
    span = min(max(1, round(_CORE * n)), n - 1)
    rounding = _HEIGHT_ROUNDING * (curve[0] - curve[-1])
    falls = curve[: n - span] - curve[span:]
    start = int(np.argmax(falls <= falls.min() + rounding))  # of steps, many are alike
    heights = curve[start : start + span + 1]
    ratio = (np.arange(start, start + span + 1) + 0.5) / n
    deviation = ratio - ratio.mean()
    middle = heights.mean()
    slope = float(deviation @ (heights - middle) / (deviation @ deviation))
    top, bottom = middle - slope * ratio.mean(), middle + slope * (1 - ratio.mean())
    hills, dales = curve[curve > top + rounding] - top, bottom - curve[curve < bottom - rounding]
    first, second = hills.size / n, 1 - dales.size / n
    if abs(top - bottom) <= rounding and (hills.size > 0) != (dales.size > 0):  # crossed once
        first = second = first if hills.size else second
    return Layers(
        core=float(top - bottom),
        peaks=2 * float(hills.mean()) if hills.size else 0.0,
        pits=2 * float(dales.mean()) if dales.size else 0.0,
        first=first,
        second=second,
    )


def compute_volumes(curve: Real) -> Volumes:
    """Return the volumes of material above and of void below the curve, between 10 % and 80 %."""
    n = curve.size
    mean = float(curve.mean())
    below = np.concatenate([[0.0], np.cumsum(curve - mean)]) / n
    ranks = (np.arange(n) + 0.5) / n

    def material(ratio: float) -> float:
        """Material above the height of a material ratio."""
        height = np.interp(ratio, ranks, curve - mean)
        return float(np.interp(ratio * n, np.arange(n + 1), below) - ratio * height)

    def void(ratio: float) -> float:
        """Void below the height of a material ratio."""
        height = np.interp(ratio, ranks, curve - mean)
        return material(ratio) + float(height - below[-1])

    return Volumes(
        peaks=material(PEAKS),
        core=material(PITS) - material(PEAKS),
        void_of_core=void(PEAKS) - void(PITS),
        void_of_pits=void(PITS),
    )


def mean_step(curve: Real) -> float:
    """Mean step between the heights that occur, where most points share theirs; else 0. [length]"""
    levels = int(np.count_nonzero(np.diff(curve))) + 1
    return float(curve[0] - curve[-1]) / (levels - 1) if 1 < levels < curve.size / 2 else 0.0
