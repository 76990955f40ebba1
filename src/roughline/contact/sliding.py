"""The curve of a surface that is pressed and sheared, with friction between the bodies."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.quantities import SLIDING_QUANTITIES
from roughline.errors.public import public
from roughline.halfspace.friction.law import Friction


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class CurveWithFriction(Curve):
    """What friction adds to the curve of a surface, and of springs alike."""

    friction: Friction = field(repr=False)
    shear_force: Real
    slide: Real
    shear_stiffness: Real
    shear_stiffness_back: Real
    stick_fraction: Real
    shear_limit: Real
    dissipated: Real

    @property
    def drift(self) -> Real:
        """The slide that is left where there is no shear force; NaN at other loads. [length]"""
        return np.where(self.shear_force.any(axis=1, keepdims=True), np.nan, self.slide)

    def _variables(self) -> dict[str, Any]:
        variables = super()._variables()
        for each in SLIDING_QUANTITIES:
            if "x" not in each.dims:
                values = getattr(self, each.attribute)
                variables[each.name] = (each.dims, values, each.attributes(self.unit))
        return variables


@public
@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class SlidingCurve(CurveWithFriction, SurfaceCurve):
    """Contact quantities of a surface that is pressed and sheared, over its loads.

    Those of :class:`~roughline.SurfaceCurve`, and what follows of friction. Vectors are along x and
    y of the surface. Where pressure displaces along the surface, as between two materials,
    `stiffness` is that under a constant shear force, and the tangential ones are those under a
    constant force.

    Attributes
    ----------
    friction : Friction
        What the points in contact bear.
    shear_force : ndarray, shape (loads, 2)
        Total shear force on the half-space. [force]
    slide : ndarray, shape (loads, 2)
        How far the rough body has slid since first touch. Bodies that are lifted off under no shear
        force come off where the highest point bears no shear. [length]
    shear_stiffness : ndarray, shape (loads, 2, 2)
        Exact dQ/d(slide) on further shear, in about the direction in which points slip: those that
        stick follow, and those that slip turn. [force / length]
    shear_stiffness_back : ndarray, shape (loads, 2, 2)
        Exact dQ/d(slide) on turning back, when all of the contact sticks. [force / length]
    stick_fraction : ndarray, shape (loads,)
        Share of the contact that sticks if loads go on as they did last. [1]
    shear_limit : ndarray, shape (loads,)
        Largest shear force that friction bears; beyond it bodies slide. [force]
    dissipated : ndarray, shape (loads,)
        Energy that slip has dissipated since the load before. [energy]

    Notes
    -----
    Which points stick follows from the rates at the end of a load: one that stops slipping within
    it has the shear of one that slips on. Where pressure displaces along the surface, a contact
    that grows depends on how finely the loads are cut, by some 0.3 % of depth or force in one load
    from first touch, and 0.03 % in four: press with half as many to see by how much. So does a load
    that turns away from the shear before it: a turn by a right angle at six tenths of what friction
    bears has a slide that is off by 0.7 % in one load, 0.3 % in eight and 0.1 % in sixteen.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> body, shears = rl.Homogeneous(1.0, poisson=0.3), rl.cycle(2e-3, per_cycle=4, cycles=1)
    >>> asked = {"friction": rl.Friction(0.3), "forces": [0.01] * len(shears)}
    >>> curve = rl.press(surface, half_space=body, shear_forces=shears, **asked)
    >>> print((1e3 * curve.slide[:, 0]).round(3), curve.stick_fraction.round(2))
    [ 0.     4.062  0.376 -4.062 -0.376  4.062] [1.   0.36 0.71 0.36 0.71 0.36]
    """

    def _variables(self) -> dict[str, Any]:
        variables = super()._variables()
        kept = [one for one in self.fields if one is not None]
        for each in SLIDING_QUANTITIES:
            if "x" not in each.dims or not kept:
                continue
            values = np.array([getattr(one, each.attribute) for one in kept], float)
            if not self._fields_are_of_some:
                among = np.full((len(self.fields), *values.shape[1:]), np.nan)
                among[self._with_fields] = values
                values = among
            first = "field_load" if self._fields_are_of_some else "load"
            dims = first, *each.dims[1:]
            variables[each.name] = (dims, values, each.attributes(self.unit))
        return variables


@public
@dataclass(frozen=True, eq=False)
class SlidingFields(Fields):
    """Fields of one load on the grid, with friction: those of :class:`~roughline.Fields`, and more.

    Attributes
    ----------
    shear : ndarray, shape (nx, ny, 2)
        Shear on the half-space, along x and y. [pressure]
    slip : ndarray, shape (nx, ny, 2)
        How far the rough body has slipped along the half-space since the load before. [length]
    slip_total : ndarray, shape (nx, ny)
        Length of the way that each point has slipped since first touch. Over a cycle, it is the
        difference between its two ends. [length]
    stick : ndarray of bool, shape (nx, ny)
        Where the bodies touch and do not slip if loads go on as they did last.
    """

    shear: Real
    slip: Real
    slip_total: Real
    stick: Mask
