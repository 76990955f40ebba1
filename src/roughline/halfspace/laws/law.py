"""What pressure and gap obey at a node: all that is asked of a contact law."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors.earlier import refuse_part

LEAST_SHARE = 1e-7
"""Share of the largest pull, from which on pulls are told apart."""


class ContactLaw(ABC):
    """What pressure and gap obey at a node.

    The pressure of each node has a lower and an upper bound. Between them the bodies touch, so the
    gap is zero. At the upper bound they overlap, and stay dented by that. The lower bound is zero
    where bodies only push: nodes at it are apart. Bodies that pull have one below zero, the largest
    pull. Apart, nodes bear the share of it that their gap leaves, :meth:`share_at`.

    Laws are values. They say what bodies are, and nothing of how a contact is found.

    Attributes
    ----------
    assumption : str
        What the law takes bodies to be, as pages say it, such as "linear elastic, without
        adhesion".
    cutoff : float
        Gap at which the pull ends, if it does; the share may jump to zero there. On a grid a jump
        ends over a ramp about the cutoff, so that cells come within reach evenly. [length]
    """

    assumption: ClassVar[str] = "of a law of their own"
    cutoff: float = math.inf

    if not TYPE_CHECKING:  # checkers know what there is

        def __getattr__(self, name):
            refuse_part("law", name, type(self).__name__)

    @abstractmethod
    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return the least and the largest pressure of nodes.

        Parameters
        ----------
        nodes : ndarray of int, or None
            Flat indices in the grid, so those of a field's ``ravel()``; None for all of it.

        Returns
        -------
        low, high : float, or ndarray, shape (nodes,)
            The bounds. The lower one is zero, or minus the largest pull. [pressure]
        """

    @abstractmethod
    def scaled(self, pressure: float, length: float) -> ContactLaw:
        """Return the same law in other units: pressures and lengths divided by the new ones.

        Parameters
        ----------
        pressure, length : float
            The new units of pressures and of gaps, in the old ones. So a hardness H is
            H / `pressure` there. [pressure] and [length]
        """

    def on(self, take: Callable[[Real], Real]) -> ContactLaw:
        """Return the law on another grid.

        Parameters
        ----------
        take : callable
            Takes a field over this grid, shape (nx, ny), to one over the other. Fields are floats:
            a mask is taken as one of ones and zeros, and may come back with what is between. Only
            a law that differs from node to node needs it.
        """
        return self

    def share_at(self, gap: Real) -> Real:
        """Return the share of the largest pull that nodes bear across gaps. [1]

        Parameters
        ----------
        gap : ndarray, shape (nodes,)
            Gaps from zero to :attr:`cutoff`. [length]

        Returns
        -------
        ndarray, shape (nodes,)
            One at a gap of zero, and never more at a larger gap.
        """
        return np.zeros_like(gap)

    def gap_at(self, share: Real) -> Real:
        """Return a gap at which nodes bear a share of the largest pull. [length]

        Parameters
        ----------
        share : ndarray, shape (nodes,)
            Shares up to one, from that at :attr:`cutoff` or 1e-7 on. [1]
        """
        return np.zeros_like(share)

    def work_beyond(self, gap: Real) -> Real:
        """Return the work to separate nodes from gaps on, over the largest pull. [length]

        It is the integral of :meth:`share_at` over larger gaps, so at a gap of zero it is the work
        of adhesion over the largest pull.

        Parameters
        ----------
        gap : ndarray, shape (nodes,)
            Gaps from zero to :attr:`cutoff`. [length]
        """
        return np.zeros_like(gap)

    def refuse_grid(self, compliance: float) -> None:  # noqa: B027 as most are resolved
        """Refuse a grid that does not resolve the pull of the law, if there are such grids.

        A law that pulls is asked of the grid of a surface, not of the coarser ones that guesses
        come from.

        Parameters
        ----------
        compliance : float
            Displacement of a cell of the grid by unit pressure on it alone. [length / pressure]

        Raises
        ------
        InputError
            If the grid is too coarse.
        """

    @property
    def only_pushes(self) -> bool:
        """Whether no pressure is negative, so that nodes that lie too far apart cannot touch."""
        low = self.bounds(None)[0]
        return low >= 0 if isinstance(low, float) else not np.any(np.less(low, 0.0))

    @property
    def memory(self) -> Literal["none", "dents", "path"]:
        """What a contact leaves.

        "none": the order of loads does not matter. "dents": overlaps stay in the surface, and loads
        below the largest so far retrace their states. "path": bodies pull, so that each load starts
        from the one before.
        """
        if not self.only_pushes:
            return "path"
        high = self.bounds(None)[1]
        if isinstance(high, float):
            return "dents" if high < math.inf else "none"
        return "dents" if np.any(np.less(high, math.inf)) else "none"

    @property
    def settings(self) -> dict[str, str | float]:
        """What is told of the law with a result: its name, and its numbers by theirs."""
        numbers = {name: each for name, each in vars(self).items() if isinstance(each, int | float)}
        return {"law": type(self).__name__, **numbers}
