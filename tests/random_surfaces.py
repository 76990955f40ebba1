"""Rough surfaces for laws that hold whatever the surface, and how many of them are tried."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import roughline as rl

_TRIED = settings(deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])


def laws(*strategies, few=5, many=25):
    """Hold a law to what strategies draw: few of it in a short case, and many in a long one."""

    def of(law):
        @pytest.mark.parametrize("examples", [few, many])
        def holds(examples):
            settings(_TRIED, max_examples=examples)(given(*strategies)(law))()

        holds.__name__, holds.__doc__ = law.__name__, law.__doc__
        return holds

    return of


@st.composite
def surfaces(draw, square=False):
    """Rough surfaces of any roughness and shape, cut from a larger one or white noise."""
    nx = draw(st.integers(4, 40))
    ny = nx if square else draw(st.integers(4, 40))
    seed = draw(st.integers(0, 10**6))
    hurst = draw(st.sampled_from([0.0, 0.3, 0.7, 1.0, None]))
    if hurst is None:
        heights = np.random.default_rng(seed).normal(size=(nx, ny))
    else:
        whole = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(40, seed).heights
        heights = whole[:nx, :ny]
    aspect = 1.0 if square else draw(st.sampled_from([0.1, 0.5, 1.0, 3.0]))
    return rl.Surface(heights, (nx / 40, aspect * ny / 40))
