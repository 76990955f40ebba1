"""How far a curve may differ from that of ever finer grids, judged from coarser ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.full_contact import in_full_contact
from roughline.contact.loads import Loads
from roughline.contact.measures import Measured
from roughline.contact.pressing import Pressing
from roughline.contact.selection import among_loads
from roughline.contact.terraces import with_whole_plateaus
from roughline.errors import InputError
from roughline.facts.fact import Fact
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.operators.cell import cell_compliance
from roughline.topography.body import Surface, with_heights
from roughline.topography.preparation import resampled

# Half widths over what is measured, so that they hold 95 % of all surfaces on grids four times
# finer (benchmarks/measured_coverage.py):
_YIELD_FACTOR = 1.1  # of what a softer body shows
_AREA_FACTOR = 1.3  # of differences of the area's logarithm
_STEEPENING_EXPONENT = 1.4  # of the logarithm of the steepening that opens the area
_MEASURE_EXPONENT = 0.5  # of the steepening, by which differences of a measure are widened
# Of what yield takes from the stiffness on loading, which few cells decide, so much is uncertain.
_YIELD_SHARE = 0.3
# Weights of differences from every other point, from means of two by two points, and between these
# and means of four by four, which are larger the coarser the grid.
_GRID_WEIGHTS = (1.0, 1.0, 0.25)
# White noise has the fastest growth of all surfaces: means over two by two points halve its
# heights, so that its mean square slope is 16 times as large from grid to grid.
_NOISE_GROWTH = 16.0
# Means of points of a rougher self-affine surface steepen the last step so much, because the points
# hold the shorter waves folded into them.
_FASTEST_POINT_GROWTH = 4 / 3
_LARGEST_LOADING = 0.9  # of a softer body, over the force under which all of it yields
_FEWEST_POINTS = 4  # along a side of the coarsest grid

COARSER, PLATEAUS, AS_STEEP, STEEPER = "coarser grids", "whole plateaus", "as steep", "steeper"
STAGES = (COARSER, PLATEAUS, AS_STEEP, STEEPER)
"""What is pressed to learn the errors, in its order: what is needed is known from those before."""

_OfStages = Mapping[str, Sequence[SurfaceCurve]]
"""Curves of the stages that are done."""


@dataclass(frozen=True, eq=False)
class _Grids:
    """A surface and its coarser selves."""

    quarter: Surface  # means of four by four points
    half: Surface  # means of two by two
    thinned: Surface  # every other point along both sides
    full: Surface

    @classmethod
    def of(cls, surface: Surface) -> _Grids:
        """The coarser selves of a surface."""
        half = halved(surface)
        return cls(halved(half), half, _thinned(surface), surface)

    @property
    def coarser(self) -> tuple[Surface, Surface, Surface]:
        """The coarser ones, in the order of their weights."""
        return self.thinned, self.half, self.quarter

    def laws(self, law: ContactLaw) -> list[ContactLaw]:
        """Return a law of the surface on each of them."""
        coarsened = _thinned, halved, lambda surface: halved(halved(surface))
        return [law.on(partial(field_on, self.full, each)) for each in coarsened]

    @property
    def steepening(self) -> float:
        """How much larger the rms slope of a grid four times finer will be.

        What a grid of means adds to the mean square slope changes by one factor from grid to grid.
        Slopes that grow faster than those of self-affine surfaces do are those of white noise.
        """
        means = np.square([each.rms_slope for each in (self.quarter, self.half, self.full)])
        points = [each.rms_slope**2 for each in (_thinned(self.thinned), self.thinned)]
        before, last = np.maximum(np.diff(means), 0.0)
        if last == 0:
            return 1.0
        growth = min(last / before, _NOISE_GROWTH) if before > 0 else _NOISE_GROWTH
        noise = max(
            _excess([*points, means[2]], 1.0), _excess(means.tolist(), _FASTEST_POINT_GROWTH), 0.0
        )
        more = last / means[2] * (growth + growth**2) + noise * _NOISE_GROWTH**2
        return float(np.sqrt(1 + more))

    @property
    def step(self) -> float:
        """How much larger the rms slope is than that of the means of two by two points."""
        half = self.half.rms_slope
        return max(1.0, self.full.rms_slope / half) if half > 0 else 1.0


def with_grid_error(curve: SurfaceCurve, pressing: Pressing) -> SurfaceCurve:
    """Add to a curve the discretisation errors estimated from coarser grids."""
    study, found = GridStudy(pressing), dict[str, Sequence[SurfaceCurve]]()
    for stage in STAGES:
        found[stage] = [each.curve() for each in study.presses(stage, curve, found)]
    return study.concluded(curve, found)


@dataclass(frozen=True, eq=False)
class GridStudy:
    """How far the curve of a surface may differ from that of ever finer grids.

    The error of a stiffness is the steepening m, by which two finer grids raise the rms slope,
    times the root of squares by which its compliance differs between grids. Compliances add, and
    their differences stay finite where a coarse grid is in full contact. Where points yield, a body
    with the hardness H / m tells what waves do that no grid here has.

    The same waves open the contact area of elastic bodies as Persson's theory tells [1]_, where no
    area is less than the force over the hardness. Layers that are harder than their base meet short
    waves more stiffly than long ones, which opens it further. Besides, an area of N points scatters
    as a count does, by 1 / sqrt(N). The logarithm of a measure is as uncertain as it differs
    between grids, times the root of m.

    A pixel that is a mean across the edge of a plateau lies below it, and all grids lose the rim.
    So terraced surfaces are pressed once more with the pixels around plateaus raised to them, and
    what this changes adds to the error.

    The error under a load does not depend on the other loads. The errors cover grids four times
    finer, but no noise that begins at the spacing. A value v with error e lies between
    v / (1 + e / v) and v + e. Errors are NaN where a grid did not converge, and where the surface
    is in full contact and coarser grids are not.

    References
    ----------
    .. [1] B. N. J. Persson, "Theory of rubber friction and contact mechanics", J. Chem. Phys. 115,
       3840-3861 (2001).
    """

    pressing: Pressing  # of the surface itself

    @cached_property
    def _grids(self) -> _Grids:
        return _Grids.of(self.pressing.surface)

    @cached_property
    def _on_grids(self) -> Pressing:
        """The same pressing, with the measures that coarser grids have as well."""
        measures = [each for each in self.pressing.measures if not each.of_this_grid]
        return replace(self.pressing, measures=measures)

    @cached_property
    def _coarser(self) -> list[Pressing]:
        """The coarser selves, in the order of their weights, under the same loads."""
        laws = self._grids.laws(self.pressing.law)
        return [
            replace(self._on_grids, surface=surface, law=law)
            for surface, law in zip(self._grids.coarser, laws, strict=True)
        ]

    @cached_property
    def _refusal(self) -> str:
        """Why coarser grids do not resolve the law; empty where they do."""
        if self.pressing.law.only_pushes:
            return ""
        coarser, half_space = self._coarser, self.pressing.half_space
        try:
            for each in coarser:
                grid = each.surface.shape, each.surface.spacing
                each.law.refuse_grid(cell_compliance(half_space, *grid))
        except InputError as error:
            return str(error)
        return ""

    def presses(self, stage: str, curve: SurfaceCurve, found: _OfStages) -> list[Pressing]:
        """What is pressed in a stage, from the curve of the surface and of the stages before."""
        if self._refusal:
            return []
        if stage == COARSER:
            return self._coarser
        followed = found[COARSER][1] if stage == AS_STEEP else curve
        if not _known_forces(followed).any():
            return []
        if stage == PLATEAUS:
            plateaus = with_whole_plateaus(self.pressing.surface)
            return [] if plateaus is None else [self._again(curve, plateaus, curve.law)]
        if stage == AS_STEEP:
            laws = self._steeper_laws(followed)
            return [self._again(followed, self._grids.half, law) for law in laws]
        return self._steeper(curve, found[COARSER])

    def concluded(self, curve: SurfaceCurve, found: _OfStages) -> SurfaceCurve:
        """The curve with its errors, from the curves of all stages."""
        if self._refusal:
            return _unknown(curve, self._refusal)
        k, k_u, area = curve.stiffness, curve.unloading_stiffness, curve.area_fraction_corrected
        surface, coarser, steepening = self.pressing.surface, found[COARSER], self._grids.steepening
        rims_of_k, rims_of_area = _rim_differences(curve, _over_loads(curve, found[PLATEAUS]))
        with np.errstate(invalid="ignore", divide="ignore"):  # bodies apart, or in full contact
            of_grids = steepening * _compliance_difference("unloading_stiffness", coarser, curve)
            of_yield = _yielding_share(k, _over_loads(coarser[1], found[AS_STEEP]))
            of_k_u = np.hypot(np.hypot(of_grids, _YIELD_FACTOR * of_yield), rims_of_k)
            taken = np.where((k > 0) & (k < k_u), _YIELD_SHARE * np.log(k_u / k), 0.0)
            of_k = np.maximum(
                steepening * _compliance_difference("stiffness", coarser, curve), of_k_u + taken
            )
            steepest = max(steepening, grid_steepening(in_full_contact(surface, curve.half_space)))
            of_area = _area_difference(curve, coarser, steepest, surface.heights.size)
            of_area = np.hypot(of_area, rims_of_area)
            return replace(
                curve,
                stiffness_error=_times(k, of_k),
                unloading_stiffness_error=_times(k_u, of_k_u),
                area_fraction_error=_times(area, of_area),
                measured=self._measured(curve, found),
                pull_off_force_error=_pull_off_error(curve, coarser),
            )

    def _again(
        self, curve: SurfaceCurve, surface: Surface, law: ContactLaw, share: float = 1.0
    ) -> Pressing:
        """Press a surface softer under a share of the forces of a curve, as far as it bears them.

        Measures are taken under a share alone.
        """
        forces = np.minimum(
            share * curve.force[_known_forces(curve)],
            _LARGEST_LOADING * Bounds.of(law).largest_force(surface.area),
        )
        measures = self._on_grids.measures if share < 1 else ()
        again = replace(self.pressing, surface=surface, law=law, measures=measures)
        return replace(again, loads=Loads("forces", forces))

    def _steeper_laws(self, half: SurfaceCurve) -> list[ContactLaw]:
        """The law on n / 2 points that yield as the surface does, and as a finer grid will.

        There are none where no slope is added, or no pressure of n / 2 points would be as large as
        the steeper one bears.
        """
        step, steepening = self._grids.step, self._grids.steepening
        # pressures and gaps of a surface so many times steeper, in units so many times larger
        law = self._coarser[1].law
        laws = [law.scaled(times, times) for times in (step, step * steepening)]
        needless = steepening == 1 or is_elastic(half, float(np.min(laws[1].bounds(None)[1])))
        return [] if needless else laws

    def _steeper(self, curve: SurfaceCurve, coarser: Sequence[SurfaceCurve]) -> list[Pressing]:
        """The surface as steep as a finer grid will be, where a measure is zero on one of them."""
        steepening = self._grids.steepening
        grids, pushes = (curve, *coarser), curve.law.only_pushes
        values = [each.measured[name].values for each in grids for name in coarser[0].measured]
        if not (pushes and steepening > 1 and any((each == 0).any() for each in values)):
            return []
        # pressures and gaps of the steeper surface, in units so many times larger
        law = curve.law.scaled(steepening, steepening)
        return [self._again(curve, self.pressing.surface, law, 1 / steepening)]

    def _measured(self, curve: SurfaceCurve, found: _OfStages) -> Mapping[str, Measured]:
        """The measures of a curve with the ends of their intervals.

        A measure that is zero on one of the grids, as the flow through a gap that is sealed there,
        is at most that of a surface as steep as a finer grid will be, whose contact is more open.
        """
        coarser, measured = found[COARSER], dict(curve.measured)
        widening = self._grids.steepening**_MEASURE_EXPONENT
        for name in coarser[0].measured:
            on_grids = np.array([each.measured[name].values for each in (curve, *coarser)])
            low, high = _ends_of_measure(on_grids, widening)
            for steeper in _over_loads(curve, found[STEEPER]):
                opened = np.fmax(high, steeper.measured[name].values)
                high = np.where((on_grids == 0).any(axis=0), opened, high)
            measured[name] = replace(measured[name], low=low, high=high)
        return measured


def _known_forces(curve: SurfaceCurve) -> Mask:
    """Loads of a curve that have pushed, from which on others are pressed under their forces."""
    return np.isfinite(curve.force) & (np.maximum.accumulate(np.nan_to_num(curve.force)) > 0)


def _over_loads(curve: SurfaceCurve, found: Sequence[SurfaceCurve]) -> list[SurfaceCurve]:
    """Curves under these forces, over all loads of the curve."""
    return [among_loads(each, _known_forces(curve)) for each in found]


def _pull_off_error(curve: SurfaceCurve, coarser: Sequence[SurfaceCurve]) -> float:
    """Discretisation error of the pull-off force. [force]"""
    return float(
        _between(np.array([each.pull_off_force for each in coarser]), curve.pull_off_force)
    )


def _unknown(curve: SurfaceCurve, why: str) -> SurfaceCurve:
    """Say of a curve why its errors are not known."""
    unknown = np.full(curve.depth.shape, np.nan)
    return replace(
        curve,
        facts=(*curve.facts, Fact("no_grid_error", why=why)),
        stiffness_error=unknown,
        unloading_stiffness_error=unknown,
        area_fraction_error=unknown,
    )


def grid_steepening(surface: Surface) -> float:
    """How much larger the rms slope of a grid four times finer will be."""
    return _Grids.of(surface).steepening


def refuse_few_points(surface: Surface) -> None:
    """Refuse a surface that has too few points to be halved twice."""
    if min(surface.shape) < 4 * _FEWEST_POINTS:
        raise InputError(
            f"grid_error needs grids of n / 2 and n / 4 points, and the surface has "
            f"{surface.shape[0]} x {surface.shape[1]}: give at least {4 * _FEWEST_POINTS} a side"
        )


def _compliance_difference(name: str, coarser: Sequence[SurfaceCurve], curve: SurfaceCurve) -> Real:
    """Root of the squares by which a compliance differs between grids, over that of the surface."""
    full = getattr(curve, name)
    values = np.array([getattr(each, name) for each in coarser])
    found = _between(np.where(values == full, 1.0, full / values), 1.0)
    is_separated = (full == 0) & (values != 0).any(axis=0)  # and a coarser grid is not
    return np.where(np.isinf(found) | is_separated, np.nan, found)


def _rim_differences(curve: SurfaceCurve, raised: Sequence[SurfaceCurve]) -> tuple[Real, Real]:
    """What the rims of plateaus change of the compliance and of the area's logarithm."""
    none = np.zeros(curve.depth.shape)
    if not raised:
        return none, none
    k, area = curve.unloading_stiffness, curve.area_fraction_corrected
    stiffer, wider = raised[0].unloading_stiffness, raised[0].area_fraction_corrected
    with np.errstate(invalid="ignore", divide="ignore"):
        of_k, of_area = np.abs(1 - k / stiffer), np.abs(np.log(wider / area))
    return np.where(k == stiffer, 0.0, of_k), np.where(area == wider, 0.0, of_area)


