"""The state of the view "The paper": what its address says, read and checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from roughline.errors.checks import shown
from roughline.lab.controls import (
    VERSION,
    Choice,
    Control,
    ControlError,
    Texts,
    as_text,
    refuse_strange,
)
from roughline.lab.published import controls as c

Window = tuple[float, float]


@dataclass(frozen=True)
class PublishedState:
    """What is chosen.

    Attributes
    ----------
    dimensions : tuple of float
        Fractal dimensions that are shown.
    mean : {"arithmetic", "geometric"}
        Over realisations, at fixed force.
    punch : {"paper", "exact", "raw"}
        What the stiffness of the full model is divided by.
    windows : dict of tuple of float
        Smallest and largest F̄ of the fit, by model.
    tolerance : float
        On the trust map. [1]
    roll_off, map_D_f, map_F : float
        The point on the trust map: roll-off ratio, fractal dimension and F̄. [1]
    claims : str
        Which claims are shown.
    """

    dimensions: tuple[float, ...]
    mean: Any
    punch: str
    windows: Mapping[str, Window]
    tolerance: float
    roll_off: float
    map_D_f: float
    map_F: float
    claims: str

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and all that is chosen."""
        said = {
            "v": VERSION,
            c.DIMENSIONS_KEY: ",".join(f"{each:g}" for each in self.dimensions),
            c.AVERAGING.key: self.mean,
            c.PUNCH.key: self.punch,
        }
        return said | {
            **{key: as_text(value) for key, value in self.numbers().items()},
            c.ROLL_OFF.key: f"{self.roll_off:g}",
            c.CLAIMS.key: self.claims,
        }

    def numbers(self) -> dict[str, float]:
        """What the sliders of the page stand at."""
        edges = {
            edge.key: value
            for model, window in self.windows.items()
            for edge, value in zip(c.WINDOWS[model], window, strict=True)
        }
        return edges | {
            c.TOLERANCE.key: self.tolerance,
            c.MAP_DIMENSION.key: self.map_D_f,
            c.MAP_FORCE.key: self.map_F,
        }


def state_of(said: Texts) -> PublishedState:
    """Read the parameters of an address, or the texts of the controls.

    Parameters
    ----------
    said : mapping of str to str
        Texts by the keys of the controls; those that are missing have their defaults.

    Raises
    ------
    ControlError
        If the version is another, or a text cannot be used; it says at which control.
    """
    keys = {each.key for each in (*c.NUMBERS, *c.CHOICES)} | {c.DIMENSIONS_KEY}
    refuse_strange(said, keys)
    return PublishedState(
        dimensions=_dimensions(said.get(c.DIMENSIONS_KEY)),
        mean=_choice(said, c.AVERAGING),
        punch=_choice(said, c.PUNCH),
        windows={model: _window(said, model) for model in c.MODELS},
        tolerance=_number(said, c.TOLERANCE),
        roll_off=float(_choice(said, c.ROLL_OFF)),
        map_D_f=_number(said, c.MAP_DIMENSION),
        map_F=_number(said, c.MAP_FORCE),
        claims=_choice(said, c.CLAIMS),
    )


def _number(said: Texts, control: Control) -> float:
    return control.read(said.get(control.key, str(control.default)))


def _choice(said: Texts, choice: Choice) -> str:
    return choice.read(said.get(choice.key, choice.default))


def _window(said: Texts, model: str) -> Window:
    low, high = c.WINDOWS[model]
    window = _number(said, low), _number(said, high)
    if not window[0] < window[1]:
        raise ControlError(
            f"the window of the {model} model begins at F̄ = {window[0]:.4g} and ends at "
            f"{window[1]:.4g}: its end must be the larger one",
            *(high.key, low.key),
        )
    return window


def _dimensions(text: str | None) -> tuple[float, ...]:
    if text is None:
        return c.DIMENSIONS
    known = {f"{each:g}": each for each in c.DIMENSIONS}
    chosen = [word for word in text.split(",") if word]
    strange = [word for word in chosen if word not in known]
    if strange or not chosen:
        said = f"D_f is {shown(strange[0])}" if strange else "no fractal dimension is chosen"
        raise ControlError(f"{said}; choose one or more of {', '.join(known)}", c.DIMENSIONS_KEY)
    return tuple(sorted({known[word] for word in chosen}))
