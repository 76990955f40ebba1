"""Which nodes slip on if loads go on as they did last: a question to the rates.

A node that stops slipping within a load ends it with all the shear that it bears, as one does that
slips on. Which is which shows if loads go on by very little. All nodes follow along the rims of
their discs. Outward, a node that slips on follows what it bears, and its slip must grow. One that
sticks must not bear more than it can,

    dw · q >= 0  or  dw = 0  and  dq · q <= dg |q|.

That holds for a node that has joined within the load, too, whatever it bears: it has borne nothing
yet beside what goes on, unless it yields and its pressure grows no more.
Sets are changed where they are wrong until they are not, as for a contact [1]_.

References
----------
.. [1] M. Hintermüller, K. Ito and K. Kunisch, "The primal-dual active set strategy as a semismooth
   Newton method", SIAM J. Optim. 13, 865-888 (2002).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Mask, Real

_AT_RIM = 1 - 1e-10  # of what a node bears
_RATE_ROUNDING = 1e-4  # of the largest rate, to which rates are known
_MOST_ROUNDS = 20


@dataclass(frozen=True, eq=False)
class Rim:
    """Nodes in contact, and which of them have all the shear that they bear."""

    outward: Real  # shape (nodes, 2): direction of the shear
    full: Mask
    may_slip: Mask  # these, and those that have joined
    slope: Real  # how much more shear a node bears under more pressure [1]

    @classmethod
    def of(cls, shear: Real, bound: Real, joined: Mask, slope: Real) -> Rim:
        """Find the nodes whose shear is as large as its bound."""
        size = np.hypot(shear[:, 0], shear[:, 1])
        outward = shear / np.maximum(size, 1e-300)[:, np.newaxis]
        full = (size >= bound * _AT_RIM) & (size > 0)
        return cls(outward, full, full | (joined & (size > 0)), slope)

    def along(self, vectors: Real) -> Real:
        """Return what of vectors points outward."""
        return np.einsum("ij,ij->i", self.outward, vectors)


@dataclass(frozen=True)
class Going:
    """How loads went last: those that are given, and which these are."""

    normal: float  # force or depth
    along: tuple[float, float]  # shear force or slide
    by_force: bool  # whether a force is given, and no depth
    by_shear: bool  # whether a shear force is given, and no slide

    @property
    def stands(self) -> bool:
        """Whether nothing changed."""
        return self.normal == 0 and self.along == (0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Rates:
    """How nodes go on with given sets of those that slip."""

    slip: Real  # outward, shape (nodes,)
    excess: Real  # of the shear outward beyond what nodes bear, shape (nodes,)


def rate_rounding(rates: Real) -> float:
    """Return up to which size rates of nodes are zero."""
    return _RATE_ROUNDING * float(np.abs(rates).max(initial=0.0))


def slip_on(rim: Rim, rates: Callable[[Mask], Rates | None]) -> Mask:
    """Return which nodes slip on; those of full shear, as far as rates are not known."""
    slips = rim.full.copy()
    for _ in range(_MOST_ROUNDS):
        found = rates(slips)
        if found is None:
            break
        least, most = rate_rounding(found.slip), rate_rounding(found.excess)
        wrong = np.where(slips, found.slip < -least, rim.may_slip & (found.excess > most))
        if not wrong.any():
            break
        slips ^= wrong
    return slips
