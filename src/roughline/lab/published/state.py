"""The state of the view "The paper": what its address says, read and checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughline.errors.checks import shown
from roughline.lab.controls import VERSION, ControlError, Texts, as_text, refuse_strange
from roughline.lab.published.controls import CHOICES, DIMENSIONS, NUMBERS, WINDOWS

if TYPE_CHECKING:
    from roughline.paper.stated import ModelLabel
    from roughline.paper.windows import ForceWindow

_DROPPED_KEYS = {"claims"}
"""What links of version 0.3 chose besides: which claims are listed, which the handbook does now."""


@dataclass(frozen=True)
class PublishedState:
    """What is chosen, by the keys of the controls, which say what each means."""

    dimensions: tuple[float, ...]  # fractal dimensions that are shown
    words: Mapping[str, str]
    numbers: Mapping[str, float]

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and all that is chosen."""
        numbers = {key: as_text(value) for key, value in self.numbers.items()}
        dimensions = ",".join(f"{each:g}" for each in self.dimensions)
        return {"v": VERSION, "D_f": dimensions, **self.words, **numbers}

    def window(self, model: ModelLabel) -> ForceWindow:
        """Return the smallest and the largest F̄ of the fit of a model."""
        low, high = (self.numbers[edge.key] for edge in WINDOWS[model])
        return low, high


def read_state(texts: Texts) -> PublishedState:
    """Read the parameters of an address, or the texts of the controls, or their defaults."""
    refuse_strange(texts, {*NUMBERS, *CHOICES, "D_f", *_DROPPED_KEYS})
    state = PublishedState(
        _dimensions(texts.get("D_f")),
        {key: each.read_in(texts) for key, each in CHOICES.items()},
        {key: each.read_in(texts) for key, each in NUMBERS.items()},
    )
    for model, edges in WINDOWS.items():
        low, high = (state.numbers[edge.key] for edge in edges)
        if not low < high:
            raise ControlError(
                f"the window of the {model} model begins at F̄ = {low:.4g} and ends at {high:.4g}: "
                "its end must be the larger one",
                *(edge.key for edge in reversed(edges)),
            )
    return state


def _dimensions(text: str | None) -> tuple[float, ...]:
    if text is None:
        return DIMENSIONS
    known = {f"{each:g}": each for each in DIMENSIONS}
    chosen = [word for word in text.split(",") if word]
    strange = [word for word in chosen if word not in known]
    if strange or not chosen:
        why = f"D_f is {shown(strange[0])}" if strange else "no fractal dimension is chosen"
        raise ControlError(f"{why}; choose one or more of {', '.join(known)}", "D_f")
    return tuple(sorted({known[word] for word in chosen}))
