"""All kinds of physics that the lab can add to a contact, and what the page has of them."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Any

from roughline.lab.controls import Choice, Number
from roughline.lab.explore.adhesion import AdhesionPhysics
from roughline.lab.explore.controls import CHOICES, NUMBERS
from roughline.lab.explore.fluid import FluidPhysics
from roughline.lab.explore.layer import LayerPhysics
from roughline.lab.explore.panels import PANELS
from roughline.lab.explore.shear import ShearPhysics
from roughline.lab.explore.state import Physics
from roughline.lab.explore.words import STRIP
from roughline.lab.explore.yielding import YieldingPhysics
from roughline.lab.panels import Panel

PHYSICS: tuple[type[Physics], ...] = (
    LayerPhysics,
    YieldingPhysics,
    AdhesionPhysics,
    FluidPhysics,
    ShearPhysics,
)
"""All kinds, in the order of their ticks."""
_LEADING = 3  # numbers of the strip, in large figures


def numbers() -> dict[str, Number]:
    """All numbers that can be set, by their keys."""
    return NUMBERS | {control.key: control for kind in PHYSICS for control in kind.controls}


def second_map_choice() -> Choice:
    """The choice of the second map, with the maps that kinds add."""
    added = {name: shown for kind in PHYSICS for name, shown in kind.maps.items()}
    return replace(CHOICES["shown"], options={**CHOICES["shown"].options, **added})


def panels() -> dict[str, Panel]:
    """All panels of curves by their keys, with the series that kinds add."""
    own = [panel for kind in PHYSICS for panel in kind.panels]
    return {
        panel.key: panel.with_series(
            *(each for kind in PHYSICS for each in kind.series.get(panel.key, ()))
        )
        for panel in (*PANELS, *own)
    }


def owners() -> dict[str, str]:
    """Keys of the kinds that maps and panels are there with alone, by their names."""
    return {
        name: kind.key
        for kind in PHYSICS
        for name in (*kind.maps, *(panel.key for panel in kind.panels))
    }


def declared() -> dict[str, Any]:
    """What the script of the page knows of all kinds and panels."""
    order = list(STRIP)
    for figure in (each for kind in PHYSICS for each in kind.strip):
        order.insert(max(order.index(figure.after) + 1, _LEADING), figure.key)
    kinds = {
        kind.key: {
            "word": kind.word,
            "follows": kind.follows,
            "opens": kind.opens,
            "maps": list(kind.maps),
            "panels": [panel.key for panel in kind.panels],
        }
        for kind in PHYSICS
    }
    return {
        "strip": order,
        "physics": kinds,
        "panels": [asdict(panel) for panel in panels().values()],
    }
