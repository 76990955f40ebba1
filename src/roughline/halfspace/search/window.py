"""A rectangle of the grid in which bodies are nearer than they can touch, solved by itself.

On a free half-space, displacements depend on distances alone, so a part of a grid has the operator
of its own shape. Where a law only pushes, nothing beyond it can touch: light loads pay for the part
in which they act.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Indices, InGrid, InWindow, Real
from roughline.computing.compiled import compiled
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.search.problem import Contact, ContactSet, Load, Method, Problem
from roughline.halfspace.search.turns import Turns

_FEWEST_POINTS = 32  # points along a side, where that has so many


@dataclass(frozen=True, eq=False)
class GridWindow:
    """A rectangle of the grid, which holds all nodes where the bodies are nearer than a reach."""

    problem: Problem
    rows: slice
    columns: slice
    reach: float  # beyond the least separation of the bodies as they are now [length]

    @classmethod
    def of(cls, problem: Problem, load: Load, start: ContactSet) -> GridWindow:
        """Return the window for a load: all of the grid, if the bodies may touch all over it.

        A side that is a period is not cut.
        """
        reach = problem.foreseen_reach(load, start)
        if reach == np.inf or any(problem.grid.half_space.repeats):
            return cls.everywhere(problem)
        shape = problem.separation.shape
        first_row, last_row, first_column, last_column = _ends(
            problem.separation, problem.touch + reach, start.nodes
        )
        rows = _side(first_row, last_row, shape[0])
        columns = _side(first_column, last_column, shape[1])
        window = cls(problem, rows, columns, reach)
        area = window.bodies.separation.size * problem.grid.cell_area
        # with room to spare, as nodes at an upper bound alone are no contact
        bears = load.force is None or problem.bounds.largest_force(area) > 2 * load.force
        return window if bears else cls.everywhere(problem)

    @classmethod
    def everywhere(cls, problem: Problem) -> GridWindow:
        """Return all of the grid."""
        nx, ny = problem.separation.shape
        return cls(problem, slice(0, nx), slice(0, ny), np.inf)

    @cached_property
    def bodies(self) -> Problem:
        """The bodies in the window."""
        here, problem = (self.rows, self.columns), self.problem
        separation = problem.separation[here]
        if separation.shape == problem.separation.shape:
            return problem
        return replace(
            problem,
            grid=replace(problem.grid, shape=separation.shape),
            separation=np.ascontiguousarray(separation),
            law=problem.law.on(lambda field: field[here]),
        )

    def turns(self, load: Load, start: ContactSet, method: Method) -> Turns:
        """Return the search in the window, which starts from a contact set of the grid."""
        nodes = InGrid(self.inside(start.nodes))  # the window is the grid of what is sought there
        start = replace(start, nodes=nodes)
        return Turns(self.bodies, load, start, method)

    def inside(self, nodes: InGrid) -> InWindow:
        """Return nodes of the grid as nodes of the window."""
        if self.bodies is self.problem:
            return InWindow(nodes)
        x, y = np.divmod(nodes, self.problem.separation.shape[1])
        x, y = x - self.rows.start, y - self.columns.start
        return InWindow(x * self.bodies.separation.shape[1] + y)

    def holds(self, contact: Contact) -> bool:
        """Whether nothing beyond the window can touch at the depth of a contact."""
        return self.problem.reach(contact.depth) <= self.reach

    def on_grid(self, nodes: InWindow) -> InGrid:
        """Return nodes of the window as nodes of the grid."""
        if self.bodies is self.problem:
            return InGrid(nodes)
        x, y = np.divmod(nodes, self.bodies.separation.shape[1])
        x, y = x + self.rows.start, y + self.columns.start
        return InGrid(x * self.problem.separation.shape[1] + y)

    def guess(self, turns: Turns) -> ContactSet:
        """Return the contact that a search in the window finds roughly, as one of the grid."""
        found = turns.guess()
        return replace(found, nodes=self.on_grid(InWindow(found.nodes)))

    def contact(self, turns: Turns) -> Contact:
        """Return the contact that a search in the window finds, as one of the grid."""
        found = turns.contact()
        if self.bodies is self.problem:
            return found
        problem, shape = self.problem, self.problem.separation.shape
        if found.separation is not self.bodies.separation:
            separation = problem.separation.copy()
            separation[self.rows, self.columns] = found.separation
            problem = replace(problem, separation=separation)
        looked_at = found.looked_at.indices if found.looked_at else np.arange(found.gaps.size)
        return replace(
            found,
            problem=problem,
            nodes=self.on_grid(InWindow(found.nodes)),
            looked_at=GridNodes.of(self.on_grid(InWindow(looked_at)), shape),
        )


@compiled
def _ends(separation: Real, reach: float, nodes: Indices) -> tuple[int, int, int, int]:
    """Return the first and last row and column with nodes within reach, or of these."""
    nx, ny = separation.shape
    first_row, last_row, first_column, last_column = nx, -1, ny, -1
    for x in range(nx):
        row, found = separation[x], False
        for y in range(ny):
            if row[y] <= reach:
                found = True
                first_column, last_column = min(first_column, y), max(last_column, y)
        if found:
            first_row, last_row = min(first_row, x), x
    for node in nodes:
        x, y = node // ny, node % ny
        first_row, last_row = min(first_row, x), max(last_row, x)
        first_column, last_column = min(first_column, y), max(last_column, y)
    return first_row, last_row, first_column, last_column


def _side(first: int, last: int, points: int) -> slice:
    """Return a part of a side, halved as often as may be, that holds points and neighbours.

    So there are few shapes, and their tables serve again.
    """
    first, last = max(0, first - 1), min(points, last + 2)
    length, least = points, max(last - first, _FEWEST_POINTS)
    while (half := -(-length // 2)) >= least:
        length = half
    start = min(max(0, first - (length - last + first) // 2), points - length)
    return slice(start, start + length)
