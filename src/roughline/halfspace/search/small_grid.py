"""The contact on a small grid of bodies that only push, by whole fields.

It is the primal-dual active set of :mod:`~roughline.halfspace.search.active_set` with few calls a
round, as on a small grid a call takes longer than its work. The equations of few nodes are solved
by a Cholesky factor; those of more by conjugate gradients, which the inverse convolution
preconditions. What is found here is certified as any other start is.
"""

from __future__ import annotations

import math
import threading

import numpy as np
from scipy.linalg import lapack

from roughline.computing.arrays import Indices, InGrid, Integers, Real, among
from roughline.computing.compiled import compiled, compiled_sums
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse, fill_triangle
from roughline.halfspace.operators.small_grid import SmallFields, SmallGrid
from roughline.halfspace.search.active_set import TOLERANCE_AIM
from roughline.halfspace.search.carriers import merged
from roughline.halfspace.search.patch import MOST_STEPS
from roughline.halfspace.search.problem import ContactSet, Load, Method, Problem
from roughline.halfspace.search.region import REACH_OF_ERROR

MOST_FACTORED_NODES = 300
"""Nodes up to which their equations are solved directly."""
_MOST_UNDER_HARD_LAYERS = 400  # of them where the inverse convolution is no inverse
_MOST_EXCHANGES = 30
_MOST_VAIN_EXCHANGES = 6  # without a new minimum of wrong nodes
_FEW_WRONG = 0.1  # part of the nodes in contact that may be wrong in a guess
_ROUGH_FROM = 1e-2  # tolerance of one
_MOST_AIMS = 8  # at the stiffness, each from the compliance that is known by then; one is enough
_RELIEF = 1e-3  # part of the most that a node bears by which it is relieved


class _Last(threading.local):
    """The last Cholesky factor of a thread, and of which nodes of which grid it is."""

    inverse: ApproximateInverse | None = None
    nodes: InGrid
    factor: Real


_last = _Last()


def contact_under(
    problem: Problem, load: Load, start: ContactSet, method: Method
) -> tuple[ContactSet | None, int]:
    """Return the contact under a load, and the convolutions that were spent.

    None where the grid is large, bodies pull or yield by a field, many nodes touch under a hard
    layer, of which the inverse convolution is no inverse, or nothing is found.
    """
    grid, bounds = problem.operator.small_grid, problem.bounds
    if grid is None or np.any(bounds.low) or np.ndim(bounds.high):
        return None, 0
    search = _SmallGridSearch(problem, grid, load, method)
    return search.from_start(start), search.convolutions


_APART, _TOUCHING, _PLASTIC = 0, 1, 2  # states of a node


