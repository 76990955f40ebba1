"""What is asked of a fluid in the gap: which one, between which pressures, through which seal."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
from attrs import field, frozen

from roughline.computing.arrays import Mask, Real
from roughline.engineering.fluids import Gas, Liquid, fluid_of
from roughline.engineering.leak import gas_throughput, liquid_leak
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, flag, refuse
from roughline.errors.public import public
from roughline.errors.words import called, speaking
from roughline.fluid.gap import Along
from roughline.fluid.rarefied import Rarefied
from roughline.fluid.reopening import Reopening
from roughline.fluid.sealing_pressure import SealingPressure
from roughline.units import as_si, engineering, in_si

ATMOSPHERE = 101325.0
"""Pressure outside, where no other is given. [Pa]"""

_CARRIES = 0.05  # of the load, from which share on the fluid is taken to carry it
_NODES = 40  # of Gauss over the area of a ring
_SHARE_ROUNDING = 1e-9  # of a load, by which it may miss that share

_MARKED = re.compile(
    r"(?P<pressure>.*(?:Pa|bar|psi|atm))\s*\(?(?P<mark>gauge|g|absolute|abs|a)\.?\)?\s*",
    re.IGNORECASE,
)
"""A pressure that says whether it is above that of the air, such as "6 barg", or "7 bar abs"."""

_ACROSS = re.compile(r"\s+x\s+|\s*×\s*")
_RING = re.compile(r"\s*\.\.+\s*")
_NEEDED = (
    'give its length across the flow and its width along it, such as "100 mm x 2 mm", or the two '
    'radii of a ring, such as "20 mm .. 24 mm"'
)


@dataclass(frozen=True)
class SealShape:
    """The face of a seal: a strip that is crossed, or a ring that is crossed radially."""

    words: str
    ratio: float  # W / B, length across the flow over the way through, of a ring 2π / ln(R/r) [1]
    width: float  # W, of a ring its inner circumference [m]
    area: float  # [m²]
    is_ring: bool

    @classmethod
    def of(cls, given: Any) -> SealShape:
        """Read a shape such as "100 mm x 2 mm" or "20 mm .. 24 mm".

        Raises
        ------
        InputError
            If it is neither, or the inner radius is not below the outer one.
        UnitError
            If a length has no unit, or a wrong one.
        """
        if isinstance(given, cls):
            return given
        if not isinstance(given, str):
            refuse("seal", given, _NEEDED)
        for pattern in (_RING, _ACROSS):
            parts = pattern.split(given.strip())
            if len(parts) == 2:
                first, second = (in_si(part, "m", "seal") for part in parts)
                break
        else:
            refuse("seal", given, _NEEDED)
        if not (0 < first < math.inf and 0 < second < math.inf):
            refuse("seal", given, "positive, finite lengths are needed")
        if pattern is _ACROSS:
            return cls(given.strip(), first / second, first, first * second, False)
        if first >= second:
            refuse("seal", given, "the inner radius comes first, and is below the outer one")
        around, area = 2 * math.pi, math.pi * (second**2 - first**2)
        return cls(given.strip(), around / math.log(second / first), around * first, area, True)


def _fluid(given: str | Liquid | Gas | None) -> Liquid | Gas | None:
    """A fluid, from itself or from its description."""
    if given is None:
        return None
    try:
        with speaking(None):  # a description calls its values the same for everyone
            return fluid_of(given)
    except InputError as error:
        raise type(error)(f"cannot be used: {error}", "fluid") from error


def _absolute(given: float | str, name: str) -> float:
    """An absolute pressure; that of vacuum is zero. [Pa]"""
    marked = _MARKED.fullmatch(given) if isinstance(given, str) else None
    if marked and marked["mark"].lower().startswith("g"):
        refuse(name, given, "an absolute pressure is needed: add that of the air, 1.013 bar")
    pressure = as_si(marked["pressure"] if marked else given, "Pa", name)
    if not 0 <= pressure < math.inf:
        refuse(name, given, "an absolute pressure is needed, which is zero in vacuum")
    return pressure


def _inlet(given: float | str | None) -> float | None:
    return None if given is None else _absolute(given, "inlet")


def _outlet(given: float | str | None) -> float:
    return ATMOSPHERE if given is None else _absolute(given, "outlet")


def _seal(given: str | SealShape | None) -> SealShape | None:
    return None if given is None else SealShape.of(given)


def _direction(given: Literal["x", "y", "both"]) -> Literal["x", "y", "both"]:
    directions: tuple[Literal["x", "y", "both"], ...] = ("both", "x", "y")
    return allowed_choice("along", given, directions)


def _carries(given: bool | None) -> bool | None:
    return None if given is None else flag("carries", given)


@public
@frozen
class Fluid:
    """A fluid in the gap, the pressures on both sides of it, and the seal that it crosses.

    Asked for what flows through, for what a gas conducts, and for where the gap closes.

    Parameters
    ----------
    fluid : str, Liquid or Gas, optional
        Such as "water" or "helium", of the table of fluids. Where the gap closes is known of any:
        then it may be left out.
    inlet : float or str, optional
        Absolute pressure where it enters the seal, such as "6 bar". [Pa]
    outlet : float or str, optional
        Absolute pressure where it leaves the seal, such as "1 bar", or zero for vacuum; default:
        that outside, 1 atm. [Pa]
    seal : str, optional
        The face that it crosses, asked for its leak rate: length across the flow and width along
        it, such as "100 mm x 2 mm", or the inner and the outer radius of a ring, such as
        "20 mm .. 24 mm".
    along : {"both", "x", "y"}, optional
        Direction over the map in which it flows; "both" stands for the leakier one.
    closure : bool, optional
        Whether the mean pressure is asked for at which the last channel closes, and how far the
        load may then be taken off.
    carries : bool, optional
        Whether it carries its part of the load, so that the bodies press with the rest; default:
        where that is a twentieth of the load or more.

    Raises
    ------
    InputError
        If what is given does not fit together, or no fluid and no closure is asked for.
    UnitError
        If a text has no unit, or a wrong one.

    Examples
    --------
    >>> import roughline as rl
    >>> ring = rl.Fluid("helium", inlet="6 bar", outlet="1 bar", seal="20 mm .. 24 mm", along="x")
    >>> print(ring.inlet, round(ring.seal.ratio, 2))
    600000.0 34.46
    """

    fluid: Liquid | Gas | None = field(default=None, converter=_fluid)
    inlet: float | None = field(default=None, converter=_inlet, kw_only=True)
    outlet: float = field(default=None, converter=_outlet, kw_only=True)
    seal: SealShape | None = field(default=None, converter=_seal, kw_only=True)
    along: Literal["x", "y", "both"] = field(default="both", converter=_direction, kw_only=True)
    closure: bool = field(default=False, kw_only=True)
    carries: bool | None = field(default=None, converter=_carries, kw_only=True)

    def __attrs_post_init__(self) -> None:
        inlet, seal = called("inlet"), called("seal")
        if self.carries is not None and self.inlet is None:
            text = f"{called('carries')} belongs to {inlet}: give that too"
            raise InputError(text, None, "carries", "inlet")
        if self.fluid is None:
            self._refuse_without_fluid()
        if (self.inlet is None) != (self.seal is None):
            have, need = (inlet, seal) if self.seal is None else (seal, inlet)
            raise InputError(f"a leak needs {need} beside {have}: give it", None, "inlet", "seal")
        if self.inlet is not None and not self.inlet > self.outlet:
            raise InputError(
                f"the inlet ({inlet}) is at {engineering(self.inlet, 'Pa')}, and the outlet "
                f"({called('outlet')}) at {engineering(self.outlet, 'Pa')}, both absolute: a fluid "
                "enters where its pressure is higher",
                None,
                "inlet",
                "outlet",
            )

    def _refuse_without_fluid(self) -> None:
        """Refuse what belongs to a fluid that is named."""
        outlet = None if self.outlet == ATMOSPHERE else self.outlet
        for name, value in (("inlet", self.inlet), ("outlet", outlet), ("seal", self.seal)):
            if value is not None:
                text = f"{called(name)} belongs to a fluid ({called('fluid')}): give that too"
                raise InputError(text, None, name, "fluid")
        if not self.closure:
            asked = f"{called('fluid')} and {called('closure', True)}"
            text = f"neither a fluid is named, nor its closure asked for: give one of {asked}"
            raise InputError(text, None, "fluid", "closure")

    @property
    def medium(self) -> Liquid | Gas:
        """The fluid that flows; of a gap that is asked for its closure alone, it is refused."""
        if self.fluid is None:
            raise InputError('is not named; give one, such as "water"', "fluid")
        return self.fluid

    @property
    def directions(self) -> Sequence[Along]:
        """Directions over the map in which the fluid flows."""
        return get_args(Along) if self.along == "both" else (self.along,)

    @property
    def gas(self) -> Gas | None:
        """The fluid, if it is a gas."""
        return self.fluid if isinstance(self.fluid, Gas) else None

    @property
    def conductivity(self) -> float:
        """Thermal conductivity of the gas; 0 where none is known, and in vacuum. [W / (m K)]"""
        gas = self.gas
        return gas.conductivity or 0.0 if gas is not None and self.mean_pressure > 0 else 0.0

    @property
    def mean_pressure(self) -> float:
        """Mean of both pressures, or that of the outlet alone. [Pa]"""
        return self.outlet if self.inlet is None else (self.inlet + self.outlet) / 2

    @property
    def excess(self) -> float:
        """By how much the mean pressure in the gap is above the outside; 0 where it is not. [Pa]

        Along the way the pressure of a liquid falls evenly, and the square of that of a gas. That
        of a rare gas falls more evenly, and its mean is less than this.
        """
        if self.inlet is None:
            return 0.0
        first, last = self.inlet, self.outlet
        mean = (first + last) / 2
        if self.gas is not None and first + last > 0:
            mean = 2 / 3 * (first**2 + first * last + last**2) / (first + last)
        return max(mean - ATMOSPHERE, 0.0)

    @property
    def excess_in_ring(self) -> tuple[float, float]:
        """Mean excess over the area of a ring, if the fluid enters inside, and if outside. [Pa]

        The pressure of a liquid falls evenly with the logarithm of the radius, and the square of
        that of a gas. Of a strip both are the excess.
        """
        if self.inlet is None or self.seal is None or not self.seal.is_ring:
            return self.excess, self.excess
        nodes, weights = np.polynomial.legendre.leggauss(_NODES)
        span = 4 * math.pi / self.seal.ratio  # logarithm of the square of the radii's ratio
        fallen = np.log1p((nodes + 1) / 2 * math.expm1(span)) / span  # over even parts of the area
        power = 1 if self.gas is None else 2
        first, last = self.inlet**power, self.outlet**power
        means = (
            float(weights @ (first + (last - first) * each) ** (1 / power)) / 2
            for each in (fallen, 1 - fallen)
        )
        inside, outside = (max(mean - ATMOSPHERE, 0.0) for mean in means)
        return inside, outside

    def _is_carried(self, load: Real, area: float) -> Mask:
        """Whether the fluid carries a part of forces [N] on an area [m²] that counts."""
        least = 0.0 if self.carries else _CARRIES * (1 - _SHARE_ROUNDING)
        counts = self.carries is not False and self.excess > 0
        return counts & (self.excess * area >= least * np.asarray(load))

    def force_on_bodies(self, load: Real, area: float) -> Real:
        """Forces with which bodies of an area [m²] press under forces on them. [N]

        A uniform pressure of the fluid moves nothing but the mean of a half-space, so that the
        contact is that of what is left. Where that is zero or less, the fluid lifts the bodies.
        """
        return np.where(self._is_carried(load, area), load - self.excess * area, load)

    def load_on(self, pressing: Real, area: float) -> Real:
        """Forces on bodies of an area [m²] that press with some forces: the inverse. [N]"""
        load = pressing + self.excess * area
        return np.where(self._is_carried(load, area), load, pressing)

    def opens_at(self, pressure: Real) -> Real:
        """Absolute pressure at the inlet that lifts bodies under a mean pressure. [Pa]

        The mean pressure in the gap is then as far above the outside. Where the pressure of the
        outlet is enough, it is that.
        """
        mean, last = pressure + ATMOSPHERE, self.outlet
        if self.gas is None:
            return np.maximum(2 * mean - last, last)
        # of 2/3 (P1² + P1 P2 + P2²) / (P1 + P2) = P_m, the larger root
        beneath = np.maximum(9 * mean**2 + 12 * mean * last - 12 * last**2, 0.0)
        return np.maximum((3 * mean - 2 * last + np.sqrt(beneath)) / 4, last)

    def opens_soft_faces(self, pressure: Real) -> Mask:
        """Whether the fluid is above the outside by mean pressures of the load where it enters."""
        return np.asarray((self.inlet or 0.0) - ATMOSPHERE >= pressure)

    @property
    def free_path(self) -> float:
        """Mean free path of the gas at the mean pressure; zero of a liquid, and in vacuum. [m]"""
        if self.gas is None or not self.mean_pressure > 0:
            return 0.0
        return self.gas.mean_free_path(self.mean_pressure)

    @property
    def rarefied(self) -> Rarefied:
        """How rare the fluid is on its way along the seal; a liquid is not. [m]"""
        if self.free_path == 0 or self.inlet is None:
            return Rarefied(self.free_path)
        return Rarefied(self.free_path, (self.inlet - self.outlet) / (self.inlet + self.outlet))

    def leak(self, aperture: Real) -> Real | None:
        """Volume of a liquid, or pressure times volume of a gas, per time. [m³ / s, Pa m³ / s]

        The aperture is the gap of flat plates [m]. None where no seal is crossed.
        """
        if self.seal is None or self.inlet is None:
            return None
        ratio, fluid = self.seal.ratio, self.medium
        if isinstance(fluid, Gas):
            permeance = self.rarefied.plates(aperture)
            return gas_throughput(permeance, ratio, self.inlet, self.outlet, fluid)
        return liquid_leak(aperture, ratio, self.inlet - self.outlet, fluid)


@dataclass(frozen=True, eq=False)
class Closing:
    """At which mean pressure the last channel closes, and how far the load may be taken off."""

    pressure: SealingPressure
    reopening: Reopening | None = None  # from the largest load; None where that was not solved
