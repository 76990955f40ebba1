"""A fluid from outside, made by the handbook alone: one that thins with the rate of shear."""

from dataclasses import dataclass

import pytest

import roughline as rl


@dataclass(frozen=True)
class PowerLawFluid:
    """Its shear stress is K times a power n of the rate of shear."""

    consistency: float  # K [Pa s^n]
    power: float

    def viscosity(self, rate):
        return self.consistency * rate ** (self.power - 1)

    def leak(self, gap, fall, width):
        """Volume per time between flat plates under a fall of pressure. [m³ / s]"""
        n = self.power
        wall = fall * gap / 2 / self.consistency
        return width * gap**2 / 2 * n / (2 * n + 1) * wall ** (1 / n)


THINNING = PowerLawFluid(consistency=2.0, power=0.6)


def test_it_is_refused_in_one_line():
    for ask in (lambda: rl.Fluid(THINNING), lambda: rl.fluid_of(THINNING)):
        with pytest.raises(
            rl.InputError, match="is a PowerLawFluid; a text or a Liquid"
        ) as refused:
            ask()
        assert "\n" not in str(refused.value)


def test_between_plates_a_liquid_of_its_least_viscosity_leaks_no_less():
    gap, width, length, step = 10e-6, 0.1, 2e-3, 5e5
    fall = step / length
    at_walls = (fall * gap / 2 / THINNING.consistency) ** (1 / THINNING.power)
    liquid = rl.Liquid(THINNING.viscosity(at_walls))
    of_liquid = width / length * gap**3 * step / (12 * liquid.viscosity)
    assert THINNING.leak(gap, fall, width) < of_liquid
    assert THINNING.leak(gap, fall, width) == pytest.approx(of_liquid * 3 * 0.6 / 2.2)
