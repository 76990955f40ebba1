"""Ratios to the correlations: what they depend on, laws that fit, and root sums of squares."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.statistics.averages import average, relative_difference
from roughline.statistics.bootstrap import IntervalEstimate
from studies.correlations.measure import (
    BANDS,
    BOXES,
    DIMENSIONS,
    ELASTIC,
    FINE_HARDNESSES,
    FULL,
    Sample,
    data,
    holm,
    plan,
    sample,
    yovanovich,
)
from studies.correlations.reduction import BEARING

Ratio = Callable[[Sample], Real]
"""Returns what surfaces have over what is predicted, shape (realisations, pressures)."""

MIDDLE = 2.5
"""Fractal dimension of the surfaces that are shown where one is enough."""
ELASTIC_BANDS = tuple(BANDS)[:-1]
"""Bands q_high / q_roll of which there are elastic bodies."""


@dataclass(frozen=True)
class CommonLaw:
    """One power law for all fractal dimensions."""

    prefactor: float  # geometric mean of those of the single laws
    exponent: float  # mean of those of the single laws
    deviation: float  # largest relative deviation of a mean conductance from it in the window


def common_law(hardness_bar: float) -> CommonLaw:
    """Return the law of the bodies of one hardness, whatever their fractal dimension."""
    samples = [sample("main", hardness_bar, dimension) for dimension in DIMENSIONS]
    laws = [one.fit() for one in samples]
    prefactor = math.exp(np.mean([math.log(law.prefactor) for law in laws]))
    exponent = float(np.mean([law.exponent for law in laws]))
    deviations = [
        average(one.conductance).mean / (prefactor * one.variable**exponent) - 1 for one in samples
    ]
    inside = samples[0].in_window
    return CommonLaw(prefactor, exponent, float(np.abs(deviations)[:, inside].max()))


def over_root_sum(one: Sample) -> Real:
    """Conductance over sqrt(h_e² + h_p²) of the same surfaces, shape (realisations, pressures).

    h_e is that of the elastic surface under the same load, h_p that of the fully plastic one under
    the same p / H. NaN where the load is below those of the elastic surface.
    """
    elastic, plastic = (
        sample(one.prefix, hardness, one.fractal_dimension, every=one.every)
        for hardness in (ELASTIC, FULL)
    )
    wanted = np.log(one.pressure * one.hardness_bar)
    x, count = np.log(elastic.pressure), one.count
    rows = [np.interp(wanted, x, row, left=math.nan) for row in np.log(elastic.conductance[:count])]
    return one.conductance / np.hypot(np.exp(rows), plastic.conductance[:count])


def over_holm(one: Sample) -> Real:
    """Conductance over that of Holm's single spot, shape (realisations, pressures)."""
    return one.conductance / holm(one.pressure, one.slope)


def over_bearing_area(one: Sample) -> Real:
    """A / A_0 over p / H, shape (realisations, pressures)."""
    return one.area / one.pressure


def elastic_pressure_over_hardness(one: Sample) -> float:
    """Mean contact pressure over H of the elastic bodies under p / (E* g) = 0.01."""
    elastic = sample("main", ELASTIC, one.fractal_dimension)
    area = elastic.mean_at(elastic.area, 1e-2).mean[0]
    return float(1e-2 / area / one.hardness_bar)


def grid_shift(one: Sample, ratio: Ratio) -> list[IntervalEstimate]:
    """Return by how much a ratio is higher on twice the points, at each pressure.

    The same surfaces are compared, at every other load. Of a hardness that was not pressed on the
    finer grid, the next one is taken.
    """
    hardness = ELASTIC
    if not one.elastic:
        hardness = min(FINE_HARDNESSES, key=lambda each: abs(math.log(each / one.hardness_bar)))
    fine = sample("fine", hardness, one.fractal_dimension)
    coarse = sample("main", hardness, one.fractal_dimension, every=2)
    ends = relative_difference(ratio(fine), ratio(coarse)[: fine.count], paired=True)
    return [IntervalEstimate(*map(float, each)) for each in zip(*ends, strict=True)]


def change_with_band(
    hardness_bar: float, dimension: float, narrow: int, wide: int
) -> IntervalEstimate:
    """Return the relative change of the ratio at a pressure of 0.01 from one band to another."""
    return _change(hardness_bar, dimension, BANDS[narrow], BANDS[wide], 1e-2)


