"""What several maps of a part say together of the part behind them.

Maps are pressed under the same mean pressure p, and the part is not. At equal distance of the mean
planes a rougher place bears more. With the separation u = u_0 log(p_0 / p) of a place of stiffness
k = p / u_0 per area, which scatters between places by a standard deviation s of log(k), and with
bodies that give way to waves of wavenumber q by 2 / (E* q) per pressure, pressures are
p exp(-L t x) to first order, where x is the deviation of log(k), L = log(p_0 / p), and

    t = 1 / (1 + 2 k / (E* q)).

The stiffness of the part over the geometric mean of its places is then, to second order in s,

    log(K / k) = s² (-(L t)² / 2 + (1 - L t)² (t - 1/2)).

It goes from -s²/2, the harmonic mean, where bodies give way (t = 0), to s² (1/2 - L), where they do
not. In neither case is the part softer than its roughest places alone, two standard deviations from
the middle. L is the logarithm of 1 over the contact area fraction, and differences between maps
have waves of at least two of their sides. Maps of one surface that is alike everywhere differ by
chance; how their chance waves share the load is what their tiles show. So s² is that share of the
variance between maps which their quarters do not explain, as in an analysis with random effects.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.engineering.intervals import Ends
from roughline.errors import InputError
from roughline.facts.fact import Fact
from roughline.margins.larger_measure import UNBOUNDED
from roughline.margins.larger_surface import Differences, LargerSurface
from roughline.margins.spread import logit
from roughline.margins.tiles import FEWEST_POINTS, Tiles
from roughline.measurement.fit import SelfAffineFit, nearest_law
from roughline.measurement.longer_waves import long_shapes
from roughline.question.extrapolation import MOST_DOUBLINGS, Extrapolation, fitted_roll_offs
from roughline.question.question import Question
from roughline.spectra.isotropic import isotropic_spectrum, mean_spectrum
from roughline.statistics.places import Agreement, agreement
from roughline.topography.body import Body, Surface

_DEVIATIONS_TO_EDGE = 2.0  # standard deviations from the middle to the roughest places
_SIDE_TOLERANCE = 0.05  # logarithm of sides, up to which maps have the same waves
_CHANCE = 0.01  # of a tilt and bow that the waves of the maps explain
_FEWEST_POINTS = 16  # points along a side, whose quarters have an rms height


class MapOfPart(Protocol):
    """One of several maps, pressed, as far as it tells of the part."""

    @property
    def question(self) -> Question:
        """What was asked of it."""

    @property
    def body(self) -> Body:
        """What was pressed. [m]"""

    @property
    def curve_as_asked(self) -> Curve:
        """Its curve at the loads that were asked for."""

    @property
    def larger(self) -> LargerSurface | None:
        """The surface that it was cut out of, under these loads; None if it is no map."""


@dataclass(frozen=True, eq=False)
class BehindMaps:
    """The surface behind several maps, under the loads that were asked for."""

    agreement: Agreement | None  # of logarithms of rms heights, between maps and their quarters
    common: Differences  # from the mean of its places, as the tiles of maps show it
    sharing: Differences  # as places share the load
    why_unknown: Fact | None = None  # why the maps do not tell of it; None where they do

    def facts(self, answers: Mapping[str, str], *, is_joint: bool) -> list[Fact]:
        """Of which answers, names by their keys, maps do not tell, and whether maps agree."""
        found: list[Fact] = []
        if self.why_unknown and answers:
            numbers = {"answers": tuple(answers.values()), "is_joint": is_joint}
            unknown = Fact("behind_maps_unknown", why=self.why_unknown, **numbers)
            found.append(unknown if is_joint else unknown.concerning(*answers))
        if (agree := self.agreement) is not None:
            # factors over 1 by which rms heights scatter
            scatter = {"between": math.expm1(agree.between), "within": math.expm1(agree.within)}
            kind = "maps_agree" if agree.holds else "maps_disagree"
            found.append(Fact(kind, **scatter, ratio=agree.ratio, chance=agree.chance))
        return found


def behind_maps(results: Sequence[MapOfPart]) -> BehindMaps | None:
    """Say what two or more maps tell of the surface behind them; None if one is no map of it."""
    larger = [each.larger for each in results if each.larger is not None]
    surfaces = [each.body for each in results if isinstance(each.body, Surface)]
    if len(results) < 2 or min(len(larger), len(surfaces)) < len(results):
        return None
    first, same = results[0], _same_size(surfaces)
    law = _mean_law(same)
    roll_offs = None if law is None else fitted_roll_offs(law)
    area = float(np.mean([each.area for each in surfaces]))
    extrapolation = Extrapolation.of(roll_offs, area, first.question.joint)
    gap_extrapolation = Extrapolation.of(roll_offs, area, *first.question.gap_assembly)
    tiles = [each.tiles for each in larger if each.tiles is not None]
    nothing = np.zeros(first.curve_as_asked.force.size)
    common = Differences((nothing, nothing), (nothing, nothing))
    if tiles:
        of_stiffness, of_area = (
            Tiles.mean(each).extrapolated(extrapolation, mean=True)
            for each in zip(*tiles, strict=True)
        )
        common = Differences(of_stiffness, of_area, _measure_differences(larger, gap_extrapolation))
    agree = _agreement(surfaces)
    curves = [each.curve_as_asked for each in results]
    areas = [each.area_fraction_corrected for each in curves if isinstance(each, SurfaceCurve)]
    sharing = shared_load(
        np.stack([each.stiffness.values for each in larger]),
        np.stack(areas),
        math.sqrt(area),
        float(first.curve_as_asked.half_space.modulus(np.array([math.pi / math.sqrt(area)]))[0]),
        1.0 if agree is None else agree.place_share,
    )
    why_unknown = None if law is None else _longer_waves(same, law)
    if first.question.coated:
        why_unknown = Fact("part_is_coated", body=first.question.coated[0].name)
    elif why_unknown is None and not extrapolation.is_supported:
        lengths = {"times": 2**extrapolation.doublings, "least": 2**MOST_DOUBLINGS}
        why_unknown = Fact("maps_show_no_roll_off", **lengths)
    elif why_unknown is None and not tiles:
        why_unknown = Fact("maps_without_tiles", points=FEWEST_POINTS)
    return BehindMaps(agree, common, sharing, why_unknown)


def _measure_differences(
    larger: Sequence[LargerSurface], extrapolation: Extrapolation
) -> Mapping[str, Ends]:
    """How measures of the surface behind maps differ from the mean of its places."""
    found: dict[str, Ends] = {}
    for name in larger[0].measures:
        if all(name in each.measures for each in larger):
            measures = [each.measures[name] for each in larger]
            mean = Tiles.mean([each.tiles for each in measures]).extrapolated(
                extrapolation, mean=True
            )
            border = np.mean([each.border for each in measures], axis=0)
            both = np.minimum(mean[0], border[0]), np.maximum(mean[1], border[1])
            found[name] = both if extrapolation.is_supported else UNBOUNDED
    return found


def shared_load(
    stiffness: Real, area: Real, side: float, E_star: float, of_places: float = 1.0
) -> Differences:
    """Bounds of how a part differs from the mean of its places as they share its load.

    The stiffness of the interface [N / m] and the area fraction of each map are of shape (maps,
    loads), under the same mean pressure; `side` is that of a map [m]. `of_places` is the share of
    the variance between maps that belongs to places, and not to chance; `E_star` is the contact
    modulus that waves of two sides feel [Pa]. The bounds are of the differences of the stiffness's
    logarithm and of the area's logit: a mean area is not the logit's mean either.
    """
    s_k, log_k = _scatter_and_middle(np.log, stiffness)
    s_a, logit_a = _scatter_and_middle(logit, area)
    s_k, s_a = s_k * math.sqrt(of_places), s_a * math.sqrt(of_places)
    a = 1 / (1 + np.exp(-logit_a))
    t = 1 / (1 + 2 * np.exp(log_k) / (math.pi * E_star * side))
    towards_rough = -np.log(a) * t
    softer = np.minimum(np.maximum(towards_rough, 0.5) * s_k**2, _DEVIATIONS_TO_EDGE * s_k)
    less = np.minimum(
        np.maximum(towards_rough * s_k, (a - 0.5) * s_a) * s_a, _DEVIATIONS_TO_EDGE * s_a
    )
    more = np.maximum(0.5 - a, 0.0) * s_a**2
    return Differences((-softer, 0.0 * softer), (-less, more))


def _scatter_and_middle(scale: Callable[[Real], Real], values: Real) -> tuple[Real, Real]:
    """Standard deviation and mean over the maps of values on a scale, as far as they have one."""
    with np.errstate(divide="ignore", invalid="ignore"):
        scaled = scale(values)
    known = np.isfinite(scaled)
    count = known.sum(axis=0)
    middle = np.where(known, scaled, 0.0).sum(axis=0) / np.maximum(count, 1)
    squares = np.where(known, (scaled - middle) ** 2, 0.0).sum(axis=0)
    return np.sqrt(squares / np.maximum(count - 1, 1)), middle


def _same_size(surfaces: Sequence[Surface]) -> list[Surface]:
    """Maps with the points and sides of the first, and so with its waves."""
    first = surfaces[0]

    def is_as_large(other: Surface) -> bool:
        ratios = np.divide(other.sizes, first.sizes)
        return other.shape == first.shape and bool((abs(np.log(ratios)) < _SIDE_TOLERANCE).all())

    return [each for each in surfaces if is_as_large(each)]


def _mean_law(surfaces: Sequence[Surface]) -> SelfAffineFit | None:
    """Law of the mean spectrum of maps of one size; None where there are too few points."""
    try:
        return nearest_law(mean_spectrum([isotropic_spectrum(each) for each in surfaces]))
    except InputError:
        return None


def _longer_waves(surfaces: Sequence[Surface], law: SelfAffineFit) -> Fact | None:
    """Say whether maps are tilted and bowed more than the waves of their law explain."""
    if len(surfaces) < 2:
        return None
    shapes = list(long_shapes(surfaces, law))
    grave = [each for each in shapes if each.chance < _CHANCE / len(shapes)]
    if not grave:
        return None
    worst = max(grave, key=lambda each: each.rms / each.explained)
    heights = {"rms": worst.rms, "explained": worst.explained, "unit": surfaces[0].unit}
    return Fact("maps_lie_on_longer_waves", degree=min(worst.degree, 3), **heights)


def _agreement(surfaces: Sequence[Surface]) -> Agreement | None:
    """Whether maps agree: their rms heights, compared with those of their quarters."""
    if min(min(each.shape) for each in surfaces) < _FEWEST_POINTS:
        return None
    with np.errstate(divide="ignore"):
        logs = np.log([[each.rms_height for each in _quarters(surface)] for surface in surfaces])
    return agreement(logs) if np.isfinite(logs).all() else None


def _quarters(surface: Surface) -> list[Surface]:
    """Four quarters of a map, each without its tilt."""
    x, y = ((0, n // 2, 2 * (n // 2)) for n in surface.shape)
    return [
        surface.cropped((x[i], x[i + 1]), (y[j], y[j + 1])).detrended()
        for i in (0, 1)
        for j in (0, 1)
    ]
