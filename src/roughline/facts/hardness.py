"""What yields, with which hardness, and how far that is known."""

from __future__ import annotations

from roughline.errors.words import called
from roughline.facts.fact import INTERVALS, LIMITS, Wording, kind
from roughline.units import LEAST_CHANGE, change_in_words, decimal, engineering

_BUT_FOR = "except for p_c/H and the estimates that are made with the hardness"


@kind(LIMITS, "note")
def some_yields(share: float, hardness: float, whose: str) -> Wording:
    """A share of the contact yields; `whose` says where the hardness is from."""
    return (
        f"{100 * share:.3g}% of the contact yields at the largest load, at {_hardness(hardness)}",
        f"{100 * share:.3g}% of the contact yields at the largest load: it bears the hardness, "
        f"{_hardness(hardness)}, {whose}",
    )


@kind(LIMITS, "note")
def nothing_yields(hardness: float, whose: str) -> Wording:
    """No point reaches the hardness."""
    known = f"{_hardness(hardness)}, {whose}"
    return (
        f"nothing yields at the largest load, as no point reaches {_hardness(hardness)}",
        f"nothing yields at the largest load: no point reaches the hardness, {known}",
    )


@kind(INTERVALS, "note")
def scatter_unknown(factor: float) -> Wording:
    """Interrupted before the effect of the scatter of the hardness was known."""
    return (
        f"the hardness is known to a factor of {factor:g}; interrupted before its effect was known",
        f"{_known_to(factor)}; interrupted before the effect of that on the answers was known, so "
        "values come without intervals",
    )


@kind(INTERVALS, "note")
def softest_does_not_bear(factor: float) -> Wording:
    """The softest body that is possible does not bear the largest load."""
    return (
        f"the hardness is known to a factor of {factor:g}, and the softest does not bear the load",
        f"{_known_to(factor)}; the softest such body does not bear the largest load, so how far "
        "the answers change there is not known, and they come without intervals",
    )


@kind(INTERVALS, "note")
def scatter_changes_nothing(factor: float, is_yielding: bool) -> Wording:
    """The scatter of the hardness does not move the answers."""
    if is_yielding:
        why = (
            "with the softest and the hardest such body, the answers at the largest load change by "
            f"less than {LEAST_CHANGE:g}%, {_BUT_FOR}"
        )
    else:
        why = (
            "as nothing yields at the largest load, this changes no answer there except "
            f"{_BUT_FOR.removeprefix('except for ')}"
        )
    return (
        f"the hardness is known to a factor of {factor:g}, which changes no answer",
        f"{_known_to(factor)}; {why}",
    )


@kind(INTERVALS, "note")
def scatter_changes(
    factor: float, changes: tuple[tuple[str, float, float], ...], are_included: bool
) -> Wording:
    """By which ratios answers change, the least and the largest, with their names."""
    listed = ", ".join(f"{name} {change_in_words(low, high)}" for name, low, high in changes)
    held = "the intervals include that"
    if not are_included:
        held = "that is in no interval, as values come without"
    name, low, high = max(changes, key=lambda each: max(each[2], 1 / each[1] if each[1] else 0.0))
    return (
        f"the hardness is known to a factor of {factor:g}: {name} {change_in_words(low, high)}",
        f"{_known_to(factor)}; with the softest and the hardest such body, the answers at the "
        f"largest load change by: {listed}; {held}",
    )


@kind(LIMITS, "note")
def hardness_of_softer_taken(material: str) -> Wording:
    """The hardness of one body is not known."""
    text = f"the hardness of {material} is not known"
    return text, f"{text}; that of the other is taken as the softer's"


@kind(LIMITS, "note")
def no_hardness(materials: tuple[str, ...], is_softer: bool) -> Wording:
    """The hardness that matters is not known."""
    softer = ", and it is the softer one, as its modulus is below the other's hardness"
    return (
        "the hardness is not known, so both bodies are taken as elastic: give it (hardness=...)",
        f"the hardness of {' and of '.join(materials)} is not known{softer if is_softer else ''}, "
        "so both bodies are taken as elastic, whatever the pressure; give it with the material, as "
        '"hardness=..."',
    )


@kind(LIMITS, "grave")
def beyond_elastic(ratio: float, limit: float) -> Wording:
    """The mean contact pressure of elastic bodies is more than metals bear."""
    times, without = decimal(ratio, 2), called("elastic", True)
    return (
        f"mean contact pressure is {times} times the hardness: summits yield; leave out {without}",
        f"the mean contact pressure reaches {times} times the softer body's hardness; beyond "
        f"{limit:g} of it summits yield, so these elastic answers do not hold: leave out "
        f"{without}, or an infinite {called('hardness')}",
    )


@kind(LIMITS, "grave")
def summits_yield(index: float) -> Wording:
    """The plasticity index is above one."""
    number = decimal(index, 2)
    return (
        f"the plasticity index is {number}, over 1: summits yield at first touch",
        f"the plasticity index is {number}, over 1: summits yield at first touch; under repeated "
        "loads they deform elastically about their flattened shape",
    )


@kind(LIMITS, "note")
def line_without_yield(limit: float, most: float, slope: float | None) -> Wording:
    """Up to which rms slope a line stands for metals; `slope` is that of a scan."""
    return (
        f"a line has no yield, and rms slopes over {decimal(most, 2)} would make metals yield",
        _line_limits(limit, most, slope),
    )


@kind(LIMITS, "grave")
def line_is_too_steep(limit: float, most: float, slope: float) -> Wording:
    """A scan is so steep that metals yield."""
    return (
        f"rms slope {decimal(slope, 2)}, over {decimal(most, 2)}: it yields, and a line has no "
        "yield: press a map",
        f"{_line_limits(limit, most, slope)}, so these elastic answers do not hold, and come "
        "without intervals: press a map, whose model has yield",
    )


def _line_limits(limit: float, most: float, slope: float | None) -> str:
    text = (
        "the reduced model has no yield: it can be used while mean contact pressures stay below "
        f"about {limit:g} of the hardness; rms slopes over {2 * limit:g} H / E* = "
        f"{decimal(most, 2)} exceed that"
    )
    return text if slope is None else f"{text}; the rms slope of the scan is {decimal(slope, 2)}"


def _known_to(factor: float) -> str:
    return f"the hardness of the table is known to a factor of {factor:g}"


def _hardness(value: float) -> str:
    return engineering(value, "Pa")
