"""From a map to the joint of which it shows a part: alike everywhere, and evenly loaded."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from roughline.engineering.answer import Answer, answer


def of_joint(given: Iterable[Answer], area: float, joint: float) -> list[Answer]:
    """Return the answers of a joint, from those of a map of it under the same mean pressure.

    Quantities per area, and shares, stay as they are; forces, areas and conductances grow with the
    nominal area, and resistances fall with it. The stiffness is that of the interface on unloading;
    for metals that yield, that on further loading is given as well. The contact stiffness of a free
    map includes the bodies' constriction to the outline of the map, which a joint does not have.

    Parameters
    ----------
    given : iterable of Answer
        Of the map in the periodic half-space; its stiffness is that of the interface.
    area, joint : float
        Nominal areas of both. [m²]
    """
    answers, ratio = {each.key: each for each in given}, joint / area
    yields = "unloading_stiffness" in answers
    interface = _interface(answers["interface_stiffness"], ratio, yields=yields)
    found = []
    for key, each in answers.items():
        if key == "contact_stiffness":
            found += [interface, *([_on_loading(each, ratio)] if yields else [])]
        elif key == "stiffness_per_area":
            found.append(_per_area(interface, joint))
        elif key not in ("interface_stiffness", "unloading_stiffness"):
            found.append(_grown(each, ratio))
        if key == "constriction_resistance":
            found.append(_specific(found[-1], joint))
    return found


def constriction_of_disc(joint: float, E_star: float) -> float:
    """Stiffness of a flat round punch as large as a joint, 2 E* a with pi a² its area. [N / m]

    Bodies that are much wider than the joint have this stiffness even without any roughness.
    """
    return 2 * E_star * math.sqrt(joint / math.pi)


def _interface(each: Answer, ratio: float, *, yields: bool) -> Answer:
    """Stiffness of the interface; where metals yield, it is that on unloading, and says so."""
    return replace(
        _grown(each, ratio),
        name=f"{each.name} on unloading" if yields else each.name,
        formula=_of_map("dF/dd on unloading"),
    )


def _on_loading(each: Answer, ratio: float) -> Answer:
    """Stiffness of the interface on further loading, which the contact stiffness of a map is not.

    It has a symbol of its own, as k is that of a free body.
    """
    return replace(
        _grown(each, ratio),
        name="interface stiffness on further loading",
        symbol="k_load",
        formula=_of_map("dF/dd on further loading"),
        validity=f"of the interface alone; {each.validity}",
    )


def _of_map(slope: str) -> str:
    return (
        f"{slope} of the map in a periodic half-space at the same mean pressure, times A_0 over "
        "the area of the map"
    )


def _per_area(interface: Answer, joint: float) -> Answer:
    """Stiffness of the interface over the area of the joint."""
    return answer(
        "stiffness_per_area", interface.rows / joint, symbol="k_i/A_0", formula="k_i / A_0"
    )


def _specific(resistance: Answer, joint: float) -> Answer:
    """Resistance times the area of the joint."""
    return answer("specific_contact_resistance", resistance.rows * joint)


def _grown(each: Answer, ratio: float) -> Answer:
    """An answer on an area that is so many times larger."""
    factor = ratio**each.growth
    differing: dict[str, Any] = {}
    if each.key == "mean_pressure":
        differing["formula"] = f"{each.formula} of the joint"
    elif each.key == "depth":
        differing["validity"] = (
            "of the map, from the touch of its highest point; the joint has higher points"
        )
    low, high = (None if end is None else end * factor for end in (each.low, each.high))
    return replace(each, values=each.values * factor, low=low, high=high, **differing)
