"""A self-affine spectrum with its height: as a continuum, and on the wavevectors of a grid.

A periodic body of length L has the wavevectors of a lattice of spacing q_0 = 2 pi / L, and a grid
of n points carries those with |q| < pi n / L. Where the spectrum rises down to q_0, sums over the
few longest waves differ from integrals by tens of per cent. So a spectrum that is given by its rms
height has one factor C_0 as a continuum, and another on every grid.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real
from roughline.errors.public import public
from roughline.spectra.band import Band

BodyName = Literal["surface", "line"]

_BLOCK_WAVES = 2**20  # wavevectors summed at a time


@public
@dataclass(frozen=True)
class ScaledSpectrum(ABC):
    """Isotropic spectrum with its height, at wavenumbers q of either sign. [1 / length]

    Attributes
    ----------
    band : Band
        Shape, and the range of wavenumbers.
    C_0 : float
        Value of C_2d at ``q_roll`` and on the plateau. [length⁴]
    """

    band: Band
    C_0: float

    @abstractmethod
    def moment(self, order: int) -> float:
        """<h²> for order 0, <|grad h|²> for 2, <(laplacian h)²> for 4. [length^(2 - order)]"""

    @property
    def rms_height(self) -> float:
        """Root-mean-square height. [length]"""
        return math.sqrt(self.moment(0))

    @property
    def rms_slope(self) -> float:
        """Root-mean-square gradient. [1]"""
        return math.sqrt(self.moment(2))

    def C_2d(self, q: ArrayLike) -> Real:
        """Spectrum of the surface over its wavevectors, the paper's eq. 3. [length⁴]"""
        return self.C_0 * self.band.shape(np.abs(np.asarray(q, dtype=np.float64)))

    def C_reduced(self, q: ArrayLike) -> Real:
        """Spectrum pi q C_2d(q) of the reduced line, the paper's eq. 7. [length³]"""
        return np.pi * np.abs(np.asarray(q, dtype=np.float64)) * self.C_2d(q)

    def C_profile(self, q: ArrayLike) -> Real:
        """Spectrum of a straight cut, 2 int_q^inf C_2d(q') q' dq' / sqrt(q'² - q²). [length³]

        This is what a line scan measures; it is not the spectrum of the reduced line.
        """
        return self.C_0 * self.band.cut(np.abs(np.asarray(q, dtype=np.float64)))


@public
@dataclass(frozen=True)
class ContinuumSpectrum(ScaledSpectrum):
    """A spectrum whose moments are integrals: that of a surface much larger than its waves."""

    def moment(self, order: int) -> float:
        """Integral 2 pi int q^(1 + order) C_2d dq. [length^(2 - order)]

        Order 0 is <h²>, order 2 <|grad h|²>, order 4 <(laplacian h)²>; the reduced line has the
        same moments of h, h' and h''.

        Raises
        ------
        InputError
            If the integral diverges, because ``q_high`` is not set.
        """
        return self.C_0 * self.band.moment(order)


@public
@dataclass(frozen=True)
class LatticeSpectrum(ScaledSpectrum):
    """The spectrum of a periodic body of n points: that of its heights, to rounding.

    Attributes
    ----------
    n : int
        Points along a side. Waves with |q| < pi n / length are carried.
    body : {"surface", "line"}
        Whether sums are over the lattice of wavevectors in the plane, or along the reduced line.
    """

    n: int
    body: BodyName

    @classmethod
    def of(cls, band: Band, C_0: float, n: int, body: BodyName) -> LatticeSpectrum:
        """Cut a band at what the grid carries."""
        # strictly below the grid's shortest wave, whose phase n points do not determine
        most = band.q_low * n / 2 * (1 - 1e-9)
        q_high = min(band.q_high, most)
        return cls(replace(band, q_roll=min(band.q_roll, q_high), q_high=q_high), C_0, n, body)

    def moment(self, order: int) -> float:
        """Sum over the wavevectors of the grid. [length^(2 - order)]

        Order 0 is <h²>, order 2 <|grad h|²> or <h'²>, order 4 <(laplacian h)²> or <h''²>.
        """
        return sum(float((power * q**order).sum()) for q, power in self.waves())

    def waves(self) -> Iterator[tuple[Real, Real]]:
        """Give wavenumbers and their shares of <h²>, in blocks. [1 / length], [length²]"""
        q_0 = self.band.q_low
        if self.body == "line":
            q = q_0 * np.arange(1.0, (self.n - 1) // 2 + 1)
            yield q, 2 * q_0 * self.C_reduced(q)
            return
        for q, count in lattice_waves(q_0, self.n):
            yield q, q_0**2 * count * self.C_2d(q)


def lattice_waves(q_0: float, n: int) -> Iterator[tuple[Real, int]]:
    """Give the wavenumbers of the lattice that n points carry, each for 4 wavevectors."""
    most = (n - 1) // 2
    along = np.arange(0.0, most + 1)
    rows = max(1, _BLOCK_WAVES // (most + 1))
    for start in range(1, most + 1, rows):  # a quarter of the plane: mx > 0, my >= 0
        across = along[start : start + rows, np.newaxis]
        m = np.hypot(across, along).ravel()
        yield q_0 * m[m < n / 2], 4
