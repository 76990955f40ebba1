"""The controls of the view "The paper"."""

from __future__ import annotations

from typing import Literal

from roughline.lab.controls import Choice, Control

DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
"""Fractal dimensions of the paper's Figures 3 and 4."""
GALLERY = ("2", "7/3", "8/3", "3")
"""Fractal dimensions of the bodies of its Figure 1, as the paper writes them."""
MODELS = ("1D", "3D")
DIMENSIONS_KEY = "D_f"
"""Key of the fractal dimensions that are shown, in the address."""

_EDGE = "Dimensionless force F / (E* h L); the fit takes the loads between the two edges."


def _edge(key: str, name: str, default: float, low: float, step: float) -> Control:
    return Control(key, "F̄", name, low, 10.0, default, "logarithmic", _EDGE, step)


LOW_1D = _edge("low_1D", "from (1D)", 1e-4, 1e-5, 0.1)
HIGH_1D = _edge("high_1D", "to (1D)", 1e-2, 1e-5, 0.1)
LOW_3D = _edge("low_3D", "from (3D)", 1e-2, 1e-3, 0.25)
HIGH_3D = _edge("high_3D", "to (3D)", 1e-1, 1e-3, 0.25)
WINDOWS = {"1D": (LOW_1D, HIGH_1D), "3D": (LOW_3D, HIGH_3D)}
"""Edges of the window of each model."""

AVERAGING = Choice(
    "mean",
    "mean of k at fixed F̄",
    {"arithmetic": "arithmetic", "geometric": "geometric"},
    "arithmetic",
    "Which mean over the realisations is drawn and fitted. The paper does not say; the published "
    "page takes the arithmetic one.",
)
PUNCH = Choice(
    "punch",
    "3D stiffness over that of",
    {"paper": "1.1419 E* L", "exact": "1.1523 E* L", "raw": "E* L"},
    "paper",
    "What k is divided by in Figure 4: the square punch as the paper takes it, the exact square "
    "punch, or the raw E* L. It changes ζ, but not α.",
)
TOLERANCE = Control(
    "tolerance",
    "±",
    "tolerance",
    0.01,
    0.5,
    0.1,
    "linear",
    "How far the reduced model may be off, as a share of the stiffness: 0.1 is 10 %.",
    0.01,
)
ROLL_OFF = Choice(
    "roll_off",
    "q_r/q_0",
    {text: text for text in ("1", "2", "4", "8", "16")},
    "1",
    "Roll-off ratio: how many roll-off wavelengths lie along a side. At 1 the spectrum has no "
    "plateau.",
)
MAP_DIMENSION = Control(
    "map_D_f",
    "D_f",
    "fractal dimension",
    2.0,
    3.0,
    2.2,
    "linear",
    "Fractal dimension of the point on the map; it has no unit.",
    0.05,
)
MAP_FORCE = Control(
    "map_F",
    "F̄",
    "load",
    1e-3,
    3.162,
    0.1,
    "logarithmic",
    "Dimensionless force F / (E* h L) of the point on the map.",
    0.05,
)
CLAIMS = Choice(
    "claims",
    "show",
    {"all": "all", "confirmed": "confirmed", "undecided": "undecided", "refuted": "refuted"},
    "all",
    "Which claims the table shows, by the verdict on the claim as a whole.",
)

NUMBERS = (LOW_1D, HIGH_1D, LOW_3D, HIGH_3D, TOLERANCE, MAP_DIMENSION, MAP_FORCE)
CHOICES = (AVERAGING, PUNCH, ROLL_OFF, CLAIMS)

ModelLabel = Literal["1D", "3D"]
