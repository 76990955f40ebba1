"""The pressure in a network of conductances on a grid, by nested dissection.

The plane is cut into small rectangles of cells. Each is condensed into conductances between the
faces on its border, and two neighbours into those of their union, until nothing is left but faces
whose pressure is known: inlet and outlet, or, of a network that repeats both ways, one face of each
part. The way back gives the pressures [1].

All conductances are sums of positive terms, and a pivot is the sum of a row, never a difference
[2]. So the conductance of the whole, and the pressures, are accurate to the last digits however
small the last channel is, where a residual says nothing.

References
----------
.. [1] George, A. Nested dissection of a regular finite element mesh. SIAM J. Numer. Anal. 10,
   345-363 (1973).
.. [2] Grassmann, W. K., Taksar, M. I., Heyman, D. P. Regenerative analysis and steady state
   distributions for Markov chains. Oper. Res. 33, 1107-1116 (1985).
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import chain, pairwise, product

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.computing.compiled import compiled
from roughline.computing.cores import available_cores
from roughline.computing.linear_algebra import on_one_thread
from roughline.fluid.gap import MOST_KEPT

_INLET, _OUTLET = 0, 1  # numbers of these two among the faces

_FLOW_ROUNDING = 64 * np.finfo(float).eps  # of a sum of flows, over that

_RECTANGLE_CELLS = 16  # cells a side of the rectangles that are condensed cell by cell

_FACES_AT_ONCE = 256  # faces that are eliminated together


@dataclass(frozen=True, eq=False)
class Network:
    """Cells of a grid, each joined to its four faces.

    Attributes
    ----------
    cells : ndarray, shape (nx, ny)
        Conductance of a square cell; zero where it is closed.
    along, across : float
        Conductance of a cell over that of a square one, along the flow and across it.
    repeats_along : bool
        Whether the first and the last row are neighbours; if not, the inlet is before the first
        row, and the outlet behind the last.
    repeats_across : bool
        Whether the first and the last column are neighbours; if not, both borders are closed.
    """

    cells: Real
    along: float
    across: float
    repeats_along: bool
    repeats_across: bool

    def conductances(self) -> tuple[Real, Real]:
        """Conductances between neighbours, (nx + 1, ny) along the flow and (nx, ny + 1) across.

        The first and the last row join cells to the inlet and to the outlet, by half a cell, or are
        one and the same.
        """
        k = self.cells
        along = np.empty((k.shape[0] + 1, k.shape[1]))
        along[0], along[1:-1], along[-1] = 2 * k[0], _in_series(k[:-1], k[1:]), 2 * k[-1]
        if self.repeats_along:
            along[0] = along[-1] = _in_series(k[-1], k[0])
        across = np.zeros((k.shape[0], k.shape[1] + 1))
        across[:, 1:-1] = _in_series(k[:, :-1], k[:, 1:])
        if self.repeats_across:
            across[:, 0] = across[:, -1] = _in_series(k[:, -1], k[:, 0])
        return self.along * along, self.across * across

    def pressures(self) -> Real:
        """Pressures of the cells with 1 at the inlet, and with 1 at the outlet, (2, nx, ny).

        Their sum is 1 in open cells. Each is accurate relative to itself. All cells that are open
        have to be joined to inlet and outlet.
        """
        ends = np.full((2, *self.cells.shape), -1)
        dissection = _Dissection.of(self, ends[0], ends[1], retained=2)
        return dissection.solved(np.zeros((*self.cells.shape, 2)), lambda _: np.eye(2))

    def response(self, into: Real, grounds: tuple[Indices, Indices], parts: Indices) -> Real:
        """Pressures of the cells under flows into them and out of them, (2, columns, nx, ny).

        Nothing ends, and what flows into a part, flows out of it. The pressure is the difference of
        both, of which each is accurate relative to itself.

        Parameters
        ----------
        into : ndarray, shape (columns, nx, ny)
            Flow into each cell.
        grounds : tuple of ndarray, shapes (nx, ny)
            Numbers of faces before cells, along the flow and across, that are kept to the end; -1
            of all others. They lie on the borders of rectangles (:meth:`borders`). One in each part
            is enough; where a place that winds by itself hangs on others by a thread, what flows
            within it is accurate only if it has one as well.
        parts : ndarray, shape (grounds,)
            Part of each of these. The pressure at the first one of a part is zero.
        """
        columns = into.shape[0]
        signed = np.concatenate([np.maximum(into, 0.0), np.maximum(-into, 0.0)])

        def ground_pressures(last: _Block) -> Real:
            """Pressures at the grounds, of which those of positive flows hold those of all."""
            inward, outward = last.sources[:, :columns], last.sources[:, columns:]
            net = inward - outward
            net[np.abs(net) <= _FLOW_ROUNDING * (inward + outward)] = 0.0  # nothing but rounding
            held = np.zeros((parts.size, 2 * columns))
            of_faces = parts[last.faces]
            free = np.ones(last.faces.size, bool)
            free[np.unique(of_faces, return_index=True)[1]] = False
            if free.any():
                g = last.conductances
                lower = _inverse_factor(g[np.ix_(free, free)], g[np.ix_(free, ~free)].sum(axis=1))
                held[last.faces[free], :columns] = lower.T @ (lower @ net[free])
            return held

        dissection = _Dissection.of(self, *grounds, retained=parts.size)
        found = dissection.solved(np.ascontiguousarray(np.moveaxis(signed, 0, 2)), ground_pressures)
        return found.reshape(2, columns, *self.cells.shape)

    def borders(self) -> tuple[Mask, Mask]:
        """Faces before cells, along the flow and across, that are on the border of a rectangle."""
        masks = np.zeros((2, *self.cells.shape), bool)
        masks[0, _cuts(self.cells.shape[0], self.repeats_along)[:-1]] = True
        masks[1, :, _cuts(self.cells.shape[1], self.repeats_across)[:-1]] = True
        return masks[0], masks[1]


def _in_series(first: Real, second: Real) -> Real:
    """Conductance between the middles of two neighbours: the harmonic mean, or zero."""
    both = first + second
    return 2 * first * np.divide(second, both, out=np.zeros_like(both), where=both > 0)


@dataclass(frozen=True, eq=False)
class _Block:
    """A rectangle, condensed: the open faces on its border, and the conductances between them."""

    faces: Indices  # (m,), ascending
    conductances: Real  # (m, m); the diagonal means nothing
    sources: Real  # flows into the faces, (m, columns)


@dataclass(frozen=True, eq=False)
class _Condensed:
    """A rectangle, condensed, and how the pressures of its cells follow from those of its faces."""

    block: _Block
    shares: Real  # and the two below as :func:`_eliminate_cells` gives them
    driven: Real
    slots: Indices

    def pressures(self, of_faces: Real, rows: int, columns: int) -> Real:
        """Pressures of the cells from those of all faces."""
        of_border = of_faces[self.block.faces]
        return _follow_cells(self.shares, self.driven, self.slots, of_border, rows, columns)


@dataclass(frozen=True, eq=False)
class _Elimination:
    """How the pressures of faces between two blocks follow from those on the border of both."""

    inner: Indices
    outer: Indices
    lower: Real  # inverse of the Cholesky factor of the inner faces
    upper: Real  # that times the conductances from inner to outer faces
    driven: Real  # and times the flows into the inner faces

    def descend(self, pressures: Real) -> None:
        """Set the pressures of the inner faces."""
        pressures[self.inner] = self.lower.T @ (self.upper @ pressures[self.outer] + self.driven)


@dataclass(frozen=True, eq=False)
class _Dissection:
    """A network whose cells lie in a tree of rectangles."""

    network: Network
    rows: Indices  # where the smallest rectangles begin and end
    columns: Indices
    along: Indices  # numbers of faces along the flow, (nx + 1, ny); -1 where one is closed
    across: Indices  # and across it, (nx, ny + 1)

    retained: int  # faces with smaller numbers are kept to the end

    @classmethod
    def of(cls, network: Network, along: Indices, across: Indices, retained: int) -> _Dissection:
        """Cut a network, and number the faces between two open cells.

        Faces before cells that are kept have their numbers already, all others -1.
        """
        nx, ny = network.cells.shape
        open_cells = network.cells > 0
        of_along = np.arange((nx + 1) * ny).reshape(nx + 1, ny) + retained
        of_across = np.arange(nx * (ny + 1)).reshape(nx, ny + 1) + retained + of_along.size
        of_along[:-1][along >= 0] = along[along >= 0]
        of_across[:, :-1][across >= 0] = across[across >= 0]
        open_along = np.ones(of_along.shape, bool)
        open_along[:-1] &= open_cells
        open_along[1:] &= open_cells
        open_across = np.zeros(of_across.shape, bool)
        open_across[:, 1:-1] = open_cells[:, 1:] & open_cells[:, :-1]
        # one and the same where the plane repeats
        if network.repeats_along:
            of_along[-1] = of_along[0]
            open_along[0] = open_along[-1] = open_cells[0] & open_cells[-1]
        else:
            of_along[0], of_along[-1] = _INLET, _OUTLET
        if network.repeats_across:
            of_across[:, -1] = of_across[:, 0]
            open_across[:, 0] = open_across[:, -1] = open_cells[:, 0] & open_cells[:, -1]
        return cls(
            network,
            _cuts(nx, network.repeats_along),
            _cuts(ny, network.repeats_across),
            np.where(open_along, of_along, -1),
            np.where(open_across, of_across, -1),
            retained,
        )

    def solved(self, sources: Real, retained_pressures: Callable[[_Block], Real]) -> Real:
        """Pressures of the cells, (columns, nx, ny), under flows into them.

        Those at the faces that are kept follow from all, condensed into what is between these.
        """
        with on_one_thread(), ThreadPoolExecutor(available_cores()) as pool:
            return self._solved(sources, retained_pressures, pool)

    def _solved(
        self, sources: Real, retained_pressures: Callable[[_Block], Real], pool: ThreadPoolExecutor
    ) -> Real:
        corners = list(product(pairwise(self.rows), pairwise(self.columns)))
        keeps = self.network.cells.size <= MOST_KEPT
        condensed = list(pool.map(lambda each: self._condensed(each, sources, keeps), corners))
        blocks = [each.block for each in condensed]
        shape = self.rows.size - 1, self.columns.size - 1
        steps: list[_Elimination] = []
        while len(blocks) > 1:
            grid = np.empty(len(blocks), object)
            grid[:] = blocks
            grid = grid.reshape(shape)
            if shape[0] >= shape[1]:
                pairs = zip(grid[::2].ravel(), grid[1::2].ravel(), strict=True)
                shape = shape[0] // 2, shape[1]
            else:
                pairs = zip(grid[:, ::2].ravel(), grid[:, 1::2].ravel(), strict=True)
                shape = shape[0], shape[1] // 2
            joined = pool.map(lambda pair: _joined(pair[0], pair[1], self.retained), pairs)
            blocks, new = map(list, zip(*joined, strict=True))
            steps += chain.from_iterable(new)
        of_faces = np.zeros((self.retained + self.along.size + self.across.size, sources.shape[2]))
        of_faces[: self.retained] = retained_pressures(blocks[0])
        for step in reversed(steps):
            step.descend(of_faces)
        pressures = np.empty((sources.shape[2], *self.network.cells.shape))

        def spread(corner: _Rectangle, known: _Condensed) -> None:
            found = known if keeps else self._condensed(corner, sources, keeps=True)
            (i, i_end), (j, j_end) = corner
            pressures[:, i:i_end, j:j_end] = found.pressures(of_faces, i_end - i, j_end - j)

        list(pool.map(spread, corners, condensed))
        return pressures

    def _border(self, corner: _Rectangle) -> tuple[Indices, list[Indices]]:
        """Open faces of a rectangle, and where each of its border lies among them, or -1."""
        (i, i_end), (j, j_end) = corner
        faces = (
            self.along[i, j:j_end],
            self.along[i_end, j:j_end],
            self.across[i:i_end, j],
            self.across[i:i_end, j_end],
        )
        numbers, places = np.unique(np.concatenate(faces), return_inverse=True)
        closed = int(numbers.size > 0 and numbers[0] < 0)
        ends = np.cumsum([face.size for face in faces])[:-1]
        return numbers[closed:], np.split(places - closed, ends)

    def _condensed(self, corner: _Rectangle, sources: Real, keeps: bool) -> _Condensed:
        """A rectangle, condensed; how the pressures of its cells follow only if that is kept."""
        (i, i_end), (j, j_end) = corner
        numbers, (before, behind, left, right) = self._border(corner)
        conductances, into, shares, driven, slots = _eliminate_cells(
            self.network.cells[i:i_end, j:j_end],
            sources[i:i_end, j:j_end],
            (self.network.along, self.network.across),
            (before, behind, left, right),
            numbers.size,
            retained=(i_end - i) * (j_end - j) if keeps else 1,
        )
        return _Condensed(_Block(numbers, conductances, into), shares, driven, slots)


_Rectangle = tuple[tuple[int, int], tuple[int, int]]
"""Rows and columns of a rectangle, each from its first to one more than its last."""


def _cuts(n: int, repeats: bool) -> Indices:
    """Cut a side into a power of two of nearly equal pieces, none too large.

    They are two at least where the side repeats, so that no rectangle is its own neighbour.
    """
    pieces = 2 if repeats else 1
    while n > pieces * _RECTANGLE_CELLS:
        pieces *= 2
    return np.arange(pieces + 1) * n // pieces


def _joined(first: _Block, second: _Block, retained: int) -> tuple[_Block, list[_Elimination]]:
    """Condense two blocks into one."""
    numbers, inner, conductances, sources = _assembled(
        first.faces,
        first.conductances,
        first.sources,
        second.faces,
        second.conductances,
        second.sources,
        retained,
    )
    steps = []
    for start in range(0, inner, _FACES_AT_ONCE):
        end = min(start + _FACES_AT_ONCE, inner)
        n = end - start
        to_others = conductances[:n, n:]
        lower = _inverse_factor(conductances[:n, :n].copy(), to_others.sum(axis=1))
        upper, driven = lower @ to_others, lower @ sources[:n]
        between_others = upper.T @ upper
        between_others += conductances[n:, n:]
        conductances, sources = between_others, sources[n:] + upper.T @ driven
        steps.append(_Elimination(numbers[start:end], numbers[end:], lower, upper, driven))
    return _Block(numbers[inner:], conductances, sources), steps


@compiled
def _assembled(
    faces: Indices,
    conductances: Real,
    sources: Real,
    others: Indices,
    of_others: Real,
    into_others: Real,
    retained: int,
) -> tuple[Indices, int, Real, Real]:
    """Faces of two blocks, those between them first, and how many these are.

    With the conductances between all of them, and the flows into them.
    """
    between = both = 0
    j = 0
    for face in faces:
        while j < others.size and others[j] < face:
            j += 1
        if j < others.size and others[j] == face:
            both += 1
            between += face >= retained
    numbers = np.empty(faces.size + others.size - both, faces.dtype)
    places, of_second = np.empty_like(faces), np.empty_like(others)
    i = j = inner = 0
    outer = between
    while i < faces.size or j < others.size:
        in_first = j == others.size or (i < faces.size and faces[i] <= others[j])
        in_second = i == faces.size or (j < others.size and others[j] <= faces[i])
        face = faces[i] if in_first else others[j]
        place = outer
        if in_first and in_second and face >= retained:
            place = inner
            inner += 1
        else:
            outer += 1
        numbers[place] = face
        if in_first:
            places[i] = place
            i += 1
        if in_second:
            of_second[j] = place
            j += 1
    total = np.zeros((numbers.size, numbers.size))
    into = np.zeros((numbers.size, sources.shape[1]))
    for i, row in enumerate(places):
        into[row] = sources[i]
        for j, column in enumerate(places):
            total[row, column] = conductances[i, j]
    for i, row in enumerate(of_second):
        into[row] += into_others[i]
        for j, column in enumerate(of_second):
            total[row, column] += of_others[i, j]
    return numbers, between, total, into


@compiled
def _eliminate(g: Real, into: Real, here: int, share: Real, driven: Real) -> None:
    """Join the neighbours of a node in its place.

    Sets the share of each of them in its pressure, and what the flow into it adds to that.
    """
    reach = share.size
    row = g[here]
    pivot = row[:reach].sum()
    share[:] = row[:reach] / pivot
    for column in range(driven.size):
        driven[column] = into[here, column] / pivot
    for other in range(reach):
        part = share[other]
        if part > 0:
            g[other, here] = 0
            for column in range(driven.size):
                into[other, column] += part * into[here, column]
            for each in range(reach):
                g[other, each] += part * row[each]
            g[other, other] = 0
    row[:reach] = 0
    for column in range(driven.size):
        into[here, column] = 0


@compiled
def _eliminate_cells(
    cells: Real,
    sources: Real,
    square: tuple[float, float],
    borders: tuple[Indices, Indices, Indices, Indices],
    faces: int,
    retained: int,
) -> tuple[Real, Real, Real, Real, Indices]:
    """Condense a rectangle, cell by cell, and tell how the pressure of each cell follows.

    Returns the conductances between faces and the flows into them; the share of each neighbour in
    the pressure of a cell, and what flows into cells add to it, of all cells or of one if no more
    are kept; and the places of the faces among these. Cells have the first places, in turns, as
    long as they are not eliminated; each face has one from where the sweep meets it.
    """
    along, across = square
    before, behind, left, right = borders
    nx, ny = cells.shape
    window = ny + 1
    reach = window
    slots = np.full(faces, -1)
    g = np.zeros((window + faces, window + faces))
    into = np.zeros((window + faces, sources.shape[2]))
    shares, driven = np.zeros((retained, window + faces)), np.zeros((retained, sources.shape[2]))
    for cell in range(nx * ny):
        i, j = cell // ny, cell % ny
        k = cells[i, j]
        if k == 0:
            continue
        here = cell % window
        row = g[here]
        for column in range(sources.shape[2]):
            into[here, column] += sources[i, j, column]
        for face, square_of in (
            (before[j] if i == 0 else -1, along),
            (behind[j] if i + 1 == nx else -1, along),
            (left[i] if j == 0 else -1, across),
            (right[i] if j + 1 == ny else -1, across),
        ):
            if face >= 0:
                if slots[face] < 0:
                    slots[face] = reach
                    reach += 1
                row[slots[face]] += 2 * square_of * k
        if i + 1 < nx and cells[i + 1, j] > 0:
            next_row = cells[i + 1, j]
            row[(cell + ny) % window] += 2 * along * k * (next_row / (k + next_row))
        if j + 1 < ny and cells[i, j + 1] > 0:
            next_one = cells[i, j + 1]
            row[(cell + 1) % window] += 2 * across * k * (next_one / (k + next_one))
        _eliminate(g, into, here, shares[cell % retained, :reach], driven[cell % retained])
    conductances = np.empty((faces, faces))
    for i in range(faces):
        for j in range(faces):
            conductances[i, j] = g[slots[i], slots[j]]
    return conductances, into[slots], shares, driven, slots


@compiled
def _follow_cells(
    shares: Real, driven: Real, slots: Indices, of_faces: Real, nx: int, ny: int
) -> Real:
    """Pressures of the cells of a rectangle from those of its faces, (columns, nx, ny)."""
    window, columns = ny + 1, of_faces.shape[1]
    values = np.zeros((shares.shape[1], columns))
    for face in range(slots.size):
        values[slots[face]] = of_faces[face]
    pressures = np.empty((columns, nx, ny))
    total = np.empty(columns)
    for cell in range(nx * ny - 1, -1, -1):
        total[:] = driven[cell]
        for each in range(shares.shape[1]):
            share = shares[cell, each]
            for column in range(columns):
                total[column] += share * values[each, column]
        values[cell % window] = total
        pressures[:, cell // ny, cell % ny] = total
    return pressures


@compiled
def _inverse_factor(g: Real, to_others: Real) -> Real:
    """Inverse of the Cholesky factor of the nodes of a network.

    `g` are the conductances between them, `beyond` the sums of those to all other nodes; both are
    overwritten. The diagonal of `g` means nothing.
    """
    n = g.shape[0]
    column = np.empty(n)
    factor = np.zeros((n, n))
    for k in range(n):
        pivot = to_others[k]
        for i in range(k + 1, n):
            column[i] = g[i, k]
            pivot += column[i]
        root = np.sqrt(pivot)
        factor[k, k] = root
        for i in range(k + 1, n):
            if column[i] > 0:
                factor[i, k] = column[i] / root
                part = column[i] / pivot
                to_others[i] += part * to_others[k]
                for j in range(k + 1, i):
                    g[i, j] += part * column[j]
    inverse = np.zeros((n, n))
    for i in range(n):
        for j in range(i):
            part = factor[i, j]
            if part > 0:
                for k in range(j + 1):
                    inverse[i, k] += part * inverse[j, k]
        for k in range(i):
            inverse[i, k] /= factor[i, i]
        inverse[i, i] = 1 / factor[i, i]
    return inverse
