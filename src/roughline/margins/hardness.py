"""The hardness: materials scatter, so that the body may be softer or harder; and one without yield.

It bounds answers: what the softest and the hardest body would give is within their intervals, and
is not independent of what else leaves them open.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from roughline.computing.arrays import Mask
from roughline.contact.arguments import yielding_law
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.grid_error import is_elastic
from roughline.contact.selection import among_loads, at_loads
from roughline.engineering.coated import Coated
from roughline.engineering.formulas import plasticity_index
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import yields
from roughline.facts.fact import Fact
from roughline.margins.cause import Cause
from roughline.margins.sheared import SHEARED, sheared_as
from roughline.margins.spread import Spread
from roughline.margins.variant import AS_ASKED, Curves, Variant, larger_name, repeated
from roughline.question.case import Case
from roughline.question.films import Film, film_that_spots_exceed, hardness_ends
from roughline.question.kinds import nominal_area
from roughline.question.loads import Hardness, LoadCase
from roughline.topography.body import Body, Surface

ELASTIC = "elastic"
SOFTEST = "softest"
HARDEST = "hardest"
AS_HARD = "as hard on half as many points a side"  # as the softest and hardest of large bodies are

WAYS = (ELASTIC, AS_HARD, SOFTEST, HARDEST)
"""Names of variants of another hardness, or on another grid to compare these with."""


@dataclass(frozen=True)
class OfHardness:
    """A variant of another hardness, of which the same is answered."""

    variant: str
    body: Body
    hardness: float | None  # None where nothing yields [Pa]


class HardnessScatter(Cause):
    """The softer body may be softer or harder than its material's hardness says."""

    name = "hardness"
    title = "the scatter of the hardness"
    remedy = "a measured hardness"
    takes = "for elastic bodies and the scatter of the hardness if points yield"
    is_bound = True

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """The body without yield, and as soft and as hard as it may be, repeated as well."""
        hardness, body = case.hardness, case.body
        if hardness is None or case.pair is None or not isinstance(body, Surface):
            return ()
        if pressed.name != AS_ASKED:
            return ()
        listed = []
        for name, other in [(ELASTIC, body), *self._scattered(case)]:
            needed = partial(_as_hard, case, name, other)
            share = other.heights.size / body.heights.size
            variant = Variant(name, self.name, needed, body.shape, case.loads.periodic, share)
            listed += [
                variant,
                *([repeated(case, variant)] if case.is_repeated_for_interface else []),
            ]
        return listed

    def sheared_presses(self, case: Case, as_asked: Variant) -> Sequence[Variant]:
        """The body as soft and as hard as it may be, along the path of a shear force."""
        listed = [
            sheared_as(case, as_asked, way, body, partial(_sheared_as_hard, case, way, body))
            for way, body in self._scattered(case)
            if isinstance(body, Surface)
        ]
        return [each for each in listed if each is not None]

    def _scattered(self, case: Case) -> list[tuple[str, Body]]:
        """Ways of a hardness that scatters, and the bodies on which that is judged."""
        if case.hardness is None or case.pair is None or case.hardness.factor == 1:
            return []
        other = case.scatter_body
        nominal = [(AS_HARD, other)] if other is not case.body else []
        return [*nominal, (SOFTEST, other), (HARDEST, other)]

    def spread(self, case: Case, curves: Curves, variant: str) -> Spread | None:
        """None: it bounds what others leave open."""
        return None

    def nominal(self, case: Case) -> OfHardness | None:
        """What the ends are compared with, if it is not the body as asked: on a coarser grid."""
        if case.hardness is None or case.scatter_body is case.body:
            return None
        return OfHardness(AS_HARD, case.scatter_body, case.hardness.value)

    def ends(self, case: Case, curves: Curves) -> Sequence[OfHardness]:
        """The softest body and the hardest; none where the hardness is taken as exact."""
        if case.hardness is None or case.hardness.factor == 1:
            return ()
        body, as_asked = case.scatter_body, curves.as_asked
        return [
            OfHardness(way, body, _hardness_in(case, way, as_asked)) for way in (SOFTEST, HARDEST)
        ]

    def facts(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """What yields at the largest load, with which hardness, and how far that is known."""
        curve, pair = curves.as_asked, case.pair
        found = [] if case.hardness is None else _on_yield(case, curves, case.hardness)
        found += _on_softest(case, curves)
        if pair is None:
            return found
        summits, hardness = case.moments, pair.hardness
        if pair.coated:
            found += _on_layers(case, pair, curve)
        elif summits is not None and hardness is not None and not curve.hardness:
            of_summits = summits.summit_deviation, summits.summit_radius
            index = plasticity_index(curve.E_star, hardness, of_summits)
            if index > 1:
                found.append(Fact("summits_yield", index=index))
        return found


def _on_softest(case: Case, curves: Curves) -> list[Fact]:
    """Say that the softest body is known without being pressed."""
    curve = curves.get(AS_ASKED)
    ends = None if curve is None else hardness_ends(case.question, curve)
    if curve is None or ends is None or not _is_known(case, curves, ends[0]):
        return []
    most = max(float(np.nanmax(each.largest_pressure)) for each in _as_asked(case, curves))
    return [Fact("softest_is_elastic", pressure=most, hardness=ends[0])]


def _on_yield(case: Case, curves: Curves, hardness: Hardness) -> list[Fact]:
    """Say what yields at the largest load, with which hardness, and what its scatter does."""
    curve, largest, pair = curves.get(AS_ASKED), case.loads.largest, case.pair
    if curve is None or np.isnan(share := float(curve.plastic_fraction[largest])):
        return []
    bearer = None if pair is None or hardness.factor == 1 else pair.bearer
    known = {"hardness": hardness.value, "bearer": bearer}
    found = [
        Fact("some_yields", share=share, **known) if share else Fact("nothing_yields", **known)
    ]
    if hardness.factor == 1 or pair is None:
        return found
    kind, softest = "scatter_in_intervals", curves.get(SOFTEST)
    if curves.stopped or softest is None:
        kind = "scatter_unknown"
    elif not softest.converged[largest]:
        kind = "softest_does_not_bear"
    elif not softest.plastic_fraction[largest] > 0:
        kind = "scatter_changes_nothing"
    return [*found, Fact(kind, factor=hardness.factor)]


def _on_layers(case: Case, pair: MaterialPair, curve: Curve) -> list[Fact]:
    """Say of what the hardness of a coated body is, and what is not known with it."""
    found, softer = [], pair.softer
    if isinstance(softer, Coated) and not case.question.elastic:
        top = softer.surface
        found.append(Fact("hardness_in_bulk", body=softer.name, top=top.name))
        if (exceeded := film_that_spots_exceed(case.question, curve)) is not None:
            found.append(_on_film(*exceeded))
        if (of := top.layer_hardness) and top.hardness:
            numbers = {"hardness": top.hardness, "of_layers": of}
            found.append(Fact("layer_hardness_differs", material=top.name, **numbers))
    if pair.hardness is not None and curve.hardness is None:
        found.append(Fact("no_plasticity_index_of_layers"))
    return found


def _on_film(film: Film, radius: float) -> Fact:
    """Say which hardness spots wider than a film is thick feel, and which way that goes."""
    top, below = film.top.hardness, film.below.hardness
    return Fact(
        "spots_wider_than_film",
        radius=radius,
        thickness=film.thickness,
        top=film.top.name,
        below=film.below.name,
        is_known=top is not None and below is not None,
        is_harder=None if top is None or below is None else below > top,
        is_included=film.top.hardness_factor > 1,
    )


def _hardness_in(case: Case, way: str, curve: Curve) -> float | None:
    """The hardness in a way, from the curve as asked; None if bodies are elastic. [Pa]"""
    ends = hardness_ends(case.question, curve)
    if ends is None or case.hardness is None or way == ELASTIC:
        return None
    return {AS_HARD: case.hardness.value, SOFTEST: ends[0], HARDEST: ends[1]}[way]


def _as_hard(case: Case, way: str, body: Body, curves: Curves) -> LoadCase | Curve | None:
    """Press the body with another hardness, under the loads that it bears then.

    As long as nothing yields, the curve as asked is that of a harder body as well, and of a softer
    one that bears its largest pressure.
    """
    curve = curves.as_asked
    hardness = _hardness_in(case, way, curve)
    if not yields(curve):
        if hardness is None:
            return None
        is_harder = body is case.body and hardness >= (curve.hardness or 0)
        if is_harder or _is_known(case, curves, hardness):
            settings = {**curve.settings, "hardness": hardness}
            return replace(curve, law=yielding_law(hardness), settings=settings)
    loads = _loads_below(case, curve, hardness)
    if not loads.any():
        return among_loads(at_loads(curve, np.flatnonzero(loads)), loads)
    measures = () if case.is_repeated_for_interface else case.measures
    of_hardness = case.loads.with_hardness(hardness, loads, curve)
    return replace(of_hardness, body=body, measures=measures)


def _sheared_as_hard(
    case: Case,
    way: str,
    body: Body,
    along: Callable[[Curves], LoadCase | None],
    curves: Curves,
) -> LoadCase | Curve | None:
    """Shear the body with another hardness, if it bears the largest load.

    If all of its curve is known, so is what the shear force does.
    """
    found, loads, largest = _as_hard(case, way, body, curves), along(curves), case.loads.largest
    if isinstance(found, Curve):
        return curves.get(SHEARED) if found.converged[largest] else None
    if found is None or loads is None or not (found.among is None or found.among[largest]):
        return None
    return replace(loads, hardness=found.hardness)


def _is_known(case: Case, curves: Curves, hardness: float) -> bool:
    """Whether the curves as asked are those of the body with another hardness as well."""
    pressed = _as_asked(case, curves)
    is_same = case.scatter_body is case.body and not curves.stopped
    return is_same and bool(pressed) and all(is_elastic(each, hardness) for each in pressed)


def _as_asked(case: Case, curves: Curves) -> list[SurfaceCurve]:
    """Curves of the body as asked, and of it repeated."""
    found = (curves.get(name) for name in dict.fromkeys((AS_ASKED, larger_name(case, AS_ASKED))))
    return [each for each in found if each is not None]


def _loads_below(case: Case, curve: Curve, hardness: float | None) -> Mask:
    """Which loads of the curve as asked were solved, and are borne by a body of a hardness.

    What a load leaves that is too large is not known, nor are those after it.
    """
    if hardness is None or case.loads.depths:
        return curve.converged
    largest = np.maximum.accumulate(np.nan_to_num(curve.force))
    return curve.converged & (largest < hardness * nominal_area(case.body))
