"""Equations for even pressures on blocks of nodes, solved as if all blocks were full."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real

_LEAST = 0.1  # eigenvalue of a kernel of blocks over the median; cut short, it may have others


@dataclass(frozen=True, eq=False)
class BlockKernel:
    """The kernel averaged over blocks.

    Attributes
    ----------
    values : ndarray, shape of the lattice of blocks
        Displacement of a node by the pressure on another, averaged over the blocks of the two, by
        the distance of these blocks. [length / pressure]
    periodic : bool
        Whether the lattice repeats itself.
    """

    values: Real
    periodic: bool

    @cached_property
    def periods(self) -> tuple[int, int]:
        """Blocks after which the inverse convolution repeats itself."""
        mx, my = self.values.shape
        return (mx, my) if self.periodic else (max(1, 2 * mx - 2), max(1, 2 * my - 2))

    @cached_property
    def inverse(self) -> Real:
        """Half of the eigenvalues of the inverse, over the product of the periods."""
        x, y = (np.minimum(np.arange(n), -np.arange(n) % n) for n in self.periods)
        spectrum = fft.half_spectrum(self.values[x[:, np.newaxis], y]).real
        return 1 / (np.maximum(spectrum, _LEAST * np.median(spectrum)) * x.size * y.size)


class EvenOnBlocks:
    """The inverse convolution of the kernel of blocks; each block counts by its own energy.

    Parameters
    ----------
    kernel : BlockKernel
        Averaged kernel.
    count : ndarray, shape of the lattice
        Nodes in each block.
    energy : ndarray, shape of the lattice
        Energy of unit pressure on them; never taken below that of the averaged kernel.
        [length / pressure]
    """

    def __init__(self, kernel: BlockKernel, count: Real, energy: Real) -> None:
        full, occupied = kernel.values[0, 0], count > 0
        own = np.maximum(energy, count**2 * full)[occupied]
        if not own.min(initial=full) > 0:
            raise np.linalg.LinAlgError("the half-space is not positive definite")
        self._kernel, self._per_node = kernel, np.zeros(count.shape)
        self._per_node[occupied] = np.sqrt(full / own)

    def __call__(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        (mx, my), periods = sums.shape, self._kernel.periods
        padded = np.zeros(periods)
        padded[:mx, :my] = sums * self._per_node
        modes = fft.half_spectrum(padded) * self._kernel.inverse
        return fft.synthesise(modes, periods[1])[:mx, :my] * self._per_node