def _between(of_coarser: Sequence[Real] | Real, of_surface: Real | float) -> Real:
    """Root of the weighted squares of differences between grids: thinned, halved and quartered."""
    thinned, half, quarter = of_coarser
    differences = [thinned - of_surface, half - of_surface, quarter - half]
    return np.asarray(
        np.sqrt(sum((w * d) ** 2 for w, d in zip(_GRID_WEIGHTS, differences, strict=True)))
    )


def _yielding_share(stiffness: Real, steep: Sequence[SurfaceCurve]) -> Real:
    """Share that a softer body takes from the compliance on unloading; none without one.

    Near full contact a softer body is flattened more than waves alone would: it counts by the root
    of the area that it leaves open.
    """
    if not steep:
        return np.zeros_like(stiffness)
    as_steep, softer = steep
    before, after = as_steep.unloading_stiffness, softer.unloading_stiffness
    area = softer.area_fraction_corrected
    share = 1 - np.minimum(before, after) / np.maximum(before, after)
    return np.where(before == after, 0.0, share * np.sqrt(np.maximum(1 - area, 0.0)))


def _area_difference(
    curve: SurfaceCurve, coarser: Sequence[SurfaceCurve], steepening: float, points: int
) -> Real:
    """Logarithm of the factor by which the contact area may differ."""
    area = curve.area_fraction_corrected
    values = np.array([each.area_fraction_corrected for each in coarser])
    between = _between(np.log(np.where(values == area, 1.0, values / area)), 0.0)
    opened = np.hypot(_opened(steepening**_STEEPENING_EXPONENT, area), _AREA_FACTOR * between)
    most = Bounds.of(curve.law).largest_force(curve.length**2)
    if np.isfinite(most):
        least = curve.force / most
        opened = np.minimum(opened, np.maximum(np.log(area / least), 0.0))
    counted = 1 / np.sqrt(points * area)
    found = np.where(opened == 0, 0.0, np.hypot(opened, counted))
    return np.where(area > 0, found, np.where((values == 0).all(axis=0), 0.0, np.nan))