class _SmallGridSearch:
    """Rounds in which the equations of the nodes that touch are solved, and wrong ones exchanged.

    Displacements and gaps count from the surfaces as they touch.
    """

    def __init__(self, problem: Problem, grid: SmallGrid, load: Load, method: Method) -> None:
        self._problem, self._grid, self._method = problem, grid.fields(), method
        self._inverse: ApproximateInverse = problem.inverse
        self._most = float(problem.bounds.high)  # that a node bears
        self._total = load.total(problem.grid.cell_area)
        self._approach = 0.0 if load.depth is None else load.depth - problem.touch
        self._above = problem.separation - problem.touch
        self._state = np.zeros(problem.separation.shape, dtype=np.int8)
        self._slack = 0.0  # gap up to which plastic nodes stay so [length]
        self.convolutions = 0

    def from_start(self, start: ContactSet) -> ContactSet | None:
        """Return the contact; None if it is not found."""
        is_plastic = start.pressure >= self._most
        bound = int(np.count_nonzero(is_plastic))
        if bound and self._total is not None and bound * self._most >= self._total:
            is_plastic[:] = False  # a start of bodies that do not yield
        self._state.reshape(-1)[start.nodes] = np.where(is_plastic, _PLASTIC, _TOUCHING)
        self._nodes, self._plastic = among(start.nodes, ~is_plastic), among(start.nodes, is_plastic)
        self._pressure = np.maximum(start.pressure[~is_plastic], 0.0)
        few = _FEW_WRONG if self._method.rtol >= _ROUGH_FROM else 0.0
        fewest, in_vain = math.inf, 0
        for _ in range(_MOST_EXCHANGES):
            count = self._nodes.size
            if not self._can_go_on():
                return None
            try:
                wrong, error, self._slack = self._solved()
            except np.linalg.LinAlgError:  # an elastic half-space is positive definite
                return None
            self._exchange()
            if wrong <= few * count and error <= self._slack:
                return self._contact()
            in_vain = 0 if wrong < fewest else in_vain + 1
            fewest = min(wrong, fewest)
            if in_vain > _MOST_VAIN_EXCHANGES:
                return None
        return None

    def _can_go_on(self) -> bool:
        """Whether a round is possible, and leaves a convolution for the certificate."""
        count, left = self._nodes.size, self._left
        round_takes = 2 if self._plastic.size else 1
        return (
            count > 0
            and (left is None or left > 0)
            and self.convolutions + round_takes < self._method.max_iterations
            and (_are_few(count, self._inverse) or not self._inverse.solves_blocks)
        )

    @property
    def _left(self) -> float | None:
        """Sum of the pressures on nodes that touch; None under a given depth."""
        if self._total is None or not self._plastic.size:
            return self._total
        return self._total - self._most * self._plastic.size

    def _contact(self) -> ContactSet:
        """Return the nodes under pressure, the pressures and the depth."""
        nodes, pressure = self._nodes, self._pressure
        if self._plastic.size:
            nodes, order = merged(nodes, self._plastic)
            pressure = np.append(pressure, np.full(self._plastic.size, self._most))[order]
        return ContactSet(nodes, pressure, self._approach + self._problem.touch)

    def _exchange(self) -> None:
        """List the nodes that touch now and those at the bound, with the pressures they have."""
        before, pressure, relieved = self._nodes, self._pressure, self._plastic
        self._nodes = InGrid(np.flatnonzero(self._state == _TOUCHING))
        self._pressure = _carried_over(before, pressure, self._nodes)
        if math.isfinite(self._most):
            self._plastic = InGrid(np.flatnonzero(self._state == _PLASTIC))
            high = np.full(relieved.size, (1 - _RELIEF) * self._most)
            self._pressure += _carried_over(relieved, high, self._nodes)

    def _moved(self) -> Real:
        """Return the displacement by the pressures, as a field of the grid."""
        grid, plastic = self._grid, self._plastic
        self.convolutions += 1
        grid.put(self._pressure, grid.places(self._nodes))
        if plastic.size:
            grid.source[grid.places(plastic)] = self._most
        grid.convolve(self._problem.operator.spectrum)
        return grid.result

    def _tolerance(self, displaced: float) -> float:
        """Return the error that is allowed, by the scales of the residuals. [length]"""
        problem, total = self._problem, float(self._pressure.sum())
        if self._plastic.size:
            total += self._most * self._plastic.size
        scale = max(displaced, problem.resolution * abs(total) * problem.grid.cell_area)
        scale = min(problem.rms_height, scale) if problem.rms_height else scale
        return TOLERANCE_AIM * self._method.rtol * scale

    def _solved(self) -> tuple[int, float, float]:
        """Solve the equations of the nodes that touch, and let wrong ones change their state.

        Return how many there are, the largest gap in contact, and what is allowed.
        """
        few = _are_few(self._nodes.size, self._inverse)
        return self._solved_directly() if few else self._led_by_gradients()

    def _solved_directly(self) -> tuple[int, float, float]:
        """Solve them by a Cholesky factor."""
        nodes, inverse = self._nodes, self._inverse
        factor = _factor(inverse, nodes)
        right = np.empty((nodes.size, 2), order="F")
        right[:, 0] = 1.0
        right[:, 1] = self._above.reshape(-1)[nodes]
        if self._plastic.size:
            self._pressure[:] = 0.0
            self._moved()
            right[:, 1] += self._grid.at(self._grid.places(nodes))
        solution, _ = lapack.dpotrs(factor, right, lower=1, overwrite_b=1)
        even, rest = (float(each) for each in solution.sum(axis=0))
        added, left = inverse.even_pressure_term, self._left  # the kernel displaces by more
        if left is not None:
            level = (left + rest) / even
            self._approach = level - added * left
        else:
            level = (self._approach - added * rest) / (1 - added * even)
        self._pressure = level * solution[:, 0] - solution[:, 1]
        wrong, error, displaced = _exchanged_by_gap(
            self._pressure,
            (nodes, self._plastic),
            (self._moved(), self._grid.width, self._above, self._approach),
            (self._most, self._slack),
            self._state,
        )
        return wrong, error, self._tolerance(displaced)

    def _led_by_gradients(self) -> tuple[int, float, float]:
        """Lead the pressures by conjugate gradients, until errors of the set outweigh their own."""
        left, pressure, grid = self._left, self._pressure, self._grid
        if left is not None and pressure.any():
            pressure *= left / pressure.sum()
        moved, places = self._moved(), grid.places(self._nodes)
        displaced = float(grid.at(grid.places(self._plastic)).max(initial=0.0))
        error, level, most_displaced = _missing(
            pressure,
            (self._nodes, places),
            (moved, self._above.reshape(-1)),
            left is not None,
            self._approach,
        )
        least = level + REACH_OF_ERROR * math.sqrt(float(error @ error) / error.size)
        beside, gap = _watched((moved, grid.width, self._above, self._plastic), self._state, least)
        gradients = Gradients(self._inverse, grid, self._nodes, pressure, error)
        watched = np.append(beside, self._plastic)
        gradients.watch(watched, gap, (self._inverse.diagonal, self._most, beside.size))
        gradients.level, tolerance = level, self._tolerance(max(displaced, most_displaced))
        spare = self._method.max_iterations - self.convolutions
        gradients.lead(tolerance, fixed=left is not None, most_steps=min(MOST_STEPS, spare))
        self.convolutions += gradients.steps
        self._approach = gradients.level
        wrong = _exchanged(
            pressure,
            (self._nodes, watched, beside.size),
            gap - gradients.level,
            (self._most, self._slack),
            self._state.reshape(-1),
        )
        return wrong, gradients.largest_error, tolerance


