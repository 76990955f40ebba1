"""A gap to let a fluid through: distances, the sides of its rectangle, and how it repeats."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.curve import Curve
from roughline.contact.fields import Fields
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, between, refuse
from roughline.fluid.rarefied import conductance
from roughline.topography.body import Line, Surface
from roughline.topography.heights import checked_sides

Along = Literal["x", "y"]
Sides = Literal["periodic", "closed", "x", "y"]

REPEATS: dict[Sides, tuple[bool, bool]] = {
    "periodic": (True, True),
    "closed": (False, False),
    "x": (True, False),
    "y": (False, True),
}
"""Whether a gap repeats along x and along y."""

_SHORTEST_LENGTH, _LONGEST_LENGTH = 1e-40, 1e40  # squares of their third powers are numbers
_ASPECT = 1e10  # largest of a cell
_CELL_BYTES = 130  # that an open cell takes for each doubling of a side
MOST_KEPT = 2**16
"""Cells of a map of which it is kept how pressures follow; of larger ones it is found again."""
_KEPT_BYTES = 700  # that an open cell takes for that


@dataclass(frozen=True, eq=False)
class Gap:
    """Distances of two bodies on a rectangle, and along which of its sides they repeat."""

    distances: Real  # (nx, ny) [length]
    sizes: tuple[float, float]
    sides: Sides
    path: float  # mean free path of a gas; zero of a liquid [length]

    @classmethod
    def of(cls, given: Any, sizes: Any, sides: Any, mean_free_path: Any) -> Gap:
        """Check distances, or the fields of a load, which know their sides."""
        repeats = given.repeats if isinstance(given, Fields) else (True, True)
        known = next(name for name, each in REPEATS.items() if each == repeats)
        checked: Sides = known if sides is None else allowed_choice("sides", sides, get_args(Sides))
        sizes = sizes or (given.sizes if isinstance(given, Fields) else None)
        distances = _checked(given)
        if sizes is None:
            raise InputError("is not given; give the sides of the rectangle, (Lx, Ly)", "sizes")
        gap = cls(distances, checked_sides(sizes), checked, checked_free_path(mean_free_path))
        if not 1 / _ASPECT <= gap.ratio <= _ASPECT:
            refuse("sizes", sizes, f"cells at most {_ASPECT:g} times as long as wide are needed")
        return gap

    def repeats(self, side: Along) -> bool:
        """Whether it repeats along a side."""
        return REPEATS[self.sides]["xy".index(side)]

    @property
    def ratio(self) -> float:
        """Distance of cells along x over that along y. [1]"""
        (lx, ly), (nx, ny) = self.sizes, self.distances.shape
        return lx / nx / (ly / ny)

    def turned(self) -> Gap:
        """Return the gap with x and y exchanged."""
        other: dict[Sides, Sides] = {"x": "y", "y": "x"}
        sides = other.get(self.sides, self.sides)
        return Gap(self.distances.T, (self.sizes[1], self.sizes[0]), sides, self.path)

    def conducting(self, through: Mask) -> Real:
        """Conductances of the cells through which a fluid flows, were they square. [length³]"""
        cell_bytes = _CELL_BYTES * np.log2(max(through.shape))
        if through.size <= MOST_KEPT:
            cell_bytes += _KEPT_BYTES
        refuse_beyond_memory(
            int(cell_bytes * through.sum()),
            f"a flow through {through.shape[0]} x {through.shape[1]} cells",
            "coarsen the gap",
        )
        found = np.zeros(through.shape)
        found[through] = conductance(self.distances[through], self.path)
        return found


def checked_free_path(given: Any) -> float:
    """A mean free path; refused where it is negative, or its conductance is beyond numbers."""
    needed = f"a number from 0 to {_LONGEST_LENGTH:g} is needed"
    return between("mean_free_path", given, 0.0, _LONGEST_LENGTH, needed)


def _checked(given: Any) -> Real:
    """The distances that are given, as an array of their own."""
    if given is None or isinstance(given, Curve):
        needed = "give the fields of a load, curve.fields[i], which rl.press keeps with fields=True"
        refuse("gap", given, needed)
    if isinstance(given, Line):
        raise InputError(
            "is a Line; along a line, in one dimension, any contact stops the flow: give "
            "the gap under a surface",
            "gap",
        )
    if isinstance(given, Surface):
        raise InputError(
            "is a Surface; press it, with fields=True, and give curve.fields[i]", "gap"
        )
    if isinstance(given, Fields):  # rounding leaves neither gaps in contact nor overlaps beside it
        return np.where(given.contact, 0.0, np.maximum(given.gap, 0.0))
    try:
        array = np.ma.asarray(given)
        if array.dtype.kind in "cmM":  # of complex numbers and of times, a part would be lost
            raise TypeError
        gap = np.ma.filled(array.astype(np.float64), np.nan)
    except (TypeError, ValueError, OverflowError):
        refuse("gap", given, "an array of numbers, shape (nx, ny), is needed")
    if gap.ndim != 2 or min(gap.shape) < 2:
        refuse(
            "gap",
            given,
            "two dimensions of at least 2 cells are needed: in one, any contact stops the flow",
        )
    wrong = ~((gap == 0) | ((gap >= _SHORTEST_LENGTH) & (gap <= _LONGEST_LENGTH)))
    if wrong.any():
        i, j = np.argwhere(wrong)[0]
        raise InputError(
            f"has {int(wrong.sum())} values that are no distances, the first {gap[i, j]} at "
            f"({i}, {j}); a distance is 0 where the bodies touch, and else a number from "
            f"{_SHORTEST_LENGTH:g} to {_LONGEST_LENGTH:g}, not masked",
            "gap",
        )
    return gap
