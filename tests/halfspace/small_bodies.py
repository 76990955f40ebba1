"""Heights of bodies that are small enough for dense matrices."""

import numpy as np

import roughline as rl


def rough(shape, hurst, seed=1):
    """Return random heights, cut out of a square that is periodic."""
    heights = rl.SelfAffine(hurst=hurst, rms_height=0.1).surface(max(shape), seed).heights
    return np.array(heights[: shape[0], : shape[1]])


def needle(shape, above=0.3):
    """Return heights of which one point stands out."""
    heights = 0.1 * rough(shape, 0.5)
    heights[3, 5] += above
    return heights
