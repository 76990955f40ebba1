"""What can be set on the page: each control declared once, for the page and for its reader."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import roughline as rl
from roughline.units import refuse_decimal_comma

VERSION = "1"
"""Of the addresses; one of another version is refused."""

STRANGE = "this question is not one of the lab: reload the page"
"""What is said of a question that no page of this lab asks."""

_OF_THE_PAGE = ("view", "theme")  # parameters of an address that are no part of a view's state


class ControlError(rl.InputError):
    """The value that a control of the page is set to cannot be used.

    Attributes
    ----------
    at : str
        Key of the control; empty for the whole view.
    """

    def __init__(self, message: str, at: str = "") -> None:
        super().__init__(message)
        self.at = at


@dataclass(frozen=True)
class Control:
    """A number that can be set, by a slider or as text.

    Attributes
    ----------
    key : str
        Its name in the address.
    symbol, name : str
        What the field calls it, and in words.
    low, high, default : float
        Its range.
    scale : {"linear", "logarithmic", "whole"}
        How the slider runs; "whole" allows whole numbers alone.
    meaning : str
        One sentence, with its unit.
    step : float
        Of the slider, in the number or, on a logarithmic scale, in decades.
    """

    key: str
    symbol: str
    name: str
    low: float
    high: float
    default: float
    scale: Literal["linear", "logarithmic", "whole"]
    meaning: str
    step: float

    def read(self, text: str) -> float:
        """Return the number in a text.

        Raises
        ------
        ControlError
            If it is none, or out of range.
        """
        try:
            refuse_decimal_comma(text, self.name)
            value = float(text)
        except ValueError as error:
            said = str(error) if "comma" in str(error) else f'{self.name} is "{text[:40]}"'
            raise ControlError(f"{said}; give a number {self.range}", self.key) from None
        return self.checked(value)

    def checked(self, value: float) -> float:
        """Return a number that is in range.

        Raises
        ------
        ControlError
            If it is not.
        """
        slack = 1e-9 * max(abs(self.low), abs(self.high))
        if not self.low - slack <= value <= self.high + slack:
            raise ControlError(f"{self.name} is {value:.6g}; give a number {self.range}", self.key)
        if self.scale == "whole" and value != math.floor(value):
            raise ControlError(f"{self.name} is {value:g}; give a whole number", self.key)
        return min(max(value, self.low), self.high)

    @property
    def range(self) -> str:
        """The range in words."""
        return f"from {self.low:g} to {self.high:g}"


@dataclass(frozen=True)
class Choice:
    """One of several words.

    Attributes
    ----------
    key, name : str
        Its name in the address, and in words.
    options : dict of str
        What may be chosen: the word in the address, and what the page shows.
    default : str
        A word in the address.
    meaning : str
        One sentence.
    """

    key: str
    name: str
    options: dict[str, str] = field(default_factory=dict)
    default: str = ""
    meaning: str = ""

    def read(self, text: Any) -> str:
        """Return the word, if it is one of them.

        Raises
        ------
        ControlError
            If it is not.
        """
        if text not in self.options:
            allowed = ", ".join(self.options)
            raise ControlError(
                f'{self.name} is "{str(text)[:40]}"; allowed are {allowed}', self.key
            )
        return str(text)


def texts_of(arguments: Mapping[str, Any]) -> Mapping[str, str]:
    """Return the texts of the controls by their keys, as a page sends them.

    Parameters
    ----------
    arguments : mapping
        Of a task; "state" holds the texts.

    Raises
    ------
    ControlError
        If it does not; at the control whose text is none.
    """
    said = arguments.get("state")
    if not isinstance(said, Mapping):
        raise ControlError(STRANGE)
    for key, text in said.items():
        if not isinstance(text, str):
            raise ControlError(STRANGE, key)
    return said


def refuse_strange(said: Mapping[str, str], known: Collection[str]) -> None:
    """Refuse an address of another version, and parameters that a view does not know.

    Parameters
    ----------
    said : mapping of str to str
        Parameters of the address.
    known : collection of str
        Keys of the view.

    Raises
    ------
    ControlError
        In one sentence, at the version, which stands for the whole address.
    """
    if said.get("v", VERSION) != VERSION:
        raise ControlError(
            f'this link is of version "{said["v"][:20]}" of the lab\'s addresses, and this lab '
            f"reads version {VERSION}: set the controls by hand",
            "v",
        )
    strange = [name[:40] for name in said if name not in (*known, "v", *_OF_THE_PAGE)]
    if strange:
        raise ControlError(
            f'the link sets "{strange[0]}", which this lab does not know: it may be of another '
            "version; set the controls by hand",
            "v",
        )