class Gradients:
    """Conjugate gradients on the nodes in contact of a small grid.

    They start from pressures and from what these miss of the displacement, and overwrite both. What
    other nodes are displaced by is computed for those that are watched.
    """

    def __init__(
        self,
        inverse: ApproximateInverse,
        grid: SmallFields,
        nodes: InGrid,
        pressure: Real,
        error: Real,
    ) -> None:
        around, self._inverse = inverse.small_inverse
        self.level = 0.0  # of the displacement, which a fixed total leaves open [length]
        self.largest_error = math.inf  # [length]
        self.energy = 0.0  # of the error, norm squared, by the preconditioner
        self.steps = 0  # each takes one convolution
        self._grid, self._spectrum = grid, inverse.operator.spectrum
        self._around = around.fields()
        self._places, self._places_around = grid.places(nodes), self._around.places(nodes)
        self._pressure, self._error = pressure, error
        # watched places, their gaps from any datum [length], and bounds
        self._watched: tuple[Indices, Real] = np.empty(0, dtype=np.intp), np.empty(0)
        self._bounds = 0.0, math.inf, 0

    def watch(self, watched: Indices, gap: Real, bounds: tuple[float, float, int]) -> None:
        """Watch nodes, and pressures beyond their bounds, as displacements at their own nodes.

        The gaps of the nodes are from any datum, and overwritten. The bounds are the diagonal of
        the operator, the most that a node bears, and how many of the watched nodes are without
        pressure; the others bear the most.
        """
        self._watched, self._bounds = (self._grid.places(watched), gap), bounds

    def lead(
        self,
        tolerance: float,
        *,
        fixed: bool,
        least_energy: float = 0.0,
        most_steps: int = MOST_STEPS,
    ) -> None:
        """Go on until errors are within a tolerance, or outweighed by those of the set.

        Or until their energy, by the preconditioner, is so small. With a fixed total the sum of the
        pressures stays, and the level follows. [pressure length]
        """
        grid, around, error = self._grid, self._around, self._error
        here, there = self._places_around, self._places
        direction = np.zeros_like(error)
        grid.source[:] = 0.0
        if fixed:
            mean = float(error.mean())
            error -= mean
            self.level -= mean
            self.largest_error = float(abs(error).max())
        around.put(error, here)
        while self.steps < most_steps:
            around.convolve(self._inverse)
            self.energy = _turned(
                (around.result, here), self.energy, error, direction, (grid.source, there), fixed
            )
            if self.energy <= least_energy:
                break
            grid.convolve(self._spectrum)
            rise, of_set, of_error, largest = _stepped(
                (direction, grid.result, there, self.energy),
                (fixed, self.level, *self._bounds),
                (self._pressure, error),
                self._watched,
                (around.source, here),
            )
            if largest < 0:  # nothing to gain
                break
            self.steps += 1
            self.level += rise
            self.largest_error = largest
            if largest <= tolerance or of_set > of_error:
                break


