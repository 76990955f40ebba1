"""Random surfaces and lines of a spectrum; one draw belongs to one wavevector.

Draws are ordered by wavenumber (1D) or by square rings around q = 0 (2D), so a finer grid with the
same seed repeats the draws of the coarser one and adds to them.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, is_whole, refuse
from roughline.spectra.band import Band
from roughline.spectra.lattice import BodyName

Seed = int | np.random.SeedSequence | np.random.Generator | None
Amplitudes = Literal["fixed", "gaussian"]
Normalisation = Literal["rms_height", "C_0"]

_AMPLITUDES = 0x616D706C  # spawn key of the amplitudes; no ensemble counts realisations so far
_TURN_STEPS = 4096  # of a turn, from which phases are reached by a small rotation
_TURN = np.exp(2j * np.pi * np.arange(_TURN_STEPS) / _TURN_STEPS)
_BYTES_PER_POINT = 40  # of a surface, while it is generated
_MOST_POINTS: dict[BodyName, int] = {"surface": 2**15, "line": 2**28}


def refuse_points(n: int, body: BodyName) -> None:
    """Refuse what is neither "surface" nor "line", and a number of points that neither has."""
    allowed_choice("body", body, _MOST_POINTS)
    if not is_whole(n) or not 3 <= n <= _MOST_POINTS[body]:
        refuse("n", n, f"a whole number of points from 3 to {_MOST_POINTS[body]} is needed")


def realisation(
    band: Band,
    normalisation: Normalisation,
    magnitude: float,
    body: BodyName,
    n: int,
    rng: Seed,
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
    allowed_choice("amplitudes", amplitudes, ("fixed", "gaussian"))
    for_phases, for_amplitudes = _generators(rng)
    seed = _described(rng, for_phases)
    C_0 = magnitude if normalisation == "C_0" else 1.0
    if body == "surface":
        moduli, heights_of = _surface_moduli(band, C_0, n), _surface_heights
    else:
        moduli, heights_of = _line_moduli(band, C_0, n), _line_heights
    if amplitudes == "gaussian":  # complex modes of unit mean square have these moduli
        is_map = body == "surface"
        draws = _surface_draws(n, for_amplitudes) if is_map else for_amplitudes.random(moduli.size)
        moduli = moduli * np.sqrt(-np.log1p(-draws))
    scale = 1.0 if normalisation == "C_0" else magnitude / _rms(moduli)
    heights = heights_of(moduli, for_phases, scale, n)
    return heights, {"n": int(n), "amplitudes": amplitudes, "seed": seed}


def random_line(moduli: Real, rms_height: float, n: int, rng: Seed) -> Real:
    """Sum modes of given moduli, from m = 1 on, and random phases to a line of an rms height."""
    for_phases, _ = _generators(rng)
    return _line_heights(moduli, for_phases, rms_height / _rms(moduli), n)


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


def _generators(rng: Seed) -> tuple[np.random.Generator, np.random.Generator]:
    """Return the generators of phases and of amplitudes that belong to a seed."""
    if isinstance(rng, np.random.Generator):
        return rng, rng.spawn(1)[0]
    try:
        seed = rng if isinstance(rng, np.random.SeedSequence) else np.random.SeedSequence(rng)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"rng is {rng!r}; a seed is a non-negative integer, a numpy SeedSequence or Generator"
        ) from error
    # not seed.spawn(), which would count up in the caller's seed
    child = np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, _AMPLITUDES))
    return np.random.default_rng(seed), np.random.default_rng(child)


def _described(rng: Seed, generator: np.random.Generator) -> str:
    """Say how to make the generator of the phases again."""
    if isinstance(rng, np.random.Generator):
        return "a generator in an unknown state"
    seed = generator.bit_generator.seed_seq
    assert isinstance(seed, np.random.SeedSequence)
    return f"entropy {seed.entropy}, spawn key {seed.spawn_key}"


def _surface_draws(n: int, rng: np.random.Generator) -> Real:
    """Draw one number in [0, 1) for each mode of the half plane with max(|mx|, |my|) < n / 2.

    They have the shape (n, n // 2 + 1) and lie where the real inverse FFT wants its modes; the
    negative half of the line my = 0 is left to Hermitian symmetry.
    """
    rings = (n - 1) // 2
    stream = rng.random(2 * rings * (rings + 1))
    draws = np.zeros((n, n // 2 + 1))
    for ring in range(1, rings + 1):
        members = stream[2 * ring * (ring - 1) : 2 * ring * (ring + 1)]
        draws[: ring + 1, ring] = members[: ring + 1]
        draws[n - ring :, ring] = members[ring + 1 : 2 * ring + 1]
        draws[ring, :ring] = members[2 * ring + 1 : 3 * ring + 1]
        draws[n - ring, 1:ring] = members[3 * ring + 1 :]
    return draws


def _rms(amplitudes: Real) -> float:
    """Root-mean-square height of a line or a surface with modes of given moduli (Parseval)."""
    if amplitudes.ndim == 1:
        return float(np.sqrt(2 * np.einsum("i,i->", amplitudes, amplitudes)))
    half = (amplitudes.shape[0] - 1) // 2
    plane, edge = amplitudes[:, 1:], amplitudes[1 : half + 1, 0]
    total = np.einsum("ij,ij->", plane, plane) + np.einsum("i,i->", edge, edge)
    return float(np.sqrt(2 * total))


def _line_heights(amplitudes: Real, rng: np.random.Generator, scale: float, n: int) -> Real:
    """Sum modes of given amplitudes and random phases to a periodic line.

    The amplitudes, in units of `scale`, are those of 0 < m < n / 2; the mean and, for even n, the
    Nyquist mode are zero.
    """
    from roughline.spectra.loops import set_line_modes  # here because numba loads slowly

    # the one array holds draws, modes and heights in turn: fresh memory costs more than the FFT
    heights = np.empty(n)
    draws = heights[n - amplitudes.size :]
    rng.random(out=draws)
    set_line_modes(heights, amplitudes, draws, scale, _TURN)
    fft.synthesise_line(heights)
    return heights


def _surface_heights(amplitudes: Real, rng: np.random.Generator, scale: float, n: int) -> Real:
    """Sum modes of given amplitudes, shape (n, n // 2 + 1), to a periodic surface.

    As :func:`_line_heights`, with the phases of :func:`_surface_draws`.
    """
    from roughline.spectra.loops import set_modes  # here because numba loads slowly

    modes = np.empty(amplitudes.shape, dtype=np.complex128)
    set_modes(modes.ravel(), amplitudes.ravel(), _surface_draws(n, rng).ravel(), scale, _TURN)
    half = (n - 1) // 2
    modes[n - half :, 0] = modes[half:0:-1, 0].conj()
    return fft.synthesise(modes, n)
