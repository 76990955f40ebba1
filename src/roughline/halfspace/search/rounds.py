"""Rounds in which the shares of a pull and the gaps of its contact are led to each other.

At given shares the contact is a convex problem. Its gaps leave other shares, and so on, from those
of the load before. At a given depth more pull closes more gap, so these rounds go one way: to where
bodies come that are moved slowly. Near their end they are extrapolated [1]_.

References
----------
.. [1] D. G. Anderson, "Iterative procedures for nonlinear integral equations", J. ACM 12, 547-560
   (1965).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from roughline.computing.arrays import InGrid, Mask, Real, among
from roughline.halfspace.search.carriers import merged
from roughline.halfspace.search.pull import Pull, Shares

# Shares are extrapolated from so many rounds where they change by less than the first number. Where
# a change is so large a part of the one before, no end is near: bodies slide to a jump, and shares
# go up to so many times as far.
_SMALL_CHANGE, _MOST_ROUNDS, _NO_END_FROM, _MOST_SPEED_UP = 0.1, 6, 0.9, 8.0


@dataclass(frozen=True, eq=False)
class _RoundHistory:
    """What followed from shares in the last rounds, at the nodes that have moved in any."""

    nodes: InGrid
    followed: tuple[Real, ...] = ()
    moved: tuple[Real, ...] = ()  # by which these differ from the shares of the contact

    @classmethod
    def none(cls) -> _RoundHistory:
        """No rounds."""
        return cls(InGrid(np.empty(0, np.intp)))

    @property
    def change(self) -> float:
        """The largest difference in the last round."""
        return float(np.abs(self.moved[-1]).max(initial=0.0))

    def joined_by(self, taken: Shares, followed: Shares, moved: Shares) -> _RoundHistory:
        """Return the history with another round; others are what they were while they rested."""
        nodes, before, differed = self.nodes, self.followed, self.moved
        joining = moved.nodes
        if 2 * joining.size > followed.nodes.size:  # soon all of them will have moved
            joining = followed.nodes
        joining = among(joining, Shares(nodes, np.ones(nodes.size)).at(joining) == 0)
        if joining.size:
            nodes, order = merged(nodes, joining)
            rested, nothing = taken.at(joining), np.zeros(joining.size)
            before = tuple(np.append(each, rested)[order] for each in before)
            differed = tuple(np.append(each, nothing)[order] for each in differed)
        before, differed = (*before, followed.at(nodes)), (*differed, moved.at(nodes))
        return _RoundHistory(nodes, before[-_MOST_ROUNDS:], differed[-_MOST_ROUNDS:])

    def last(self, shares: Shares) -> Shares:
        """Return what followed in the last round, and elsewhere other shares."""
        return shares.but(self.nodes, self.followed[-1])

    def extrapolated(self, shares: Shares) -> Shares:
        """Return where those taken and those that follow would be the same, else other shares."""
        if len(self.moved) < 2:
            return shares
        moving = np.any(self.moved, axis=0)
        steps, *_ = np.linalg.lstsq(
            _steps(self.moved, moving).T, self.moved[-1][moving], rcond=1e-10
        )
        there = self.followed[-1][moving] - steps @ _steps(self.followed, moving)
        return shares.but(among(self.nodes, moving), np.clip(there, 0.0, 1.0))


@dataclass(frozen=True, eq=False)
class Rounds:
    """The shares for the next contact, and how they were found."""

    pull: Pull
    shares: Shares
    misfit: float = 0.0  # of the last contact: gap that its shares go with, from its own [length]
    history: _RoundHistory = field(
        default_factory=_RoundHistory.none
    )  # of which shares are extrapolated
    near: float = _SMALL_CHANGE  # change of the shares below which they are
    factor: float = 1.0  # by which the shares went further than they followed
    change: float = 0.0  # by the last round
    moved: Shares = field(default_factory=Shares.none)
    followed: Shares = field(default_factory=Shares.none)  # where they went further

    def then(self, gap: Real, nodes: InGrid | None = None) -> Rounds:
        """Take the shares of a gap, or others on the way to where rounds end.

        The gap is that of some nodes, to which shares are kept; without any, it is that of all.
        """
        followed, moved, misfit = self.pull.followed(gap, self.shares, nodes)
        change, onwards = _largest(moved), _along(moved, self.moved)
        plain = Rounds(self.pull, followed, misfit, near=self.near, change=change, moved=moved)
        if self.factor > 1 and not onwards:  # shares went beyond an end
            return replace(plain, shares=self.followed, change=0.0)
        if change >= self.near:
            factor = min(self.factor, 1.0)
            if change > _NO_END_FROM * self.change > 0:  # as fast as before: shares slide, or swing
                factor = min(2 * self.factor, _MOST_SPEED_UP) if onwards else factor / 2
            nodes, near = followed.nodes, _SMALL_CHANGE if change > _SMALL_CHANGE else self.near
            there = self.shares.at(nodes) + factor * moved.at(nodes)
            further = Shares(nodes, np.clip(there, 0.0, 1.0))
            return replace(plain, shares=further, followed=followed, factor=factor, near=near)
        history = self.history
        if len(history.moved) > 1 and change > _NO_END_FROM * history.change:
            return replace(
                plain, shares=history.last(self.shares), near=history.change / 3, change=0.0
            )
        history = history.joined_by(self.shares, followed, moved)
        return replace(plain, shares=history.extrapolated(followed), history=history)


def _steps(rounds: Sequence[Real], moving: Mask) -> Real:
    """Return the differences of values from round to round, at moving nodes."""
    return np.array([after[moving] - before[moving] for before, after in pairwise(rounds)])


def _largest(moved: Shares) -> float:
    """Return the largest change of shares."""
    return float(np.abs(moved.values).max(initial=0.0))


def _along(moved: Shares, before: Shares) -> bool:
    """Whether shares move on as they moved before."""
    return float(np.vdot(moved.values, before.at(moved.nodes))) > 0
