"""Facts on an assessment: what is suspicious, where assumptions break, and what is told beside."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.border_of_flow import what_borders_do
from roughline.assessment.notes import (
    facts_on_borders,
    facts_on_each,
    facts_on_facing,
    facts_on_loads,
    facts_on_materials,
    facts_on_pull_off,
    facts_on_yield,
    line_scan_limits,
    what_was_prepared,
)
from roughline.contact.borders import border_warnings
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.quantities import RESOLVED_FROM
from roughline.engineering.formulas import plasticity_index
from roughline.engineering.rules.mechanical import (
    CONTACT_STIFFNESS,
    INTERFACE_STIFFNESS,
    UNLOADING_STIFFNESS,
)
from roughline.facts.fact import Fact, by_weight
from roughline.facts.listed import MOST_NAMED
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.measurement.homogeneity import ISOTROPIC_FROM
from roughline.question.assumptions import Prediction, departures_behind, takes_down
from roughline.question.case import COARSENED_FROM
from roughline.question.kinds import is_map
from roughline.question.question import Question
from roughline.spectra.isotropic import isotropy
from roughline.spectra.moments import Moments
from roughline.topography.body import Body, Line, Surface
from roughline.topography.files.read import suspicions
from roughline.units import engineering

_LARGE_STRAIN = 0.1  # mean pressure over E*, or depth over side, above which a warning says so
_STEEP_SLOPE = 0.5  # rms slope above which a warning says that half-spaces assume small slopes
_PRESSED = _STEEP_SLOPE / 2  # mean contact pressure over E*, as on such slopes; on layers it is not
_WARNED_FILLED_SHARE = 0.05  # share of the force on filled points from which on a warning says so
_GRAVE_FILLED_SHARE = 0.5  # from which on answers are of heights that nobody measured
_WIDE_RATIO = 4.0  # upper over lower end from which on the causes of an interval are said
_COUNTED_RATIO = 1.2  # upper over lower end of what counts as a cause
_KINDS_ON_BODY = ("step_changes", "map_jumps_at_borders", "border_carries")
"""What curves say as well, and is told of all bodies, and of the loads that were asked for."""


def collect_facts(
    result: Assessment, spectrum: Moments | None, of_causes: Sequence[Fact], tried: bool
) -> list[Fact]:
    """All that is worth telling, the gravest first.

    `tried` says whether the error of the grid was looked for, and Ctrl-C came.
    """
    question, body, curve = result.question, result.body, result.curve
    bodies, pair = [each.body for each in result.topographies], question.pair
    of_curve = [each for each in curve.facts if each.kind not in _KINDS_ON_BODY]
    is_scan = isinstance(body, Line) and body.kind == "profile"
    found = [
        *(of_curve if is_scan else _departures(result)),
        *facts_on_yield(result),
        *facts_on_pull_off(question),
        *result.left_out,
        *facts_on_each(bodies, suspicions),
        *facts_on_each(bodies, what_was_prepared),
        *_broken_assumptions(result, spectrum),
        *(fact for each in result.answers.values() for fact in each.facts),
        *_on_filled_points(result),
        *_on_full_contact(result),
        *_on_wide_intervals(result),
        *line_scan_limits(question, body),
        *(facts_on_materials(result, pair) if pair is not None else ()),
        *what_borders_do(result),
        *([] if is_scan else of_curve),
        *_at_borders(result),
        *of_causes,
        *facts_on_loads(question, body),
        *facts_on_borders(question, body),
        *_on_pressures(question),
        *facts_on_facing(body),
    ]
    if isinstance(body, Surface) and not _knows_grid_error(curve):
        found.append(_without_grid_error(question, body, tried))
    if pair is not None and not isinstance(curve, SurfaceCurve):
        found.append(Fact("no_area_of_line"))
    return by_weight(found)


def _knows_grid_error(curve: Curve) -> bool:
    """Whether the discretisation errors of a curve were estimated."""
    return isinstance(curve, SurfaceCurve) and curve.stiffness_error is not None


def _at_borders(result: Assessment) -> tuple[Fact, ...]:
    """Say what the border carries under the loads that were asked for, of all that were pressed."""
    curve, loads = result.curve, result.asked
    if not isinstance(curve, SurfaceCurve):
        return ()
    return border_warnings(curve.surface, curve.force[loads], curve.border_share[loads])


def _on_pressures(question: Question) -> list[Fact]:
    """Repeat the pressures of a fluid, and that they are absolute."""
    sealing = question.sealing
    if sealing is None or sealing.inlet is None:
        return []
    pressures = {"inlet": sealing.inlet, "outlet": sealing.outlet}
    return [Fact("absolute_pressures", fluid=sealing.medium.name, **pressures)]


def _departures(result: Assessment) -> list[Fact]:
    """Say how what was pressed departs from assumptions, gravest first, and what that takes down.

    Nothing is said of a departure on which no answer to the question rests. What a line scan
    shows is said where it is pressed.
    """
    made: dict[Prediction, bool] = {
        "grid": _knows_grid_error(result.curve),
        "larger surface": is_map(result.body) and bool(result.answers),
        "theories": bool(result.theories),
    }
    predictions = [prediction for prediction, is_made in made.items() if is_made]
    unbounded, whole = _without_interval(result)
    names = tuple(result.answers[key].name for key in unbounded)
    found = []
    for departure in departures_behind(predictions, result.body):
        down = {each for each in predictions if takes_down(departure, each, result.body)}
        if down:
            lost = {"takes_all": "grid" in down, "takes_theories": "theories" in down}
            of = names if "larger surface" in down else ()
            fact = Fact("departs", fact=departure.fact, answers=of, whole=whole, **lost)
            fact = fact.grave("grid" in down)
            found.append(fact.concerning(*unbounded) if down == {"larger surface"} else fact)
    return found


def _without_interval(result: Assessment) -> tuple[list[str], str]:
    """Keys of the answers of the joint or the larger surface that come without an interval.

    The second result names what they are all of, if that is so and they are many.
    """
    is_joint = result.question.joint is not None
    meant = {
        key: each
        for key, each in result.answers.items()
        if (is_joint or each.is_of_larger) and not each.rule.is_given
    }
    unbounded = [key for key, each in meant.items() if each.low is None]
    whole = "joint" if is_joint else "larger surface"
    return unbounded, whole if MOST_NAMED < len(unbounded) == len(meant) else ""


def _on_filled_points(result: Assessment) -> list[Fact]:
    """Say how much of the force stands on points that nobody measured."""
    if result.on_filled is None:
        return []
    shares = result.on_filled[result.asked]
    most = int(np.argmax(np.nan_to_num(shares)))
    if not (share := float(shares[most])) > _WARNED_FILLED_SHARE:
        return []
    fact = Fact("on_filled_points", load=result.headings[most], share=share)
    return [fact.grave(share > _GRAVE_FILLED_SHARE)]


def _broken_assumptions(result: Assessment, spectrum: Moments | None) -> Iterator[Fact]:
    """Say where an assumption breaks."""
    question, body = result.question, result.body
    yield from _steep(body)
    yield from _strained(result)
    hardness = None if question.pair is None or result.curve.hardness else question.pair.hardness
    if hardness is not None and spectrum is not None and not question.coated:  # summits have none
        summits = spectrum.summit_deviation, spectrum.summit_radius
        index = plasticity_index(result.curve.E_star, hardness, summits)
        if index > 1:
            yield Fact("summits_yield", index=index)
    if (
        question.theories
        and isinstance(body, Surface)
        and (ratio := isotropy(body)) < ISOTROPIC_FROM
    ):
        yield Fact("theories_assume_isotropy", ratio=ratio)
    if question.theories and question.attraction is not None:
        yield Fact("theories_without_adhesion")


def _steep(body: Body) -> Iterator[Fact]:
    if body.rms_slope > _STEEP_SLOPE:
        yield Fact("steep", slope=body.rms_slope, limit=_STEEP_SLOPE)


def _strains(of_loads: Sequence[tuple[float, Fact]]) -> list[tuple[float, Fact]]:
    return [(x, Fact("strained", strain=each)) for x, each in of_loads if x > _LARGE_STRAIN]


def _strained(result: Assessment) -> Iterator[Fact]:
    """Say how far bodies are strained beyond what is linear elastic, by what strains them most."""
    question, pressed = result.question, result.answers.get("contact_pressure")
    found = _strains(question.strains(result.body))
    if question.coated and pressed is not None:
        ratio = float(np.nanmax(pressed.values, initial=0.0)) / question.half_space.softest
        if ratio > _PRESSED:
            found.append((ratio, Fact("layers_are_strained", ratio=ratio)))
    if found:
        yield max(found, key=lambda each: each[0])[1]


def _on_full_contact(result: Assessment) -> Iterator[Fact]:
    """Say under which loads all points touch, or all but a few."""
    if isinstance(result.curve_as_asked, SurfaceCurve):
        yield from _full_contact(result.body, result.curve_as_asked, result.headings)


def _full_contact(body: Body, curve: SurfaceCurve, loads: Sequence[str]) -> Iterator[Fact]:
    # what repeats along both axes, and whose mean is not free, stands on a rigid base
    stands = "on base" if all(curve.half_space.repeats) else "punch"
    stands = "free" if curve.half_space.mean_is_free else stands
    open_points = np.rint((1 - curve.area_fraction) * body.heights.size)
    found = list(zip(loads, open_points, strict=True))
    if full := tuple(name for name, n in found if n == 0):
        yield Fact("all_touch", loads=full, stands=stands)
    if nearly := tuple(name for name, n in found if 0 < n < RESOLVED_FROM):
        yield Fact("nearly_all_touch", loads=nearly, points=RESOLVED_FROM)


def facts_on_press(surface: Surface, curve: SurfaceCurve) -> list[Fact]:
    """All that is worth telling of a surface that was pressed, the gravest first.

    These are the facts of an assessment that rest on the body and its loads alone: what the curve
    says, slopes and strains beyond those of half-spaces, and loads under which all points touch.
    """
    half_space = curve.half_space
    side = math.inf if half_space.periodic is True else min(surface.sizes)
    loads = [engineering(force, "N", 3) for force in curve.force]
    of = "pressure" if isinstance(half_space, Homogeneous) else "layers"
    ratios = [half_space.strain(max(force, 0.0) / surface.area, side) for force in curve.force]
    strains = [
        (ratio, Fact("strain_of_load", load=load, ratio=ratio, of=of, is_beside_fluid=False))
        for load, ratio in zip(loads, ratios, strict=True)
    ]
    worst = [fact for _, fact in sorted(_strains(strains), key=lambda each: -each[0])[:1]]
    found = [*_steep(surface), *worst, *_full_contact(surface, curve, loads)]
    return by_weight([*found, *curve.facts])


def _on_wide_intervals(result: Assessment) -> Iterator[Fact]:
    """Say why the interval of a stiffness is wide: its causes, the largest first, and a remedy."""
    rules = (INTERFACE_STIFFNESS, UNLOADING_STIFFNESS, CONTACT_STIFFNESS)
    answer = next((result.answers[each.key] for each in rules if each.key in result.answers), None)
    curve, points = result.curve_as_asked, result.body.heights.size
    if answer is None or answer.ends is None or not isinstance(curve, SurfaceCurve):
        return
    with np.errstate(divide="ignore", invalid="ignore"):
        factors = np.nan_to_num(answer.ends[1] / answer.ends[0], posinf=0.0)
    i = int(np.argmax(factors))
    causes = [each for each in answer.why(i) if each.factor > _COUNTED_RATIO]
    if factors[i] < _WIDE_RATIO or not causes:
        return
    yield Fact(
        "wide",
        answer=answer.name,
        load=result.headings[i],
        factor=float(factors[i]),
        cells=round(float(curve.area_fraction[i]) * points),
        points=points,
        causes=tuple(Fact("left_open", title=each.title, factor=each.factor) for each in causes),
        remedy=causes[0].remedy,
    ).concerning(answer.key)


def _without_grid_error(question: Question, body: Surface, tried: bool) -> Fact:
    """Say that values come without an interval, and why; `tried` if Ctrl-C stopped the estimate."""
    why = "takes long"
    if tried:
        why = "interrupted"
    elif question.grid_error is not None:
        why = "switched off"
    elif min(body.shape) < COARSENED_FROM:
        why = "few points"
    return Fact("grid_error_unknown", why=why, points=COARSENED_FROM)
