"""The controls of the view "Explore"."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import roughline as rl
from roughline.errors.checks import shown
from roughline.lab.controls import Choice, Control, ControlError, has_unit, rounded
from roughline.units import engineering, in_si


@dataclass(frozen=True)
class ScaledControl(Control):
    """A number that may be given with its unit, and is then divided by a scale."""

    unit: str = "1"
    state_scale: Callable[[Any], float] = float  # gives the scale of a state, in the unit
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
        scale = self.state_scale(state)
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


_length = partial(
    ScaledControl, unit="m", state_scale=lambda state: float(state.length), over="sides"
)  # over the side of the surface


_NUMBERS = (
    Control(
        key="D_f",
        symbol="D_f",
        name="fractal dimension",
        low=2.0,
        high=3.0,
        default=2.2,
        meaning="How rough the surface is on small scales: 2 is smooth, 3 fills space; D_f = 3 - "
        "H, with the Hurst exponent H. It has no unit. H may be typed instead, as H = 0.8.",
        scale="linear",
    ),
    _length(
        key="roll_off",
        symbol="λ_r/L",
        name="roll-off wavelength",
        low=1 / 32,
        high=1.0,
        default=1.0,
        meaning="The spectrum is flat for waves longer than this. Relative to the side of the "
        "surface, or with a unit, such as 0.2 mm; at 1 there is no plateau.",
    ),
    _length(
        key="cutoff",
        symbol="λ_s/L",
        name="cutoff wavelength",
        low=1 / 512,
        high=0.5,
        default=1 / 512,
        meaning="Length of the shortest wave. Relative to the side of the surface, or with a unit; "
        "n points along a side carry no waves shorter than 2/n, which is the default of each grid.",
    ),
    _length(
        key="h",
        symbol="h/L",
        name="rms height",
        low=1e-6,
        high=0.1,
        default=1e-3,
        meaning="Root-mean-square height. Relative to the side of the surface, or with a unit: 0.3 "
        "um.",
    ),
    Control(
        key="slope",
        symbol="∇h",
        name="rms slope",
        low=1e-4,
        high=1.0,
        default=0.1,
        meaning="Root-mean-square slope of the surface on its grid, without unit; the theory "
        "assumes small slopes.",
    ),
    Control(
        key="seed",
        symbol="seed",
        name="seed",
        low=0,
        high=999_999,
        default=20,
        meaning="Selects one of all random surfaces: the same seed gives the same surface, with "
        "more detail on a finer grid.",
        scale="whole",
        step=1,
    ),
    Control(
        key="F",
        symbol="F̄",
        name="load",
        low=1e-4,
        high=10.0,
        default=0.1,
        meaning="Dimensionless force F / (E* h L), or with a unit: a force such as 10 N, or a mean "
        "pressure such as 2 MPa.",
    ),
)
_CHOICES = (
    Choice(
        key="n",
        name="points along a side",
        options={str(n): str(n) for n in (64, 128, 256, 512, 1024)},
        default="512",
        meaning="Points along a side of the grid: more points give finer waves and take longer.",
    ),
    Choice(
        key="rms",
        name="roughness by",
        options={"height": "rms height", "slope": "rms slope"},
        default="height",
        meaning="Which of the two is kept when the spectrum changes.",
    ),
    Choice(
        key="boundary",
        name="around the surface",
        options={"free": "free", "periodic": "periodic"},
        default="free",
        meaning="Free: the half-space continues, unloaded, around the surface. Periodic: the "
        "surface is repeated without end; the stiffness is then that of the interface alone.",
    ),
    Choice(
        key="shown",
        name="contact as",
        options={
            **{"area": "area", "pressure": "pressure", "gap": "gap"},
            **{"displacement": "displacement", "height": "heights", "white": "area on white"},
        },
        default="area",
        meaning="What lies on the relief of the surface.",
    ),
    Choice(
        key="theories",
        name="theory",
        options={
            "persson": "Persson",
            "bush-gibson-thomas": "Bush, Gibson, Thomas",
            "greenwood-williamson": "Greenwood, Williamson",
        },
        default="",
        meaning="Theories for the same waves, drawn with the curves; they hold for periodic "
        "surfaces.",
    ),
)
NUMBERS = {each.key: each for each in _NUMBERS}
"""Numbers by their keys."""
CHOICES = {each.key: each for each in _CHOICES}
"""Choices by their keys."""

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
