"""The output quantities of a curve, each declared once.

:class:`~roughline.contact.curve.Curve`, its files, the stores of campaigns, JSON and the glossary
read what is declared here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from operator import attrgetter
from types import MappingProxyType

RESOLVED_FROM = 10
"""Least number of springs or cells in contact; with fewer, the grid decides the stiffness."""
OVER_LOADS = ("load",)
_ON_THE_GRID = ("load", "x", "y")

DIMENSIONS = {"length": "m", "force": "N", "pressure": "Pa", "energy": "J", "1": "1"}
"""What a dimension is a quotient of, and its SI units."""


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
    # what a contact law must leave (its ``memory``) for files to hold it; empty: anything
    memories: tuple[str, ...] = ()
    # name of the attribute of a curve or of its fields, where it is not that in files
    attribute: str = ""

    def __post_init__(self) -> None:
        self.unit_in("m")
        object.__setattr__(self, "attribute", self.attribute or self.name)

    def unit_in(self, length_unit: str | None) -> str | None:
        """Return the unit where lengths have this one; None for a flag."""
        return None if self.dimension is None else unit_name(self.dimension, length_unit)

    def is_left_by(self, memory: str) -> bool:
        """Whether files hold it of a contact law that leaves "none", "dents" or the "path"."""
        return not self.memories or memory in self.memories

    def attributes(self, length_unit: str | None) -> dict[str, str]:
        """Return its attributes in files: ``units`` and ``long_name``, as far as it has them."""
        unit = self.unit_in(length_unit)
        attributes = {} if unit is None else {"units": unit}
        return attributes | ({"long_name": self.long_name} if self.long_name else {})


def unit_name(dimension: str, length_unit: str | None) -> str:
    """Return the unit of a dimension where lengths have a given unit.

    Lengths in "m" give SI units; without a unit of lengths the dimension itself is returned, and
    with any other unit only lengths have one.
    """
    parts = dimension.split("/")
    for part in parts:
        if part not in DIMENSIONS:
            raise ValueError(f"dimension is {dimension!r}; known are {', '.join(DIMENSIONS)}")
    if length_unit == "m":
        return "/".join(DIMENSIONS[part] for part in parts)
    lengths = {"length": length_unit or "length"}
    return "/".join(lengths.get(part, part) for part in parts)


_of_surfaces = partial(Quantity, of_lines=False)
_of_yielding = partial(Quantity, of_lines=False, memories=("dents",))
_of_sticking = partial(Quantity, of_lines=False, memories=("path",))
_of_both = partial(Quantity, of_lines=False, memories=("dents", "path"))
_on_the_grid = partial(Quantity, of_lines=False, dims=_ON_THE_GRID)

_DECLARED = (
    Quantity(
        "depth",
        "d",
        "length",
        "approach since first touch of the highest point",
        long_name="depth since touch",
        column=0,
    ),
    Quantity(
        "force",
        "F",
        "force",
        "total normal force, compression positive",
        long_name="normal force",
        column=1,
    ),
    Quantity(
        "stiffness",
        "k",
        "force/length",
        "contact stiffness, the exact $dF/dd$",
        long_name="normal contact stiffness dF/dd",
        column=2,
    ),
    _of_yielding(
        "unloading_stiffness",
        "k_u",
        "force/length",
        "stiffness on unloading, when all of the contact springs back",
        long_name="contact stiffness on unloading",
        column=15,
    ),
    _of_surfaces(
        "area_fraction",
        "",
        "1",
        "real over nominal contact area, cells whose pressure is above zero counted whole",
        long_name="real contact area over nominal area, cells counted whole",
        column=6,
    ),
    _of_surfaces(
        "area_fraction_corrected",
        "A/A_0",
        "1",
        "`area_fraction` less the area that whole cells add under summits",
        long_name="real contact area over nominal area, corrected for the outline's steps",
        column=8,
    ),
    _of_surfaces("area_fraction_most", "", "1", "upper bound of the area fraction on finer grids"),
    _of_surfaces(
        "stiffness_error",
        "",
        "force/length",
        "estimated discretisation error of `stiffness`",
        long_name="discretisation error of stiffness",
        column=9,
    ),
    _of_yielding(
        "unloading_stiffness_error",
        "",
        "force/length",
        "estimated discretisation error of `unloading_stiffness`",
        long_name="discretisation error of unloading_stiffness",
        column=22,
    ),
    _of_surfaces(
        "area_fraction_error",
        "",
        "1",
        "estimated discretisation error of `area_fraction_corrected`",
        long_name="discretisation error of area_fraction_corrected",
        column=10,
    ),
    _of_yielding(
        "plastic_fraction",
        "",
        "1",
        "share of the contact that is at the hardness",
        long_name="share of the contact at the hardness",
        column=16,
    ),
    _of_yielding(
        "indentation",
        "",
        "length",
        "largest permanent indentation so far",
        long_name="largest permanent indentation",
        column=17,
    ),
    _of_both(
        "work",
        "W",
        "energy",
        "work done by the load since first touch, less the work returned on unloading",
        long_name="work done by the load",
        column=18,
    ),
    _of_both(
        "dissipated_work",
        "",
        "energy",
        "part of the work that permanent indentations, or jumps of bodies that stick, dissipated",
        long_name="work dissipated by indentation or by jumps",
        column=19,
    ),
    _of_sticking(
        "pulling_fraction",
        "",
        "1",
        "area across whose gap the bodies pull each other, over the nominal area",
        long_name="area that pulls across a gap over nominal area",
        column=23,
    ),
    _of_sticking(
        "on_approach",
        "",
        None,
        "whether the bodies came nearer from the load before, the branch of bodies that stick",
        long_name="1 on approach, 0 on retreat",
        column=24,
        dtype="?",
    ),
    Quantity(
        "residual",
        "",
        "1",
        "largest violation of the contact conditions, each relative to its scale",
        long_name="largest residual",
        column=5,
    ),
    Quantity(
        "resolved",
        "",
        None,
        f"whether at least {RESOLVED_FROM} springs or cells are in contact",
        long_name=f"at least {RESOLVED_FROM} springs or cells in contact",
        column=4,
        dtype="?",
    ),
    Quantity("status", "", None, "how the solution ended, a `Status`", column=3, dtype="i1"),
    _of_surfaces(
        "convolutions",
        "",
        "1",
        "exact convolutions that the load took, its stiffness included",
        long_name="convolutions spent",
        column=7,
        dtype="i8",
    ),
    Quantity(
        "force_bar",
        r"\bar F",
        "1",
        "dimensionless force $F/(E^* h L)$, the paper's eq. 2",
        long_name="F / (E* h L)",
    ),
    Quantity(
        "stiffness_bar",
        r"\bar k",
        "1",
        r"dimensionless stiffness $k/(1.1419\,E^* L)$, the paper's eq. 1; of a line $k/(E^* L)$",
    ),
    _on_the_grid("pressure", "p", "pressure", "contact pressure, compression positive", column=11),
    _on_the_grid(
        "displacement", "u", "length", "normal displacement of the half-space's surface", column=12
    ),
    _on_the_grid("gap", "g", "length", "distance of the two bodies", column=13),
    _on_the_grid("contact", "", "1", "1 where the bodies touch, else 0", column=14, dtype="?"),
    _on_the_grid(
        "plastic",
        "",
        "1",
        "1 where the pressure is at the hardness, else 0",
        column=20,
        dtype="?",
        memories=("dents",),
    ),
    _on_the_grid(
        "indentation_field",
        "",
        "length",
        "permanent indentation: how much lower the surface is than before any load",
        column=21,
        memories=("dents",),
        attribute="indentation",
    ),
    _on_the_grid(
        "pulling",
        "",
        "1",
        "1 where the bodies pull each other across a gap, else 0",
        column=25,
        dtype="?",
        memories=("path",),
    ),
)

_VECTORS, _TENSORS = ("load", "axis"), ("load", "axis", "moved_axis")
_of_friction = partial(Quantity, of_lines=False)

SLIDING_QUANTITIES = (
    _of_friction("shear_force", "Q", "force", "total shear force on the half-space", dims=_VECTORS),
    _of_friction("slide", r"\delta", "length", "slide of the rough body", dims=_VECTORS),
    _of_friction(
        "shear_stiffness",
        "k_t",
        "force/length",
        r"tangential stiffness $dQ/d\delta$ on further shear",
        dims=_TENSORS,
    ),
    _of_friction(
        "shear_stiffness_back",
        "",
        "force/length",
        r"tangential stiffness $dQ/d\delta$ on turning back, when all of the contact sticks",
        dims=_TENSORS,
    ),
    _of_friction("stick_fraction", "", "1", "share of the contact that sticks"),
    _of_friction("shear_limit", "", "force", "largest shear force that friction bears"),
    _of_friction("dissipated", "", "energy", "energy dissipated by slip since the load before"),
    _of_friction("shear", "q", "pressure", "shear on the half-space", dims=(*_ON_THE_GRID, "axis")),
    _of_friction("slip", "", "length", "slip since the load before", dims=(*_ON_THE_GRID, "axis")),
    _of_friction("slip_total", "", "length", "way slipped since first touch", dims=_ON_THE_GRID),
    _of_friction("stick", "", "1", "1 where the bodies stick, else 0", dims=_ON_THE_GRID),
)
"""The output quantities that a curve with friction has beside those of others."""

QUANTITIES: Mapping[str, Quantity] = MappingProxyType({each.name: each for each in _DECLARED})
"""All output quantities by name, in the order in which people read them."""

IN_FILES = tuple(
    sorted((each for each in _DECLARED if each.column is not None), key=attrgetter("column"))
)
"""The variables of a curve's file, in their order."""

IN_JSON = tuple(
    each
    for each in _DECLARED
    if each.column is not None and each.dims == OVER_LOADS and each.name != "convolutions"
)
"""The quantities of a curve in JSON output, in order; the cost of computing is left out."""
