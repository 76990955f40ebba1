"""Names of the array types that signatures use."""

from __future__ import annotations

from typing import NewType, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]  # numbers in double precision
Single = NDArray[np.float32]  # numbers in single precision
Indices = NDArray[np.intp]  # positions in another array
Mask = NDArray[np.bool_]  # true for what is chosen
# Nodes are told by their places in four lists, which a type checker keeps apart.
InGrid = NewType("InGrid", Indices)  # in a grid, row by row
InWindow = NewType("InWindow", Indices)  # in a window of a grid, row by row
InRegion = NewType("InRegion", Indices)  # among the nodes of a region
InPatch = NewType("InPatch", Indices)  # among the nodes under pressure
Floats = NDArray[np.floating]  # numbers in single or double precision
Integers = NDArray[np.integer]  # whole numbers of any width

_Places = TypeVar("_Places", bound=Indices)


def among(places: _Places, chosen: Mask | Indices | slice) -> _Places:
    """Return some of the places, which stay places in the same list."""
    return cast("_Places", places[chosen])
