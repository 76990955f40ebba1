"""A measure: one number that is taken from the fields of each load, and kept when they are not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.fields import Fields
from roughline.contact.quantities import DIMENSIONS, QUANTITIES, Quantity
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, as_number, refuse
from roughline.errors.public import public


@public
@dataclass(frozen=True, eq=False)
class Measure:
    """One number that is taken from the fields of each load, over which a curve then has it.

    Fields of many loads are large. A measure is taken when a load is solved, and stays when its
    fields go.

    Parameters
    ----------
    name : str
        Name by which it is found, and of its variable in files, such as "mean_gap".
    symbol : str
        What formulas call it, in LaTeX.
    dimension : str
        Its unit in any coherent units: "1", "length", "force", "pressure", "energy", or a quotient
        of these such as "1/length".
    meaning : str
        What it is, in a few words.
    value : callable
        Takes it from :class:`~roughline.Fields`; NaN where they do not tell it. [dimension]
    intensive : bool, optional
        Whether it comes to a number as a surface grows, as a mean gap does and a largest one does
        not. What a larger surface has is then told by the parts of a map; it is not negative.
    of_this_grid : bool, optional
        Whether it belongs to one grid, and is not taken on coarser ones; it has no interval then.

    Raises
    ------
    InputError
        If the name is no word of Python or that of another quantity, or the dimension is none.

    Examples
    --------
    >>> import roughline as rl
    >>> deepest = rl.Measure(
    ...     "deepest_gap", "u_0", "length", "largest gap", lambda fields: fields.gap.max()
    ... )
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01).surface(64, rng=7)
    >>> curve = rl.press(surface, E_star=1.0, forces=[1e-4, 1e-3], measures=[deepest])
    >>> print(curve.measured["deepest_gap"].values.round(3))
    [0.054 0.047]
    """

    name: str
    symbol: str
    dimension: str
    meaning: str
    value: Callable[[Fields], float]
    intensive: bool = False
    of_this_grid: bool = False

    def __post_init__(self) -> None:
        if not (isinstance(self.name, str) and self.name.isidentifier()):
            refuse("name", self.name, 'a word of letters and "_" is needed, such as "mean_gap"')
        if self.name in QUANTITIES:
            raise InputError(f'"{self.name}" is that of another quantity: give another', "name")
        for part in str(self.dimension).split("/"):
            allowed_choice("dimension", part, DIMENSIONS)
        if not callable(self.value):
            refuse("value", self.value, "a function of the fields of a load is needed")

    @property
    def quantity(self) -> Quantity:
        """Its declaration as files read it."""
        return Quantity(
            self.name, self.symbol, self.dimension, self.meaning, self.meaning, of_lines=False
        )

    def of(self, fields: Fields) -> float:
        """Take it from the fields of a load.

        Raises
        ------
        InputError
            If it is no number.
        """
        found = as_number(self.value(fields))
        if found is None:
            raise InputError(f"the measure {self.name} gives no number of a load: let it give one")
        return found


MEAN_GAP = Measure(
    "mean_gap",
    r"\bar u",
    "length",
    "mean gap over the nominal area, zero where the bodies touch",
    lambda fields: fields.mean_gap,
    intensive=True,
)
"""Mean distance of the bodies: the volume between them over the nominal area."""


@dataclass(frozen=True, eq=False)
class Measured:
    """A measure over the loads of a curve.

    Attributes
    ----------
    quantity : Quantity
        What was taken: name, symbol, dimension and meaning.
    values : ndarray, shape (loads,)
        NaN where a load was not solved. [dimension of the measure]
    low, high : ndarray, shape (loads,), or None
        Ends of the interval that the grid leaves open, if it was asked for. [dimension]
    """

    quantity: Quantity
    values: Real
    low: Real | None = None
    high: Real | None = None

    @property
    def rows(self) -> Real:
        """Values, and both ends where they are known, (1 or 3, loads)."""
        ends = () if self.low is None or self.high is None else (self.low, self.high)
        return np.stack([self.values, *ends])

    def over(self, other_loads: Callable[[Real], Real]) -> Measured:
        """Return the measure over other loads, to which a function takes values."""
        values, *ends = map(other_loads, self.rows)
        low, high = ends or (None, None)
        return replace(self, values=values, low=low, high=high)


def checked_measures(given: Any) -> tuple[Measure, ...]:
    """Return measures, each once; refuse what is none, and two of one name."""
    needed = "give a list of measures, such as [rl.MEAN_GAP]"
    if not isinstance(given, list | tuple):
        refuse("measures", given, needed)
    found = tuple(dict.fromkeys(given))
    for i, each in enumerate(found):
        if not isinstance(each, Measure):
            refuse("measures", each, needed)
        if each.name in [other.name for other in found[:i]]:
            raise InputError(f'two have the name "{each.name}": give one another name', "measures")
    return found


def all_measured(
    measures: Sequence[Measure], values: Sequence[Sequence[float]] | Real
) -> dict[str, Measured]:
    """Measures by their names, of which values stand in a row for each load."""
    table = np.array(values, dtype=float).reshape(len(values), len(measures))
    return {
        each.name: Measured(each.quantity, np.ascontiguousarray(column))
        for each, column in zip(measures, table.T, strict=True)
    }
