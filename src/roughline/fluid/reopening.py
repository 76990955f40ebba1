"""How far a load may be taken off a contact until far more leaks through, by bisection."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.arguments import checked_count
from roughline.contact.curve import SurfaceCurve
from roughline.contact.measures import Measure
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
from roughline.fluid.trials import Hunt, Trials, bisected, crossing, ends, side_by_side
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw
from roughline.topography.body import Surface

_LARGER_FACTOR = math.nextafter(1.0, 2.0), sys.float_info.max, "a factor above 1 is needed"
_TIMES, _RTOL = 10.0, 0.01  # if not told
_FIRST_SHARES = 0.01, 0.1  # that are tried first, beside the smallest and all of it
_FIRST_STEP = 1.18  # up and down from what another surface tells, to those that are tried first
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
        The same on half as many points along each side, within about 2 %; NaN if not asked for. [1]
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
    times: float = _TIMES,
    along: Along | Literal["both"] = "both",
    rtol: float = _RTOL,
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
    found = search.bracket(_Relieved(left, law, float(history[-1])))
    if not interval or not can_be_cut(curve.surface, curve.half_space):
        return found
    return _with_interval(found, search, curve.surface, law, history)


def reopenings_about(
    curves: Sequence[SurfaceCurve], load: int, expected: float, *, along: Along | Literal["both"]
) -> list[Reopening]:
    """The shares that :func:`reopening` finds, within about 2 %, if another surface tells one.

    They are of surfaces of one shape and one half-space, which are pressed side by side.
    """
    search = _ShareSearch(curves[0].half_space, _TIMES, along, _RTOL)
    left = [
        _Relieved(each.surface_after(load), each.law, float(each.force[load])) for each in curves
    ]
    unknown = (math.nan, math.nan, math.nan)
    return [Reopening(each, each, unknown, _TIMES, along) for each in search.about(left, expected)]


def _with_interval(
    found: Reopening, search: _ShareSearch, surface: Surface, law: ContactLaw, history: Real
) -> Reopening:
    """Press half as many points along each side, and the quarters of the surface."""
    most, force = np.nanmax(history) / surface.area, history[-1] / surface.area

    def loaded(piece: Surface, its_law: ContactLaw) -> _Relieved:
        return _Relieved(piece, its_law, force * piece.area, not_yet=most * piece.area)

    pieces = [loaded(*each) for each in (on_half(surface, law), *quarters(surface, law))]
    half, *of_quarters = search.about(pieces, found.value)
    value, *others = np.array([found.value, half, *of_quarters]) + _NARROWEST_INTERVAL
    factor = factor_left_open(value, others[0], others[1:], tells=tells_of_larger(surface))
    low = (found.low + _NARROWEST_INTERVAL) / factor - _NARROWEST_INTERVAL
    high = (found.high + _NARROWEST_INTERVAL) * factor - _NARROWEST_INTERVAL
    interval = low if low > _NARROWEST_INTERVAL else 0.0, min(max(high, _NARROWEST_INTERVAL), 1.0)
    return replace(found, on_half=half, on_quarters=of_quarters, interval=interval)


@dataclass
class _Relieved:
    """A surface that a load has left, or one that it is not under yet."""

    surface: Surface
    law: ContactLaw
    force: float  # that is taken off
    not_yet: float = 0.0  # the largest force so far, if the surface is still untouched


@dataclass(frozen=True)
class _ShareSearch:
    """How surfaces are pressed that a force has left, and how near both shares have to be."""

    half_space: HalfSpace
    times: float
    along: Along | Literal["both"]
    rtol: float

    def bracket(self, left: _Relieved) -> Reopening:
        """Bisect the shares of a force."""
        return side_by_side([self._bracketed()], [partial(self._apertures, left)])[0]

    def about(self, surfaces: Sequence[_Relieved], expected: float) -> list[float]:
        """The shares of surfaces of one shape, within about 2 %."""
        searches = [self._near(expected) for _ in surfaces]
        return side_by_side(searches, [partial(self._apertures, each) for each in surfaces])

    def _bracketed(self) -> Hunt[Reopening]:
        """Search both ends."""
        trials = yield from self._started([_SMALLEST_SHARE, *_FIRST_SHARES])
        low = high = 0.0
        if trials.is_above(_SMALLEST_SHARE):
            bisect = partial(bisected, _SMALLEST_SHARE, 1.0, self.rtol)
            low, high = yield from ends(trials, bisect)
        at_low, at_high = (trials.values[each or _SMALLEST_SHARE] for each in (low, high))
        apertures = trials.values[1.0], at_low, at_high
        return Reopening(low, high, apertures, self.times, self.along)

    def _near(self, expected: float) -> Hunt[float]:
        """Search the share, from what another surface tells; zero where it never leaks so much."""
        first = [expected / _FIRST_STEP, min(expected * _FIRST_STEP, 1.0)]
        trials = yield from self._started(first if expected > 0 else [_SMALLEST_SHARE])
        if trials.ends[0] == 0 and _SMALLEST_SHARE not in trials.values:
            trials.add([_SMALLEST_SHARE], (yield [_SMALLEST_SHARE]))
        return (yield from crossing(trials)) if trials.ends[0] > 0 else 0.0

    def _started(self, shares: Sequence[float]) -> Hunt[Trials]:
        """Try the first shares, and all of the force."""
        asked = [*dict.fromkeys((*shares, 1.0))]
        known = dict(zip(asked, (yield asked), strict=True))
        most = known[1.0] * float(np.cbrt(self.times))  # if sealed, whatever leaks is too much
        return Trials(most, values=known)

    @property
    def _measures(self) -> list[Measure]:
        directions: Sequence[Along] = ("x", "y") if self.along == "both" else (self.along,)
        return [hydraulic_aperture(along) for along in directions]

    def _apertures(self, left: _Relieved, shares: Sequence[float]) -> list[float]:
        """Hydraulic apertures under shares of the force, after the largest one."""
        forces = [share * left.force for share in shares]
        path = [left.not_yet, *(each for each in forces if each != left.not_yet)]
        pressed = press(
            left.surface,
            half_space=self.half_space,
            law=left.law,
            forces=path if left.not_yet else forces,
            measures=self._measures,
        )
        if left.not_yet:
            left.surface, left.not_yet = pressed.surface_after(0), 0.0
        found = np.max([each.values for each in pressed.measured.values()], axis=0)
        of_force = dict(zip(pressed.force.tolist(), found.tolist(), strict=True))
        return [of_force[each] for each in forces]