def _are_few(count: int, inverse: ApproximateInverse) -> bool:
    """Whether the equations of so many nodes are solved directly."""
    return count <= (_MOST_UNDER_HARD_LAYERS if inverse.solves_blocks else MOST_FACTORED_NODES)


def compliance(
    inverse: ApproximateInverse, nodes: InGrid, pressure: Real, accuracy: float
) -> tuple[float, int]:
    """Lead pressures of unit force, which are overwritten, to those that displace all nodes alike.

    Return the compliance, NaN where it is not found to such a part of itself, and the convolutions.
    """
    if _are_few(nodes.size, inverse):
        return _compliance_of_few(inverse, nodes, pressure, accuracy)
    if inverse.solves_blocks:
        return math.nan, 0
    cell_area, (grid, displacement) = (
        inverse.operator.cell_area,
        _displaced(inverse, nodes, pressure),
    )
    found, mean = float(pressure @ displacement), float(displacement.mean())
    error = np.subtract(mean, displacement, out=displacement)
    gradients = Gradients(inverse, grid, nodes, pressure, error)
    gradients.level = mean
    for _ in range(_MOST_AIMS):
        gradients.lead(0.0, fixed=True, least_energy=accuracy * found)
        found = float(pressure @ (gradients.level - error))
        if gradients.energy <= accuracy * found:
            return found * cell_area, 1 + gradients.steps
    return math.nan, 1 + gradients.steps


def _compliance_of_few(
    inverse: ApproximateInverse, nodes: InGrid, pressure: Real, accuracy: float
) -> tuple[float, int]:
    """Return the compliance of few nodes, from a Cholesky factor, and the convolutions."""
    factor, cell_area = _factor(inverse, nodes), inverse.operator.cell_area
    solution, _ = lapack.dpotrs(factor, np.ones(nodes.size), lower=1, overwrite_b=1)
    pressure[:] = solution / (solution.sum() * cell_area)
    _, moved = _displaced(inverse, nodes, pressure)
    found = float(pressure @ moved) * cell_area
    off = moved - moved.mean()
    rest, _ = lapack.dpotrs(factor, off, lower=1)
    return (found if float(off @ rest) * cell_area <= accuracy * found else math.nan), 1


def _displaced(
    inverse: ApproximateInverse, nodes: InGrid, pressure: Real
) -> tuple[SmallFields, Real]:
    """Return fields of the grid, and the displacement of nodes by pressures on them."""
    assert inverse.operator.small_grid is not None
    grid = inverse.operator.small_grid.fields()
    places = grid.places(nodes)
    grid.put(pressure, places)
    grid.convolve(inverse.operator.spectrum)
    return grid, grid.at(places)


