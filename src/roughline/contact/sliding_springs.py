"""The reduced model's curve of a body that is pressed and sheared, on springs with friction."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import LineCurve
from roughline.contact.loads import GivenLoads
from roughline.contact.reduced import press_line
from roughline.contact.revolution import press_profile
from roughline.contact.shear_loads import GivenShear, ShearLoads
from roughline.contact.sliding import CurveWithFriction
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.jkr import JKR
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.reduction.friction import (
    NormalSprings,
    ShearedSprings,
    SpringsOfLine,
    SpringsOfRevolution,
)
from roughline.reduction.revolution import Revolution
from roughline.reduction.springs import Springs
from roughline.topography.body import Line
from roughline.topography.profile import Profile

_ACROSS_ROUNDING = 1e-12  # of the largest load along the surface: what is across it
_SLIDES_FROM = 1 - 1e-9  # of mu F


@public
@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class SlidingLineCurve(CurveWithFriction, LineCurve):
    """Contact quantities of a profile or a line that is pressed and sheared, by springs.

    Those of :class:`~roughline.LineCurve`, and what follows of friction, as a
    :class:`~roughline.SlidingCurve` has it. All is exact where Poisson's ratio is zero, for any
    history of loads whose shear is along one line. With other ratios shear is not quite along the
    slide where springs slip, and slides of a ball are too large by up to 0.3 %. A rough line has
    the history of its springs exactly, and stands for its surface as far as its stiffness does.

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
        Share of the contact that sticks where shear goes on, (c / a)²; of a line, of its springs
        in contact. [1]
    shear_limit : ndarray, shape (loads,)
        Largest shear force that friction bears, mu F. [force]
    dissipated : ndarray, shape (loads,)
        Energy that slip has dissipated since the load before, along a way that is straight in depth
        and slide. [energy]
    """


def press_sheared_springs(
    body: Profile | Line,
    half_space: Homogeneous,
    law: JKR | None,
    given: GivenLoads,
    given_shear: GivenShear,
) -> SlidingLineCurve:
    """Press and shear a body of revolution, or a reduced line, on springs with friction."""
    _refuse_beyond_springs(half_space, law, given_shear.friction)
    springs: NormalSprings
    if isinstance(body, Line):
        curve, rows = press_line(body, half_space, given), body.heights.size
        springs = SpringsOfLine(Springs.under(body.heights, body.spacing, half_space.E_star))
    else:
        curve, rows = press_profile(body, half_space, None, given), body.radii.size
        profile = Revolution.of(body.radii, body.heights, half_space.E_star, 0.0)
        springs = SpringsOfRevolution(profile)
    pressed = curve.force if curve.control == "forces" else curve.depth
    law_of_springs, no_fields = Unilateral(), (rows, 1)
    loads = given_shear.checked(curve.control, pressed, half_space, law_of_springs, no_fields)
    assert loads is not None
    assert isinstance(loads.friction.coefficient, float)
    axis = _axis(loads)
    along, limit = loads.values @ axis, loads.friction.coefficient * curve.force
    if loads.control == "shear_forces":
        _refuse_sliding(along, limit)
    ratio = 1 / half_space.even_shear[1]
    state, states = ShearedSprings(springs, loads.friction.coefficient, ratio), []
    for depth, force, value in zip(curve.depth, curve.force, along, strict=True):
        led = state.under if loads.control == "shear_forces" else state.at
        states.append(state := led(depth, force, value))
    back = ratio * curve.stiffness
    on = back.copy()
    for i, each in enumerate(states):
        if each.stick_depth < curve.depth[i]:
            on[i] = ratio * each.stick_stiffness
    touches, rank = curve.stiffness > 0, 1 if isinstance(body, Line) else 2  # points of a disc
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
        stick_fraction=np.where(touches, on / np.where(touches, back, 1.0), 0.0) ** rank,
        shear_limit=limit,
        dissipated=np.array([each.dissipated for each in states]),
    )


def _refuse_beyond_springs(
    half_space: Homogeneous, law: JKR | None, friction: Friction | None
) -> None:
    """Refuse what springs of a profile do not know."""
    if law is not None:
        raise InputError(
            "friction and law are given, and springs that stick bear no friction: "
            "leave one of the two out"
        )
    if isinstance(friction, Friction) and not friction.is_even:
        raise InputError(
            "friction has a strength or a field, and springs have one coefficient: "
            "give a number such as rl.Friction(0.3), or press a Surface"
        )
    if half_space.is_coupled:
        raise InputError(
            f"half_space is {half_space!r}, in which pressure displaces along the surface, and the "
            "springs do not: give beta=0.0, or press a Surface"
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
            f"({loads.values[largest, 0]:g}, {loads.values[largest, 1]:g}); springs "
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
