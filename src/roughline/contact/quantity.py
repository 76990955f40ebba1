"""What an output quantity of a curve is: its name, unit and meaning."""

from __future__ import annotations

from dataclasses import dataclass

OVER_LOADS = ("load",)
ON_THE_GRID = ("load", "x", "y")

_SI = {"length": "m", "force": "N", "pressure": "Pa", "energy": "J", "1": "1"}


@dataclass(frozen=True)
class Quantity:
    """One output quantity.

    Attributes
    ----------
    name : str
        Name of the variable in files, and of the attribute unless that is given.
    symbol : str
        What formulas call it, in LaTeX; empty where they do not name it.
    dimension : str or None
        Its unit in any coherent units: "1", "length", "force", "pressure", "energy" or a quotient
        of two of them; None for a flag, which has no unit.
    meaning : str
        What it is, for the glossary.
    long_name : str
        What it is in a few words, for the attributes of files; empty where files have none.
    column : int or None
        Its place among the variables of a file; None for what files do not hold. Tables are read
        by position too, so a new quantity takes the next number.
    dims : tuple of str
        What it extends over: the loads, or the loads and the grid.
    dtype : str
        NumPy's name of the type of its values.
    of_lines : bool
        Whether the reduced model gives it.
    of_yielding : bool
        Whether files hold it only where a hardness was given.
    attribute : str
        Name of the attribute of a curve or of its fields, where it is not that in files.

    Raises
    ------
    ValueError
        If the dimension is not known.
    """

    name: str
    symbol: str
    dimension: str | None
    meaning: str
    long_name: str = ""
    column: int | None = None
    dims: tuple[str, ...] = OVER_LOADS
    dtype: str = "f8"
    of_lines: bool = True
    of_yielding: bool = False
    attribute: str = ""

    def __post_init__(self) -> None:
        self.unit_in("m")
        object.__setattr__(self, "attribute", self.attribute or self.name)

    def unit_in(self, length_unit: str | None) -> str | None:
        """Return the unit where lengths have this one; None for a flag."""
        return None if self.dimension is None else unit_of(self.dimension, length_unit)

    def attributes(self, length_unit: str | None) -> dict[str, str]:
        """Return its attributes in files: ``units`` and ``long_name``, as far as it has them."""
        unit = self.unit_in(length_unit)
        attributes = {} if unit is None else {"units": unit}
        return attributes | ({"long_name": self.long_name} if self.long_name else {})


def unit_of(dimension: str, length_unit: str | None) -> str:
    """Return the unit of a dimension where lengths have a given unit.

    Lengths in "m" give SI units; without a unit of lengths the dimension itself is returned, and
    with any other unit only lengths have one.
    """
    parts = dimension.split("/")
    for part in parts:
        if part not in _SI:
            raise ValueError(f"dimension is {dimension!r}; known are {', '.join(_SI)}")
    if length_unit == "m":
        return "/".join(_SI[part] for part in parts)
    lengths = {"length": length_unit or "length"}
    return "/".join(lengths.get(part, part) for part in parts)
