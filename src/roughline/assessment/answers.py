"""What follows from an assessed curve for two materials, and which assumptions do not hold."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from roughline.assessment.assessment import Assessment
from roughline.assessment.hardness import hardness_of
from roughline.assessment.kinds import has_spectrum
from roughline.assessment.larger_surface import LargerSurface, stiffness_of_the_piece
from roughline.assessment.misfit import strains
from roughline.engineering.formulas import plasticity_index
from roughline.engineering.intervals import Ends, Intervals
from roughline.engineering.pressed import Interface, Pressed
from roughline.engineering.rule import rules
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
    if result.question.pair is None:
        return result
    intervals = result.intervals_as_asked
    interface = _interface(result, larger)
    given, left_out = rules.answers(_pressed(result, interface, intervals, spectrum))
    larger = None if larger is None else larger.at(result.asked)
    return replace(result, answers=given, left_out=left_out, larger=larger)


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
    larger, curve = result.larger, result.curve_as_asked
    if larger is None or not result.answers or curve.area_fraction_corrected is None:
        return {}
    larger = larger.from_many(curve.area_fraction_corrected, further, with_grid=with_grid)
    intervals = result.intervals_as_asked if with_grid else None
    if result.question.joint is not None:  # the map is pressed as a part of the larger one
        known = curve if with_grid else replace(curve, stiffness_error=None)
        intervals = larger.intervals(known)
    pressed = _pressed(result, larger.stiffness, intervals, surface_moments(result.body))
    given, _ = rules.answers(pressed)
    return {key: each.ends for key, each in given.items() if each.ends is not None}


def _pressed(
    result: Assessment,
    interface: Interface | None,
    intervals: Intervals | None,
    spectrum: Moments | None,
) -> Pressed:
    """What the rules of the answers are given."""
    question, curve = result.question, result.curve_as_asked
    pair, hardness = question.pair, hardness_of(question)
    assert pair is not None
    return Pressed(
        curve,
        result.area,
        pair,
        joint=question.joint,
        interface=interface,
        rms_height=result.body.rms_height,
        rms_slope=spectrum.rms_slope if spectrum else None,
        frequency=question.frequency_in_hertz,
        intervals=intervals,
        hardest=hardness.ends[1] if hardness and isinstance(result.body, Surface) else None,
        has_depths=bool(question.depths),
        fields=result.fields,
    )


def broken_assumptions(result: Assessment, spectrum: Moments | None) -> list[str]:
    """Say where an assumption breaks, and what is to be said with the answers."""
    question, body = result.question, result.body
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
    if (index := _plasticity(result, spectrum)) > 1:
        broken.append(
            f"the plasticity index is {decimal(index, 2)}, over 1: summits yield at first touch; "
            "under repeated loads they deform elastically about their flattened shape"
        )
    if question.theories and isinstance(body, Surface) and (alike := isotropy(body)) < ALIKE:
        broken.append(
            "theories assume an isotropic surface, and the rms slope depends on direction: the "
            f"least is {alike:.2f} of the largest"
        )
    return broken + [each.warning for each in result.answers.values() if each.warning]


def _plasticity(result: Assessment, spectrum: Moments | None) -> float:
    """Greenwood and Williamson's index, where summits are not given a hardness; else zero."""
    pair = result.question.pair
    if pair is None or pair.hardness is None or spectrum is None or result.curve.hardness:
        return 0.0
    summits = spectrum.summit_deviation, spectrum.summit_radius
    return plasticity_index(result.curve.E_star, pair.hardness, summits)


def _interface(result: Assessment, larger: LargerSurface | None) -> Interface | None:
    """Stiffness of the interface alone; None where the contact stiffness is that already."""
    intervals = result.intervals_as_asked
    if larger is not None:
        interface = larger.stiffness.at(result.asked)
        # what one piece leaves open is narrower than what is unknown without the grid's error
        return interface.bare if intervals is None else interface
    if result.question.periodic:
        return None
    ends = intervals.unloading if intervals else None
    return stiffness_of_the_piece(result.body, result.curve_as_asked, ends)
