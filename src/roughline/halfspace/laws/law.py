"""What pressure and gap obey at a node: all that the search for a contact knows of it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import ClassVar, Literal, Protocol

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError


class Solved(Protocol):
    """What a law is shown of a contact that obeys it."""

    @property
    def nodes(self) -> Indices:
        """Nodes with a pressure, ascending flat indices."""

    @property
    def pressure(self) -> Real:
        """Pressures on them. [pressure]"""

    @property
    def gap(self) -> Real:
        """Gap on the whole grid, shape (nx, ny). [length]"""


class ContactLaw(ABC):
    """What pressure and gap obey at a node.

    Under a load the pressure of each node has a lower and an upper bound. Between them the bodies
    touch, so the gap is zero. At the lower bound they may be apart, at the upper bound they may
    overlap. Pressures with these properties are unique. All else that a law knows, such as what
    happened before, it tells by the law that follows it: under the next load (:meth:`start`), or
    under the same load where a contact does not settle it yet (:meth:`then`).

    Laws are values: none of their methods changes them.

    Attributes
    ----------
    memory : {"none", "dents", "path"}
        What a contact leaves. "none": the order of loads does not matter. "dents": overlaps stay
        in the surface, and loads below the largest so far retrace their states. "path": each load
        starts from the one before.
    only_pushes : bool
        Whether no pressure is negative, so that nodes that lie too far apart cannot touch.
    follows_gaps : bool
        Whether bounds depend on gaps, so that a law and its contact are led to each other by what
        :meth:`then` returns.
    assumption : str
        What it takes bodies to be, as pages say it, such as "linear elastic, without adhesion".
    misfit : float
        Of a law that follows gaps, and that follows a contact: by how much the gaps of that differ
        at most from those that go with the bounds which it obeyed. [length]
    """

    misfit: float = 0.0
    assumption: ClassVar[str] = "of a law of their own"
    memory: ClassVar[Literal["none", "dents", "path"]] = "none"
    only_pushes: ClassVar[bool] = True
    follows_gaps: ClassVar[bool] = False

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
            The bounds. The lower one is zero or negative. [pressure]
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

    def between(
        self, separation: Real, compliance: float, repeats: tuple[bool, bool]
    ) -> ContactLaw:
        """Return the law for the bodies at hand, in its units.

        Parameters
        ----------
        separation : ndarray, shape (nx, ny)
            Distance of the untouched bodies at first touch. [length]
        compliance : float
            Displacement of a node by the pressure on it alone, over that. [length / pressure]
        repeats : tuple of bool
            Whether bodies go on as they begin, along x and along y.
        """
        return self

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

    def refuse(
        self, control: str, values: Real, heights: Real, area: float, mean_is_free: bool
    ) -> None:
        """Refuse loads that the law does not allow.

        Parameters
        ----------
        control : {"depths", "forces"}
            What is prescribed.
        values : ndarray, shape (loads,)
            Finite loads, in their order. [length] or [force]
        heights : ndarray, shape (nx, ny)
            Heights of the surface. [length]
        area : float
            Nominal area. [length²]
        mean_is_free : bool
            Whether displacements count from their mean, as on a periodic half-space.

        Raises
        ------
        InputError
            If a load is not allowed.
        """
        if self.only_pushes:
            refuse_pulls(control, values)

    def start(self, value: float, last: float | None, largest: float | None) -> ContactLaw:
        """Return the law with which the search under a load starts.

        Parameters
        ----------
        value : float
            The load. [length] or [force]
        last, largest : float or None
            The load before it, and the largest so far; None before the first.
        """
        return self

    def foreseen(self, nodes: Indices, pressure: Real) -> ContactLaw:
        """Return the law to start with where a rough guess has these pressures.

        Parameters
        ----------
        nodes : ndarray of int
            Flat indices in the grid.
        pressure : ndarray, shape (nodes,)
            Pressures on them, from a coarser grid. [pressure]
        """
        return self

    def then(self, contact: Solved) -> ContactLaw | None:
        """Return the law that follows under the same load; None if the contact settles it.

        Parameters
        ----------
        contact : Solved
            The contact that obeys this law, in the law's units. Where a depth takes more than any
            finite pressures, they are infinite on all nodes.
        """
        return None

    def energy(self, contact: Solved) -> float:
        """Return the energy of a pull, which is zero where bodies are far apart.

        Parameters
        ----------
        contact : Solved
            The contact that obeys this law, in the law's units.

        Returns
        -------
        float
            The mean over the nodes, zero or negative. [pressure * length]
        """
        return 0.0

    def remarks(self, separation: Real) -> tuple[str, ...]:
        """Return what users must know of a law for the bodies at hand, in its units.

        Parameters
        ----------
        separation : ndarray, shape (nx, ny)
            Distance of the untouched bodies at first touch, in units in which E* is 1 and a cell
            has unit area. [length]
        """
        return ()

    def scales(self, pressure: Real, displacement: Real) -> tuple[float, float]:
        """Return with what pressures and gaps are compared in the residuals.

        Parameters
        ----------
        pressure, displacement : ndarray, shape (nodes,)
            Pressures and displacements of the nodes with a pressure. [pressure] and [length]

        Returns
        -------
        pressure, length : float
            The mean magnitude of the pressures, which does not vanish where pushes and pulls
            balance, and the largest displacement towards the half-space, or, where bodies pull,
            in either direction. Both are positive. [pressure] and [length]
        """
        moved = displacement if self.only_pushes else np.abs(displacement)
        return float(np.abs(pressure).mean()), float(moved.max())

    @property
    def reach(self) -> float:
        """Gap beyond which nothing is pulled. [length]"""
        return 0.0

    @property
    def largest_pull(self) -> float:
        """Largest tension that a node bears across a gap. [pressure]"""
        return -float(np.min(self.bounds(None)[0]))

    @property
    def settings(self) -> dict[str, str | float]:
        """What is told of the law with a result: its name, and its numbers by theirs."""
        return {"law": type(self).__name__}

    @property
    def resolution(self) -> dict[str, float]:
        """How well the grid resolves it, where E* is 1 and a cell has unit area."""
        return {}

    @property
    def resolves_pull_off(self) -> bool:
        """Whether the grid resolves what pulls, where E* is 1 and a cell has unit area."""
        return True

    def largest_force(self, area: float) -> float:
        """Return the force under which the mean pressure on an area is the upper bound. [force]"""
        return float(np.mean(self.bounds(None)[1])) * area


def refuse_pulls(control: str, values: Real) -> None:
    """Refuse loads under which bodies that only push do not touch, unless they unload."""
    before_touch = np.maximum.accumulate(values) <= 0
    for wrong, what in (
        (values < 0, "negative: compression counts positive"),
        ((values == 0) & before_touch, "zero, at which nothing touches"),
    ):
        if wrong.any():
            raise InputError(
                f"{control}[{wrong.argmax()}] is {values[wrong][0]}, {what}; give positive "
                "numbers, and zero only to unload"
            )
