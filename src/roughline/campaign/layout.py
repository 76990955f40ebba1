"""The arrays of a store.

Each ensemble is a group with arrays over (fractal_dimension, realisation, force_bar). The
attributes of the root say which version made the store.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline.campaign.plan import Ensemble
from roughline.contact.quantities import QUANTITIES, RESOLVED_FROM

FORMAT = 1  # changes when older stores can no longer be read
PENDING, DONE, FAILED = 0, 1, 2

_DIMENSIONS = ("fractal_dimension", "realisation", "force_bar")


@dataclass(frozen=True)
class Variable:
    """An array of a store."""

    name: str
    dtype: str  # NumPy's name of the type of its values
    fill: float  # value where nothing was written; no finished case has it
    meaning: str  # for the attributes of the array; everything in a store is dimensionless
    dims: tuple[str, ...] = _DIMENSIONS
    of_lines: bool = True  # whether the reduced model gives it
    memories: tuple[str, ...] = ()  # what loads must leave for bodies to have it; empty: anything
    of_friction: bool = False  # whether bodies that rub alone have it
    averaged: bool = False  # whether tables of means over the realisations have it

    @property
    def per_body(self) -> bool:
        """Whether a body has one value, rather than one for each load."""
        return "force_bar" not in self.dims

    def along_x(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return values over the loads, of vectors and tensors those along x."""
        return values.reshape(len(values), -1)[:, 0]

    @property
    def attributes(self) -> dict[str, str]:
        """What the array says about itself."""
        return {"long_name": self.meaning, "units": "1"}


def _curve_variable(name: str, meaning: str = "", *, averaged: bool = False) -> Variable:
    """Declare that stores keep a quantity of the curve; flags are small integers there."""
    quantity = QUANTITIES[name]
    dtype, fill = ("f8", np.nan) if quantity.dtype == "f8" else ("i1", -1)
    return Variable(
        name,
        dtype,
        fill,
        meaning or quantity.long_name,
        of_lines=quantity.of_lines,
        memories=quantity.memories,
        averaged=averaged,
    )


def _sliding_variable(name: str, meaning: str) -> Variable:
    return Variable(name, "f8", np.nan, meaning, of_friction=True, averaged=True)


def _body_variable(name: str, meaning: str, *memories: str) -> Variable:
    return Variable(name, "f8", np.nan, meaning, _DIMENSIONS[:2], memories=memories)


_DECLARED = (
    _curve_variable("stiffness", "raw stiffness k / (E* L)", averaged=True),
    _curve_variable("depth", "depth since touch / h", averaged=True),
    _curve_variable(
        "area_fraction", "real over nominal contact area, cells in contact", averaged=True
    ),
    _curve_variable("area_fraction_corrected"),
    _curve_variable(
        "unloading_stiffness", "raw stiffness on unloading k_u / (E* L)", averaged=True
    ),
    _curve_variable("plastic_fraction", averaged=True),
    _curve_variable("indentation", "largest permanent indentation / h", averaged=True),
    _curve_variable("pulling_fraction", averaged=True),
    _curve_variable("work", "work done by the load / (E* h² L)", averaged=True),
    _curve_variable("dissipated_work", "work dissipated / (E* h² L)", averaged=True),
    _sliding_variable("slide", "slide along x since touch / h"),
    _sliding_variable("shear_stiffness", "dQ / d(slide) along x on further shear / (E* L)"),
    _sliding_variable("shear_stiffness_back", "dQ / d(slide) along x on turning back / (E* L)"),
    _sliding_variable("stick_fraction", "share of the contact that sticks"),
    _sliding_variable("dissipated", "energy dissipated by slip since the load before / (E* h² L)"),
    _curve_variable(
        "status", "0 converged, 1 stalled, 2 max_iterations, 3 no tangent, -1 not done"
    ),
    _curve_variable(
        "resolved",
        f"1 where at least {RESOLVED_FROM} springs or cells are in contact, -1 not done",
    ),
    _body_variable("rms_slope", "rms slope L / h of the grid, forward differences"),
    _body_variable("highest", "highest point above the mean / h"),
    _body_variable(
        "pull_off_force", "largest pull after the largest load / (E* h L), negative", "path"
    ),
)

VARIABLES = {variable.name: variable for variable in _DECLARED}
"""What is computed of each case, by name."""

CASE_STATUS = Variable(
    "case_status",
    "i1",
    PENDING,
    "0 not done, 1 done, 2 failed (reasons in the group's attribute failures)",
    _DIMENSIONS[:2],
)
"""The mark of each case."""

CASE_DIGEST = Variable(
    "case_digest",
    "i8",
    -1,
    "CRC-32 of D_f, realisation and all values of the case, -1 not done",
    _DIMENSIONS[:2],
)
"""What tells of each case whether its values are those that were computed."""

_COORDINATES = (
    Variable("fractal_dimension", "f8", np.nan, "D_f = 3 - H", _DIMENSIONS[:1]),
    Variable(
        "realisation",
        "i8",
        -1,
        "body i has the seed SeedSequence(seed, spawn_key=(i,))",
        _DIMENSIONS[1:2],
    ),
    Variable("force_bar", "f8", np.nan, QUANTITIES["force_bar"].long_name, _DIMENSIONS[2:]),
    Variable("shear_bar", "f8", np.nan, "shear force along x, Q / (E* h L)", _DIMENSIONS[2:]),
)

COORDINATES = {coordinate.name: coordinate for coordinate in _COORDINATES}
"""What the arrays are over, by name."""


def stored_variables(ensemble: Ensemble) -> list[Variable]:
    """Return what is kept of an ensemble.

    The reduced model gives no contact area, elastic bodies no indentation, others no pull, and
    bodies without friction no slide.
    """
    return [
        each
        for each in _DECLARED
        if (ensemble.model == "full" or each.of_lines)
        and (not each.memories or ensemble.memory in each.memories)
        and (not each.of_friction or ensemble.friction is not None)
    ]


def codecs() -> dict[str, Any]:
    """Return how chunks are compressed, and that they carry checksums."""
    from zarr.codecs import Crc32cCodec, ZstdCodec

    return {"compressors": (ZstdCodec(level=1), Crc32cCodec())}
