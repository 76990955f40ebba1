"""The controls of the view "The paper"."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.lab import declared
from roughline.lab.controls import Control, Several

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

NUMBERS = declared.numbers(__package__, {})
"""Numbers by their keys."""
CHOICES = declared.choices(__package__)
"""Choices by their keys."""
WINDOWS = {model: [NUMBERS[f"{end}_{model}"] for end in ("low", "high")] for model in MODELS}
"""Edges of the window of each model."""

_SHOWN = Several(
    key="D_f",
    name="fractal dimension",
    options={f"{each:g}": f"{each}" for each in DIMENSIONS},
    of=float,
    default=DIMENSIONS,
    is_needed=True,
    meaning="Which curves are drawn and fitted.",
)
CONTROLS: dict[str, Control] = {
    each.key: each for each in (_SHOWN, *CHOICES.values(), *NUMBERS.values())
}
"""All controls by their keys."""
