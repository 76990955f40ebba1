"""What is not known of coated bodies."""

from __future__ import annotations

from roughline.errors.words import called
from roughline.facts.fact import INTERVALS, LIMITS, Wording, kind
from roughline.facts.listed import listed_in_short
from roughline.units import decimal, engineering


@kind(INTERVALS, "note")
def layer_modulus_differs(material: str, modulus: float, of_layers: str) -> Wording:
    """Layers of a material have another modulus than the table has."""
    return (
        f"layers of {material} have E of {of_layers}; {engineering(modulus, 'Pa')} is taken",
        f"E of {material} is {engineering(modulus, 'Pa')} here, and layers of it have {of_layers}, "
        'which no interval includes: give it with the material, as "E=..."',
    )


@kind(INTERVALS, "note")
def layer_hardness_differs(material: str, hardness: float, of_layers: str) -> Wording:
    """Layers of a material have another hardness than the table has."""
    here = engineering(hardness, "Pa")
    return (
        f"layers of {material} have a hardness of {of_layers}; {here} is taken",
        f"the hardness of {material} is {here} here, of annealed metal, and layers of it have "
        f'{of_layers}, which no interval includes: give it with the material, as "hardness=..."',
    )


@kind(LIMITS, "note")
def hardness_in_bulk(body: str, top: str) -> Wording:
    """The hardness of a coated body is that of its top layer."""
    return (
        f"the hardness of {body} is that of its top layer in bulk",
        f"the hardness of {body} is that of its top layer, {top}, in bulk: one that was measured "
        "through a thin layer is of what lies below as well, which may yield first",
    )


@kind(INTERVALS, "note")
def spots_wider_than_film(
    radius: float, thickness: float, top: str, below: str, is_harder: bool | None, is_included: bool
) -> Wording:
    """Spots feel what lies below a film; None of `is_harder`: its hardness is not known."""
    spots = engineering(radius, "m", 2)
    text = (
        f"contact spots have a mean radius of {spots}, and the layer of {top} is "
        f"{engineering(thickness, 'm')} thick: they feel {below} below it as well"
    )
    if is_harder is None:
        text += ", whose hardness is not known, and no interval includes that"
    else:
        than, size = ("harder", "large") if is_harder else ("softer", "small")
        reach = "no interval includes that, as the hardness of the layer is given"
        if is_included:
            reach = "intervals reach to there"
        text += f", which is {than}, so area and conductance are too {size}; {reach}"
    return f"contact spots of radius {spots} feel {below} below {top}", text


@kind(LIMITS, "grave")
def through_the_layer(material: str, thickness: float, indentation: float) -> Wording:
    """A layer is indented deeper than it is thick."""
    thick, deep = engineering(thickness, "m"), engineering(indentation, "m")
    return (
        f"the layer of {material}, {thick}, is indented by {deep}: what is below would yield",
        f"the layer of {material}, {thick}, is indented by up to {deep}: what lies below would "
        "yield with a hardness of its own, and no interval includes that",
    )


@kind(INTERVALS, "note")
def larger_surface_of_layers(answers: tuple[str, ...]) -> Wording:
    """A map of a coated body does not tell of the surface around it."""
    return (
        "how far a larger surface may be from its map is not known of coated bodies",
        "how far a larger surface may be from its map is not known of coated bodies, so no "
        f"interval of {listed_in_short(answers)} includes it",
    )


@kind(LIMITS, "note")
def currents_of_map_repeated() -> Wording:
    """Currents through layers are solved in the map repeated."""
    joint = called("rl.Joint")
    return (
        f"currents through layers are of the map repeated: give the joint's area ({joint})",
        "currents through layers are solved in the map repeated, so that neither resistance nor "
        f"conductance of the map alone is known: give the joint's area ({joint})",
    )


@kind(LIMITS, "note")
def currents_of_the_piece() -> Wording:
    """Currents through layers are solved from all of a piece."""
    remedy = called("periodic", True)
    return (
        f"no conductance per area of the interface alone through layers: {remedy} gives it",
        "currents through layers are solved from all of this piece, so that no conductance per "
        f"area of its interface alone is known: {remedy} gives it",
    )


@kind(LIMITS, "note")
def resistance_of_layers(added: tuple[tuple[float, str, str], ...]) -> Wording:
    """What layers add to an even current: a number, its unit, and of what, of each current."""
    sums = " and ".join(f"{value:.3g} {unit} of {what}" for value, unit, what in added)
    return (
        f"layers add {sums} to resistances",
        "resistance and conductance are those of the spots alone: the layers' own resistance to an "
        f"even current adds {sums}",
    )


@kind(LIMITS, "grave")
def layers_are_strained(ratio: float) -> Wording:
    """The mean contact pressure is large beside the modulus of layers."""
    times = decimal(ratio, 2)
    return (
        f"mean contact pressure is {times} times the softest modulus: not linear elastic any more",
        f"the mean contact pressure reaches {times} times the contact modulus of the softest "
        "materials: unless a layer of these is too thin to move aside, or lies deep, it is "
        "strained beyond what is linear elastic, and no interval includes that",
    )
