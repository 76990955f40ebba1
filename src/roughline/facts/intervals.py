"""Which answers there are not, which have no interval, and what leaves wide ones open."""

from __future__ import annotations

from typing import Literal

from roughline.errors.words import called
from roughline.facts.fact import INTERVALS, LIMITS, Fact, Wording, kind
from roughline.facts.listed import MOST_NAMED, listed_in_short
from roughline.units import decimal, engineering

WhyNot = Literal["interrupted", "switched off", "few points", "takes long"]
"""Why the error of the grid is not estimated."""

_WITHOUT = "without an interval"


@kind(LIMITS, "note")
def without_answer(names: tuple[str, ...], why: str) -> Wording:
    """Answers that there are not, each with the share of the loads if it is of some, and why."""
    text = f"{', '.join(f'no {each}' for each in names)}: {why}"
    return f"no {listed_in_short(names)}: {why}", text


@kind(INTERVALS)
def departs(
    fact: Fact,
    *,
    takes_all: bool,
    takes_theories: bool,
    answers: tuple[str, ...] = (),
    whole: str = "",
) -> Wording:
    """What was pressed departs from an assumption, and which predictions that takes down.

    These are all intervals, or those of some answers, which may be all of the `whole` joint or
    larger surface; and theories.
    """
    lost = []
    if takes_all:
        lost.append(f"all values come {_WITHOUT}")
    if answers:
        names, verb = listed_in_short(answers), "comes" if len(answers) == 1 else "come"
        if len(answers) > MOST_NAMED and whole:
            names = f"all answers of the {whole}"
        lost.append(f"{names} {verb} {_WITHOUT}")
    if takes_theories:
        lost.append("theories assume otherwise")
    short = fact.in_short
    if takes_all or answers:
        short = f"no interval: {short}"
    return short, "; ".join([str(fact), *lost])


@kind(INTERVALS)
def line_stands_for_surface(fact: Fact) -> Wording:
    """What a line scan shows, so that it does not tell of its surface."""
    return (
        f"no interval: {fact.in_short}",
        f"{fact}; the stiffness comes without an interval, and may be off by a factor of several: "
        "press a map",
    )


@kind(INTERVALS)
def grid_error_unknown(why: WhyNot, points: int) -> Wording:
    """Why the error of the grid is not estimated."""
    option = called("grid_error", True)
    reasons = {
        "interrupted": ("interrupted before", ""),
        "switched off": ("switched off", ""),
        "few points": (
            f"fewer than {points} points a side; with {option} it is estimated nevertheless",
            option,
        ),
        "takes long": (
            f"that takes about twice as long; with {option} it is estimated",
            f"{option}, twice as long",
        ),
    }
    reason, remedy = reasons[why]
    return (
        f"no intervals, as the error of the grid is not known ({remedy or reason})",
        f"grid error not estimated, so values come without intervals ({reason})",
    )


@kind(INTERVALS)
def wide(
    answer: str,
    load: str,
    factor: float,
    causes: tuple[tuple[str, str, float], ...],
    cells: int,
    points: int,
) -> Wording:
    """Why an interval is wide: its causes, the largest first.

    Each has a title, a remedy, and the factor between both ends that it alone leaves open. Of all
    the points of the grid, some cells are in contact.
    """
    texts = [f"{title} (a factor of {decimal(of, 2)})" for title, _, of in causes]
    times, remedy = decimal(factor, 2), causes[0][1]
    return (
        f"{answer} is known to a factor of {times}: {remedy} helps most",
        f"the {answer} under {load}, with {cells} of {points} points in contact, is known to a "
        f"factor of {times} between both ends; it is left open by {', then by '.join(texts)}: "
        f"{remedy} would narrow it most",
    )


@kind(INTERVALS, "note")
def filling_matters(method: str, stiffness: float, area: float, least: float) -> Wording:
    """By how many per cent another way to fill missing points changes stiffness and area."""
    of_stiffness, of_area = (
        f"up to {each:.2g}%" if each >= least else f"less than {least}%"
        for each in (stiffness, area)
    )
    return (
        f"filled by {method} instead, stiffness changes by {of_stiffness}, area by {of_area}",
        f"with missing points filled by {method} instead, stiffness changes by {of_stiffness}, "
        f"area by {of_area}",
    )


@kind(INTERVALS, "note")
def no_filled_point_left() -> Wording:
    """The piece that is pressed holds none of the points that were filled."""
    return "no filled point is left in the piece that is pressed"


@kind(INTERVALS, "note")
def filled_before(is_of_file: bool) -> Wording:
    """Points were filled before they came here."""
    before = "before the file was written" if is_of_file else "before"
    return (
        f"the points were filled {before}: what that does is not known",
        f"the points were filled {before}: the effect of their filling is not known",
    )


@kind(INTERVALS, "note")
def border_moves_flow(
    load: str,
    is_in_interval: bool,
    directions: tuple[tuple[str, float, float, float], ...],
) -> Wording:
    """What the border of a map does to u_h [m], along each direction.

    They are as the map repeats, with the flow given at the border, and with the pressure.
    """
    rest = "moves what flows, and no interval holds that"
    if is_in_interval:
        rest = "leaves open more than all else does"
    words = []
    for along, *apertures in directions:
        of_map, with_flow, with_pressure = (engineering(each, "m", 3) for each in apertures)
        words.append(
            f"along {along} u_h is {of_map} as the map repeats, {with_pressure} with the pressure "
            f"held even along the border, and {with_flow} with the flow given there"
        )
    short = f"under {load} the border of the map {rest}"
    return short, f"{short}: {'; '.join(words)}"


@kind(LIMITS)
def theories_assume_isotropy(ratio: float) -> Wording:
    """Slopes depend on direction."""
    return (
        f"theories assume an isotropic surface; the least rms slope is {ratio:.2f} of the largest",
        "theories assume an isotropic surface, and the rms slope depends on direction: the least "
        f"is {ratio:.2f} of the largest",
    )


@kind(LIMITS)
def theories_without_adhesion() -> Wording:
    """Theories know no adhesion."""
    return "theories leave out that the bodies stick"


@kind(LIMITS, "note")
def no_pull_off_of_strip() -> Wording:
    """What repeats along one side is not drawn apart."""
    return "what it takes to draw a body apart that is repeated along one side is not known"


@kind(LIMITS, "note")
def no_pull_off_without_materials() -> Wording:
    """What draws bodies apart is an answer."""
    materials = called("materials")
    return (
        f"what it takes to draw the bodies apart needs two materials ({materials})",
        "what it takes to draw the bodies apart is one of the answers, which need two materials "
        f"({materials})",
    )


@kind(LIMITS, "note")
def no_area_of_line() -> Wording:
    """A line has no contact area."""
    return "no contact area: the reduced model of a line does not predict it"
