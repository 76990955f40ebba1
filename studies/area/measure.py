"""The study's numbers: kappa = A E* g / F at a share of the area in contact, with intervals.

g is the rms slope of the spectrum, not that of differences on the grid. The area is corrected for
the steps of its outline. Surfaces have rms height, side and E* 1, so p / E* is F̄.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np

from roughline.computing.arrays import Real
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import IntervalEstimate, Resampled
from roughline.statistics.power_law import exponent_weights
from studies.judged import Found
from studies.reduced_data import Reduced

REDUCED = Reduced(
    Path(__file__).parent, ("area_fraction", "area_fraction_corrected", "status", "resolved")
)

HURSTS = (0.8, 0.5, 0.2)
BANDS = (4, 8, 16, 32, 64)
"""q_high / q_roll of the main surfaces."""
FINE_BANDS, LARGE_BANDS = (4, 8, 16), (4, 16)
"""Those pressed with 16 cells for the shortest wave, and with eight roll-off waves a side too."""
AREAS = (0.005, 0.01, 0.02, 0.05, 0.1, 0.15)
"""Shares of the area in contact at which kappa is reported."""
HALVES = 2.0
"""An error that halves with the spacing is twice the difference of two grids."""


@dataclass(frozen=True, eq=False)
class Sample:
    """Surfaces of one spectrum."""

    kind: str  # which part of the plan
    band: int  # q_high / q_roll
    hurst: float  # H
    nayak: float  # Nayak's parameter m_0 m_4 / m_2² of the spectrum on its lattice of wavevectors
    pressure: Real  # shape (loads,): p / (E* g)
    # shape (realisations, loads): A / A_0
    area: Real  # corrected for the steps of its outline
    cells: Real  # counted in cells

    @property
    def count(self) -> int:
        """Number of realisations."""
        return len(self.area)

    def first(self, count: int) -> Sample:
        """Return the first realisations alone."""
        return replace(self, area=self.area[:count], cells=self.cells[:count])


@cache
def sample(kind: str, band: int, hurst: float) -> Sample:
    """Return the surfaces of one spectrum."""
    name = f"{kind}-{band}-{3 - hurst:g}"
    ensemble, one = REDUCED.plan.ensemble(name), REDUCED.data[name].isel(fractal_dimension=0)
    lattice = ensemble.spectrum(3 - hurst).lattice(ensemble.n)
    height, slope, curvature = (lattice.moment(order) for order in (0, 2, 4))
    return Sample(
        kind=kind,
        band=band,
        hurst=hurst,
        # of a profile of an isotropic surface: m_2 = <|grad h|²> / 2, m_4 = 3 <(laplacian h)²> / 8
        nayak=1.5 * height * curvature / slope**2,
        pressure=one.force_bar.values / math.sqrt(slope),
        area=one.area_fraction_corrected.values,
        cells=one.area_fraction.values,
    )


def log_kappa(areas: Real, pressure: Real, level: float, rng: int = 0) -> Resampled:
    """Logarithm of kappa where a share of the area is in contact, from the mean area.

    Areas A / A_0 are over realisations and loads, pressures p / (E* g) over loads. Between two
    loads, ln p is linear in ln A.
    """
    between = _loads_around(areas.mean(axis=0), level)
    return bootstrap.function_of_means(
        areas[:, between], lambda means: _log_kappa(means, pressure[between], level), rng
    )


def kappa(one: Sample, level: float, confidence: float = 0.95) -> IntervalEstimate:
    """Return kappa of the corrected area, with its interval; the grid's error is not in it."""
    return log_kappa(one.area, one.pressure, level).interval_estimate(confidence).exp()


def kappa_in_cells(one: Sample, level: float) -> float:
    """Return kappa of the cells in contact."""
    return math.exp(log_kappa(one.cells, one.pressure, level).value)


def grid_shift(band: int, hurst: float, level: float) -> IntervalEstimate:
    """Return by how much kappa is higher with 16 cells for the shortest wave than with eight.

    The same surfaces are compared.
    """
    fine = sample("fine", band, hurst)
    coarse = sample("main", band, hurst).first(fine.count)
    # brackets of each grid, side by side in one table, so that pairs are resampled together
    places = [_loads_around(each.area.mean(axis=0), level) for each in (fine, coarse)]
    both = np.hstack([fine.area[:, places[0]], coarse.area[:, places[1]]])

    def difference(means: Real) -> tuple[Real, Real]:
        first = _log_kappa(means[..., :2], fine.pressure[places[0]], level)
        second = _log_kappa(means[..., 2:], coarse.pressure[places[1]], level)
        return first[0] - second[0], np.concatenate([first[1], -second[1]], axis=-1)

    return bootstrap.function_of_means(both, difference).interval_estimate()


