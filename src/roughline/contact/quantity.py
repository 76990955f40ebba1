"""What an output quantity of a curve is: its name, unit and meaning."""

from __future__ import annotations

from dataclasses import dataclass

OVER_LOADS = ("load",)
ON_THE_GRID = ("load", "x", "y")

_SI = {"length": "m", "force": "N", "pressure": "Pa", "energy": "J", "1": "1"}


@dataclass(frozen=True)
class Quantity:
    """One output quantity."""

    name: str  # name of the variable in files, and of the attribute unless that is given
    symbol: str  # what formulas call it, in LaTeX; empty where they do not name it
    # its unit in any coherent units: "1", "length", "force", "pressure", "energy" or a quotient of
    # two of them; None for a flag, which has no unit
    dimension: str | None
    meaning: str  # what it is, for the glossary
    # what it is in a few words, for the attributes of files; empty where files have none
    long_name: str = ""
    # Its place among the variables of a file; None for what files do not hold. Tables are read by
    # position too, so a new quantity takes the next number
    column: int | None = None
    dims: tuple[str, ...] = OVER_LOADS  # what it extends over: the loads, or the loads and the grid
    dtype: str = "f8"  # NumPy's name of the type of its values
    of_lines: bool = True  # whether the reduced model gives it
    of_yielding: bool = False  # whether files hold it only where a hardness was given
    # name of the attribute of a curve or of its fields, where it is not that in files
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
