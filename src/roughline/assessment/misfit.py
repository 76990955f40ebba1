"""What cannot be asked of a body of some kind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.assessment.hardness import WITHOUT_YIELD
from roughline.assessment.kinds import has_spectrum
from roughline.assessment.nominal import nominal_area
from roughline.errors import InputError
from roughline.errors.words import called
from roughline.topography.body import Body, Line, Surface
from roughline.units import decimal, engineering

if TYPE_CHECKING:
    from roughline.assessment.question import Question


def refuse_misfit(question: Question, body: Body) -> None:
    """Refuse what does not suit the kind of a body, or its size.

    Raises
    ------
    InputError
        If something that belongs to a surface is asked of a line scan, theories of a body that
        has no spectrum, or a joint that is smaller than its map; or if a mean pressure is above the
        contact modulus, or a depth above the shorter side.
    """
    is_scan = isinstance(body, Line) and body.kind == "profile"
    if is_scan and (question.periodic or question.grid_error or question.depths):
        raise InputError(
            "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
            "loads, through its spectrum: leave them out, or press a map"
        )
    given = {
        called("hardness"): question.hardness is not None,
        called("history", True): question.history,
        called("unload", True): question.unload,
    }
    if isinstance(body, Line) and any(given.values()):
        came = " and ".join(name for name, is_given in given.items() if is_given)
        raise InputError(
            "hardness, history and unload belong to a surface; the reduced model of a line "
            f"{WITHOUT_YIELD} (rms slopes below 0.8 H / E*): leave {came} out, or press a map"
        )
    if question.joint is not None:
        _refuse_as_piece_of_a_joint(body, question.joint)
    for ratio, text in strains(question, body):
        if ratio > 1:
            raise InputError(
                f"{text}, and half-spaces are linear elastic far below that only: give a smaller "
                "one, and check its unit"
            )
    if question.theories and not has_spectrum(body):
        raise InputError("theories are evaluated for a rough surface of 8 x 8 points or more")


def strains(question: Question, body: Body) -> list[tuple[float, str]]:
    """Return how far each load strains a body: as a ratio, and in words."""
    area = nominal_area(body)
    side = min(body.sizes) if isinstance(body, Surface) else body.length
    if depths := question.heights():
        what = "depth {} is {} times the shorter side of the body"
        ratios = [depth / side for depth in depths]
    else:
        what = "the mean pressure of load {} is {} times the contact modulus"
        ratios = [force / area / question.modulus for force in question.forces(area)]
    return [
        (ratio, what.format(heading, decimal(ratio, 2)))
        for heading, ratio in zip(question.headings, ratios, strict=False)
    ]


def _refuse_as_piece_of_a_joint(body: Body, joint: float) -> None:
    """Refuse a body that cannot stand for a joint of some area [m²]."""
    if isinstance(body, Line):
        raise InputError(
            f"{called('joint_area')} belongs to a surface: a line stands for the square of "
            "its length alone, "
            f"and what lies beyond is not known; leave {called('joint_area')} out"
        )
    if body.area > joint * (1 + 1e-9):  # sides are rounded
        raise InputError(
            f"the joint has an area of {engineering(joint, 'm²')}, less than the map, which has "
            f"{engineering(body.area, 'm²')}: crop the map, or leave {called('joint_area')} out"
        )
