"""The mean pressure at which the last channel through a contact closes, by bisection."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from roughline.computing.arrays import Mask
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.arguments import checked_half_space, given_law
from roughline.contact.curve import SurfaceCurve
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
from roughline.fluid.trials import (
    Decide,
    Trials,
    bisected,
    bracketed,
    crossing,
    ends,
    side_by_side,
)
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.topography.body import Surface

_PERCOLATION_PRESSURE = 0.277  # over E* and the rms slope, where Persson's area is 0.42
_HARDNESS_SHARE = 0.4  # about the share of the area that seals, all of which bears the hardness
_FIRST_OF_GUESS = 0.45, 0.67, 0.9  # of a guess, tried first: most leave the gap open
_FIRST_OF_EXPECTED = 0.7, 0.95  # of what another surface tells
_RTOL_FACTOR = 1e4  # of the ends over that of contacts, which so decides no cell
_PART_OF_GAPS = 1 / 256  # of the cells of a gap, within which the narrowest of a channel is found
_RTOL = 0.01  # of what is bisected


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
        The same on half as many points along each side, within about 2 %; NaN if not asked for, or
        if these do not resolve a layer. [pressure]
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
    rtol: float = _RTOL,
    interval: bool = True,
) -> SealingPressure:
    """Find the mean pressure at which the last channel through a contact closes.

    Loads are bisected on the untouched surface, as on first loading. Few of them are pressed, as
    the width of the last channel tells how most of them turn out. The gap is open where a path of
    cells out of contact, each beside the next, leads from a place to its next repetition along a
    side, be it in a diagonal; where the surface does not repeat, where one joins two opposite
    sides.

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
    found = search.bracket(surface, law, guess)
    if not interval or not can_be_cut(surface, half_space):
        return found
    return _with_interval(found, search, surface, law, grid_steepening(full))


def sealing_pressures_about(
    curves: Sequence[SurfaceCurve], expected: Sequence[float], *, along: Along | Literal["both"]
) -> list[SealingPressure]:
    """Mean pressures that seal the surfaces of curves, within about 2 %, if others tell some.

    They are of one shape and one half-space, and are pressed side by side.
    """
    search = _PressureSearch(curves[0].half_space, along, _RTOL)
    found = search.about([(each.surface, each.law) for each in curves], expected)
    return [SealingPressure(each, each, (math.nan, math.nan), along) for each in found]


def _with_interval(
    found: SealingPressure,
    search: _PressureSearch,
    surface: Surface,
    law: ContactLaw,
    steepening: float,
) -> SealingPressure:
    """Return what was found with the ends that grid and size leave open."""
    pieces = [on_half(surface, law), *quarters(surface, law)]
    half, *of_quarters = search.about(pieces, [found.value] * len(pieces))
    tells = tells_of_larger(surface)
    left_open = partial(factor_left_open, found.value, half, of_quarters, tells=tells)
    most = min(found.high * left_open(of_grid=steepening), Bounds.of(law).largest_force(1.0))
    interval = found.low / left_open() if tells else 0.0, max(found.high, most)
    return replace(found, on_half=half, on_quarters=of_quarters, interval=interval)


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

    def bracket(self, surface: Surface, law: ContactLaw, guess: float) -> SealingPressure:
        """Bisect the mean pressure, from a guess on."""
        guess, most = _below_hardness(guess, law)
        areas: dict[float, float] = {}

        def bisect(is_open: Decide) -> tuple[float, float]:
            return bisected(*bracketed(guess, most, is_open), self.rtol, is_open)

        press = partial(self._gaps, surface, law, areas)
        first = [guess * each for each in _FIRST_OF_GUESS]
        search = ends(Trials(most=most, first=first), bisect)
        ((low, high),) = side_by_side([search], [press])
        return SealingPressure(low, high, (areas[low], areas[high]), self.along)

    def about(
        self, surfaces: Sequence[tuple[Surface, ContactLaw]], expected: Sequence[float]
    ) -> list[float]:
        """The mean pressures that seal surfaces of one shape, within about 2 %."""
        searches = []
        for (_, law), likely in zip(surfaces, expected, strict=True):
            guess, most = _below_hardness(likely, law)
            first = [guess * each for each in _FIRST_OF_EXPECTED]
            searches.append(crossing(Trials(most=most, first=first)))
        return side_by_side(searches, [partial(self._gaps, *each, {}) for each in surfaces])

    def _gaps(
        self,
        surface: Surface,
        law: ContactLaw,
        areas: dict[float, float],
        pressures: Sequence[float],
    ) -> list[float]:
        """Width of the last channel under rising mean pressures; notes contact area fractions."""
        measure, gaps = CHANNEL[self.along], []
        paths = [[each] for each in pressures] if law.memory == "path" else [pressures]
        for path in paths:
            curve = press(
                surface,
                half_space=self.half_space,
                law=law,
                forces=np.array(path) * surface.area,
                measures=[measure],
                rtol=self.rtol / _RTOL_FACTOR,
            )
            gaps += curve.measured[measure.name].values.tolist()
            areas.update(zip(path, curve.area_fraction.tolist(), strict=True))
        return gaps


def _below_hardness(guess: float, law: ContactLaw) -> tuple[float, float]:
    """A mean pressure to start from, and the one that all of the area bears at most."""
    largest = Bounds.of(law).largest_force(1.0)
    return (guess if guess < largest else _HARDNESS_SHARE * largest), largest


def _narrowest_gap(fields: Fields, along: Along | Literal["both"]) -> float:
    """Gap at the narrowest place of the widest way through; zero where none leads through."""
    from roughline.fluid.winding import leads_through  # here because compiled loops load slowly

    def is_open(cells: Mask) -> bool:
        return leads_through(cells, along, fields.repeats)

    if not is_open(~fields.contact):
        return 0.0
    gaps = np.sort(fields.gap[~fields.contact])
    open_at, closed_at = 0, gaps.size  # numbers of gaps from which on cells count as open
    while closed_at - open_at > max(1, gaps.size * _PART_OF_GAPS):
        middle = (open_at + closed_at) // 2
        if is_open(~fields.contact & (fields.gap >= gaps[middle])):
            open_at = middle
        else:
            closed_at = middle
    return max(float(gaps[open_at]), sys.float_info.min)  # rounding leaves a gap, where it is open


CHANNEL = {
    along: Measure(
        f"last_channel_{along}",
        "",
        "length",
        f"gap at the narrowest place of the widest way through along {along}, or zero",
        partial(_narrowest_gap, along=along),
    )
    for along in ("x", "y", "both")
}
"""Width of the last channel along x, along y, or along one of both."""
