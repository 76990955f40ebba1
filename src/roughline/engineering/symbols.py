"""Symbols that formulas use and that are no answers, each told with the formula that uses it.

Here are those of several groups of answers; the others stand beside the rules of theirs.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from roughline.engineering.pressed import Pressed
from roughline.errors.public import public


@public
@dataclass(frozen=True)
class Symbol:
    """A symbol of a formula that is no answer.

    Parameters
    ----------
    symbol : str
        As formulas write it.
    meaning : str
        What it stands for.
    unit : str, optional
        SI.
    value : float, optional
        None where it is not one number. [unit]
    """

    symbol: str
    meaning: str
    unit: str = "1"
    value: float | None = None

    def is_in(self, formula: str) -> bool:
        """Whether a formula uses it; of a quotient, both parts."""
        parts = self.symbol.split("/")
        return all(
            re.search(rf"(?<!\w){re.escape(part)}(?![A-Za-z0-9_*])", formula) for part in parts
        )


def contact_modulus(pressed: Pressed) -> Symbol:
    """E*."""
    return Symbol("E*", "contact modulus", "Pa", pressed.curve.E_star)


def tangential_modulus(pressed: Pressed) -> Symbol:
    """G*."""
    return Symbol("G*", "tangential contact modulus", "Pa", pressed.pair.G_star)


def nominal_area(pressed: Pressed) -> Symbol:
    """A_0, of the joint if there is one."""
    return Symbol("A_0", "nominal area", "m²", pressed.nominal_area)


def hardness(pressed: Pressed) -> Symbol:
    """H, whether points may yield or not."""
    return Symbol("H", "hardness of the softer body", "Pa", pressed.hardness)


def both_bodies(
    letter: str, meaning: str, unit: str, values: tuple[float, float] | None
) -> list[Symbol]:
    """A property of both bodies, numbered."""
    first, second = values or (None, None)
    return [
        Symbol(f"{letter}1", f"{meaning} of the first body", unit, first),
        Symbol(f"{letter}2", f"{meaning} of the second body", unit, second),
    ]
