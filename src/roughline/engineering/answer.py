"""One answer: a quantity over the loads, with its interval, formula, validity and source."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.engineering.declared import DECLARED
from roughline.engineering.intervals import Ends


@dataclass(frozen=True, eq=False)
class Answer:
    """One quantity over the loads.

    Attributes
    ----------
    key : str
        Name by which it is found, such as "contact_stiffness".
    name, symbol, unit : str
        What it is called in tables and formulas; the unit is SI.
    values : ndarray, shape (loads,)
        NaN where a load was not solved. [unit]
    low, high : ndarray, shape (loads,), or None
        Ends of the interval; None where it is not known. Uncertainties that are not known are not
        in it. [unit]
    formula : str
        How it follows from the curve.
    validity : str
        Where the formula holds.
    source : str
        Publication of the formula.
    growth : float
        Power of the nominal area with which it grows at the same mean pressure.
    """

    key: str
    name: str
    symbol: str
    unit: str
    values: Real
    low: Real | None
    high: Real | None
    formula: str
    validity: str = ""
    source: str = ""
    growth: float = 0.0

    @property
    def ends(self) -> Ends | None:
        """Both ends of its interval. [unit]"""
        return None if self.low is None or self.high is None else (self.low, self.high)

    @property
    def rows(self) -> Real:
        """Values, and both ends where they are known, (1 or 3, loads). [unit]"""
        return np.stack([self.values, *(self.ends or ())])

    def at(self, loads: Indices) -> Answer:
        """The same at some of the loads, by their numbers."""
        values, *ends = self.rows[:, loads]
        low, high = ends or (None, None)
        return replace(self, values=values, low=low, high=high)


def answer(key: str, rows: Real, **differing: str) -> Answer:
    """Make an answer from its declaration and its values.

    Parameters
    ----------
    key : str
        Key of the declaration.
    rows : ndarray, shape (loads,), (1, loads) or (3, loads)
        Values, or values and both ends of their interval in either order. [unit]
    **differing : str
        Texts that differ from the declaration: name, formula or validity.
    """
    values, *ends = np.atleast_2d(rows)
    low, high = (np.minimum(*ends), np.maximum(*ends)) if ends else (None, None)
    declared: dict[str, Any] = vars(DECLARED[key]) | differing
    return Answer(key=key, values=values, low=low, high=high, **declared)
