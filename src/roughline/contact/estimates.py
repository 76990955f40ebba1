"""What pressing a surface will cost in memory and time."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from roughline.contact.arguments import (
    checked_count,
    checked_shape,
    kept_loads,
)
from roughline.contact.full_contact import in_full_contact
from roughline.contact.loads import Loads
from roughline.errors.checks import between, flag, refuse
from roughline.errors.public import public_names
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, given_periodic
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import farthest_pulled
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.topography.body import Surface

# Beside what the operator is asked for: the separation, a trial's field and the coarser grids, on
# each point; and what lists and vectors of the contact were measured to take, for each of its nodes
# (docs/measured.md). Lists are long where steps are restricted to nodes near the contact; with
# more contact than that there are vectors alone. [bytes]
_POINT_BYTES = 18
_NEAR_CONTACT_BYTES = 210
_MUCH_CONTACT_BYTES = 70, 18  # on each point, and for each node in contact
_FIELDS_BYTES = {False: 26, True: 30}  # of one load, elastic and yielding
# Where bodies pull: the bounds of each point, and for each node within reach its share, what it was
# in the last rounds, and what it takes as one that bears pressure. All nodes bear a pull without an
# end, but few of them so much that they are led in rounds. Measured on 1024 points a side.
_PULL_BYTES = 10, 130
_ENDLESS_PULL_BYTES = 75
_YIELD_BYTES = 28  # where several loads leave a surface behind
_DENTS_BYTES = 30  # and for each node in contact
# Where pressure may displace a free surface towards the other body, as beside a layer, all of it is
# looked at. Where layers bend as plates, there are tables of small blocks. On 1024 and 2048 points
# a side soft layers were measured to take 8 to 12 bytes more than homogeneous bodies do under light
# loads, and nothing more under heavy ones; free plates take 23 to 25.
_ALL_PLACES_BYTES = 12
# Of small grids that lead a grid: on each point of a small one, and of a larger one at most.
_SMALL_GRIDS_BYTES = 150, {False: 1.5e6, True: 2e6}
_FEW_POINTS = 2**16  # of a grid whose small grids hold contacts of fewer nodes
_SMALL_CONTACT_BYTES = 2.2e6, 9e6  # and of full contact on them: of a free grid, and one repeated
_GRIDS_FACTOR = 4 / 3  # coarser grids that lead a grid, and itself
_MEMORY_MARGIN = 1.15  # times as much, so that what is told covers what was measured
_PROCESS_BYTES = 228_000_000  # of the interpreter and its libraries
_HEIGHT_BYTES = 8
# Largest share in contact where it is not known: that at saturation, free and periodic.
_SATURATED_FROM = 0.2
_FULL_CONTACT_FROM = 1.0
_SLOPE_FACTOR = 1.6  # Persson's theory has sqrt(2), and has too little in contact under small loads
# A load with its stiffness takes as long as so many convolutions of whole fields, on average over a
# path, most of it for steps that are restricted to the contact.
_CONVOLUTIONS = 14
TIMES_WITH_FRICTION = {False: 3, True: 26}
"""As long as so many loads without friction one with it takes, with both tangents, of uncoupled and
of coupled bodies: as `make friction-speed` measured on 512 points a side."""

# How shear displaces, of uncoupled and of coupled bodies, and for each node in contact what steps
# and tangents keep of it, as measured on 256 and 512 points a side; the way that each point has
# slipped; of each load whose fields are kept its shear, slip, way and stick.
_SHEAR_BYTES = {False: (45, 650), True: (185, 2000)}
_SLIPPED_BYTES, _SLIDING_FIELDS_BYTES = 8, 41
_SHORTEST_SECONDS = 1e-3  # of a load, on any grid [s]
_PROBE_POINTS = 512  # points along a side of the grid that is timed


@dataclass(frozen=True)
class Estimate:
    """Cost of pressing a surface.

    Attributes
    ----------
    memory : int
        Largest memory of the whole process: the interpreter and its libraries, the surface, and
        what the loads take. [bytes]
    seconds : float
        Time on this machine, known to a factor of two or three. [s]
    """

    memory: int
    seconds: float

    def __str__(self) -> str:
        return f"about {gigabytes(self.memory)} and {duration(self.seconds)}"


@public_names
def estimate(
    shape: tuple[int, int],
    n_loads: int,
    *,
    periodic: Periodic = False,
    fields: bool | Sequence[int] = False,
    yielding: bool = False,
    area_fraction: float | None = None,
    law: ContactLaw | None = None,
    friction: bool | Literal["coupled"] = False,
) -> Estimate:
    """Estimate what pressing a surface with the full model will cost.

    Convolutions are timed on a small grid, which takes some hundredths of a second. Half-spaces are
    homogeneous ones, or soft layers on a harder base, which take about the same. A layer far harder
    than its base may take 25 bytes more for each point, and many times as long.

    Parameters
    ----------
    shape : tuple of int
        Points of the surface, (nx, ny).
    n_loads : int
        Number of loads.
    periodic : bool, "x" or "y", optional
        Whether the surface is repeated: along both axes, none, or the one that is named.
    fields : bool or sequence of int, optional
        Whether the fields of every load are kept, or the numbers of the loads whose fields are, as
        for :func:`press`.
    yielding : bool, optional
        Whether the surface is pressed with a hardness, which takes more memory.
    area_fraction : float, optional
        Largest share of the surface that will be in contact, from 0 to 1; nodes in contact take
        most of the memory where there are many. Default: up to saturation of a free surface (0.2),
        all of one that is repeated. [1]
    law : ContactLaw, optional
        As for :func:`press`. One that pulls takes more memory, all of the surface being within
        reach at worst, and three to six times as long as the time that is given.
    friction : bool or "coupled", optional
        Whether the loads have friction, which takes more memory and several times as long; far
        longer of coupled bodies, whose pressures and shear move each other.

    Returns
    -------
    Estimate
        Memory [bytes] and time [s].

    Raises
    ------
    InputError
        If an argument is not what is described here.

    Examples
    --------
    >>> import roughline as rl
    >>> told = rl.estimate((4096, 4096), n_loads=20)
    >>> print(told.memory > 8 * 4096**2, told.seconds > 0)
    True True
    """
    shape, n_loads = checked_shape(shape), checked_count("n_loads", n_loads, 1)
    periodic, yielding = given_periodic("periodic", periodic), flag("yielding", yielding)
    law, kept = _checked_law(law), len(kept_loads(fields, n_loads))
    if area_fraction is not None:
        share = "a share of the surface from 0 to 1 is needed"
        area_fraction = between("area_fraction", area_fraction, 0.0, 1.0, share)
    given: dict[str, Any] = {"several": n_loads > 1, "area_fraction": area_fraction}
    coupled = friction == "coupled"
    if not (isinstance(friction, bool) or coupled):
        refuse("friction", friction, 'True, False or "coupled" is needed')
    besides = bytes_of_pull(law, 1.0)
    if friction:
        most = most_in_contact(periodic) if area_fraction is None else area_fraction
        besides += bytes_of_shear(kept, most, coupled=coupled)
    given |= {"yielding": yielding or law.memory == "dents", "besides": besides}
    pressing = memory_for(shape, periodic, kept, **given)
    memory = _PROCESS_BYTES + _HEIGHT_BYTES * shape[0] * shape[1] + pressing
    seconds = _SHORTEST_SECONDS + _CONVOLUTIONS * _convolution_seconds(shape, periodic)
    times = TIMES_WITH_FRICTION[coupled] if friction else 1
    return Estimate(memory, n_loads * times * seconds)


def _checked_law(law: ContactLaw | None) -> ContactLaw:
    """Return a law that bodies obey; they are elastic where none is given."""
    if law is None:
        return Unilateral()
    if not isinstance(law, ContactLaw):
        refuse("law", law, "a contact law is needed, such as rl.Dugdale(work_of_adhesion, range)")
    if math.isinf(Bounds.of(law).largest_pull):
        refuse("law", law, "no grid resolves it: a law with a range is needed, such as rl.Dugdale")
    return law


def _convolution_seconds(shape: tuple[int, int], periodic: Periodic) -> float:
    """Return how long a convolution of whole fields takes, from the time of a small one. [s]"""
    # compiled loops load slowly, so only here
    from roughline.halfspace.operators.convolution import displacement_field
    from roughline.halfspace.operators.discretisation import on_grid

    operator = on_grid(Homogeneous(1.0, periodic), (_PROBE_POINTS, _PROBE_POINTS), (1.0, 1.0))
    pressure = np.ones(operator.shape)
    displacement_field(operator, pressure)  # compiles
    probes = []
    for _ in range(3):
        start = time.perf_counter()
        displacement_field(operator, pressure)
        probes.append(time.perf_counter() - start)
    points = shape[0] * shape[1]
    return (
        min(probes) * points / _PROBE_POINTS**2 * math.log(points + 1) / math.log(_PROBE_POINTS**2)
    )


def memory_for(
    shape: tuple[int, int],
    periodic: Periodic,
    kept_fields: int,
    *,
    yielding: bool = False,
    several: bool = True,
    area_fraction: float | None = None,
    besides: float = 0.0,
) -> int:
    """Return the memory that pressing a surface takes beside the surface, with a margin. [bytes]

    What layers and a pull take besides is added. [bytes/point]
    """
    share = most_in_contact(periodic) if area_fraction is None else area_fraction
    held = bytes_at_a_point(shape, periodic, share, yielding=yielding, several=several)
    points, (on_each, at_most) = shape[0] * shape[1], _SMALL_GRIDS_BYTES
    most = at_most[points > _FEW_POINTS]
    most += share * _SMALL_CONTACT_BYTES[bool(periodic)]
    held += besides + min(on_each, most / points)
    return points * round(_MEMORY_MARGIN * held + _FIELDS_BYTES[yielding] * kept_fields)


def most_in_contact(periodic: Periodic) -> float:
    """Return the largest share in contact where it is not known: that at saturation."""
    return _FULL_CONTACT_FROM if periodic else _SATURATED_FROM


def bytes_at_a_point(
    shape: tuple[int, int], periodic: Periodic, share: float, *, yielding: bool, several: bool
) -> float:
    """Return what a press with this share in contact holds, over the points, as it was measured."""
    from roughline.halfspace.operators.discretisation import bytes_on_grid

    held = _POINT_BYTES + bytes_on_grid(shape, periodic=periodic) / (shape[0] * shape[1])
    at_least, more = _MUCH_CONTACT_BYTES
    held += min(_NEAR_CONTACT_BYTES * share, at_least + more * share)
    if yielding and several:  # the surface is kept as loads have left it
        held += _YIELD_BYTES + _DENTS_BYTES * share
    return held


def bytes_of_layers(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> float:
    """Return what a half-space that has a length takes in addition. [bytes/point]"""
    from roughline.halfspace.inverse.approximate_inverse import bends_as_plates
    from roughline.halfspace.operators.discretisation import empty_on_grid

    held = 0.0
    if not (all(half_space.repeats) or half_space.is_pushed_everywhere):
        held += _ALL_PLACES_BYTES
    operator = empty_on_grid(half_space, shape, spacing)
    if bends_as_plates(operator):
        held += _GRIDS_FACTOR * operator.spectrum.nbytes / (shape[0] * shape[1])
    return held


def bytes_of_pull(law: ContactLaw, share: float) -> float:
    """Return what a law takes in addition with such a share of nodes within reach. [bytes/point]"""
    if law.only_pushes:
        return 0.0
    if math.isinf(law.cutoff):
        return _ENDLESS_PULL_BYTES
    of_point, of_node = _PULL_BYTES
    return of_point + of_node * share


def bytes_of_shear(kept_fields: int, share: float, *, coupled: bool) -> float:
    """Return what friction takes in addition with such a share in contact. [bytes/point]

    It is with what it adds to fields.
    """
    of_point, of_node = _SHEAR_BYTES[coupled]
    held = of_point + of_node * share
    return held + _SLIPPED_BYTES + _SLIDING_FIELDS_BYTES * kept_fields


def expected_area_fraction(
    surface: Surface, half_space: HalfSpace, loads: Loads, law: ContactLaw
) -> float:
    """Estimate the largest share of a surface that its loads bring into contact or reach. [1]

    For forces, the share follows from Persson's theory, with a factor fitted to computed surfaces,
    or from the pressures that nodes bear where that gives more. For depths, it is the share of the
    heights within reach, doubled where the half-space repeats, as is found near full contact. How
    near forces bring bodies that pull is not known before.
    """
    largest = float(loads.values.max())
    if loads.control == "depths":
        farthest = surface.heights.max() - largest - farthest_pulled(law)
        reached = np.count_nonzero(surface.heights > farthest)
        return min(
            1.0, (2.0 if any(half_space.repeats) else 1.0) * float(reached) / surface.heights.size
        )
    if not law.only_pushes:
        return _FULL_CONTACT_FROM
    slope, pressure = in_full_contact(surface, half_space).rms_slope, largest / surface.area
    share = math.erf(_SLOPE_FACTOR * pressure / (half_space.E_star * slope)) if slope else 1.0
    return max(share, min(largest / Bounds.of(law).largest_force(surface.area), 1.0))


def gigabytes(memory: int) -> str:
    """Return memory in words, to two digits."""
    size = memory / 1e9
    return f"{size:.0f} GB" if size >= 100 else f"{size:.2g} GB"


def duration(seconds: float) -> str:
    """Return a time in words, to two digits."""
    for size, unit in ((3600, "h"), (60, "min")):
        if seconds >= size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.2g} s"
