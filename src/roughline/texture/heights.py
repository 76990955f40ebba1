"""Parameters of the heights alone; those of places and slopes do not count."""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import Real
from roughline.measurement.gaussian_heights import skewness_and_kurtosis
from roughline.texture.found import Found
from roughline.topography.heights import rms_deviation

_FLAT = "all heights are equal"


def height_parameters(heights: Real, letter: str) -> Found:
    """Return Sq, Ssk, Sku, Sp, Sv, Sz and Sa, or those of profiles under their letter.

    The largest ones are those of all points.
    """
    mean = float(heights.mean())
    peak, pit = max(0.0, float(heights.max()) - mean), max(0.0, mean - float(heights.min()))
    skewness, kurtosis = skewness_and_kurtosis(heights)
    return {
        f"{letter}q": rms_deviation(heights),
        f"{letter}sk": _FLAT if math.isnan(skewness) else skewness,
        f"{letter}ku": _FLAT if math.isnan(kurtosis) else kurtosis,
        f"{letter}p": peak,
        f"{letter}v": pit,
        f"{letter}z": float(np.ptp(heights)),
        f"{letter}a": 0.0 if rms_deviation(heights) == 0 else float(np.abs(heights - mean).mean()),
    }
