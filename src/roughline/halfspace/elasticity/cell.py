"""What pressure on one cell of a grid displaces that cell by."""

from __future__ import annotations

import numpy as np

from roughline.halfspace.elasticity.half_space import HalfSpace

_PERIOD = 64  # cells, after which one cell of a repeated half-space comes again


def cell_compliance(half_space: HalfSpace, spacing: tuple[float, float]) -> float:
    """Return the displacement of a cell by unit pressure on it alone. [length / pressure]

    A repeated half-space has no cell alone. There it is one of 64 x 64, which are one period, to
    about a hundredth of what it is on larger grids.

    Parameters
    ----------
    half_space : HalfSpace
        What is pressed.
    spacing : tuple of float
        Sides of the cell, (dx, dy). [length]
    """
    if all(half_space.repeats):
        qx, qy = (2 * np.pi * np.fft.fftfreq(_PERIOD, side) for side in spacing)
        with np.errstate(divide="ignore", invalid="ignore"):
            moved = half_space.spectrum(np.hypot(qx[:, np.newaxis], qy))
        return float(np.mean(moved, where=np.isfinite(moved)))
    alone = np.empty((1, 1))
    half_space.kernel(0, spacing, alone)
    return float(alone[0, 0])
