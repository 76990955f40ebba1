"""What pressing a surface will cost in memory and time."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np

# Most memory that a path of loads held at any time, and the fields of one load, as measured (see
# docs/speed.md). Periodic surfaces were pressed nearly to full contact, where all nodes have
# vectors; free ones up to saturation. Near full contact these take a quarter more.
# [bytes per point]
_BYTES = 96
_BYTES_PERIODIC = 170
_BYTES_OF_FIELDS = 34
# More where half of a surface is indented, as by the last of spaced loads; a free surface that is
# all but flattened takes 75 more than that.
_BYTES_OF_YIELD = 80
# A load with its stiffness takes as long as so many convolutions of whole fields, on average over a
# path. It does some 35, most of them in single precision and on a part of the rows.
_CONVOLUTIONS = 20
_SECONDS_AT_LEAST = 1e-3  # of a load, on any grid [s]
_PROBE = 512  # points along a side of the grid that is timed


@dataclass(frozen=True)
class Estimate:
    """Cost of pressing a surface.

    Attributes
    ----------
    memory : int
        Largest memory beside the surface and the interpreter. [bytes]
    seconds : float
        Time on this machine, known to a factor of two or three. [s]
    """

    memory: int
    seconds: float

    def __str__(self) -> str:
        return f"about {self.memory / 1e9:.2g} GB and {_duration(self.seconds)}"


def estimate(
    shape: tuple[int, int],
    n_loads: int,
    *,
    periodic: bool = False,
    fields: bool = False,
    yielding: bool = False,
) -> Estimate:
    """Estimate what pressing a surface with the full model will cost.

    Convolutions are timed on a small grid, which takes some hundredths of a second.

    Parameters
    ----------
    shape : tuple of int
        Points of the surface, (nx, ny).
    n_loads : int
        Number of loads.
    periodic : bool, optional
        Whether the surface is repeated.
    fields : bool, optional
        Whether the fields of every load are kept.
    yielding : bool, optional
        Whether the surface is pressed with a hardness, which takes more memory.

    Returns
    -------
    Estimate
        Memory [bytes] and time [s].
    """
    # compiled loops load slowly, so only here
    from roughline.halfspace.half_space import HalfSpace
    from roughline.halfspace.operator import displacement_field

    operator = HalfSpace(1.0, periodic).operator((_PROBE, _PROBE), (1.0, 1.0))
    pressure = np.ones(operator.shape)
    displacement_field(operator, pressure)  # compiles
    probes = []
    for _ in range(3):
        start = time.perf_counter()
        displacement_field(operator, pressure)
        probes.append(time.perf_counter() - start)
    points = shape[0] * shape[1]
    growth = points / _PROBE**2 * math.log(points + 1) / math.log(_PROBE**2)
    return Estimate(
        memory_for(shape, periodic, n_loads if fields else 0, yielding=yielding),
        n_loads * (_SECONDS_AT_LEAST + _CONVOLUTIONS * growth * min(probes)),
    )


def memory_for(
    shape: tuple[int, int], periodic: bool, kept_fields: int, *, yielding: bool = False
) -> int:
    """Return the memory that pressing a surface takes, beside the surface. [bytes]"""
    bytes_ = _BYTES_PERIODIC if periodic else _BYTES
    bytes_ += _BYTES_OF_YIELD if yielding else 0
    return shape[0] * shape[1] * (bytes_ + _BYTES_OF_FIELDS * kept_fields)


def _duration(seconds: float) -> str:
    for size, unit in ((3600, "h"), (60, "min")):
        if seconds >= size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.2g} s"
