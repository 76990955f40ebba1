"""The controls of the view "Explore"."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from roughline.errors.checks import shown
from roughline.lab import declared
from roughline.lab.controls import Control, ControlError, Number, QuantityText, is_number
from roughline.lab.declared import NumberScale
from roughline.units import load_in_newtons

_HURST = re.compile(r"\s*H\s*=(?P<hurst>.*)")


@dataclass(frozen=True, kw_only=True)
class _Dimension(Number):
    """The fractal dimension, or 3 less the Hurst exponent, which may be typed instead."""

    def read(self, text: str, state: Any = None) -> float:
        typed = _HURST.fullmatch(text)
        if not typed:
            return super().read(text, state)
        hurst = typed["hurst"]
        value = float(hurst) if is_number(hurst) else -1.0
        if not 0 <= value <= 1:
            sentence = f"H is {shown(hurst.strip())}; give a number from 0 to 1"
            raise ControlError(sentence, self.key, "H")
        return round(3 - value, 12)


@dataclass(frozen=True, kw_only=True)
class LoadNumber(Number):
    """A force, or a pressure on the whole surface."""

    def in_unit(self, text: str, state: Any) -> float:
        """The force in a text, in newtons."""
        return load_in_newtons(text, state.length**2, self.name)


_SCALES = {
    "sides": NumberScale("m", lambda state: state.length),
    "h": NumberScale("m", lambda state: state.rms_height),
    "E* h L": NumberScale("N", lambda state: state.force(1.0), LoadNumber),
    "F": NumberScale("N", lambda state: state.force(state.F), LoadNumber),
    "E*": NumberScale("Pa", lambda state: state.E_star),
    "E* ∇h": NumberScale("Pa", lambda state: state.E_star * state.rms_slope),
    "E* h² / L": NumberScale(
        "J/m**2", lambda state: state.E_star * state.rms_height**2 / state.length
    ),
    "3 - H": NumberScale("", float, _Dimension),
}
"""What numbers are over, by its name in their declarations."""
_QUANTITIES = (
    QuantityText(
        key="L",
        name="side of the surface",
        label="side L",
        default="1 mm",
        meaning="Side of the surface, with a unit. The dimensionless numbers do not depend on it.",
        unit="m",
        ends=(1e-12, 1e3),
    ),
    QuantityText(
        key="E",
        name="contact modulus",
        label="modulus E*",
        default="110 GPa",
        meaning="Contact modulus, with a unit. The dimensionless numbers do not depend on it.",
        unit="Pa",
        ends=(1.0, 1e14),
    ),
)
DECLARED = declared.numbers(__package__, _SCALES)
"""All numbers by their keys, those of what may be added to a contact among them."""
NUMBERS = {key: DECLARED[key] for key in ("D_f", "roll_off", "cutoff", "h", "slope", "seed", "F")}
"""Those of every contact."""
CHOICES = declared.choices(__package__, n=int)
"""Choices by their keys."""
LOAD = "F"
"""Key of the load, which is read when the surface is known."""
CONTROLS: dict[str, Control] = {
    each.key: each for each in (*_QUANTITIES, *CHOICES.values(), *NUMBERS.values())
}
"""All controls by their keys, in the order in which they are read: the side and the modulus, which
are scales of others, come first, and the load last."""

FILES = {
    "maps.nc": "all maps, NetCDF",
    "curve.nc": "loads in SI units, NetCDF",
    "surface.nc": "surface, NetCDF",
    "surface.x3p": "surface, X3P",
    "surface.gsf": "surface, GSF of Gwyddion",
}
"""Files that are written, by their names, whose endings say of what type they are."""
DRAWN = {"contact.png": "maps, PNG", "curve.png": "curves, PNG", "curve.csv": "curves, CSV"}
"""Files that the page saves itself, as it is drawn."""
