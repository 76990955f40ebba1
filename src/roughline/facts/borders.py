"""What the borders of a piece do to its contact."""

from __future__ import annotations

from roughline.errors.words import called
from roughline.facts.fact import LIMITS, Wording, kind
from roughline.units import decimal, engineering, in_words


@kind(LIMITS)
def border_carries(
    least: float, most: float, share: float, unit: str | None, frame: float
) -> Wording:
    """The border of a piece carries a share of some forces, which are from least to most."""
    ends = [engineering(each, "N", 3) if unit == "m" else f"{each:.3g}" for each in (least, most)]
    at = f"a force of {ends[0]}" if least == most else f"forces of {ends[0]} to {ends[1]}"
    remedy = called("periodic", True)
    return (
        f"the border carries {share:.0%} of the force: take a larger piece, or {remedy}",
        f"at {at}, up to {share:.0%} of the force is carried within {frame:.0%} of the border, "
        "where this surface was cut out of a larger one: the surface beyond it would carry a part "
        "of the load, so depth, stiffness and area are those of the piece alone, a punch with this "
        "outline. Take a larger piece, or the periodic half-space",
    )


@kind(LIMITS, "note")
def map_jumps_at_borders(
    jump: float, step: float, share_of_slope: float, unit: str | None, outweighs: bool
) -> Wording:
    """Steps of a repeated map across its borders; they may outweigh all others."""
    times = decimal(jump / step, 2) if step else "infinitely many"
    height = in_words(jump, unit, 3)
    text = (
        f"repeated periodically, the map jumps by {height} (rms) across its borders, {times} times "
        f"an ordinary step between neighbouring points, {in_words(step, unit, 3)}"
    )
    if not outweighs:
        return f"repeated, the map jumps by {height} at its borders, {times} ordinary steps", text
    trend = called("trend", "curvature")
    return (
        f"repeated, the map jumps by {height} at its borders, {times} ordinary steps: {trend}",
        f"{text}; {share_of_slope:.0%} of its mean-square slope lies there, so contact near the "
        "borders is that of a step which the part does not have: remove what is left of the form "
        f"({trend}), or take a larger map",
    )


@kind(LIMITS)
def borders_unclear(ends: str, steps: float, is_cut_out: bool) -> Wording:
    """Heights do not say whether they are periodic."""
    taken = "cut out of a larger one" if is_cut_out else "periodic"
    number = decimal(steps, 2)
    return (
        f"taken as {taken}, which is unclear: say which (is_cut_out=...)",
        f"it is unclear whether these heights are periodic: {ends} are {number} ordinary steps "
        f"apart, and they are taken as {taken}: say which (is_cut_out=True or False)",
    )


@kind(LIMITS)
def surface_is_tilted(lower: float) -> Wording:
    """The mean plane is much of the height of a piece."""
    remedy = called("trend", "tilt")
    return (
        f"this surface is tilted, by {lower:.0%} of its rms height: remove that ({remedy})",
        f"this surface is tilted: without its mean plane the rms height would be {lower:.0%} "
        "lower, and the side that the tilt lifts carries the load. Unless that is meant, remove it "
        f"({remedy}, as rl.read does by default, or surface.detrended())",
    )
