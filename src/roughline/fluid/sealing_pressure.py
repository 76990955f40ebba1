"""The mean pressure at which the last channel through a contact closes, by bisection."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal, get_args

import numpy as np

from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.arguments import checked_half_space, given_law
from roughline.contact.fields import Fields
from roughline.contact.full_contact import in_full_contact
from roughline.contact.grid_error import grid_steepening
from roughline.contact.measures import Measure
from roughline.contact.press import press
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, between, flag
from roughline.errors.public import public_names
from roughline.fluid.gap import Along
from roughline.fluid.one_map import (
    can_be_cut,
    factor_left_open,
    on_half,
    quarters,
    tells_of_larger,
)
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.topography.body import Surface

_PERCOLATION_PRESSURE = 0.277  # over E* and the rms slope, where Persson's area is 0.42
_HARDNESS_SHARE = 0.4  # about the share of the area that seals, all of which bears the hardness
_TRIAL_STEP = 1.5  # step from one trial to the next, until one is open and the other sealed
_MOST_TRIALS = 60
_RTOL_FACTOR = 1e4  # of the ends over that of contacts, which so decides no cell
_LARGEST_LOADING = 0.999  # of the hardness: all of the area bears it


@dataclass(frozen=True, eq=False)
class SealingPressure:
    """Mean pressure at which the last channel through a contact closes on first loading.

    Attributes
    ----------
    low, high : float
        Mean pressures under which the gap is still open, and sealed. [pressure]
    area_fractions : tuple of float
        Contact area fractions under these, cells counted whole. [1]
    along : {"both", "x", "y"}
        Direction in which no path leads through; of both, in neither.
    on_half : float
        The same on half as many points along each side; NaN if not asked for, or if these do not
        resolve a layer. [pressure]
    on_quarters : sequence of float
        The same of the four quarters of the surface. [pressure]
    interval : tuple of float
        Ends that grid and size leave open; NaN if not asked for. They combine, as independent, by
        how much the logarithm differs from that on half as many points, and how uncertain the mean
        of the quarters is by their scatter, at 95 %. Waves that the grid does not have open the gap
        further: for the upper end, the grid leaves open at least what an elastic surface shows that
        is as steep as a grid four times finer, as far as the hardness bears it. A piece that holds
        fewer than three waves of the roll-off does not tell how early its whole seals: the lower
        end is zero, and the upper one holds twice the step from the quarters to the piece.
        [pressure]
    """

    low: float
    high: float
    area_fractions: tuple[float, float]
    along: Along | Literal["both"]
    on_half: float = math.nan
    on_quarters: Sequence[float] = ()
    interval: tuple[float, float] = (math.nan, math.nan)

    __repr__ = summary
    _repr_html_ = in_notebook

    @property
    def value(self) -> float:
        """The middle of both ends. [pressure]"""
        return math.sqrt(self.low * self.high)


@public_names
def sealing_pressure(
    surface: Surface,
    *,
    half_space: HalfSpace,
    law: ContactLaw | None = None,
    along: Along | Literal["both"] = "both",
    rtol: float = 0.01,
    interval: bool = True,
) -> SealingPressure:
    """Find the mean pressure at which the last channel through a contact closes.

    Loads are bisected; each of them is applied to the untouched surface, as on first loading. The
    gap is open where a path of cells out of contact, each beside the next, leads from a place to
    its next repetition along a side, be it in a diagonal; where the surface does not repeat, where
    one joins two opposite sides.

    Parameters
    ----------
    surface : Surface
        The rough body. [length]
    half_space : HalfSpace
        What the surface is pressed into, mostly ``rl.Homogeneous(E_star, periodic=True)``. Where it
        is not periodic, the borders of the surface are closed sides.
    law : ContactLaw, optional
        What pressure and gap obey at a point, such as ``rl.Yielding(hardness)``; default: bodies
        that neither stick nor yield.
    along : {"both", "x", "y"}, optional
        Direction in which the last path closes; of both, when none leads either way.
    rtol : float, optional
        How far apart both ends may be, over the lower one. [1]
    interval : bool, optional
        Whether the coarser grid and the quarters are pressed too, which takes about as long again.

    Raises
    ------
    InputError
        If the surface is flat, or an argument cannot be used.
    ConvergenceError
        If a load was not solved.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, q_high=100.0)
    >>> surface, body = spectrum.surface(64, rng=7), rl.Homogeneous(E_star=1.0, periodic=True)
    >>> found = rl.sealing_pressure(surface, half_space=body, along="x")
    >>> print(f"{found.low:.3g} to {found.high:.3g}: area {found.area_fractions[1]:.2f}")
    0.0658 to 0.0662: area 0.40
    """
    allowed_choice("along", along, ("both", "x", "y"))
    rtol = between("rtol", rtol, 1e-6, 1.0, "a tolerance from 1e-6 to 1 is needed")
    interval = flag("interval", interval)
    if not isinstance(surface, Surface):
        raise InputError("is no Surface; in one dimension any contact stops the flow", "surface")
    if surface.rms_slope == 0:
        raise InputError("is flat: it seals under any load; give a rough one", "surface")
    half_space, law = checked_half_space(half_space), given_law(law, None)
    full = in_full_contact(surface, half_space)
    # in round numbers, so that it is sought alike wherever a repeated surface is cut
    share = float(f"{_PERCOLATION_PRESSURE * _slope(full, half_space.repeats):.6g}")
    guess = min(share * half_space.E_star, _HARDNESS_SHARE * Bounds.of(law).largest_force(1.0))
    search = _PressureSearch(half_space, along, rtol)
    (low, open_area), (high, sealed_area) = search.bracket(surface, law, guess)
    found = SealingPressure(low, high, (open_area, sealed_area), along)
    if not interval or not can_be_cut(surface, half_space):
        return found
    return _with_interval(found, search, surface, law, grid_steepening(full))


def _with_interval(
    found: SealingPressure,
    search: _PressureSearch,
    surface: Surface,
    law: ContactLaw,
    steepening: float,
) -> SealingPressure:
    """Return what was found with the ends that grid and size leave open."""
    half = search.middle(*on_half(surface, law), found.value)
    of_quarters = [search.middle(*each, found.value) for each in quarters(surface, law)]
    tells = tells_of_larger(surface)
    left_open = partial(factor_left_open, found.value, half, of_quarters, tells=tells)
    most = min(found.high * left_open(of_grid=steepening), Bounds.of(law).largest_force(1.0))
    ends = found.low / left_open() if tells else 0.0, max(found.high, most)
    return replace(found, on_half=half, on_quarters=of_quarters, interval=ends)


def _slope(surface: Surface, repeats: tuple[bool, bool]) -> float:
    """Rms slope of a surface, over the borders as well across which it goes on. [1]"""
    squares = 0.0
    for axis, step in enumerate(surface.spacing):
        next_row = np.take(surface.heights, [0] if repeats[axis] else [], axis)
        squares += (
            float(np.square(np.diff(surface.heights, axis=axis, append=next_row)).mean()) / step**2
        )
    return math.sqrt(squares)


@dataclass(frozen=True)
class _PressureSearch:
    """How surfaces are pressed, and how near both ends of a bracket have to be."""

    half_space: HalfSpace
    along: Along | Literal["both"]
    rtol: float

    def middle(self, surface: Surface, law: ContactLaw, guess: float) -> float:
        """The middle of the bracket of a surface."""
        (low, _), (high, _) = self.bracket(surface, law, guess)
        return math.sqrt(low * high)

    def bracket(
        self, surface: Surface, law: ContactLaw, guess: float
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Mean pressure and area fraction of the last open gap, and of the first sealed one."""
        ends: dict[bool, tuple[float, float]] = {}
        largest = Bounds.of(law).largest_force(1.0)
        pressure, step = guess if guess < largest else _HARDNESS_SHARE * largest, _TRIAL_STEP
        for _ in range(_MOST_TRIALS):
            is_open, area = self._is_open(surface, law, pressure)
            ends[is_open] = pressure, area
            if len(ends) == 2:
                low, high = ends[True][0], ends[False][0]
                if high <= low * (1 + self.rtol):
                    return ends[True], ends[False]
                pressure = math.sqrt(low * high)
            else:
                pressure = pressure * step if is_open else pressure / step
                step *= step
            if pressure >= _LARGEST_LOADING * largest:
                pressure = math.sqrt(ends[True][0] * largest)
        raise InputError("does not seal under any load that was tried", "surface")

    def _is_open(self, surface: Surface, law: ContactLaw, pressure: float) -> tuple[bool, float]:
        """Whether the gap is open under a mean pressure, and the contact area fraction."""
        curve = press(
            surface,
            half_space=self.half_space,
            law=law,
            forces=[pressure * surface.area],
            measures=[OPEN[self.along]],
            rtol=self.rtol / _RTOL_FACTOR,
        )
        return bool(curve.measured[OPEN[self.along].name].values[0]), float(curve.area_fraction[0])


def _percolates(fields: Fields, along: Along | Literal["both"]) -> float:
    """One where a path leads through the gap, else zero."""
    from roughline.fluid.winding import leads_through  # here because compiled loops load slowly

    sides: tuple[Along, ...] = get_args(Along) if along == "both" else (along,)
    return float(any(leads_through(~fields.contact, each, fields.repeats) for each in sides))


OPEN = {
    along: Measure(
        f"is_open_{along}",
        "",
        "1",
        f"one where a path leads through the gap along {along}, else zero",
        partial(_percolates, along=along),
    )
    for along in ("x", "y", "both")
}
"""Whether the gap is open, along x, along y, or along one of both."""
