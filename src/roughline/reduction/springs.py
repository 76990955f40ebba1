"""The reduced model: a rough line on independent springs, solved exactly for every load at once.

References
----------
.. [1] V. L. Popov and S. G. Psakhie, "Numerical simulation methods in tribology", Tribol. Int. 40,
   916-923 (2007): a line on springs of stiffness E* per length, the paper's eq. 6.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Indices, Real

_MOST_BINS = 2**16  # a bin's number has 16 bits; more bins would not fit into a core's cache


@dataclass(frozen=True, eq=False)
class Springs:
    """A rough line on springs.

    Springs are counted in bins of their separation, and only the bins in which the contact under a
    load ends are sorted. The result is the same as if all springs were sorted.
    """

    heights: Real  # shape (n,): Heights; the highest spring touches first. [length]
    spring_stiffness: float  # E* times the spacing. [force / length]

    @classmethod
    def under(cls, heights: Real, spacing: float, E_star: float) -> Springs:
        """Put springs under the points of a line."""
        return cls(heights, E_star * spacing)

    @cached_property
    def _highest(self) -> float:
        return float(self.heights.max())

    @property
    def separations(self) -> Real:
        """Distance of each spring from the other body at first touch; the least is 0. [length]"""
        return self._highest - self.heights

    @property
    def _bin_count(self) -> int:
        return min(self.heights.size, _MOST_BINS)

    @cached_property
    def _bins_per_length(self) -> float:
        deepest = self._highest - float(self.heights.min())
        return (self._bin_count - 1) / deepest if deepest > 0 else 0.0

    @cached_property
    def _binned(self) -> tuple[NDArray[np.uint16], Indices, Real]:
        """The bin of each spring; number of springs and sum of separations in each bin."""
        from roughline.reduction.loops import fill_bins  # here because numba loads slowly

        bins = np.empty(self.heights.size, dtype=np.uint16)
        counts = np.zeros(self._bin_count, dtype=np.intp)
        sums = np.zeros(self._bin_count)
        fill_bins(self.heights, self._highest, self._bins_per_length, bins, counts, sums)
        return bins, counts, sums

    @cached_property
    def _below(self) -> tuple[Indices, Real]:
        """Number of springs and sum of their separations below each bin, and in all."""
        from roughline.reduction.loops import fill_totals  # here because numba loads slowly

        _, counts, sums = self._binned
        below, sum_below = np.empty(counts.size + 1, dtype=np.intp), np.empty(sums.size + 1)
        fill_totals(counts, sums, below, sum_below)
        return below, sum_below

    def at_depths(self, depths: Real) -> _SpringsInContact:
        """Springs in contact at each depth."""
        last = self._below[0].size - 2
        bins = np.minimum(depths * self._bins_per_length, last).astype(np.intp)
        springs = self._sorted(bins)
        ends = np.searchsorted(springs.separations, depths, side="left")
        return self._in_contact(bins, springs, ends)

    @cached_property
    def _edge_forces(self) -> Real:
        """Force at which each bin begins to touch. [force]"""
        from roughline.reduction.loops import fill_edge_forces  # here because numba loads slowly

        counts, sums = self._below
        edge_forces = np.empty(self._bin_count)
        per_length = self._bins_per_length or 1.0
        fill_edge_forces(counts, sums, per_length, self.spring_stiffness, edge_forces)
        return edge_forces

    def under_forces(self, forces: Real) -> _SpringsInContact:
        """Springs in contact under each force."""
        bins = np.searchsorted(self._edge_forces, forces, side="right") - 1
        springs = self._sorted(bins)
        touch_forces = springs.counts * springs.separations - springs.sums
        # where separations repeat these are equal, and rounding must not make them fall
        touch_forces = self.spring_stiffness * np.maximum.accumulate(touch_forces)
        ends = np.searchsorted(touch_forces, forces, side="left")
        return self._in_contact(bins, springs, ends)

    def touch_force(self, count: int) -> float:
        """Force at which one more spring than `count` comes into contact. [force]"""
        nearest = np.partition(self.separations, count)[: count + 1]
        return self.spring_stiffness * float((nearest[count] - nearest).sum())

    def _sorted(self, bins: Indices) -> _SortedSprings:
        """Sort the springs of some bins."""
        counts, sums = self._below
        wanted = np.zeros(counts.size - 1, dtype=bool)
        wanted[bins] = True
        wanted[0] = True  # never empty: the highest point is there
        bins_of_all = self._binned[0]
        members = np.flatnonzero(wanted[bins_of_all])
        separations, bin_of = self._highest - self.heights[members], bins_of_all[members]
        order = np.argsort(separations)
        separations, bin_of = separations[order], bin_of[order]
        # within a bin, ranks and sums go on from those of the bins below
        first = np.searchsorted(bin_of, bin_of)
        sums_before = np.append(0.0, np.cumsum(separations))[:-1]
        return _SortedSprings(
            bin_of,
            separations,
            counts[bin_of] + np.arange(bin_of.size) - first,
            sums[bin_of] + sums_before - sums_before[first],
        )

    def _in_contact(
        self, bins: Indices, springs: _SortedSprings, ends: Indices
    ) -> _SpringsInContact:
        """Return the springs in contact under each load.

        `bins` says in which bin the contact under each load ends, `ends` which of its springs is
        the first that does not touch. If that one belongs to another bin, all of its load's bin
        touch.
        """
        counts, sums = self._below
        position = np.minimum(ends, springs.bin.size - 1)
        inside = (ends < springs.bin.size) & (springs.bin[position] == bins)
        return _SpringsInContact(
            np.where(inside, springs.counts[position], counts[bins + 1]),
            np.where(inside, springs.sums[position], sums[bins + 1]),
            self.spring_stiffness,
        )


class _SortedSprings(NamedTuple):
    """Springs of some bins by rising separation, with number and sum of all springs below each."""

    bin: NDArray[np.uint16]
    separations: Real
    counts: Indices
    sums: Real


@dataclass(frozen=True, eq=False)
class _SpringsInContact:
    """Springs in contact at given depths or under given forces."""

    count: Indices  # shape (loads,): their number
    sum: Real  # shape (loads,): sum of their separations [length]
    spring_stiffness: float  # stiffness of each [force / length]

    @property
    def stiffness(self) -> Real:
        """K = dF/dd. [force / length]"""
        return self.spring_stiffness * self.count.astype(np.float64)

    def force_at(self, depths: Real) -> Real:
        """Force at the depths. [force]"""
        return self.spring_stiffness * (self.count * depths - self.sum)

    def depth_under(self, forces: Real) -> Real:
        """Depth under the forces, zero without a force. [length]"""
        return (forces / self.spring_stiffness + self.sum) / np.maximum(self.count, 1)
