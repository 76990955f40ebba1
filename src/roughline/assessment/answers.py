"""What follows from an assessed curve for two materials, and which assumptions do not hold."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from roughline.assessment.assessment import Assessment
from roughline.assessment.kinds import has_spectrum
from roughline.assessment.larger_surface import LargerSurface, stiffness_of_the_piece
from roughline.assessment.misfit import strains
from roughline.engineering.answer import Answer
from roughline.engineering.answers import answers
from roughline.engineering.formulas import plasticity_index
from roughline.engineering.intervals import Ends, Intervals
from roughline.engineering.joint import of_joint
from roughline.engineering.limits import elastic_warnings
from roughline.engineering.pair import MaterialPair
from roughline.engineering.symbols import with_own_symbols
from roughline.spectra.isotropic import isotropy
from roughline.spectra.moments import Moments, moments
from roughline.spectra.roughness import ALIKE
from roughline.topography.body import Body, Surface
from roughline.units import decimal

_STRAINED = 0.1  # mean pressure over E*, or depth over side, above which a warning says so
_STEEP = 0.5  # rms slope above which a warning says that half-spaces assume small slopes


def surface_moments(body: Body) -> Moments | None:
    """Moments of a surface's spectrum; None for a line, and where there is no spectrum."""
    return moments(body) if has_spectrum(body) else None


def with_answers(
    result: Assessment, larger: LargerSurface | None, spectrum: Moments | None
) -> Assessment:
    """Return the assessment with its answers for the loads that were asked for.

    Parameters
    ----------
    result : Assessment
        With its curve.
    larger : LargerSurface or None
        The larger surface behind the body, over the loads of the curve.
    spectrum : Moments or None
        Of the body.
    """
    pair = result.question.pair
    if pair is None:
        return result
    interface = _interface_stiffness(result, larger)
    given = _answers(result, pair, interface, result.intervals_as_asked, spectrum)
    larger = None if larger is None else larger.at(result.asked)
    return replace(result, answers=given, larger=larger)


def ends_from_many(
    result: Assessment, further: tuple[Ends, Ends], *, with_grid: bool
) -> Mapping[str, Ends]:
    """Ends of the answers of one of many maps, by their keys.

    Parameters
    ----------
    result : Assessment
        With its answers.
    further : tuple of (tuple of ndarray)
        As for :meth:`LargerSurface.from_many`, at the loads that were asked for.
    with_grid : bool
        Whether the ends hold what the grid leaves open as well.
    """
    pair, larger, curve = result.question.pair, result.larger, result.curve_as_asked
    if larger is None or pair is None or curve.area_fraction_corrected is None:
        return {}
    larger = larger.from_many(curve.area_fraction_corrected, further, with_grid=with_grid)
    intervals = result.intervals_as_asked if with_grid else None
    if result.question.joint is not None:  # the map is pressed as a part of the larger one
        known = curve if with_grid else replace(curve, stiffness_error=None)
        intervals = larger.intervals(known)
    given = _answers(result, pair, larger.stiffness, intervals, surface_moments(result.body))
    return {key: each.ends for key, each in given.items() if each.ends is not None}


def _answers(
    result: Assessment,
    pair: MaterialPair,
    interface_stiffness: Answer | None,
    intervals: Intervals | None,
    spectrum: Moments | None,
) -> dict[str, Answer]:
    """What follows from the curve by its key, with intervals as they are given."""
    given = answers(
        result.curve_as_asked,
        result.area,
        pair,
        interface_stiffness=interface_stiffness,
        amplitudes=(result.body.rms_height, spectrum.rms_slope if spectrum else None),
        frequency=result.question.frequency_in_hertz,
        intervals=intervals,
    )
    if result.question.joint is not None:
        given = of_joint(given, result.area, result.question.joint)
    return {each.key: each for each in with_own_symbols(given)}


def broken_assumptions(result: Assessment, spectrum: Moments | None) -> list[str]:
    """Say where an assumption breaks, and which surface k_i belongs to."""
    question, body, pair = result.question, result.body, result.question.pair
    broken = []
    if body.rms_slope > _STEEP:
        broken.append(
            f"the rms slope is {decimal(body.rms_slope, 2)}, and half-spaces assume small slopes: "
            f"no interval includes the effect of slopes over {_STEEP:g}"
        )
    ratio, text = max(strains(question, body), default=(0.0, ""))
    if ratio > _STRAINED:
        broken.append(
            f"{text}: bodies that are strained so far are not linear elastic, and no interval "
            "includes that"
        )
    if pair is not None and result.curve.hardness is None:
        index = None
        if spectrum is not None and pair.hardness is not None:
            summits = spectrum.summit_deviation, spectrum.summit_radius
            index = plasticity_index(result.curve.E_star, pair.hardness, summits)
        broken += elastic_warnings(result.answers, index)
    if question.theories and isinstance(body, Surface) and (alike := isotropy(body)) < ALIKE:
        broken.append(
            "theories assume an isotropic surface, and the rms slope depends on direction: the "
            f"least is {alike:.2f} of the largest"
        )
    if "interface_stiffness" in result.answers:
        validity = result.answers["interface_stiffness"].validity
        broken.append(f"the interface stiffness k_i is {validity}")
    return broken


def _interface_stiffness(result: Assessment, larger: LargerSurface | None) -> Answer | None:
    """Stiffness of the interface alone; None where the contact stiffness is that already."""
    intervals = result.intervals_as_asked
    if larger is not None:
        answer = larger.stiffness.at(result.asked)
        # what one piece leaves open is narrower than what is unknown without the grid's error
        return replace(answer, low=None, high=None) if intervals is None else answer
    if result.question.periodic:
        return None
    ends = intervals.unloading if intervals else None
    return stiffness_of_the_piece(result.body, result.curve_as_asked, ends)
