"""Compiled loops over the modes of random heights; they take arrays only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real
from roughline.computing.compiled import compiled


@compiled
def _phase(draw: float, turn: NDArray[np.complex128]) -> complex:
    """Return exp(2 pi i draw), several times faster than cosine and sine.

    A table of the circle, and cosine and sine of the small rest of the angle by their series, of
    which the first term left out is below 1e-19.
    """
    step = int(draw * turn.size)
    angle = 2 * np.pi * (draw - step / turn.size)
    square = angle * angle
    cosine = 1 - square / 2 * (1 - square / 12)
    sine = angle * (1 - square / 6 * (1 - square / 20))
    return turn[step] * complex(cosine, sine)


@compiled
def set_modes(
    modes: NDArray[np.complex128],
    amplitudes: Real,
    draws: Real,
    scale: float,
    turn: NDArray[np.complex128],
) -> None:
    """Set modes of given moduli and phases (over 2 pi), over flat arrays."""
    for i in range(modes.size):
        modes[i] = scale * amplitudes[i] * _phase(draws[i], turn)


@compiled
def set_line_modes(
    line: Real, amplitudes: Real, draws: Real, scale: float, turn: NDArray[np.complex128]
) -> None:
    """Set the modes of a line as the real transform wants them: mean, then real and imaginary.

    `draws` may be the end of `line`: each is read before it is overwritten.
    """
    line[0] = 0.0
    for i in range(amplitudes.size):
        mode = scale * amplitudes[i] * _phase(draws[i], turn)
        line[2 * i + 1] = mode.real
        line[2 * i + 2] = mode.imag
    if line.size % 2 == 0:
        line[line.size - 1] = 0.0
