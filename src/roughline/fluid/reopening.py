"""How far a load may be taken off a contact until far more leaks through, by bisection."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.arguments import checked_count
from roughline.contact.curve import SurfaceCurve
from roughline.contact.press import press
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, between, flag
from roughline.errors.public import public_names
from roughline.fluid.gap import Along
from roughline.fluid.measures import hydraulic_aperture
from roughline.fluid.one_map import (
    can_be_cut,
    factor_left_open,
    on_half,
    quarters,
    tells_of_larger,
)
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw
from roughline.topography.body import Surface

_LARGER_FACTOR = math.nextafter(1.0, 2.0), sys.float_info.max, "a factor above 1 is needed"
_SMALLEST_SHARE = 1e-4  # share of the load below which it counts as taken off
_NARROWEST_INTERVAL = 3e-3  # below which an interval tells no shares apart


@dataclass(frozen=True, eq=False)
class Reopening:
    """Share of a load down to which it may be taken off until so many times as much leaks.

    Attributes
    ----------
    low, high : float
        Shares of the load at which at least so much leaks, and less; both are zero where it never
        does. [1]
    apertures : tuple of float
        Hydraulic apertures under the load, and at both shares. [length]
    times : float
        How much more leaks; of a gap that is sealed under the load, whatever leaks is more. [1]
    along : {"both", "x", "y"}
        Direction of the flow; of both, the leakier.
    on_half : float
        The same on half as many points along each side; NaN if not asked for. [1]
    on_quarters : sequence of float
        The same of the four quarters of the surface. [1]
    interval : tuple of float
        Ends that grid and size leave open; NaN if not asked for. They combine, as independent, by
        how much the logarithm differs from that on half as many points, and how uncertain the mean
        of the quarters is by their scatter, at 95 %; a piece that holds fewer than three waves of
        the roll-off may differ from its whole by twice the step from the quarters to it. Shares
        below 0.003 are not told apart. [1]
    """

    low: float
    high: float
    apertures: tuple[float, float, float]
    times: float
    along: Along | Literal["both"]
    on_half: float = math.nan
    on_quarters: Sequence[float] = ()
    interval: tuple[float, float] = (math.nan, math.nan)

    __repr__ = summary
    _repr_html_ = in_notebook

    @property
    def value(self) -> float:
        """The middle of both shares. [1]"""
        return math.sqrt(self.low * self.high)


@public_names
def reopening(
    curve: SurfaceCurve,
    load: int = -1,
    *,
    times: float = 10.0,
    along: Along | Literal["both"] = "both",
    rtol: float = 0.01,
    interval: bool = False,
) -> Reopening:
    """Find down to which share a load may be taken off until so many times as much leaks.

    A surface that has yielded is flatter than before, and stays tight while most of the load is
    taken off; elastic bodies leak as they did when the load rose. Shares of the load are bisected
    on the surface that it left.

    Parameters
    ----------
    curve : SurfaceCurve
        Of a surface, by :func:`press`.
    load : int, optional
        Number of the load that is taken off, from 0; negative ones count from the last.
    times : float, optional
        How many times as much leaks as under the load. [1]
    along : {"both", "x", "y"}, optional
        Direction of the flow; of both, the leakier.
    rtol : float, optional
        How far apart both shares may be, over the lower one. [1]
    interval : bool, optional
        Whether the coarser grid and the quarters are pressed too, which takes about as long again.

    Raises
    ------
    InputError
        If the curve is of a line or a law that remembers its path, or an argument cannot be used.
    ConvergenceError
        If a load was not solved.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=100.0)
    >>> given = {"E_star": 1.0, "forces": [0.03], "periodic": True}
    >>> elastic = rl.press(spectrum.surface(64, rng=7), **given)
    >>> dented = rl.press(spectrum.surface(64, rng=7), hardness=0.1, **given)
    >>> print(f"{rl.reopening(elastic).value:.2f} {rl.reopening(dented).value:.2f}")
    0.36 0.32
    """
    load = checked_count("load", load)
    times = between("times", times, *_LARGER_FACTOR)
    allowed_choice("along", along, ("both", "x", "y"))
    rtol = between("rtol", rtol, 1e-6, 1.0, "a tolerance from 1e-6 to 1 is needed")
    interval = flag("interval", interval)
    left, law = curve.surface_after(load), curve.law
    if law.memory == "path":
        raise InputError(
            f"is {type(law).__name__}, which remembers its path and not only dents: press the "
            'loads on the way back with measures=[rl.hydraulic_aperture("x")] instead',
            "curve.law",
        )
    history = curve.force[: load % curve.force.size + 1]
    if not history[-1] > 0:
        raise InputError(f"load {load} is none: there is nothing to take off", "load")
    search = _ShareSearch(curve.half_space, times, along, rtol)
    found = search.bracket(left, law, float(history[-1]))
    if not interval or not can_be_cut(curve.surface, curve.half_space):
        return found
    forces = np.array([np.nanmax(history), history[-1]])
    return search.with_interval(found, curve.surface, law, forces)


@dataclass(frozen=True)
class _ShareSearch:
    """How surfaces are pressed that a force has left, and how near both shares have to be."""

    half_space: HalfSpace
    times: float
    along: Along | Literal["both"]
    rtol: float

    def with_interval(
        self, found: Reopening, surface: Surface, law: ContactLaw, forces: Real
    ) -> Reopening:
        """Press half as many points along each side, and the quarters of the surface."""
        half = self.after(forces, *on_half(surface, law))
        of_quarters = [
            self.after(forces * (each.area / surface.area), each, its_law)
            for each, its_law in quarters(surface, law)
        ]
        value, *others = np.array([found.value, half, *of_quarters]) + _NARROWEST_INTERVAL
        factor = factor_left_open(value, others[0], others[1:], tells=tells_of_larger(surface))
        low = (found.low + _NARROWEST_INTERVAL) / factor - _NARROWEST_INTERVAL
        high = (found.high + _NARROWEST_INTERVAL) * factor - _NARROWEST_INTERVAL
        ends = low if low > _NARROWEST_INTERVAL else 0.0, min(max(high, _NARROWEST_INTERVAL), 1.0)
        return replace(found, on_half=half, on_quarters=of_quarters, interval=ends)

    def after(self, forces: Real, untouched: Surface, law: ContactLaw) -> float:
        """The share of the last of some forces that are put on one after the other."""
        curve = press(untouched, half_space=self.half_space, law=law, forces=forces)
        return self.bracket(curve.surface_after(-1), law, float(forces[-1])).value

    def bracket(self, left: Surface, law: ContactLaw, force: float) -> Reopening:
        """Bisect the shares of the force."""
        full = self._aperture(left, law, force)
        most = full * float(np.cbrt(self.times))  # if sealed, whatever leaks is too much
        at_low, at_high = self._aperture(left, law, _SMALLEST_SHARE * force), full
        low, high = _SMALLEST_SHARE, 1.0
        if not (at_low >= most and at_low > 0):
            return Reopening(0.0, 0.0, (full, at_low, at_low), self.times, self.along)
        while high > low * (1 + self.rtol):
            middle = math.sqrt(low * high)
            found = self._aperture(left, law, middle * force)
            if found >= most and found > 0:
                low, at_low = middle, found
            else:
                high, at_high = middle, found
        return Reopening(low, high, (full, at_low, at_high), self.times, self.along)

    def _aperture(self, left: Surface, law: ContactLaw, force: float) -> float:
        """Hydraulic aperture under a force."""
        directions: Sequence[Along] = ("x", "y") if self.along == "both" else (self.along,)
        pressed = press(
            left,
            half_space=self.half_space,
            law=law,
            forces=[force],
            measures=[hydraulic_aperture(along) for along in directions],
        )
        return max(float(each.values[0]) for each in pressed.measured.values())
