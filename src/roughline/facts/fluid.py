"""What a fluid in the gap does, and what of it is left out."""

from __future__ import annotations

from typing import Literal

from roughline.facts.fact import INTERVALS, LIMITS, Fact, Wording, kind
from roughline.units import decimal, engineering

Beside = Literal["soft faces", "yield", "adhesion"]
"""What comes beside a fluid that carries."""

Ring = tuple[float, float] | None
"""Mean pressures in a ring whose sides are unlike, if the fluid enters inside or outside. [Pa]"""


@kind(LIMITS)
def fluid_carries(
    fluid: str,
    excess: float,
    shares: tuple[float, float],
    loads: tuple[float, float],
    ring: Ring,
    beside: tuple[Beside, ...],
) -> Wording:
    """A fluid carries shares of loads [Pa], from the least to the largest.

    Beside that it may open soft faces, and bodies may yield or stick.
    """
    least, most = (f"{share:.0%}" for share in shares)
    part = most if least == most else f"{least} to {most}"
    text = (
        f"{_above_outside(fluid, excess)} carries {part} of {_loads(loads)}: the bodies press with "
        "the rest"
    )
    if "soft faces" in beside:
        text += (
            "; where it enters, its pressure is above that of the load, and faces that are not "
            "stiff open from there"
        )
    text += _in_a_wide_ring(ring)
    if "yield" in beside:
        text += (
            "; dents are those of the rest, as if the fluid came first: bodies that are loaded "
            "before it comes keep deeper ones, and less leaks"
        )
    if "adhesion" in beside:
        text += "; what draws them apart is of the bodies alone, without the fluid"
    return f"{fluid} carries {part} of the load: the bodies press with the rest", text


@kind(LIMITS)
def fluid_left_out(fluid: str, excess: float, share: float) -> Wording:
    """A fluid would carry a share of the load, but is not to."""
    return (
        f"{fluid} carries up to {share:.0%} of the load, which is left out: more leaks than this",
        f"{_above_outside(fluid, excess)} carries up to {share:.0%} of the load, which no answer "
        "includes: the bodies press with less, and more leaks",
    )


@kind(LIMITS, "grave")
def fluid_lifts(
    fluid: str, excess: float, loads: tuple[float, float], ring: Ring, is_sticking: bool
) -> Wording:
    """A fluid lifts bodies apart under loads [Pa], from the least to the largest."""
    text = (
        f"{_above_outside(fluid, excess)} lifts the bodies apart under {_loads(loads)}: the seal "
        f"is open, and nothing else is known there{_in_a_wide_ring(ring)}"
    )
    if is_sticking:
        text += "; bodies that stick may hold, which is not solved"
    return f"{fluid} lifts the bodies apart under {_loads(loads)}: the seal is open", text


@kind(LIMITS, "note")
def load_that_seals(carried: float) -> Wording:
    """The fluid carries a part of the load that seals. [Pa]"""
    part = engineering(carried, "Pa")
    return (
        f"of the load that seals the fluid carries {part}",
        "the pressure that seals and the load that is left are of what the bodies press with: of "
        f"the load that seals the fluid carries {part} beside that",
    )


@kind(LIMITS, "note")
def stays_tight() -> Wording:
    """Dents stay."""
    return (
        "once the largest load was on, less than ten times as much leaks without it",
        "once the largest load was on, less than ten times as much leaks however far it is taken "
        "off: its dents stay",
    )


@kind(LIMITS)
def one_channel(share: float, pressure: float) -> Wording:
    """A single channel carries much of the flow, under a mean pressure. [Pa]"""
    part = f"{100 * share:.0f}%"
    return (
        f"a single channel carries {part} of the flow, and other maps may differ: press several",
        f"a single channel of the map carries {part} of the flow at a mean pressure of "
        f"{engineering(pressure, 'Pa')}: the leak hangs on one place, and that of another map of "
        "the same part may differ by a large factor; press several",
    )


@kind(LIMITS, "note")
def no_path(
    count: int, of: int, loads: tuple[float, float], are_highest: bool, may_be_open: bool
) -> Wording:
    """No path is open under some of the loads [Pa], from the least to the largest of these.

    They may be all from the least of them on; a finer or a coarser grid may leave paths open.
    """
    least, most = (engineering(each, "Pa") for each in loads)
    under = f"from {least} on"
    if not are_highest:
        under = f"under {count} of {of} loads, which are from {least} to {most}"
    text = (
        f"no path leads through the map {under}: the leak is exactly zero on this map and its grid"
    )
    if may_be_open:
        text += ", but other places, coarser grids or waves that no grid here has leak"
    return "no path leads through the map under some loads", text


@kind(INTERVALS)
def leak_without_interval(fact: Fact) -> Wording:
    """What leaks is of a place that the map does not tell of."""
    return (
        f"no interval of what leaks: {fact.in_short}",
        f"what leaks has no interval: it is {fact}",
    )


@kind(LIMITS)
def gap_is_steep(slope: float) -> Wording:
    """Reynolds' equation is not good there."""
    return (
        f"the gap has a slope of {slope:.2g} where it throttles: less flows than Reynolds says",
        f"the gap has a slope of {slope:.2g} where the flow is throttled: Reynolds' equation holds "
        "for small slopes, and less than it says flows",
    )


@kind(LIMITS)
def inertia_counts(number: float, limit: float) -> Wording:
    """The Reynolds number times the slope of the gap is large."""
    value = decimal(number, 2)
    return (
        f"Reynolds number times slope is {value}, and inertia is left out: less than this flows",
        f"the Reynolds number times the slope of the gap is {value}: inertia, which counts beyond "
        f"{limit:g}, is left out, and less than this flows",
    )


@kind(LIMITS)
def gas_is_rare(fluid: str, ratio: float, limit: float) -> Wording:
    """The mean free path over the hydraulic aperture is large."""
    value = decimal(ratio, 2)
    return (
        f"the free path of {fluid} is {value} of the gap: smooth walls would let more through",
        f"the mean free path of {fluid} is {value} of the hydraulic aperture: beyond {limit:g}, "
        "leaks are those of kinetic theory (the BGK model) and of walls that reflect molecules "
        "diffusely: others let more through",
    )


@kind(LIMITS)
def few_molecules(aperture: float, limit: float) -> Wording:
    """The gap is some molecules wide. [m]"""
    width = engineering(aperture, "m")
    return (
        f"the hydraulic aperture is {width}, some molecules: a liquid may leak less, or not at all",
        f"the hydraulic aperture is {width}, and below {engineering(limit, 'm')}, ten molecules or "
        "so, a liquid does not flow as in bulk: it may leak much less, or not at all",
    )


def _above_outside(fluid: str, excess: float) -> str:
    above = engineering(excess, "Pa")
    return f"{fluid} at {above} above the outside, in the mean of the gap,"


def _loads(loads: tuple[float, float]) -> str:
    least, most = (engineering(end, "Pa") for end in loads)
    return f"the load at {most}" if least == most else f"loads from {least} to {most}"


def _in_a_wide_ring(ring: Ring) -> str:
    if ring is None:
        return ""
    inside, outside = (engineering(each, "Pa", 3) for each in ring)
    return (
        f"; that is of a narrow ring: in this one the mean is {inside} if the fluid enters inside, "
        f"and {outside} if outside, and it opens as much later or earlier"
    )