def size_shift(band: int, hurst: float, level: float) -> IntervalEstimate:
    """Return by how much ln kappa is higher with eight roll-off waves a side than with four."""
    large, main = (sample(kind, band, hurst) for kind in ("large", "main"))
    difference = log_kappa(large.area, large.pressure, level, 1) - log_kappa(
        main.area, main.pressure, level
    )
    return difference.interval_estimate()


def widened_kappa(one: Sample, level: float, confidence: float = 0.95) -> Found:
    """Return the interval of kappa, widened to one side by the error of the grid.

    The error is twice the shift from eight to 16 cells, of the same band, or of the widest one that
    was pressed with 16.
    """
    found = kappa(one, level, confidence)
    shift = HALVES * grid_shift(min(one.band, max(FINE_BANDS)), one.hurst, level).value
    down, up = math.exp(min(shift, 0)), math.exp(max(shift, 0))
    ends = (found.low * down, found.value * down, found.value * up, found.high * up)
    return Found(*ends, one.count)


def exponent(
    one: Sample, window: tuple[float, float], confidence: float = 0.95
) -> IntervalEstimate:
    """Return the exponent of the area over the load, between two shares of the area."""
    mean = one.area.mean(axis=0)
    inside = one.pressure[(mean >= window[0] * 0.95) & (mean <= window[1] * 1.05)]
    weights = exponent_weights(one.pressure, (inside.min(), inside.max()))
    return bootstrap.sum_of_log_means(one.area, weights).interval_estimate(confidence)


def fall_with_nayak(hurst: float, level: float, confidence: float = 0.95) -> IntervalEstimate:
    """Return by how much ln kappa changes from one Nayak parameter to another ten times as large.

    By least squares over the bands, which count alike.
    """
    samples = [sample("main", band, hurst) for band in BANDS]
    x = np.log10([one.nayak for one in samples])
    centred = x - x.mean()
    weights = centred / (centred**2).sum()
    return _weighted(_log_kappas(samples, level), weights).interval_estimate(confidence)


def bend_with_nayak(hurst: float, level: float, confidence: float = 0.95) -> IntervalEstimate:
    """Return ln kappa of the middle band, less a straight line between the ends over log Nayak."""
    first, middle, last = (sample("main", BANDS[i], hurst) for i in (0, len(BANDS) // 2, -1))
    part = math.log(middle.nayak / first.nayak) / math.log(last.nayak / first.nayak)
    weights = np.array([part - 1, 1.0, -part])
    kappas = _log_kappas([first, middle, last], level)
    return _weighted(kappas, weights).interval_estimate(confidence)


def line_over_nayak(
    samples: Sequence[Sample], level: float
) -> tuple[IntervalEstimate, IntervalEstimate]:
    """Return kappa where Nayak's parameter is 10, and what ten times the parameter adds to it.

    By least squares over samples that count alike and are resampled apart.
    """
    x = np.log10([one.nayak for one in samples]) - 1
    at_ten, per_decade = np.linalg.pinv(np.stack([np.ones_like(x), x], axis=1))
    kappas = [each.exp() for each in _log_kappas(samples, level)]
    return (
        _weighted(kappas, at_ten).interval_estimate(),
        _weighted(kappas, per_decade).interval_estimate(),
    )


def _log_kappas(samples: Sequence[Sample], level: float) -> list[Resampled]:
    return [log_kappa(one.area, one.pressure, level, rng) for rng, one in enumerate(samples)]


def _weighted(parts: Sequence[Resampled], weights: Real) -> Resampled:
    total = _scaled(parts[0], weights[0])
    for part, weight in zip(parts[1:], weights[1:], strict=True):
        total = total - _scaled(part, -weight)
    return total


def _scaled(one: Resampled, weight: float) -> Resampled:
    return Resampled(
        weight * one.value,
        abs(weight) * one.error,
        weight * one.values,
        abs(weight) * one.errors,
        one.freedom,
    )


def _loads_around(mean_area: Real, level: float) -> slice:
    """Return the two loads between which a share of the area is in contact."""
    above = int(np.searchsorted(mean_area, level))
    if above in (0, mean_area.size):
        raise ValueError(f"{level:.1%} in contact is outside the loads of the plan")
    return slice(above - 1, above + 1)


def _log_kappa(means: Real, pressure: Real, level: float) -> tuple[Real, Real]:
    """Ln kappa between two loads, and its gradient by the two mean areas."""
    first, second = np.log(means[..., 0]), np.log(means[..., 1])
    step = math.log(pressure[1] / pressure[0])
    rise = second - first
    part = (math.log(level) - first) / rise
    value = math.log(level / pressure[0]) - part * step
    gradient = np.stack([(1 - part) / means[..., 0], part / means[..., 1]], axis=-1)
    return value, step / rise[..., np.newaxis] * gradient
