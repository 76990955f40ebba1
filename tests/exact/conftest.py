"""What the tests of exact solutions share."""

from functools import cache

import numpy as np
import pytest


@pytest.fixture(autouse=True, scope="module")
def gauss_points_are_found_once():
    """Keep the points of Gauss's rules, which take most of the time of a quadrature."""
    gauss = np.polynomial.legendre
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(gauss, "leggauss", cache(gauss.leggauss))
        yield