def change_with_box(hardness_bar: float, dimension: float, pressure: float) -> IntervalEstimate:
    """Return the relative change of the ratio from 8 to 16 roll-off waves along a side."""
    return _change(hardness_bar, dimension, BOXES[8], BOXES[16], pressure)


def change_with_boundary(
    hardness_bar: float, dimension: float, pressure: float
) -> IntervalEstimate:
    """Return the relative change of the ratio from the periodic to the free half-space."""
    return _change(hardness_bar, dimension, "main", "free", pressure, paired=True)


def _change(
    hardness_bar: float,
    dimension: float,
    before: str,
    after: str,
    pressure: float,
    *,
    paired: bool = False,
) -> IntervalEstimate:
    """Relative change of the ratio from one ensemble to another; of the same surfaces if paired."""
    samples = [sample(each, hardness_bar, dimension) for each in (after, before)]
    count = samples[0].count if paired else None
    values = [one.ratio[:count, one.places(pressure)] for one in samples]
    ends = relative_difference(*values, paired=paired)
    return IntervalEstimate(*(float(end[0]) for end in ends))


@dataclass(frozen=True)
class Heights:
    """How Gaussian the heights are: means over the surfaces, and standard deviations."""

    skewness: tuple[float, float]  # mean, and standard deviation of single surfaces
    excess_kurtosis: tuple[float, float]
    # share of Gaussian surfaces above a height, that of these, and its standard error
    bearing: tuple[tuple[float, float, float], ...]


def heights() -> Heights:
    """Return how Gaussian the heights are."""

    def moments(name: str) -> tuple[float, float]:
        values = data()[f"heights/{name}"]
        return float(values.mean()), float(values.std(ddof=1))

    shares = data()["heights/bearing"].reshape(-1, len(BEARING))
    errors = shares.std(axis=0, ddof=1) / math.sqrt(len(shares))
    return Heights(
        moments("skewness"),
        moments("excess_kurtosis"),
        tuple(zip(BEARING, shares.mean(axis=0).tolist(), errors.tolist(), strict=True)),
    )


def nayak(prefix: str, dimension: float) -> float:
    """Nayak's parameter m_0 m_4 / m_2² of the surfaces of an ensemble."""
    ensemble = next(each for each in plan().ensembles if each.name.startswith(f"{prefix}-"))
    lattice = ensemble.spectrum(dimension).lattice(ensemble.n)
    return 1.5 * lattice.moment(0) * lattice.moment(4) / lattice.moment(2) ** 2


def failed_loads() -> tuple[int, int]:
    """Return how many loads were not solved, and how many there are."""
    status = [values for name, values in data().items() if name.endswith("/status")]
    return sum(int((each != 0).sum()) for each in status), sum(each.size for each in status)


def core_seconds() -> float:
    """Return the time of all bodies on one core. [s]"""
    return sum(float(value) for name, value in data().items() if name.endswith("/core_seconds"))


def extremes(ratio: Ratio, hardnesses: tuple[float, ...]) -> tuple[float, float]:
    """Return the smallest and the largest mean of a ratio in the window, at any Hurst exponent."""
    samples = [
        sample("main", hardness, dimension) for hardness in hardnesses for dimension in DIMENSIONS
    ]
    means = [average(ratio(one)[:, one.in_window]).mean for one in samples]
    return float(min(map(min, means))), float(max(map(max, means)))


def spots_of_the_correlation(dimension: float, pressure: float) -> float:
    """Number n of equal round spots whose area is p / H and whose conductance is the correlation's.

    They have n pi a² = p / H and 2 n a = h_c / kappa_s, on the nominal area of the main surfaces.
    """
    slope = sample("main", FULL, dimension).slope
    conductance = float(yovanovich(np.array(pressure))) * slope / math.sqrt(math.pi)
    return math.pi * conductance**2 / (4 * pressure)


def slope_spread() -> float:
    """Largest standard deviation of the rms slopes of an ensemble, over their mean."""
    slopes = [values for name, values in data().items() if name.endswith("/rms_slope")]
    return max(float((each.std(axis=1) / each.mean(axis=1)).max()) for each in slopes)


def worst_grid_shift() -> float:
    """Largest mean shift of a ratio in the window on twice the points, without its sign."""
    samples = [
        sample("main", hardness, dimension)
        for hardness in (ELASTIC, *FINE_HARDNESSES)
        for dimension in DIMENSIONS
    ]
    shifts = [
        np.array([shift.value for shift in grid_shift(one, lambda each: each.ratio)])
        for one in samples
    ]
    return float(np.abs(shifts)[:, samples[0].in_window].max())
