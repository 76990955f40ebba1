"""How loads were meant, and where they strain bodies too far."""

from __future__ import annotations

from typing import Literal

from roughline.errors.words import called
from roughline.facts.fact import DATA, INTERVALS, LIMITS, Wording, kind
from roughline.units import decimal, engineering

Stands = Literal["free", "on base", "punch"]
"""What a body is where all of it touches."""

Strains = Literal["depth", "layers", "pressure"]
"""What of a load strains bodies: its depth, its pressure in layers, or its pressure."""


@kind(DATA, "note")
def load_on_body(load: str, force: float, pressure: float, sides: tuple[float, ...]) -> Wording:
    """What a load is in all; of a line over the square of its length, its only side."""
    nominal = f"the nominal area, {_by(sides)}"
    if len(sides) == 1:
        nominal = f"the square of the line's length, {_by(sides)}"
    in_all, mean = engineering(force, "N"), engineering(pressure, "Pa")
    return (
        f"load {load}: {in_all} in all, {mean}",
        f"load {load}: {in_all} in all, {mean} over {nominal}",
    )


@kind(DATA, "note")
def load_on_joint(
    load: str,
    force: float,
    joint: float,
    pressure: float,
    on_map: float,
    sides: tuple[float, ...],
) -> Wording:
    """What a load is on a joint, and on the map."""
    mean, part = engineering(pressure, "Pa"), engineering(on_map, "N")
    return (
        f"load {load}: {mean} everywhere; {part} of it on the map",
        f"load {load}: {engineering(force, 'N')} on the joint of {engineering(joint, 'm²')}, "
        f"{mean} everywhere; {part} of it on the map, {_by(sides)}",
    )


@kind(DATA, "note")
def forces_on_map_alone() -> Wording:
    """Forces act on the map, not on the part behind it."""
    joint = called("rl.Joint")
    return (
        f"forces act on the map alone; on its joint if the area of that is given ({joint})",
        "forces act on the map alone, not on the part that it was cut out of; if the area of the "
        f"joint is given ({joint}), they act on the joint, and the answers are those of the joint",
    )


@kind(DATA, "note")
def absolute_pressures(fluid: str, inlet: float, outlet: float) -> Wording:
    """Between which pressures a fluid flows."""
    return (
        f"{fluid} enters at {engineering(inlet, 'Pa')} and leaves at {engineering(outlet, 'Pa')}, "
        "both absolute pressures"
    )


@kind(LIMITS, "grave")
def strained(what: Strains, load: str, ratio: float, is_beside_fluid: bool) -> Wording:
    """A load strains bodies too far."""
    short = {
        "depth": f"depth {load} is {decimal(ratio, 2)} of the shorter side",
        "layers": f"load {load} strains layers by {decimal(ratio, 2)}",
        "pressure": f"load {load} is {decimal(ratio, 2)} times E*",
    }[what]
    return (
        f"{short}, beyond what is linear elastic: check its unit",
        f"{how_far_strained(what, load, ratio, is_beside_fluid)}: bodies that are strained so far "
        "are not linear elastic, and no interval includes that",
    )


def how_far_strained(what: Strains, load: str, ratio: float, is_beside_fluid: bool) -> str:
    """How far a load strains bodies, at the beginning of a sentence about that."""
    times = decimal(ratio, 2)
    without = ", without what the fluid carries," if is_beside_fluid else ""
    if what == "depth":
        return f"depth {load} is {times} times the shorter side of the body"
    if what == "layers":
        return (
            f"the mean pressure of load {load}{without} strains the layers or their base by about "
            f"{times}"
        )
    return f"the mean pressure of load {load}{without} is {times} times the contact modulus"


@kind(LIMITS, "grave")
def all_touch(loads: tuple[str, ...], stands: Stands) -> Wording:
    """All points touch; k is that of what stands freely, on a rigid base, or of a flat punch."""
    rest = {
        "free": "stiffness is infinite",
        "on base": "k is that of even pressure on the rigid base",
        "punch": "k is that of a flat punch",
    }[stands]
    return (
        f"all points touch under {_first(loads)}: {rest}",
        f"all points touch under {', '.join(loads)}: no gap is left, and {rest}",
    )


@kind(LIMITS, "grave")
def nearly_all_touch(loads: tuple[str, ...], points: int) -> Wording:
    """All points but a few touch."""
    return (
        f"fewer than {points} points do not touch under {_first(loads)}: the grid decides k_i",
        f"fewer than {points} points do not touch under {', '.join(loads)}: the stiffness of the "
        "interface is that of these last gaps, which the grid decides, and without them it is "
        "infinite",
    )


@kind(INTERVALS)
def on_filled_points(load: str, share: float) -> Wording:
    """Force stands on points that nobody measured."""
    crop = called("crop")
    return (
        f"{share:.0%} of load {load} stands on points that were filled: measure them, or {crop}",
        f"{share:.0%} of the force of load {load} stands on points that were missing and filled, "
        f"which nobody measured: measure them, or crop to where points are known ({crop})",
    )


def _by(sides: tuple[float, ...]) -> str:
    return " x ".join(engineering(each, "m") for each in sides)


def _first(loads: tuple[str, ...]) -> str:
    return loads[0] if len(loads) == 1 else f"{len(loads)} loads"