def _excess(squares: Sequence[float], acceleration: float) -> float:
    """Return the share of the last of three mean square slopes that is beyond a steady growth.

    The logarithm of a slope then grows by `acceleration` times what it did from grid to grid.
    """
    first, second, last = squares
    return 1 - (second / first) ** acceleration * second / last if first > 0 else 0.0


def is_elastic(curve: SurfaceCurve, hardness: float) -> bool:
    """Whether nothing yields under the loads of a curve, nor would with another hardness."""
    most = np.nanmax(curve.largest_pressure, initial=0.0)
    return not np.nan_to_num(curve.plastic_fraction).any() and bool(most <= hardness)


def _opened(steepening: float, area: Real) -> Real:
    """Return how far the logarithm of an elastic contact area falls where slopes are steeper."""
    from scipy.special import erf, erfinv  # here because they load slowly

    # Persson: the error function of the pressure over the slope, times a constant
    steeper = erf(erfinv(np.minimum(area, 1.0)) / steepening)
    return np.where(area == 0, 0.0, np.log(np.minimum(area, 1.0) / steeper))


def _ends_of_measure(on_grids: Real, widening: float) -> tuple[Real, Real]:
    """Both ends of a measure's interval, from what it is on the surface and on coarser grids.

    Its logarithm is so many times as uncertain as that differs between grids. Where it is zero on
    one of them, or changes its sign, it is the value itself; then nothing gets below zero that is
    not so on any.
    """
    value, *coarser = on_grids
    log, *of_coarser = np.log(np.where(on_grids > 0, on_grids, np.nan))
    factor = np.exp(widening * _between(of_coarser, log))
    error = widening * _between(coarser, value)
    least = np.where((on_grids >= 0).all(axis=0), 0.0, -np.inf)
    return (
        np.where(np.isnan(factor), np.maximum(value - error, least), value / factor),
        np.where(np.isnan(factor), value + error, value * factor),
    )