def _factor(inverse: ApproximateInverse, nodes: InGrid) -> Real:
    """Return the Cholesky factor of the displacements of nodes under pressures on them.

    LinAlgError is raised if they are not positive definite.

    The last one is kept: the stiffness asks for that of the contact, and so does the next load.
    """
    if _last.inverse is inverse and np.array_equal(_last.nodes, nodes):
        return _last.factor
    rows, columns = np.divmod(nodes, inverse.operator.shape[1])
    matrix = np.empty((rows.size, rows.size))
    fill_triangle(inverse.kernel, rows, columns, matrix)
    factor, failed = lapack.dpotrf(matrix.T, lower=1, clean=0, overwrite_a=1)
    if failed:
        raise np.linalg.LinAlgError("the matrix is not positive definite")
    _last.inverse, _last.nodes, _last.factor = inverse, nodes, factor
    return factor


@compiled
def _carried_over(before: Indices, pressure: Real, nodes: Indices) -> Real:
    """Return pressures on other ascending nodes: zero on those that had none."""
    values, place = np.zeros(nodes.size), 0
    for i in range(nodes.size):
        while place < before.size and before[place] < nodes[i]:
            place += 1
        if place < before.size and before[place] == nodes[i]:
            values[i] = pressure[place]
    return values


@compiled
def _exchanged_by_gap(
    pressure: Real,
    nodes_and_plastic: tuple[Indices, Indices],
    lengths: tuple[Real, int, Real, float],
    limits: tuple[float, float],
    state: Integers,
) -> tuple[int, float, float]:
    """Let nodes that overlap join, those that pull leave, and those that bear too much yield.

    Plastic nodes of which the gap is more than a slack touch again. Lengths are displacements, with
    the width of their field, separations and the approach; limits are the most that a node bears,
    and the slack. Return how many have changed, the largest gap of those that touch, and the
    largest displacement.
    """
    (nodes, plastic), (moved, width, above, approach) = nodes_and_plastic, lengths
    (most, slack), columns = limits, state.shape[1]
    wrong, error, displaced = 0, 0.0, 0.0
    for x in range(state.shape[0]):
        row = moved[x * width : x * width + columns]
        for y in range(columns):
            if state[x, y] == 0 and row[y] + above[x, y] < approach:
                state[x, y] = 1
                wrong += 1
    for i in range(nodes.size):
        x, y = nodes[i] // columns, nodes[i] % columns
        here = moved[x * width + y]
        error = max(error, abs(here + above[x, y] - approach))
        displaced = max(displaced, here)
        if pressure[i] < 0 or pressure[i] > most:
            state[x, y] = 0 if pressure[i] < 0 else 2
            wrong += 1
    for node in plastic:
        x, y = node // columns, node % columns
        here = moved[x * width + y]
        displaced = max(displaced, here)
        if here + above[x, y] - approach > slack:
            state[x, y] = 1
            wrong += 1
    return wrong, error, displaced


@compiled_sums
def _missing(
    pressure: Real,
    at: tuple[Indices, Indices],
    lengths: tuple[Real, Real],
    fixed: bool,
    approach: float,
) -> tuple[Real, float, float]:
    """Return what displacements miss of the contact at nodes, by their places in the field.

    Return with it the level: the approach, or, with a fixed total, that of the work of the
    pressures; and the largest displacement.
    """
    (nodes, places), (moved, above) = at, lengths
    error = np.empty(nodes.size)
    work, total, displaced = 0.0, 0.0, 0.0
    for i in range(nodes.size):
        here = moved[places[i]]
        displaced = max(displaced, here)
        error[i] = here + above[nodes[i]]
        work += pressure[i] * error[i]
        total += pressure[i]
    level = approach
    if fixed:
        level = work / total if total > 0 else error.mean()
    for i in range(nodes.size):
        error[i] = level - error[i]
    return error, level, displaced


@compiled
def _watched(
    lengths: tuple[Real, int, Real, Indices], state: Integers, least: float
) -> tuple[Indices, Real]:
    """List the nodes without pressure whose gap from the datum is below a number.

    Lengths are displacements, with the width of their field, and separations. Return the nodes, and
    the gaps of them and of the plastic ones, which follow.
    """
    moved, width, above, plastic = lengths
    nodes, found, columns = np.empty(state.size, dtype=np.intp), 0, state.shape[1]
    gaps = np.empty(state.size)
    for x in range(state.shape[0]):
        row = moved[x * width : x * width + columns]
        for y in range(columns):
            gap = row[y] + above[x, y]
            if gap < least and state[x, y] == 0:
                nodes[found], gaps[found] = x * columns + y, gap
                found += 1
    count = found
    for node in plastic:
        x, y = node // columns, node % columns
        gaps[count] = moved[x * width + y] + above[x, y]
        count += 1
    return nodes[:found].copy(), gaps[:count].copy()


