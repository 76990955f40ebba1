"""A margin: how far one cause alone leaves an answer open."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.engineering.intervals import Ends
from roughline.units import decimal

MATTERS = 1 + 1e-9  # upper over lower end of what a cause moves at all, to rounding


@dataclass(frozen=True, eq=False)
class Margin:
    """How far one cause alone leaves an answer open, over the loads.

    Attributes
    ----------
    cause : str
        Name of the cause, such as "grid".
    title : str
        What pages call it, such as "the grid".
    remedy : str
        What would narrow it, such as "finer pixels".
    low, high : ndarray, shape (loads,)
        Both ends that it alone leaves open; NaN where that is not known. [unit of the answer]
    is_bound : bool
        Whether it bounds what others leave open, instead of being independent of them.
    is_of_larger : bool
        Whether it is that the answer is of the surface which a map was cut out of.
    """

    cause: str
    title: str
    remedy: str
    low: Real
    high: Real
    is_bound: bool = False
    is_of_larger: bool = False

    @property
    def ends(self) -> Ends:
        """Both ends. [unit of the answer]"""
        return self.low, self.high

    @property
    def factor(self) -> Real:
        """Upper over lower end, (loads,): 1 where it moves nothing, NaN where it is not known."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.high == self.low, 1.0, self.high / self.low)

    @property
    def matters(self) -> bool:
        """Whether it moves the answer under some load, or may, as it is not known."""
        return bool((~(self.factor <= MATTERS)).any())


def multiple(end: float, value: float) -> float:
    """An end over the value; 1 where both are equal, as zero or infinite ones may be. [1]"""
    with np.errstate(divide="ignore", invalid="ignore"):
        return 1.0 if end == value else float(np.divide(end, value))


@dataclass(frozen=True)
class Reason:
    """Why an answer is not known better under one load; ``str`` says it in words.

    Attributes
    ----------
    cause, title, remedy, is_bound
        As those of its :class:`Margin`.
    low, high : float
        Lower and upper end over the value; NaN where that is not known. [1]
    """

    cause: str
    title: str
    remedy: str
    low: float
    high: float
    is_bound: bool = False

    @property
    def is_known(self) -> bool:
        """Whether its ends are known."""
        return not np.isnan([self.low, self.high]).any()

    @property
    def factor(self) -> float:
        """Upper over lower end; NaN where that is not known. [1]"""
        if not self.is_known:
            return float("nan")
        return self.high / self.low if self.low > 0 else float("inf")

    @property
    def ends_in_words(self) -> str:
        """Both ends as multiples of the value."""
        if not self.is_known:
            return "not known"
        low, high = (decimal(each, 3) for each in (self.low, self.high))
        return f"{low} or more" if np.isinf(self.high) else f"{low} to {high}"

    def __str__(self) -> str:
        if not self.is_known:
            return f"{self.title}: not known; {self.remedy} would tell more"
        return f"{self.title}: {self.ends_in_words} times the value; {self.remedy} would narrow it"
