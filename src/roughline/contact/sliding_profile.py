"""The reduced model's curve of a body of revolution that is pressed and sheared, with friction."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import LineCurve
from roughline.contact.loads import GivenLoads
from roughline.contact.quantities import SLIDING_QUANTITIES
from roughline.contact.revolution import press_profile
from roughline.contact.shear_loads import GivenShear, ShearLoads
from roughline.contact.sliding import left_without_shear
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.jkr import JKR
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.reduction.friction import ShearedRevolution
from roughline.reduction.revolution import Revolution
from roughline.topography.profile import Profile

_ACROSS_ROUNDING = 1e-12  # of the largest load along the surface: what is across it
_SLIDES_FROM = 1 - 1e-9  # of mu F


@public
@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class SlidingLineCurve(LineCurve):
    """Contact quantities of a profile that is pressed and sheared, over its loads, by springs.

    Those of :class:`~roughline.LineCurve`, and what follows of friction, as a
    :class:`~roughline.SlidingCurve` has it. All is exact where Poisson's ratio is zero, for any
    history of loads whose shear is along one line. With other ratios shear is not quite along the
    slide where springs slip, and slides of a ball are too large by up to 0.3 %.

    Attributes
    ----------
    friction : Friction
        The coefficient of friction.
    shear_force : ndarray, shape (loads, 2)
        Total shear force on the half-space. [force]
    slide : ndarray, shape (loads, 2)
        How far the body has slid since first touch. Where it is lifted off under no shear force, it
        is back where it touched first. [length]
    shear_stiffness : ndarray, shape (loads, 2, 2)
        Exact dQ/d(slide) on further shear: 2 G* c along it, with the stick radius c, and 2 G* a
        across. [force / length]
    shear_stiffness_back : ndarray, shape (loads, 2, 2)
        Exact dQ/d(slide) on turning back, 2 G* a, as all of the contact sticks. [force / length]
    stick_fraction : ndarray, shape (loads,)
        Share of the contact that sticks where shear goes on, (c / a)². [1]
    shear_limit : ndarray, shape (loads,)
        Largest shear force that friction bears, mu F. [force]
    dissipated : ndarray, shape (loads,)
        Energy that slip has dissipated since the load before, along a way that is straight in depth
        and slide. [energy]
    """

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
        return left_without_shear(self.slide, self.shear_force)

    def _variables(self) -> dict[str, Any]:
        variables = super()._variables()
        for each in SLIDING_QUANTITIES:
            if "x" not in each.dims:
                values = getattr(self, each.attribute)
                variables[each.name] = (each.dims, values, each.attributes(self.unit))
        return variables


def press_sheared_profile(
    profile: Profile,
    half_space: Homogeneous,
    law: JKR | None,
    given: GivenLoads,
    given_shear: GivenShear,
) -> SlidingLineCurve:
    """Press and shear a body of revolution by the reduction method, springs with friction."""
    _refuse_beyond_springs(half_space, law, given_shear.friction)
    curve = press_profile(profile, half_space, None, given)
    pressed = curve.force if curve.control == "forces" else curve.depth
    law_of_springs, no_fields = Unilateral(), (profile.radii.size, 1)
    loads = given_shear.checked(curve.control, pressed, half_space, law_of_springs, no_fields)
    assert loads is not None
    assert isinstance(loads.friction.coefficient, float)
    axis = _axis(loads)
    along, limit = loads.values @ axis, loads.friction.coefficient * curve.force
    if loads.control == "shear_forces":
        _refuse_sliding(along, limit)
    body = Revolution.of(profile.radii, profile.heights, half_space.E_star, 0.0)
    ratio = 1 / half_space.even_shear[1]
    state, states = ShearedRevolution(body, loads.friction.coefficient, ratio), []
    for depth, force, value in zip(curve.depth, curve.force, along, strict=True):
        led = state.under if loads.control == "shear_forces" else state.at
        states.append(state := led(depth, force, value))
    back = ratio * curve.stiffness
    on = back.copy()
    for i, each in enumerate(states):
        if each.stick_depth < curve.depth[i]:
            on[i] = ratio * 2 * half_space.E_star * each.stick_radius
    touches = curve.stiffness > 0
    vectors: dict[str, Any] = {
        name: np.outer([getattr(each, name) for each in states], axis)
        for name in ("shear_force", "slide")
    }
    plane, tensor = np.eye(2), np.outer(axis, axis)
    pressed_alone: dict[str, Any] = {each.name: getattr(curve, each.name) for each in fields(curve)}
    return SlidingLineCurve(
        **pressed_alone,
        friction=loads.friction,
        **(vectors | {loads.control.removesuffix("s"): loads.values}),
        shear_stiffness=np.multiply.outer(back, plane) - np.multiply.outer(back - on, tensor),
        shear_stiffness_back=np.multiply.outer(back, plane),
        stick_fraction=np.where(touches, on / np.where(touches, back, 1.0), 0.0) ** 2,
        shear_limit=limit,
        dissipated=np.array([each.dissipated for each in states]),
    )


def _refuse_beyond_springs(
    half_space: Homogeneous, law: JKR | None, friction: Friction | None
) -> None:
    """Refuse what springs of a profile do not know."""
    if law is not None:
        raise InputError(
            "friction and law are given, and springs of a Profile that stick bear no friction: "
            "leave one of the two out"
        )
    if isinstance(friction, Friction) and not friction.is_even:
        raise InputError(
            "friction has a strength or a field, and springs of a Profile have one coefficient: "
            "give a number such as rl.Friction(0.3), or press a Surface"
        )
    if half_space.is_coupled:
        raise InputError(
            f"half_space is {half_space!r}, in which pressure displaces along the surface, and the "
            "springs of a Profile do not: give beta=0.0, or press a Surface"
        )


def _axis(loads: ShearLoads) -> Real:
    """Return the line along which all loads along the surface are."""
    sizes = np.hypot(*loads.values.T)
    largest = int(sizes.argmax())
    if sizes[largest] == 0:
        return np.array([1.0, 0.0])
    axis: Real = loads.values[largest] / sizes[largest]
    turned = np.abs(loads.values @ np.array([-axis[1], axis[0]]))
    beside = turned > _ACROSS_ROUNDING * sizes[largest]
    if beside.any():
        x, y = loads.values[beside.argmax()]
        raise InputError(
            f"{loads.control}[{beside.argmax()}] is ({x:g}, {y:g}) and {loads.control}[{largest}] "
            f"({loads.values[largest, 0]:g}, {loads.values[largest, 1]:g}); springs of a Profile "
            "bear shear along one line: give loads along it, or press a Surface"
        )
    return axis


def _refuse_sliding(along: Real, limit: Real) -> None:
    """Refuse shear forces of which friction does not bear as much."""
    beyond = (np.abs(along) > _SLIDES_FROM * limit) & (along != 0)
    if beyond.any():
        at = int(beyond.argmax())
        raise InputError(
            f"shear_forces[{at}] is of the size {abs(along[at]):.6g}, and friction bears less than "
            f"mu F = {limit[at]:.6g} there, so that the body slides: give less, or slides"
        )
