"""Random heights from the amplitudes of Fourier modes; one draw belongs to one wavevector.

Draws are ordered by wavenumber (1D) or by square rings around q = 0 (2D), so a finer grid with the
same seed repeats the draws of the coarser one and adds to them.
"""

from __future__ import annotations

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.errors import InputError

_AMPLITUDES = 0x616D706C  # spawn key of the amplitudes; no ensemble counts realisations so far
_STEPS = 4096  # of a turn, from which phases are reached by a small rotation
_TURN = np.exp(2j * np.pi * np.arange(_STEPS) / _STEPS)

Seed = int | np.random.SeedSequence | np.random.Generator | None


def generators(rng: Seed) -> tuple[np.random.Generator, np.random.Generator]:
    """Return the generators of phases and of amplitudes that belong to a seed.

    Realisation i of an ensemble has the seed ``SeedSequence(root, spawn_key=(i,))``.
    """
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


def described(rng: Seed, generator: np.random.Generator) -> str:
    """Say how to make the generator of the phases again."""
    if isinstance(rng, np.random.Generator):
        return "a generator in an unknown state"
    seed = generator.bit_generator.seed_seq
    assert isinstance(seed, np.random.SeedSequence)
    return f"entropy {seed.entropy}, spawn key {seed.spawn_key}"


def rayleigh(draws: Real) -> Real:
    """Turn draws into moduli of complex Gaussian modes of unit mean square."""
    return np.sqrt(-np.log1p(-draws))


def line_draws(n: int, rng: np.random.Generator) -> Real:
    """Draw one number in [0, 1) for each mode 0 < m < n / 2, in this order."""
    return rng.random((n - 1) // 2)


def surface_draws(n: int, rng: np.random.Generator) -> Real:
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


def rms_of(amplitudes: Real) -> float:
    """Root-mean-square height of a line or a surface with modes of given moduli (Parseval)."""
    if amplitudes.ndim == 1:
        return float(np.sqrt(2 * np.einsum("i,i->", amplitudes, amplitudes)))
    half = (amplitudes.shape[0] - 1) // 2
    plane, edge = amplitudes[:, 1:], amplitudes[1 : half + 1, 0]
    total = np.einsum("ij,ij->", plane, plane) + np.einsum("i,i->", edge, edge)
    return float(np.sqrt(2 * total))


def line_heights(amplitudes: Real, rng: np.random.Generator, scale: float, n: int) -> Real:
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


def surface_heights(amplitudes: Real, rng: np.random.Generator, scale: float, n: int) -> Real:
    """Sum modes of given amplitudes, shape (n, n // 2 + 1), to a periodic surface.

    As :func:`line_heights`, with the phases of :func:`surface_draws`.
    """
    from roughline.spectra.loops import set_modes  # here because numba loads slowly

    modes = np.empty(amplitudes.shape, dtype=np.complex128)
    set_modes(modes.ravel(), amplitudes.ravel(), surface_draws(n, rng).ravel(), scale, _TURN)
    half = (n - 1) // 2
    modes[n - half :, 0] = modes[half:0:-1, 0].conj()
    return fft.synthesise(modes, n)
