"""The pull across the gaps of a grid, as shares of the largest pull of each node.

A law may end its pull by a jump. On a grid a cell at that edge would then have two places, within
reach and beyond, and the edge would move by whole cells. So a jump ends over a ramp about the
cutoff: half of its width is what the gap changes across half a cell, or, where that is more, what
the pull on a cell displaces it. It lessens the pull below the cutoff by what it adds beyond, so the
work of adhesion stays that of the law.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Floats, Indices, InGrid, Integers, Real, among
from roughline.computing.compiled import compiled
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import LEAST_SHARE, ContactLaw
from roughline.halfspace.laws.pulling_zone import (
    farthest_pulled,
    jump,
    narrowest_ramp,
    refuse_end_within_a_cell,
)
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.halfspace.search.carriers import merged

_BLOCK_NODES = 2**14  # for which arrays are made at a time


@dataclass(frozen=True, eq=False)
class Shares:
    """Shares of the largest pull that nodes bear, ascending flat indices; others bear none."""

    nodes: InGrid
    values: Real

    @classmethod
    def none(cls) -> Shares:
        """No node is pulled."""
        return cls(InGrid(np.empty(0, np.intp)), np.empty(0))

    @property
    def above_zero(self) -> Shares:
        """The shares that are not zero, and their nodes."""
        pulled = self.values > 0
        return Shares(among(self.nodes, pulled), self.values[pulled])

    def at(self, nodes: InGrid) -> Real:
        """Return the shares of some nodes, ascending ones."""
        if nodes is self.nodes or np.array_equal(nodes, self.nodes):
            return self.values
        found = np.zeros(nodes.size)
        _find(self.nodes, self.values, nodes, found)
        return found

    def but(self, nodes: InGrid, values: Real) -> Shares:
        """Return the same, with other values at some nodes."""
        if not self.nodes.size:
            return Shares(nodes, values)
        places = np.searchsorted(self.nodes, nodes)
        if np.array_equal(self.nodes[np.minimum(places, self.nodes.size - 1)], nodes):
            changed = self.values.copy()
            changed[places] = values
            return Shares(self.nodes, changed)
        others = ~np.isin(self.nodes, nodes, assume_unique=True)
        joined, order = merged(among(self.nodes, others), nodes)
        return Shares(joined, np.append(self.values[others], values)[order])

    def field(self, size: int) -> Real:
        """Return the shares of all nodes of a grid of so many."""
        field = np.zeros(size)
        field[self.nodes] = self.values
        return field


@dataclass(frozen=True, eq=False)
class Pull:
    """The pull of a law across the gaps of bodies on a grid, at nodes given by flat indices."""

    law: ContactLaw
    separation: Real  # distance of the bodies at first touch, shape (nx, ny) [length]
    compliance: float  # displacement of a node by the pressure on it alone [length / pressure]
    repeats: tuple[bool, bool]  # whether bodies go on as they begin, along x and along y
    known: tuple[InGrid, Real] | None = None  # nodes, and the ramp there

    @cached_property
    def jump(self) -> float:
        """Share of the pull that ends at the cutoff."""
        return jump(self.law)

    @property
    def _narrowest(self) -> float:
        """Half of the width that a ramp has at least. [length]"""
        return narrowest_ramp(self.law, self.compliance)

    def knowing(self, nodes: InGrid) -> Pull:
        """Return the same, which needs not compute the ramp of these nodes again."""
        return replace(self, known=(nodes, self._ramp(nodes))) if self.jump else self

    def at_hand(self) -> ContactLaw:
        """Return the law, or, where the pull moves less than rounding, one without it.

        Raises
        ------
        InputError
            If the pull would end within a cell.
        """
        law, cells = self.law, self.separation.size
        if law.only_pushes:
            return law
        moved = Bounds.of(law).largest_pull * self.compliance * cells
        if moved < np.finfo(float).eps * self.separation.max():
            return Unilateral()
        refuse_end_within_a_cell(law, self.compliance)
        return law

    def followed(
        self, gap: Real, shares: Shares, nodes: InGrid | None = None
    ) -> tuple[Shares, Shares, float]:
        """Return the shares that a gap leaves, and from others, at nodes where both differ.

        The gap is that of some nodes, which alone are pulled, or without any, of all, shape
        (nx * ny,). Return with them by how much, at most, gaps differ that go with the two.
        [length]
        """
        if nodes is None:
            nodes = self._near(gap, shares)
            gap = gap[nodes] if nodes.size < gap.size else gap
        ramp = self._ramp(nodes) if self.jump else None
        followed, taken = self._shares(gap, ramp), shares.at(nodes)
        places = np.flatnonzero(followed != taken)
        moved, there, before = among(nodes, places), followed[places], taken[places]
        gap_change = self._gap_change(there, before, None if ramp is None else ramp[places])
        return (
            Shares(nodes, followed),
            Shares(moved, there - before),
            float(gap_change.max(initial=0.0)),
        )

    def followed_everywhere(self, gap: Real, shares: Shares) -> tuple[Shares, float]:
        """Return what :meth:`followed` does, without where shares differ, in little memory."""
        nodes = self._near(gap, shares)
        followed, largest = np.empty(nodes.size), 0.0
        for block in _blocks(nodes.size):
            part = among(nodes, block)
            taken = Shares(part, shares.at(part))
            each, _, gap_change = self.followed(gap[part], taken, part)
            followed[block] = each.values
            largest = max(largest, gap_change)
        return Shares(nodes, followed), largest

    def _near(self, gap: Real, shares: Shares) -> InGrid:
        """Return the nodes that a gap leaves within reach, and those of shares, in one memory."""
        if math.isinf(self.law.cutoff):
            everywhere = shares.nodes.size == gap.size
            return shares.nodes if everywhere else InGrid(np.arange(gap.size))
        near = gap < farthest_pulled(self.law)
        near[shares.nodes] = True
        nodes = InGrid(np.flatnonzero(near))
        return nodes if nodes.size > shares.nodes.size else shares.nodes

    def shares_at(self, gap: Real, nodes: InGrid) -> Real:
        """Return the shares that the gaps of nodes leave."""
        return self._shares(gap, self._ramp(nodes) if self.jump else None)

    def _shares(self, gap: Real, ramp: Real | None) -> Real:
        """Return the shares that gaps leave, with the ramp where the pull ends by a jump."""
        law = self.law
        shares = law.share_at(np.clip(gap, 0.0, law.cutoff))
        if math.isinf(law.cutoff):
            return shares
        if ramp is None:
            return np.where(gap < law.cutoff, shares, 0.0)
        within = self._within(gap, ramp)
        within *= self.jump
        shares -= self.jump
        shares += within
        return shares

    def _gap_change(self, shares: Real, others: Real, ramp: Real | None) -> Real:
        """Return by how much the gaps of nodes differ that go with shares. [length]"""
        least = self.jump or LEAST_SHARE
        gaps = [self.law.gap_at(np.maximum(each, least)) for each in (shares, others)]
        gap_change = np.abs(gaps[0] - gaps[1])
        if ramp is not None:  # the rest is along it
            lower = [np.minimum(each, self.jump) / self.jump for each in (shares, others)]
            gap_change += 2 * ramp * np.abs(lower[0] - lower[1])
        return gap_change

    def energy(self, gap: Real) -> float:
        """Return minus the work that is left to separate all nodes, over the area of a cell.

        The gap is that of all nodes, shape (nx * ny,). [pressure * length]
        """
        farthest = farthest_pulled(self.law) if self.jump else self.law.cutoff
        nodes = InGrid(np.flatnonzero(gap < farthest))
        parts = (among(nodes, part) for part in _blocks(nodes.size))
        return float(sum(self._energy_at(gap[part], part) for part in parts))

    def _energy_at(self, gap: Real, nodes: InGrid) -> float:
        """Return minus the work that is left to separate some nodes, over the area of a cell."""
        law, gap = self.law, np.maximum(gap, 0.0)
        work = law.work_beyond(np.minimum(gap, law.cutoff))
        if self.jump:
            ramp = self._ramp(nodes)
            to_ramp = np.maximum(law.cutoff - ramp - gap, 0.0)
            even = to_ramp + ramp * self._within(gap, ramp) ** 2
            work += self.jump * (even - np.maximum(law.cutoff - gap, 0.0))
        return float(np.sum(Bounds.of(law, nodes).low * work))

    def _within(self, gap: Real, ramp: Real) -> Real:
        """Return one up to the ramp, and zero beyond it."""
        within = self.law.cutoff + ramp
        within -= gap
        within /= 2 * ramp
        return np.clip(within, 0.0, 1.0, out=within)

    def _ramp(self, nodes: InGrid) -> Real:
        """Return half of the width over which the pull ends at nodes. [length]"""
        if self.known is not None and nodes is self.known[0]:
            return self.known[1]
        steps = _steps(self.separation, nodes, *self.repeats)
        steps /= 2
        np.clip(steps, self._narrowest, self.law.cutoff, out=steps)
        return steps


def _blocks(size: int) -> Iterator[slice]:
    """Divide a list into blocks that take little memory."""
    return (slice(start, start + _BLOCK_NODES) for start in range(0, size, _BLOCK_NODES))


@compiled
def _find(nodes: Integers, values: Floats, wanted: Integers, found: Floats) -> None:
    """Write the values of nodes to where wanted ones are among them; both lists ascend."""
    place = 0
    for i in range(wanted.size):
        step = 1
        while place + step < nodes.size and nodes[place + step] <= wanted[i]:
            place += step
            step *= 2
        while step:
            if place + step < nodes.size and nodes[place + step] <= wanted[i]:
                place += step
            step //= 2
        if place < nodes.size and nodes[place] == wanted[i]:
            found[i] = values[place]


@compiled
def _steps(separation: Real, nodes: Indices, repeats_x: bool, repeats_y: bool) -> Real:
    """Return what the separation changes by from cell to cell, along x and along y together."""
    steps = np.zeros(nodes.size)
    nx, ny = separation.shape
    for i in range(nodes.size):
        x = nodes[i] // ny
        y = nodes[i] - x * ny
        low, high, cells = _beside(x, nx, repeats_x)
        steps[i] += abs(separation[high, y] - separation[low, y]) / cells
        low, high, cells = _beside(y, ny, repeats_y)
        steps[i] += abs(separation[x, high] - separation[x, low]) / cells
    return steps


@compiled
def _beside(place: int, points: int, repeats: bool) -> tuple[int, int, int]:
    """Return the neighbours of a point on a line, or itself at an end, and the cells between."""
    low, high = place - 1, place + 1
    if repeats:
        return (low if low >= 0 else points - 1), (high if high < points else 0), 2
    low, high = max(low, 0), min(high, points - 1)
    return low, high, max(high - low, 1)
