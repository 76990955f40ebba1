"""The controls of the view "The paper"."""

from __future__ import annotations

from typing import Literal

from roughline.lab.controls import Choice, Control

DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
"""Fractal dimensions of the paper's Figures 3 and 4."""
GALLERY = ("2", "7/3", "8/3", "3")
"""Fractal dimensions of the bodies of its Figure 1, as the paper writes them."""
MODELS = ("1D", "3D")
ModelLabel = Literal["1D", "3D"]

_EDGE = "Dimensionless force F / (E* h L); the fit takes the loads between the two edges."


def _edge(key: str, name: str, default: float, low: float, step: float) -> Control:
    return Control(key, "F̄", name, low, 10.0, default, _EDGE, step=step)


WINDOWS = {
    "1D": (
        _edge("low_1D", "from (1D)", 1e-4, 1e-5, 0.1),
        _edge("high_1D", "to (1D)", 1e-2, 1e-5, 0.1),
    ),
    "3D": (
        _edge("low_3D", "from (3D)", 1e-2, 1e-3, 0.25),
        _edge("high_3D", "to (3D)", 1e-1, 1e-3, 0.25),
    ),
}
"""Edges of the window of each model."""

_NUMBERS = (
    *WINDOWS["1D"],
    *WINDOWS["3D"],
    Control(
        "tolerance",
        "±",
        "tolerance",
        0.01,
        0.5,
        0.1,
        "How far the reduced model may be off, as a share of the stiffness: 0.1 is 10 %.",
        scale="linear",
        step=0.01,
    ),
    Control(
        "map_D_f",
        "D_f",
        "fractal dimension",
        2.0,
        3.0,
        2.2,
        "Fractal dimension of the point on the map; it has no unit.",
        scale="linear",
        step=0.05,
    ),
    Control(
        "map_F",
        "F̄",
        "load",
        1e-3,
        3.162,
        0.1,
        "Dimensionless force F / (E* h L) of the point on the map.",
        step=0.05,
    ),
)
_CHOICES = (
    Choice(
        "mean",
        "mean of k at fixed F̄",
        {"arithmetic": "arithmetic", "geometric": "geometric"},
        "arithmetic",
        "Which mean over the realisations is drawn and fitted. The paper does not say; the "
        "published page takes the arithmetic one.",
    ),
    Choice(
        "punch",
        "3D stiffness over that of",
        {"paper": "1.1419 E* L", "exact": "1.1523 E* L", "raw": "E* L"},
        "paper",
        "What k is divided by in Figure 4: the square punch as the paper takes it, the exact "
        "square punch, or the raw E* L. It changes ζ, but not α.",
    ),
    Choice(
        "roll_off",
        "q_r/q_0",
        {text: text for text in ("1", "2", "4", "8", "16")},
        "1",
        "Roll-off ratio: how many roll-off wavelengths lie along a side. At 1 the spectrum has no "
        "plateau.",
    ),
    Choice(
        "claims",
        "show",
        {"all": "all", "confirmed": "confirmed", "undecided": "undecided", "refuted": "refuted"},
        "all",
        "Which claims the table shows, by the verdict on the claim as a whole.",
    ),
)
NUMBERS = {each.key: each for each in _NUMBERS}
"""Numbers by their keys."""
CHOICES = {each.key: each for each in _CHOICES}
"""Choices by their keys."""
