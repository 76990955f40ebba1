"""The controls of the view "Explore"."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import partial
from typing import Any

from roughline.errors.checks import shown
from roughline.lab.controls import (
    Choice,
    Control,
    ControlError,
    Number,
    QuantityText,
    Several,
    is_number,
)
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


over_side = partial(Number, unit="m", state_scale=lambda state: float(state.length), over="sides")
"""A length, over the side of the surface."""
poissons_ratio = partial(Number, low=0.0, high=0.5, default=0.3, scale="linear", step=0.01)
"""Poisson's ratio of a body."""

_NUMBERS = (
    _Dimension(
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
    over_side(
        key="roll_off",
        symbol="λ_r/L",
        name="roll-off wavelength",
        low=1 / 32,
        high=1.0,
        default=1.0,
        meaning="The spectrum is flat for waves longer than this. Relative to the side of the "
        "surface, or with a unit, such as 0.2 mm; at 1 there is no plateau.",
    ),
    over_side(
        key="cutoff",
        symbol="λ_s/L",
        name="cutoff wavelength",
        low=1 / 512,
        high=0.5,
        default=1 / 512,
        meaning="Length of the shortest wave. Relative to the side of the surface, or with a unit; "
        "n points along a side carry no waves shorter than 2/n, which is the default of each grid.",
    ),
    over_side(
        key="h",
        symbol="h/L",
        name="rms height",
        low=1e-6,
        high=0.1,
        default=1e-3,
        meaning="Root-mean-square height. Relative to the side of the surface, or with a unit: 0.3 "
        "um.",
    ),
    Number(
        key="slope",
        symbol="∇h",
        name="rms slope",
        low=1e-4,
        high=1.0,
        default=0.1,
        meaning="Root-mean-square slope of the surface on its grid, without unit; the theory "
        "assumes small slopes.",
    ),
    Number(
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
    LoadNumber(
        key="F",
        symbol="F̄",
        name="load",
        low=1e-4,
        high=10.0,
        default=0.1,
        meaning="Dimensionless force F / (E* h L), or with a unit: a force such as 10 N, or a mean "
        "pressure such as 2 MPa.",
        unit="N",
        state_scale=lambda state: float(state.force(1.0)),
        over="E* h L",
    ),
)
_CHOICES = (
    Choice(
        key="n",
        name="points along a side",
        options={str(n): str(n) for n in (64, 128, 256, 512, 1024)},
        default="512",
        of=int,
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
    Several(
        key="theories",
        name="theory",
        options={
            "persson": "Persson",
            "bush-gibson-thomas": "Bush, Gibson, Thomas",
            "greenwood-williamson": "Greenwood, Williamson",
        },
        default=(),
        meaning="Theories for the same waves, drawn with the curves; they hold for periodic "
        "surfaces.",
    ),
)
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
NUMBERS = {each.key: each for each in _NUMBERS}
"""Numbers by their keys."""
CHOICES = {each.key: each for each in _CHOICES}
"""Choices by their keys."""
LOAD = "F"
"""Key of the load, which is read when the surface is known."""
CONTROLS: dict[str, Control] = {each.key: each for each in (*_QUANTITIES, *_CHOICES, *_NUMBERS)}
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
