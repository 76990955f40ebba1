"""The controls of the view "The paper"."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.lab.controls import Choice, Control, Number, Several

if TYPE_CHECKING:
    from roughline.paper.stated import ModelLabel

DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
"""Fractal dimensions of the paper's Figures 3 and 4."""
MODELS: tuple[ModelLabel, ...] = ("1D", "3D")

HANDBOOK = "https://github.com/roughline/roughline/tree/main/docs"
"""Where the handbook is."""
PAGES = {
    "paper": "all figures of the paper beside ours, its claims and what is found of each",
    "trust": "the trust map in tables",
    "averaging": "which average",
    "finite_size": "which size",
    "area": "the area of contact",
    "sealing": "where a contact seals",
    "correlations": "why surfaces are softer than lines",
}
"""Its pages on the paper and on further studies, and what is told there."""

_MEANING_OF_EDGES = (
    "Dimensionless force F / (E* h L); the fit takes the loads between the two edges."
)


def _edges(model: str, lowest: float, window: tuple[float, float], step: float) -> list[Number]:
    """The two edges of the window of a model."""
    return [
        Number(
            key=f"{end}_{model}",
            symbol="F̄",
            name=f"{word} ({model})",
            low=lowest,
            high=10.0,
            default=edge,
            meaning=_MEANING_OF_EDGES,
            step=step,
        )
        for end, word, edge in zip(("low", "high"), ("from", "to"), window, strict=True)
    ]


WINDOWS = {"1D": _edges("1D", 1e-5, (1e-4, 1e-2), 0.1), "3D": _edges("3D", 1e-3, (1e-2, 0.1), 0.25)}
"""Edges of the window of each model."""

_NUMBERS = (
    *WINDOWS["1D"],
    *WINDOWS["3D"],
    Number(
        key="tolerance",
        symbol="±",
        name="tolerance",
        low=0.01,
        high=0.5,
        default=0.1,
        meaning="How far the reduced model may be off, as a share of the stiffness: 0.1 is 10 %.",
        scale="linear",
        step=0.01,
    ),
    Number(
        key="map_D_f",
        symbol="D_f",
        name="fractal dimension",
        low=2.0,
        high=3.0,
        default=2.2,
        meaning="Fractal dimension of the point on the map; it has no unit.",
        scale="linear",
        step=0.05,
    ),
    Number(
        key="map_F",
        symbol="F̄",
        name="load",
        low=1e-3,
        high=3.162,
        default=0.1,
        meaning="Dimensionless force F / (E* h L) of the point on the map.",
        step=0.05,
    ),
)
_CHOICES = (
    Choice(
        key="mean",
        name="mean of k at fixed F̄",
        options={"arithmetic": "arithmetic", "geometric": "geometric"},
        default="arithmetic",
        meaning="Which mean over the realisations is drawn and fitted. The paper does not say; the "
        "published page takes the arithmetic one.",
    ),
    Choice(
        key="punch",
        name="3D stiffness over that of",
        options={"paper": "1.1419 E* L", "exact": "1.1523 E* L", "raw": "E* L"},
        default="paper",
        meaning="What k is divided by in Figure 4: the square punch as the paper takes it, the "
        "exact square punch, or the raw E* L. It changes ζ, but not α.",
    ),
    Choice(
        key="roll_off",
        name="q_r/q_0",
        options={text: text for text in ("1", "2", "4", "8", "16")},
        default="1",
        meaning="Roll-off ratio: how many roll-off wavelengths lie along a side. At 1 the spectrum "
        "has no plateau.",
    ),
)
_SHOWN = Several(
    key="D_f",
    name="fractal dimension",
    options={f"{each:g}": f"{each}" for each in DIMENSIONS},
    of=float,
    default=DIMENSIONS,
    is_needed=True,
    meaning="Which curves are drawn and fitted.",
)
NUMBERS = {each.key: each for each in _NUMBERS}
"""Numbers by their keys."""
CHOICES = {each.key: each for each in _CHOICES}
"""Choices by their keys."""
CONTROLS: dict[str, Control] = {each.key: each for each in (_SHOWN, *_CHOICES, *_NUMBERS)}
"""All controls by their keys."""
