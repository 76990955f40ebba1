"""Rough surfaces for laws that hold whatever the surface, and how many of them are tried."""

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

import roughline as rl

laws = settings(
    max_examples=25,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow],
)


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