def _times(value: Real, error: Real) -> Real:
    """Return the error of a value from that of its logarithm; none where that is none."""
    return np.where(error == 0, 0.0, value * np.expm1(error))


def field_on(surface: Surface, take: Callable[[Surface], Surface], field: Real) -> Real:
    """Take a field over a surface to where surfaces are taken: a coarser grid, or a piece."""
    return take(with_heights(surface, field)).heights


def halved(surface: Surface) -> Surface:
    """Return the surface on half as many points a side, over the same sides."""
    nx, ny = surface.shape
    if nx % 2 == 0 and ny % 2 == 0:
        return surface.coarsened()
    # heights count from the highest point, so that rounding leaves a flat punch flat
    return resampled(
        with_heights(surface, surface.heights - surface.heights.max()), (nx // 2, ny // 2)
    )


def _thinned(surface: Surface) -> Surface:
    """Return every other point along both sides; splines between points of odd numbers."""
    if surface.shape[0] % 2 == 0 and surface.shape[1] % 2 == 0:
        return with_heights(surface, surface.heights[::2, ::2])
    from scipy import ndimage

    # from the highest point, as above
    heights = surface.heights - surface.heights.max()
    zoom = [(n // 2) / n for n in surface.shape]
    return with_heights(surface, ndimage.zoom(heights, zoom, mode="nearest", grid_mode=True))
