"""Curves whose laws are known, and which scatter as those of surfaces do.

Areas over the pressure follow one power law, stiffnesses another that goes over into full contact,
and bodies follow a power law of their depth, with highest points that differ.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import xarray
from scipy.integrate import quad

PRESSURES = 0.002 * 10 ** (np.arange(9) / 5)  # p / (E* times the rms slope)
AREA_POWER = 0.97

DEPTH_FORCES = 10 ** (np.arange(-24, 5) / 8)
DEPTH_POWER = 2.2  # F = c d^2.2, k = dF/dd
DEPTH_EXPONENT = 1 - 1 / DEPTH_POWER  # of k over F
SPREAD = 0.3  # standard deviation of the highest points, over h
DEPTH_WINDOW = (1e-2, 1e-1)

CROSSING_FORCES = 10 ** (np.arange(-12, 11) / 4)
ASYMPTOTE, ONSET, FULL = 0.47, 0.3, 1000.0


def areas(count, rng, slope=2.2, power=AREA_POWER):
    """Areas A = slope p^power / 0.01^(power - 1) that scatter as those of surfaces."""
    mean = slope * PRESSURES * (PRESSURES / 0.01) ** (power - 1)
    common = rng.standard_normal((count, 1)) + 0.3 * rng.standard_normal((count, PRESSURES.size))
    scatter = 0.15 * (PRESSURES / PRESSURES[0]) ** -0.4
    return mean * np.exp(scatter * common - scatter**2 * 1.09 / 2)


def pressure_of(level):
    """Pressure at which the mean of such areas is a share of the nominal one."""
    return 0.01 * (level / 0.022) ** (1 / AREA_POWER)


def ensemble(count, rng):
    """Bodies F = c d^2.2 with scattered c, stiffness and highest points."""
    c = np.exp(0.3 * rng.standard_normal((count, 1)))
    depth = (DEPTH_FORCES / c) ** (1 / DEPTH_POWER)
    scatter = 0.1 * rng.standard_normal((count, 1)) + 0.05 * rng.standard_normal(
        (count, DEPTH_FORCES.size)
    )
    stiffness = (
        DEPTH_POWER * c * depth ** (DEPTH_POWER - 1) * np.exp(scatter - (0.1**2 + 0.05**2) / 2)
    )
    names = ("realisation", "force_bar")
    return xarray.Dataset(
        {
            "depth": (names, depth),
            "stiffness": (names, stiffness),
            "highest": ("realisation", 3 + SPREAD * rng.standard_normal(count)),
        },
        {"force_bar": DEPTH_FORCES},
    )


@cache
def exponent_at_level():
    """The exponent between means at fixed level in the window, by quadrature.

    The highest points are normally distributed; a body whose highest point is x above the plane
    has the force c x^2.2 and the stiffness of that depth.
    """

    def moment(power, level):
        return quad(lambda x: x**power * math.exp(-((x + level) ** 2) / (2 * SPREAD**2)), 0, 4)[
            0
        ] / (SPREAD * math.sqrt(2 * math.pi))

    mean_c = math.exp(0.3**2 / 2)
    levels = np.linspace(0.7, -0.7, 4000)
    force = np.array([mean_c * moment(DEPTH_POWER, level) for level in levels])
    inside = (force >= DEPTH_WINDOW[0]) & (force <= DEPTH_WINDOW[1])
    stiffness = [moment(DEPTH_POWER - 1, level) for level in levels[inside]]
    return np.polyfit(np.log(force[inside]), np.log(stiffness), 1)[0]


@dataclass(frozen=True)
class Crossing:
    """Stiffness whose local exponent goes from 1 / (1 + H) to 1, and beyond near full contact."""

    hurst: float

    @property
    def missing(self):
        """What the exponent of a rough surface lacks to 1."""
        return 1 - 1 / (1 + self.hurst)

    @property
    def stiffness(self):
        rough = CROSSING_FORCES / ASYMPTOTE * (1 + ONSET / CROSSING_FORCES) ** self.missing
        return rough * (1 + (CROSSING_FORCES / FULL) ** 2)

    @property
    def exponents(self):
        """Local exponents, from each load to the next but one."""
        logs, steps = np.log(self.stiffness), np.log(CROSSING_FORCES)
        return (logs[2:] - logs[:-2]) / (steps[2:] - steps[:-2])

    def load_of(self, exponent):
        """Load at which the local exponent has a value, far from full contact."""
        return ONSET * (self.missing / (1 - exponent) - 1)

    @property
    def gamma(self):
        """Largest F / k."""
        return (CROSSING_FORCES / self.stiffness).max()

    def surfaces(self, count, rng):
        """Stiffness that scatters as that of surfaces does: less under heavy loads."""
        steps = rng.standard_normal((count, CROSSING_FORCES.size))
        alike = math.exp(-np.log(CROSSING_FORCES[1] / CROSSING_FORCES[0]) / 1.5)
        for i in range(1, CROSSING_FORCES.size):
            steps[:, i] = alike * steps[:, i - 1] + math.sqrt(1 - alike**2) * steps[:, i]
        scatter = 0.35 / (1 + CROSSING_FORCES / ONSET) ** 0.5
        return self.stiffness * np.exp(scatter * steps - scatter**2 / 2)
