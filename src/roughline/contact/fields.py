"""Fields of one load on the grid, and the indentation that the load leaves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.distribution import Distribution, binned
from roughline.contact.patches import Patches, find_patches
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice
from roughline.errors.public import public
from roughline.halfspace.elasticity.half_space import Periodic, repeated_axes


@public
@dataclass(frozen=True, eq=False)
class Fields:
    """Fields of one load on the grid.

    Attributes
    ----------
    pressure : ndarray, shape (nx, ny)
        Contact pressure, compression positive. [pressure]
    displacement : ndarray, shape (nx, ny)
        Normal displacement of the half-space's surface. [length]
    gap : ndarray, shape (nx, ny)
        Distance of the two bodies. [length]
    contact : ndarray of bool, shape (nx, ny)
        Where they touch: unless bodies stick, where the pressure is above zero.
    plastic : ndarray of bool, shape (nx, ny)
        Where the pressure is at the hardness.
    pulling : ndarray of bool, shape (nx, ny)
        Where bodies that stick pull each other across a gap.
    indentation : ndarray, shape (nx, ny)
        Permanent indentation: how much lower the surface is than before any load. [length]
    sizes : tuple of float
        Sides of the surface, (Lx, Ly). [length]
    periodic : bool, "x" or "y"
        Whether the half-space is periodic, so that fields go on across the borders: along both
        axes, none, or the one that is named.
    """

    pressure: Real
    displacement: Real
    gap: Real
    contact: Mask
    plastic: Mask
    pulling: Mask
    indentation: Real
    sizes: tuple[float, float]
    periodic: Periodic

    __repr__ = summary
    _repr_html_ = in_notebook

    @property
    def repeats(self) -> tuple[bool, bool]:
        """Whether fields go on across the borders along x, and along y."""
        return repeated_axes(self.periodic)

    @property
    def is_periodic(self) -> bool:
        """Whether fields go on across all borders."""
        return all(self.repeats)

    @property
    def mean_gap(self) -> float:
        """Mean gap over the nominal area, zero where the bodies touch. [length]"""
        return float(np.where(self.contact, 0.0, self.gap).mean())

    def distribution(self, of: Literal["gap", "pressure"]) -> Distribution:
        """Return how the gap or the pressure is distributed over the nominal area.

        Bins are equally wide, from zero to the largest value; the data choose their number, from 8
        to 128, by the rule of Freedman and Diaconis [1]_.

        Parameters
        ----------
        of : {"gap", "pressure"}
            What is distributed.

        Returns
        -------
        Distribution
            Its ``at_zero`` is the share of the area in contact for the gap, and that out of contact
            for the pressure.

        Raises
        ------
        InputError
            For another field.

        References
        ----------
        .. [1] D. Freedman and P. Diaconis, "On the histogram as a density estimator", Z.
           Wahrscheinlichkeitstheorie verw. Gebiete 57, 453-476 (1981).

        Examples
        --------
        >>> import roughline as rl
        >>> surface = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=0.01).surface(64, rng=1)
        >>> curve = rl.press(surface, E_star=1.0, forces=[0.01], fields=True)
        >>> gap = curve.fields[0].distribution("gap")
        >>> print(gap.at_zero == curve.area_fraction[0])
        True
        """
        allowed_choice("of", of, ("gap", "pressure"))
        touching = int(np.count_nonzero(self.contact))
        if of == "gap":
            return binned(self.gap[~self.contact], touching)
        pressure, yielding = self.pressure[self.contact], int(np.count_nonzero(self.plastic))
        return binned(pressure, self.contact.size - touching, yielding)

    def patches(self) -> Patches:
        """Return the connected patches of the contact, the largest first.

        Examples
        --------
        >>> import roughline as rl
        >>> surface = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=0.01).surface(64, rng=1)
        >>> curve = rl.press(surface, E_star=1.0, forces=[0.01], periodic=True, fields=True)
        >>> patches = curve.fields[0].patches()
        >>> print(round(patches.forces.sum(), 6), patches.areas[0] == patches.areas.max())
        0.01 True
        """
        return find_patches(self.contact, self.pressure, self.sizes, periodic=self.periodic)


@dataclass(frozen=True, eq=False)
class Indentation:
    """Where a surface is lower than before any load, and by how much.

    Attributes
    ----------
    nodes : ndarray of int
        Flat indices in the grid, ascending.
    depth : ndarray, shape (nodes,)
        How much lower it is there. [length]
    """

    nodes: Indices
    depth: Real

    def equals(self, other: Indentation) -> bool:
        """Return whether both are the same to the last bit."""
        return np.array_equal(self.nodes, other.nodes) and np.array_equal(self.depth, other.depth)


class KeptFields(tuple[Fields | None, ...]):
    """The fields of the loads, None of those that were not kept; empty where none were."""

    __slots__ = ()

    def __getitem__(self, load: Any) -> Any:
        """Return the fields of a load, or of a slice of them.

        Raises
        ------
        InputError
            If no fields were kept, or there is no such load.
        """
        try:
            return super().__getitem__(load)
        except IndexError:
            kept = f"are of loads 0 to {len(self) - 1}" if self else "were not kept"
            raise InputError(
                f"there are no fields of load {load}: they {kept}; press with fields=True, or with "
                "fields=[...] and the numbers of loads"
            ) from None
