"""The controls of the view "Explore"."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import roughline as rl
from roughline.errors.checks import shown
from roughline.lab.controls import Choice, Control, ControlError, has_unit, rounded
from roughline.units import engineering, in_si


@dataclass(frozen=True)
class Quantity(Control):
    """A number that may be given with its unit, and is then divided by a scale."""

    unit: str = "1"
    scale_of: Callable[[Any], float] = float  # gives the scale of a state, in the unit
    over: str = ""  # what the scale is called

    def read_over(self, text: str, state: Any) -> float:
        """Return the number in a text, over the scale of a state.

        Raises
        ------
        ControlError
            If it is none, has another unit, or is out of range.
        """
        if not has_unit(text):
            return self.read(text)
        try:
            value = in_si(text, self.unit, self.name)
        except rl.UnitError as error:
            raise ControlError(str(error), self.key) from None
        scale = self.scale_of(state)
        try:
            return self.checked(rounded(value / scale))
        except ControlError:
            unit = self.unit.replace("**2", "²")
            low, high = (engineering(end * scale, unit, 3) for end in (self.low, self.high))
            raise ControlError(
                f"{self.name} is {shown(text.strip())}; give one from {low} to {high}, which is "
                f"{self.range} {self.over}",
                self.key,
            ) from None


def _length(
    key: str, symbol: str, name: str, low: float, high: float, default: float, meaning: str
) -> Quantity:
    """A length over the side of the surface."""
    return Quantity(
        *(key, symbol, name, low, high, default, meaning),
        unit="m",
        scale_of=lambda state: float(state.length),
        over="sides",
    )


_NUMBERS = (
    Control(
        "D_f",
        "D_f",
        "fractal dimension",
        2.0,
        3.0,
        2.2,
        "How rough the surface is on small scales: 2 is smooth, 3 fills space; D_f = 3 - H, with "
        "the Hurst exponent H. It has no unit. H may be typed instead, as H = 0.8.",
        scale="linear",
    ),
    _length(
        "roll_off",
        "λ_r/L",
        "roll-off wavelength",
        1 / 32,
        1.0,
        1.0,
        "The spectrum is flat for waves longer than this. Relative to the side of the surface, "
        "or with a unit, such as 0.2 mm; at 1 there is no plateau.",
    ),
    _length(
        "cutoff",
        "λ_s/L",
        "cutoff wavelength",
        1 / 512,
        0.5,
        1 / 512,
        "Length of the shortest wave. Relative to the side of the surface, or with a unit; n "
        "points along a side carry no waves shorter than 2/n, which is the default of each grid.",
    ),
    _length(
        "h",
        "h/L",
        "rms height",
        1e-6,
        0.1,
        1e-3,
        "Root-mean-square height. Relative to the side of the surface, or with a unit: 0.3 um.",
    ),
    Control(
        "slope",
        "∇h",
        "rms slope",
        1e-4,
        1.0,
        0.1,
        "Root-mean-square slope of the surface on its grid, without unit; the theory assumes "
        "small slopes.",
    ),
    Control(
        "seed",
        "seed",
        "seed",
        0,
        999_999,
        7,
        "Selects one of all random surfaces: the same seed gives the same surface, with more "
        "detail on a finer grid.",
        scale="whole",
        step=1,
    ),
    Control(
        "F",
        "F̄",
        "load",
        1e-4,
        10.0,
        0.1,
        "Dimensionless force F / (E* h L), or with a unit: a force such as 10 N, or a mean "
        "pressure such as 2 MPa.",
    ),
)
_CHOICES = (
    Choice(
        "n",
        "points along a side",
        {str(n): str(n) for n in (64, 128, 256, 512, 1024)},
        "512",
        "Points along a side of the grid: more points give finer waves and take longer.",
    ),
    Choice(
        "rms",
        "roughness by",
        {"height": "rms height", "slope": "rms slope"},
        "height",
        "Which of the two is kept when the spectrum changes.",
    ),
    Choice(
        "boundary",
        "around the surface",
        {"free": "free", "periodic": "periodic"},
        "free",
        "Free: the half-space continues, unloaded, around the surface. Periodic: the surface is "
        "repeated without end; the stiffness is then that of the interface alone.",
    ),
    Choice(
        "shown",
        "contact as",
        {
            **{"area": "area", "pressure": "pressure"},
            **{"gap": "gap", "displacement": "displacement"},
        },
        "area",
        "Quantity that the second map shows.",
    ),
    Choice(
        "theories",
        "theory",
        {
            "persson": "Persson",
            "bush-gibson-thomas": "Bush, Gibson, Thomas",
            "greenwood-williamson": "Greenwood, Williamson",
        },
        "",
        "Theories for the same waves, drawn with the curves; they hold for periodic surfaces.",
    ),
)
NUMBERS = {each.key: each for each in _NUMBERS}
"""Numbers by their keys."""
CHOICES = {each.key: each for each in _CHOICES}
"""Choices by their keys."""

FILES = {
    "contact.png": "both maps, PNG",
    "contact.pdf": "both maps, PDF",
    "maps.nc": "all maps, NetCDF",
    "curve.png": "curves, PNG",
    "curve.pdf": "curves, PDF",
    "curve.csv": "curves, CSV",
    "curve.nc": "loads in SI units, NetCDF",
    "surface.nc": "surface, NetCDF",
    "surface.x3p": "surface, X3P",
    "surface.gsf": "surface, GSF of Gwyddion",
}
"""Files that can be saved, by their names, whose endings say of what type they are."""
