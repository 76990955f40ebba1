"""The state of the view "The paper": what its address says, read and checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from roughline.errors.checks import shown
from roughline.lab.controls import VERSION, ControlError, Texts, as_text, refuse_strange
from roughline.lab.published.controls import CHOICES, DIMENSIONS, MODELS, NUMBERS, WINDOWS

Window = tuple[float, float]


@dataclass(frozen=True)
class PublishedState:
    """What is chosen, by the keys of the controls, which say what each means."""

    dimensions: tuple[float, ...]  # fractal dimensions that are shown
    mean: Any
    punch: str
    windows: Mapping[str, Window]  # smallest and largest F̄ of the fit, by model
    tolerance: float
    roll_off: float
    map_D_f: float
    map_F: float
    claims: str

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and all that is chosen."""
        return {
            "v": VERSION,
            "D_f": ",".join(f"{each:g}" for each in self.dimensions),
            "mean": self.mean,
            "punch": self.punch,
            **{key: as_text(value) for key, value in self.numbers().items()},
            "roll_off": f"{self.roll_off:g}",
            "claims": self.claims,
        }

    def numbers(self) -> dict[str, float]:
        """What the sliders of the page stand at."""
        edges = {
            edge.key: value
            for model, window in self.windows.items()
            for edge, value in zip(WINDOWS[model], window, strict=True)
        }
        return edges | {key: getattr(self, key) for key in ("tolerance", "map_D_f", "map_F")}


def state_of(said: Texts) -> PublishedState:
    """Read the parameters of an address, or the texts of the controls, or their defaults.

    Raises
    ------
    ControlError
        If the version is another, or a text cannot be used; it says at which control.
    """
    refuse_strange(said, {*NUMBERS, *CHOICES, "D_f"})
    return PublishedState(
        dimensions=_dimensions(said.get("D_f")),
        mean=CHOICES["mean"].read_in(said),
        punch=CHOICES["punch"].read_in(said),
        windows={model: _window(said, model) for model in MODELS},
        tolerance=NUMBERS["tolerance"].read_in(said),
        roll_off=float(CHOICES["roll_off"].read_in(said)),
        map_D_f=NUMBERS["map_D_f"].read_in(said),
        map_F=NUMBERS["map_F"].read_in(said),
        claims=CHOICES["claims"].read_in(said),
    )


def _window(said: Texts, model: str) -> Window:
    low, high = WINDOWS[model]
    window = low.read_in(said), high.read_in(said)
    if not window[0] < window[1]:
        raise ControlError(
            f"the window of the {model} model begins at F̄ = {window[0]:.4g} and ends at "
            f"{window[1]:.4g}: its end must be the larger one",
            *(high.key, low.key),
        )
    return window


def _dimensions(text: str | None) -> tuple[float, ...]:
    if text is None:
        return DIMENSIONS
    known = {f"{each:g}": each for each in DIMENSIONS}
    chosen = [word for word in text.split(",") if word]
    strange = [word for word in chosen if word not in known]
    if strange or not chosen:
        said = f"D_f is {shown(strange[0])}" if strange else "no fractal dimension is chosen"
        raise ControlError(f"{said}; choose one or more of {', '.join(known)}", "D_f")
    return tuple(sorted({known[word] for word in chosen}))
