"""What single answers mean, and what is left out of them."""

from __future__ import annotations

from typing import Literal

from roughline.errors.words import called
from roughline.facts.fact import LIMITS, Fact, Wording, kind
from roughline.units import decimal, engineering


@kind(LIMITS, "note")
def reduced_line_alone() -> Wording:
    """A place: that of a reduced line."""
    return "of the reduced line alone; waves longer than the scan are missing"


@kind(LIMITS, "note")
def piece_alone(is_layered: bool) -> Wording:
    """A place: a piece that is pressed alone."""
    text = "of this piece alone, a punch with its outline; "
    if is_layered:
        text += "press it periodically for that of a large surface"
    else:
        text += (
            "under the same mean pressure a large surface is a fifth less stiff at half contact "
            "and a third stiffer at 80 %: press it periodically for that"
        )
    return "of this piece alone, a punch with its outline: press it periodically", text


@kind(LIMITS, "note")
def larger_surface_behind(roll_offs: float) -> Wording:
    """A place: the larger surface behind a map, of which it holds so many wavelengths."""
    return (
        f"of the larger surface; the map holds {roll_offs:.2g} roll-off wavelengths along a side",
        "of the larger surface that the map was cut out of; the map holds "
        f"{roll_offs:.2g} roll-off wavelengths along a side",
    )


@kind(LIMITS, "note")
def some_larger_surface(times: float, of: Literal["stiffness", "gap"]) -> Wording:
    """A place: a surface so many times as long as its map, which shows no roll-off."""
    further = "lower the stiffness" if of == "stiffness" else "open the gap"
    joint = called("rl.Joint")
    return (
        f"of a surface {decimal(times, 2)} times as long: give the joint's area ({joint})",
        f"of a surface {_times(times)}: on a larger one longer waves {further} further; give the "
        f"joint's area ({joint}), or measure a larger map",
    )


@kind(LIMITS, "note")
def joint_in_reach(times: float, assembly: str) -> Wording:
    """A place: a joint or a seal so many times as long as its map, which tells of it."""
    return (
        f"of a {assembly} {decimal(times, 2)} times as long as the map",
        f"of a {assembly} {_times(times)}: the interval allows for waves as long as that",
    )


@kind(LIMITS, "warning")
def joint_out_of_reach(times: float, assembly: str, least: float) -> Wording:
    """A place: a joint or a seal so many times as long as its map that this does not tell of it."""
    return (
        f"of a {assembly} {decimal(times, 2)} times as long: map at least 1/{least:g} of it",
        f"of a {assembly} {_times(times)}: what its longer waves do is not known; measure a map at "
        f"least 1/{least:g} as long",
    )


@kind(LIMITS, "note")
def which_interface(fact: Fact) -> Wording:
    """Which place the stiffness of the interface is of."""
    return f"interface stiffness is {fact.in_short}", f"the interface stiffness k_i is {fact}"


def _times(times: float) -> str:
    return f"{decimal(times, 2)} times as long as the map, which shows no roll-off"


@kind(LIMITS)
def joint_alone(
    stiffness: float, resistance: float | None, is_about: bool, share: float
) -> Wording:
    """What bodies wider than a joint add to it: their constriction, which may matter as well.

    Stiffness [N/m] and resistance [ohm] are those of a disc of the joint's area; the interface is
    at most `share` times as stiff.
    """
    added = f"about {engineering(stiffness, 'N/m')}" if is_about else engineering(stiffness, "N/m")
    if resistance is not None:
        added += f" and {engineering(resistance, 'ohm')}"
    text = (
        "answers are those of the joint's interface alone, and the joint is taken to be alike "
        "everywhere and evenly loaded: bodies wider than the joint add its own constriction in "
        f"series, {added} for a disc of the same area"
    )
    if not share:
        return (
            f"answers are of the joint's interface alone; wider bodies add {added} in series",
            text,
        )
    times = decimal(share, 2)
    return (
        f"bodies add {added} in series; the joint is {times} times as stiff",
        f"{text}; the interface is up to {times} times as stiff as that, so such bodies matter as "
        "well, and load the joint's edge more than its middle",
    )


@kind(LIMITS)
def layers_in_series(k_i: str, compressed: float, pressure: float, stiffness: float) -> Wording:
    """Layers give way as a whole as well: so far [m] under a pressure [Pa], as a spring [N/m]."""
    by, added = engineering(compressed, "m"), engineering(stiffness, "N/m")
    return (
        f"layers give way as a whole as well, as a spring k_l = {added} in series with {k_i}",
        f"stiffness {k_i} and approach are those of the interface alone: layers are compressed as "
        f"a whole too, by {by} under {engineering(pressure, 'Pa')}, a spring k_l = {added} in "
        f"series with {k_i}. That is of layers much wider than they are thick; narrow ones widen "
        "and give way more",
    )


@kind(LIMITS)
def layers_keep_their_volume() -> Wording:
    """Incompressible layers give way at their rim."""
    return (
        "layers keep their volume and give way at their rim alone, which no answer holds",
        "even pressure does not compress layers that keep their volume, nu = 0.5: as a whole they "
        "give way at their rim alone, where they can widen, and no answer holds that",
    )


@kind(LIMITS, "note")
def as_in_vacuum() -> Wording:
    """No gas in the gap."""
    return (
        "thermal conductances are as in vacuum: air may carry several times what the spots do",
        "thermal conductances are those of the solid spots alone, as in vacuum: gas in the gap "
        "adds to them, and air may carry several times what the spots do",
    )


@kind(LIMITS, "note")
def on_the_way_in(shortest_range: float | None, heights: float | None) -> Wording:
    """Which branch answers of bodies that stick are of.

    Where no range was given, the shortest that the map resolves is taken [m], over the rms height.
    """
    text = (
        "the bodies stick: other answers are those on the way in, and stiffness and conductance "
        "those of the points that touch"
    )
    short = "the bodies stick: other answers are those on the way in"
    if shortest_range is None:
        return short, text
    reach = engineering(shortest_range, "m")
    text += f"; no range was given, and the shortest that the map resolves is taken, {reach}"
    if heights is not None:
        text += f" or {decimal(heights, 2)} rms heights"
    text += (
        ": what draws the bodies apart is of this range, without an interval, and a finer grid "
        "would take a shorter one; half of it needs a grid four times as fine"
    )
    return f"{short}, and of the range {reach}", text


@kind(LIMITS)
def set_by_the_range(share: float) -> Wording:
    """The pull-off is the largest pull on all of the area."""
    return (
        f"the pull-off is {share:.0%} of w over the range, whatever the roughness: give the range",
        f"the pull-off is {share:.0%} of w over the range, on all of the area: it is set by the "
        "range alone, whatever the roughness; give the range of the bodies at hand",
    )
