"""One random surface or line of a spectrum."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.errors.checks import is_whole, one_of, refuse
from roughline.spectra import synthesis
from roughline.spectra.band import Band
from roughline.spectra.lattice import BodyName

Amplitudes = Literal["fixed", "gaussian"]
Normalisation = Literal["rms_height", "C_0"]

_BYTES_PER_POINT = 40  # of a surface, while it is generated
_LARGEST: dict[BodyName, int] = {"surface": 2**15, "line": 2**28}


def refuse_points(n: int, body: BodyName) -> None:
    """Refuse what is neither "surface" nor "line", and a number of points that neither has."""
    one_of("body", body, _LARGEST)
    if not is_whole(n) or not 3 <= n <= _LARGEST[body]:
        refuse("n", n, f"a whole number of points from 3 to {_LARGEST[body]} is needed")


def realisation(
    band: Band,
    normalisation: Normalisation,
    magnitude: float,
    body: BodyName,
    n: int,
    rng: synthesis.Seed,
    amplitudes: Amplitudes,
) -> tuple[Real, dict[str, str | int]]:
    """Return random heights, and the settings that make them again.

    They are scaled to an rms height of the magnitude, or have the spectrum ``C_0``, which it is
    then, times the shape of the band. The rest is as for :meth:`roughline.SelfAffine.surface`.
    """
    refuse_points(n, body)
    if body == "surface":
        refuse_beyond_memory(
            _BYTES_PER_POINT * n**2, f"a surface of {n} x {n} points", "take a smaller n"
        )
    one_of("amplitudes", amplitudes, ("fixed", "gaussian"))
    for_phases, for_amplitudes = synthesis.generators(rng)
    seed = synthesis.described(rng, for_phases)
    C_0 = magnitude if normalisation == "C_0" else 1.0
    if body == "surface":
        moduli = _surface_moduli(band, C_0, n)
        draws_of, heights_of = synthesis.surface_draws, synthesis.surface_heights
    else:
        moduli = _line_moduli(band, C_0, n)
        draws_of, heights_of = synthesis.line_draws, synthesis.line_heights
    if amplitudes == "gaussian":
        moduli = moduli * synthesis.rayleigh(draws_of(n, for_amplitudes))
    scale = 1.0 if normalisation == "C_0" else magnitude / synthesis.rms_of(moduli)
    heights = heights_of(moduli, for_phases, scale, n)
    return heights, {"n": int(n), "amplitudes": amplitudes, "seed": seed}


def _surface_moduli(band: Band, C_0: float, n: int) -> Real:
    """Moduli of the modes that the real inverse FFT of a surface takes."""
    m = np.hypot(np.fft.fftfreq(n, 1 / n)[:, np.newaxis], np.arange(n // 2 + 1))
    weight = np.where((m > 0) & (m < n / 2), band.q_low**2, 0.0)
    return _moduli(band, C_0, m, weight)


@lru_cache(maxsize=8)  # an ensemble of lines has the same moduli for all of them
def _line_moduli(band: Band, C_0: float, n: int) -> Real:
    """Moduli of the modes that the real inverse FFT of a line takes, from m = 1 on."""
    m = np.arange(1, (n - 1) // 2 + 1, dtype=np.float64)
    return _moduli(band, C_0, m, np.pi * band.q_low**2 * m)


def _moduli(band: Band, C_0: float, m: Real, weight: Real) -> Real:
    power = weight * band.shape(band.q_low * m)
    power *= C_0
    return np.sqrt(power)
