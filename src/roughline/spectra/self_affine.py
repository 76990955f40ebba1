"""Self-affine roughness spectra: of the surface, of its reduced line and of a straight cut.

Conventions: q = 2 pi / wavelength, and

    <h²> = 2 pi int_0^inf q C_2d(q) dq
         = int_{-inf}^{inf} C_reduced(q) dq = int_{-inf}^{inf} C_profile(q) dq.
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace
from functools import lru_cache

from numpy.typing import ArrayLike

from roughline.computing.arrays import Real
from roughline.errors import ContinuumWarning, InputError
from roughline.errors.checks import between, positive, refuse, whole_number
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.facts.fact import Fact
from roughline.spectra.band import Band
from roughline.spectra.lattice import BodyName, ContinuumSpectrum, LatticeSpectrum
from roughline.spectra.synthesis import (
    Amplitudes,
    Normalisation,
    Seed,
    realisation,
    refuse_points,
)
from roughline.topography.body import Line, Surface
from roughline.topography.settings import Settings

_MOST_SUMMED = 64  # waves along L from which on the lattice's sum is its integral
_CLOSE_TO_CONTINUUM = 0.05  # relative difference of bodies, up to which they count as equal


@public
@dataclass(frozen=True, init=False, repr=False)
class SelfAffine:
    """Isotropic self-affine spectrum with optional roll-off and cutoff (the paper's eq. 3).

    ``C_2d(q) = C_0`` from ``q_low = 2 pi / length`` to ``q_roll`` (default: ``q_low``, no
    plateau), then ``C_0 (q / q_roll)**(-2 (H + 1))`` up to ``q_high``, and zero outside.

    What is given fixes how surfaces and lines are scaled: with ``rms_height`` each of them is
    scaled to that rms (the paper's choice); with ``C_0`` both are generated from the same
    spectrum, and their rms heights differ, as their lattices of wavevectors do.

    ``continuum`` and ``lattice(n, body)`` are the two spectra that this can mean: integrals, or the
    sums that a body of n points has. Without a roll-off, or with one below about 3 ``q_low``, they
    differ by 5 % to a factor of two. ``C_0``, ``C_2d``, ``C_reduced``, ``C_profile``, ``moment``
    and ``rms_height`` of the spectrum itself are the continuum's, and warn where bodies are more
    than 5 % off.

    Parameters
    ----------
    hurst : float, optional
        Hurst exponent H, 0 to 1. Give this or `fractal_dimension`.
    fractal_dimension : float, optional
        D_f = 3 - H, 2 to 3.
    length : float
        Side of the square surface and length of the line. [length]
    rms_height : float, optional
        Root-mean-square height h. Give this or `C_0`. [length]
    C_0 : float, optional
        Value of C_2d at ``q_roll`` and on the plateau. [length⁴]
    q_roll : float, optional
        Roll-off wavenumber; the spectrum is flat below. [1 / length]
    q_high : float, optional
        Largest wavenumber; default: whatever the grid carries. [1 / length]

    Raises
    ------
    InputError
        If both or neither of a pair are given, or a value is outside its range.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=0.01, q_roll=25.0)
    >>> surface = spectrum.surface(64, rng=7)
    >>> print(surface.shape, round(surface.rms_height, 4))
    (64, 64) 0.01
    >>> print(spectrum.line(2**10, rng=7).heights.shape)
    (1024,)
    >>> print(round(spectrum.fractal_dimension, 2))
    2.2
    """

    hurst: float
    length: float
    normalisation: Normalisation
    magnitude: float
    q_roll: float
    q_high: float

    def __init__(
        self,
        *,
        hurst: float | None = None,
        fractal_dimension: float | None = None,
        length: float = 1.0,
        rms_height: float | None = None,
        C_0: float | None = None,
        q_roll: float | None = None,
        q_high: float | None = None,
    ) -> None:
        if (hurst is None) == (fractal_dimension is None):
            given = "neither is" if hurst is None else "both are"
            raise InputError(
                f"give exactly one of {called('hurst')} and "
                f"{called('fractal_dimension')}; {given} given"
            )
        if (rms_height is None) == (C_0 is None):
            given = "neither is" if C_0 is None else "both are"
            raise InputError(f"give exactly one of {called('rms_height')} and C_0=; {given} given")
        if hurst is None:
            assert fractal_dimension is not None
            between("fractal_dimension", fractal_dimension, 2, 3, "allowed is 2 to 3")
            hurst = round(3 - fractal_dimension, 12)  # 3 - 2.2 means 0.8 to the last bit
        between("hurst", hurst, 0, 1, "allowed is 0 to 1")
        positive("length", length)
        q_low = 2 * math.pi / length
        q_roll = q_low if q_roll is None else q_roll
        q_high = math.inf if q_high is None else q_high
        if not q_low * (1 - 1e-12) <= q_roll < math.inf:
            refuse("q_roll", q_roll, f"at least q_low, 2 pi / length = {q_low:g}, is needed")
        if not q_roll < q_high:
            refuse("q_high", q_high, f"more than q_roll, {q_roll:g}, is needed")
        magnitude = C_0 if rms_height is None else rms_height
        assert magnitude is not None
        object.__setattr__(self, "normalisation", "C_0" if rms_height is None else "rms_height")
        positive(self.normalisation, magnitude)
        values = {"hurst": hurst, "length": length, "magnitude": magnitude}
        for name, value in (values | {"q_roll": q_roll, "q_high": q_high}).items():
            object.__setattr__(self, name, float(value))

    def __repr__(self) -> str:
        """Write the call that makes this spectrum again."""
        given: dict[str, float] = {
            "hurst": self.hurst,
            "length": self.length,
            self.normalisation: self.magnitude,
        }
        if self.q_roll != self.q_low:
            given["q_roll"] = self.q_roll
        if self.q_high != math.inf:
            given["q_high"] = self.q_high
        return f"SelfAffine({', '.join(f'{name}={value!r}' for name, value in given.items())})"

    @property
    def _band(self) -> Band:
        return Band(self.q_low, self.q_roll, self.q_high, 2 * (self.hurst + 1))

    @property
    def fractal_dimension(self) -> float:
        """D_f = 3 - H. [1]"""
        return round(3 - self.hurst, 12)

    @property
    def q_low(self) -> float:
        """Smallest wavenumber, 2 pi / length. [1 / length]"""
        return 2 * math.pi / self.length

    @property
    def continuum(self) -> ContinuumSpectrum:
        """The spectrum whose moments are integrals, with the C_0 or the rms height given.

        Raises
        ------
        InputError
            For H = 0 without ``q_high`` when the rms height was given: the integral diverges.
        """
        if self.normalisation == "C_0":
            return ContinuumSpectrum(self._band, self.magnitude)
        return ContinuumSpectrum(self._band, self.magnitude**2 / self._band.moment(0))

    def lattice(self, n: int, body: BodyName = "surface") -> LatticeSpectrum:
        """Return the spectrum that a generated body has.

        Parameters
        ----------
        n : int
            Points along a side, as for :meth:`surface` and :meth:`line`.
        body : {"surface", "line"}
            Which of the two. Scaled to one rms height, their spectra differ.
        """
        refuse_points(n, body)
        C_0 = self.magnitude
        if self.normalisation == "rms_height":
            C_0 = self.magnitude**2 / LatticeSpectrum.of(self._band, 1.0, n, body).moment(0)
        return LatticeSpectrum.of(self._band, C_0, n, body)

    @property
    def C_0(self) -> float:
        """Value of C_2d at q_roll, given or that of the continuum. [length⁴]

        Raises
        ------
        InputError
            As for :attr:`continuum`.
        """
        return self._continuum_for("C_0", self._over_bodies("surface")).C_0

    @property
    def rms_height(self) -> float:
        """Root-mean-square height, given or as the continuum integral of C_2d. [length]"""
        if self.normalisation == "rms_height":
            return self.magnitude
        factor = 1 / math.sqrt(_sum_over_integral(self._band, 0, "surface"))
        return self._continuum_for("rms_height", factor).rms_height

    def C_2d(self, q: ArrayLike) -> Real:
        """Spectrum of the surface, the paper's eq. 3, as of :attr:`continuum`. [length⁴]"""
        return self._continuum_for("C_2d", self._over_bodies("surface")).C_2d(q)

    def C_reduced(self, q: ArrayLike) -> Real:
        """Spectrum of the reduced line, the paper's eq. 7, as of :attr:`continuum`. [length³]"""
        return self._continuum_for("C_reduced", self._over_bodies("line"), "line").C_reduced(q)

    def C_profile(self, q: ArrayLike) -> Real:
        """Spectrum of a straight cut, as of :attr:`continuum`. [length³]"""
        return self._continuum_for("C_profile", self._over_bodies("surface")).C_profile(q)

    def moment(self, order: int) -> float:
        """<h²>, <(grad h)²>, <(laplacian h)²>, as of :attr:`continuum`. [length^(2 - order)]"""
        whole_number("order", order, 0, "0, 2 or 4 is needed, or another whole number from 0 on")
        factor = self._over_bodies("surface") / _sum_over_integral(self._band, order, "surface")
        return self._continuum_for("moment", factor).moment(order)

    def difference_from_surfaces(self) -> str:
        """Say how the continuum differs from the surfaces generated; empty within 5 %."""
        factor = _sum_over_integral(self._band, 0, "surface")
        if abs(factor - 1) <= _CLOSE_TO_CONTINUUM:
            return ""
        if self.normalisation == "rms_height":
            return f"{factor:.2f} times the C_2d"
        return f"{1 / math.sqrt(factor):.2f} times the rms height"

    def _over_bodies(self, body: BodyName) -> float:
        """C_2d of the continuum over that of the surfaces or lines that are generated. [1]"""
        return 1.0 if self.normalisation == "C_0" else _sum_over_integral(self._band, 0, body)

    def _continuum_for(
        self, name: str, factor: float, body: BodyName = "surface"
    ) -> ContinuumSpectrum:
        """Return the continuum, for an attribute; warn where it is `factor` times the bodies'."""
        if abs(factor - 1) > _CLOSE_TO_CONTINUUM:
            fact = Fact("continuum_differs", name=name, factor=factor, is_line=body == "line")
            warnings.warn(str(fact), ContinuumWarning, stacklevel=3)  # who asked for the attribute
        return self.continuum

    def surface(self, n: int, rng: Seed = None, amplitudes: Amplitudes = "fixed") -> Surface:
        """Generate a random square surface.

        The same seed with a larger `n` gives the same surface with more detail: one phase belongs
        to one wavevector. Phases do not depend on the spectrum. Modes with q below
        ``min(q_high, pi n / length)`` are used, a circle; the Nyquist modes are zero.

        Parameters
        ----------
        n : int
            Points along each side, at least 3.
        rng : int, SeedSequence, Generator, optional
            Seed. Realisation i of an ensemble has ``SeedSequence(root, spawn_key=(i,))``, so it
            does not depend on how many are made.
        amplitudes : {"fixed", "gaussian"}, optional
            Random phases with moduli from the spectrum (the paper's choice), or complex Gaussian
            modes. The phases are the same in both.

        Returns
        -------
        Surface
            Heights (n, n). [length]
        """
        heights, settings = self._generate("surface", n, rng, amplitudes)
        sides = (self.length, self.length)
        return Surface(heights, sides, settings=settings, is_cut_out=False)

    def line(self, n: int, rng: Seed = None, amplitudes: Amplitudes = "fixed") -> Line:
        """Generate the random line of the reduction method (spectrum ``C_reduced``).

        Parameters
        ----------
        n : int
            Points, at least 3.
        rng, amplitudes
            As for :meth:`surface`.

        Returns
        -------
        Line
            Heights (n,). [length]
        """
        heights, settings = self._generate("line", n, rng, amplitudes)
        return Line(heights, self.length, settings=settings, is_cut_out=False)

    def _generate(
        self, body: BodyName, n: int, rng: Seed, amplitudes: Amplitudes
    ) -> tuple[Real, Settings]:
        """Heights of a body, and the settings that make them again."""
        heights, made = realisation(
            self._band, self.normalisation, self.magnitude, body, n, rng, amplitudes
        )
        settings: Settings = {
            "origin": f"self-affine {body}",
            "hurst": self.hurst,
            "length": self.length,
            "normalisation": self.normalisation,
            self.normalisation: self.magnitude,
            "q_roll": self.q_roll,
            "q_high": self.q_high,
            **made,
        }
        return heights, settings


@lru_cache(maxsize=256)
def _sum_over_integral(band: Band, order: int, body: BodyName) -> float:
    """Moment over the whole lattice of wavevectors, over the integral.

    The sum is taken over the longest waves; over shorter ones it equals the integral.
    """
    integral = band.moment(order)
    summed = LatticeSpectrum.of(band, 1.0, 2 * _MOST_SUMMED + 1, body)
    # half a wave further: each wavevector stands for the cell around it
    edge = min(band.q_high, (_MOST_SUMMED + 0.5) * band.q_low)
    rest = replace(band, q_roll=min(band.q_roll, edge), q_high=edge).moment(order)
    return 1 + (summed.moment(order) - rest) / integral
