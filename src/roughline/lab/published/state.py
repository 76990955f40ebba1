"""The state of the view "The paper": what its address says, read and checked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughline.lab.controls import VERSION, ControlError, Texts, refuse_strange
from roughline.lab.published.controls import CONTROLS, WINDOWS

if TYPE_CHECKING:
    from roughline.paper.stated import ModelLabel
    from roughline.paper.windows import ForceWindow

_DROPPED_KEYS = {"claims"}
"""What links of version 0.3 chose besides: which claims are listed, which the handbook does now."""


class PublishedState(dict[str, Any]):
    """What is chosen, by the keys of the controls, which say what each means."""

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and all that is chosen."""
        return {"v": VERSION} | {key: each.text(self[key]) for key, each in CONTROLS.items()}

    def window(self, model: ModelLabel) -> ForceWindow:
        """Return the smallest and the largest F̄ of the fit of a model."""
        low, high = (self[edge.key] for edge in WINDOWS[model])
        return low, high


def read_state(texts: Texts) -> PublishedState:
    """Read the parameters of an address, or the texts of the controls, or their defaults."""
    refuse_strange(texts, {*CONTROLS, *_DROPPED_KEYS})
    state = PublishedState({key: each.read_in(texts) for key, each in CONTROLS.items()})
    for model, edges in WINDOWS.items():
        low, high = (state[edge.key] for edge in edges)
        if not low < high:
            raise ControlError(
                f"the window of the {model} model begins at F̄ = {low:.4g} and ends at {high:.4g}: "
                "its end must be the larger one",
                *(edge.key for edge in reversed(edges)),
            )
    return state
