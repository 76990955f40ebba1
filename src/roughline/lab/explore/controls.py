"""The controls of the view "Explore"."""

from __future__ import annotations

from roughline.lab.controls import Choice, Control

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
    Control(
        "roll_off",
        "λ_r/L",
        "roll-off wavelength",
        1 / 32,
        1.0,
        1.0,
        "The spectrum is flat for waves longer than this. Relative to the side of the surface, "
        "or with a unit, such as 0.2 mm; at 1 there is no plateau.",
    ),
    Control(
        "cutoff",
        "λ_s/L",
        "cutoff wavelength",
        1 / 512,
        0.5,
        1 / 512,
        "Length of the shortest wave. Relative to the side of the surface, or with a unit; n "
        "points along a side carry no waves shorter than 2/n, which is the default of each grid.",
    ),
    Control(
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
    Control(
        "hardness_bar",
        "H/(E*∇h)",
        "hardness",
        0.02,
        5.0,
        0.5,
        "Largest pressure that a point bears, over E* times the rms slope on the grid, or with a "
        "unit, such as 2 GPa. Where it is reached, the surface is permanently indented.",
    ),
    Control(
        "w",
        "w L/(E*h²)",
        "work of adhesion",
        1e-4,
        10.0,
        1.0,
        "Work to separate a unit of area, over E* h² / L, or with a unit, such as 50 mJ/m^2. About "
        "1 is what it takes to flatten the longest waves.",
    ),
    Control(
        "h0",
        "h_0/h",
        "range of the pull",
        1e-3,
        2.0,
        0.5,
        "Largest gap across which the bodies pull each other, evenly with w / h_0, over the rms "
        "height, or with a unit, such as 5 nm. A shorter one takes a finer grid.",
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
            **{"area": "area", "pressure": "pressure", "gap": "gap"},
            **{"displacement": "displacement", "flux": "flux", "retreat": "area, way back"},
        },
        "area",
        "Quantity that the second map shows; the flux is there with a fluid alone, the way back of "
        "bodies that stick.",
    ),
    Choice(
        "fluid",
        "a fluid flows from left to right",
        {"": "none", "x": "from left to right"},
        "",
        "A fluid flows where the bodies do not touch: the map shows where it goes, the curve how "
        "much comes through, and at which load the contact seals.",
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
WITH_ALONE = {"flux": "fluid", "retreat": "w"}
"""Quantities of the map that are there with a control alone."""
NUMBERS = {each.key: each for each in _NUMBERS}
"""Numbers by their keys."""
CHOICES = {each.key: each for each in _CHOICES}
"""Choices by their keys."""