@compiled_sums
def _turned(
    inverted: tuple[Real, Indices],
    before: float,
    error: Real,
    direction: Real,
    source: tuple[Real, Indices],
    fixed: bool,
) -> float:
    """Let the direction be conjugate to the last one, and write it into a field.

    Fields come with the places of the nodes. The energy of the error is returned; the one before is
    zero at first. With a fixed total the mean of the direction is zero, as that of the error is.
    """
    (inverted_field, here), (field, there) = inverted, source
    energy = mean = 0.0
    for i in range(error.size):
        value = inverted_field[here[i]]
        energy += error[i] * value
        mean += value
    mean = mean / error.size if fixed else 0.0
    part = energy / before if before > 0 else 0.0
    for i in range(error.size):
        direction[i] = inverted_field[here[i]] - mean + part * direction[i]
        field[there[i]] = direction[i]
    return energy


@compiled_sums
def _stepped(
    step: tuple[Real, Real, Indices, float],
    conditions: tuple[bool, float, float, float, int],
    state: tuple[Real, Real],
    beyond: tuple[Indices, Real],
    source: tuple[Real, Indices],
) -> tuple[float, float, float, float]:
    """Go along a direction to the least energy.

    A step is the direction, the field that it displaces by, with the places of the nodes in it, and
    the energy of the error. Conditions are whether the total is fixed, the level, the diagonal of
    the operator, the most that a node bears, and how many watched nodes are without pressure. The
    state, pressures and errors, and the gaps at watched places are overwritten. The errors are
    written into a field, too. Return the rise of the level, the sums of the squared violations of
    the set and of the squared errors, and the largest error, negative where nothing is to be
    gained.
    """
    (direction, response, places, energy), (fixed, level, diagonal, most, beside) = step, conditions
    (pressure, error), (watched, gap), (field, here) = state, beyond, source
    curvature = 0.0
    for i in range(places.size):
        curvature += direction[i] * response[places[i]]
    if not (curvature > 0 and energy > 0):
        return 0.0, 0.0, 0.0, -1.0
    length, total = energy / curvature, 0.0
    for i in range(places.size):
        pressure[i] += length * direction[i]
        error[i] -= length * response[places[i]]
        total += error[i]
    rise = -total / places.size if fixed else 0.0
    of_set, of_error, largest = 0.0, 0.0, 0.0
    for i in range(places.size):
        error[i] += rise
        field[here[i]] = error[i]
        of_error += error[i] ** 2
        largest = max(largest, abs(error[i]))
        of_set += (diagonal * (min(pressure[i], 0.0) + max(pressure[i] - most, 0.0))) ** 2
    for i in range(watched.size):
        gap[i] += length * response[watched[i]]
        off = gap[i] - level - rise
        of_set += (min(off, 0.0) if i < beside else max(off, 0.0)) ** 2
    return rise, of_set, of_error, largest


@compiled
def _exchanged(
    pressure: Real,
    places: tuple[Indices, Indices, int],
    gap: Real,
    limits: tuple[float, float],
    state: Integers,
) -> int:
    """Let wrong nodes change their state, as above, by the gaps of watched ones.

    Places are the nodes that touch, the watched ones, and how many of these are without pressure;
    the others are plastic.
    """
    (nodes, watched, beside), (most, slack), wrong = places, limits, 0
    for i in range(nodes.size):
        if pressure[i] < 0 or pressure[i] > most:
            state[nodes[i]] = 0 if pressure[i] < 0 else 2
            wrong += 1
    for i in range(watched.size):
        if gap[i] < 0 if i < beside else gap[i] > slack:
            state[watched[i]] = 1
            wrong += 1
    return wrong
