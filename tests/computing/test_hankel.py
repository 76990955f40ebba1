"""Hankel transforms, judged by integrals in closed form."""

import mpmath
import numpy as np
import pytest

from roughline.computing.hankel import hankel

LONGEST = 40.0  # the largest of these distances turn to the imaginary axis
DISTANCES = [0.01, 1.0, 30.0, 1e3, 2e3, 1e5, 1e8]


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("r", DISTANCES)
def test_what_falls_exponentially_has_its_closed_form(r, order):
    """The integral of exp(-2 q) J(q r)."""
    far = np.hypot(r, 2.0)
    wanted = (r / (far + 2)) ** order / far
    (found,) = hankel(lambda q: np.exp(-2 * q), np.array([r]), 1.0, LONGEST, order)
    assert found == pytest.approx(wanted, rel=1e-11)


@pytest.mark.parametrize("base", [1e-9, 1e-7, 1e-5, 1e-3, 0.03])
@pytest.mark.parametrize("r", [2e3, 1e4, 1e6, 1e8])
def test_far_longer_waves_than_a_distance_count_as_on_a_soft_base(r, base):
    """The integral of J_0(q r) / (q + base) is Struve's function less that of the second kind."""
    with mpmath.workdps(60):
        wanted = float(mpmath.pi / 2 * (mpmath.struveh(0, base * r) - mpmath.bessely(0, base * r)))
    (found,) = hankel(lambda q: 1 / (q + base), np.array([r]), 1.0, LONGEST)
    assert found == pytest.approx(wanted, rel=1e-10)
