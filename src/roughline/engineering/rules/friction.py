"""Bodies that rub: how far they move before they slide, and what a shear force does to and fro."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from roughline.computing.arrays import Real
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Rule
from roughline.engineering.slip import COUPLED_FROM, ShearCycles, excess_of_coupled
from roughline.engineering.symbols import Symbol, contact_modulus, tangential_modulus
from roughline.facts.fact import Fact
from roughline.units import engineering

_rule = partial(Rule, group="friction")

_SETTLED = 0.01  # of what a cycle dissipates, by which it may differ from the one before
_FULL_LOOP = 4 / math.pi  # loss factor of a loop that fills the rectangle between its turns


def _until_sliding(pressed: Pressed) -> Real | None:
    """Displacement at which all of the contact slips, at the largest load. [m]"""
    slip = pressed.sought.slip
    if slip is None:
        return None
    return np.where(pressed.curve.converged, slip.displacement[-1], np.nan)


def _slip_texts(pressed: Pressed) -> Mapping[str, str]:
    """With which coefficient of friction bodies slip, and under which force they slide."""
    slip = pressed.sought.slip
    if slip is None:
        return {}
    force = engineering(float(slip.force[-1]), "N")
    friction = f"coefficient of friction {slip.friction:g}, sliding from {force} on"
    return {"validity": f"{friction}; {_SLIP.validity}"}


def _coefficient(pressed: Pressed) -> float | None:
    known = pressed.sought.sheared or pressed.sought.slip
    return None if known is None else known.friction


def _symbols(pressed: Pressed) -> list[Symbol]:
    return [
        Symbol("mu", "coefficient of friction", "1", _coefficient(pressed)),
        contact_modulus(pressed),
        tangential_modulus(pressed),
    ]


def _off_where_coupled(pressed: Pressed) -> Fact | None:
    """Say by how much the closed form is off where pressure and shear move each other."""
    slip, beta = pressed.sought.slip, pressed.pair.beta
    if slip is None or abs(beta) <= COUPLED_FROM or pressed.sought.sheared is not None:
        return None
    excess = excess_of_coupled(beta, slip.friction)
    return Fact("slip_of_coupled_bodies", beta=abs(beta), excess=excess)


def _loads_until_sliding(pressed: Pressed) -> Real | None:
    """Shear force at which the last spot slides, mu F. [N]"""
    coefficient = _coefficient(pressed)
    return None if coefficient is None else coefficient * pressed.force


def _is_sheared(pressed: Pressed) -> bool:
    return pressed.sought.sheared is not None


_OneValue = Callable[[ShearCycles], float | None]


def _rows_of_shear(
    found: _OneValue, *, extensive: bool = False, of_slip: bool = True, by_points: bool = False
) -> Callable[[Pressed], Real | None]:
    """Values of what a shear force does, in rows, of the one load under which it does it.

    The interval is as far as the same followed otherwise is away, to either side, by a factor; of
    several causes, the logarithms of these add in squares.
    """

    def value(pressed: Pressed) -> Real | None:
        sheared = pressed.sought.sheared
        one = None if sheared is None else found(sheared)
        if sheared is None or one is None:
            return None
        rows = [one]
        if sheared.is_bounded and one > 0:
            others = sheared.others.values()
            logarithms = [_distance(found, sheared, each, of_slip=of_slip) for each in others]
            if by_points and any(each is not None and each.by_micro_slip for each in others):
                logarithms.append(sheared.one_point_of_stick)
            factor = math.exp(math.hypot(*logarithms))
            rows += [one / factor, one * factor]
        scale = pressed.scale if extensive else 1.0
        return np.where(pressed.curve.converged, np.array(rows)[:, np.newaxis] * scale, np.nan)

    return value


def _distance(
    found: _OneValue, sheared: ShearCycles, other: ShearCycles | None, *, of_slip: bool
) -> float:
    """Logarithm of the factor by which the same followed otherwise leaves a value open."""
    if other is None:
        return math.nan
    compared = [found]
    if of_slip and other.by_micro_slip:
        compared.append(lambda each: each.micro_slip)
    return other.times * max(abs(math.log(_ratio(each(other), each(sheared)))) for each in compared)


def _ratio(there: float | None, here: float | None) -> float:
    """How much larger a value is than another; NaN where one of them is zero, or not known."""
    if there is None or here is None:
        return math.nan
    if there == here:
        return 1.0
    return there / here if min(there, here) > 0 else math.nan


def _force_texts(pressed: Pressed) -> Mapping[str, str]:
    """Under which shear force, of how much that friction bears."""
    sheared = pressed.sought.sheared
    if sheared is None:
        return {}
    force = engineering(sheared.amplitude * pressed.scale, "N")
    share = f"{sheared.amplitude / sheared.limit:.3g}"
    return {"validity": f"shear force Q = {force} along x, {share} of mu F; {_PATH}"}


def _cycle_texts(pressed: Pressed) -> Mapping[str, str]:
    """The same, and which cycle it is of."""
    texts, sheared = _force_texts(pressed), pressed.sought.sheared
    if sheared is None:
        return {}
    which = "the first cycle" if sheared.cycles == 1 else f"cycle {sheared.cycles}"
    return {"validity": f"{which}; {texts['validity']}"}


def _on_settling(pressed: Pressed) -> Fact | None:
    """Say where one cycle is not as the one before, or where that is not known."""
    sheared = pressed.sought.sheared
    if sheared is None or not sheared.curve.half_space.is_coupled:
        return None
    change = sheared.settling
    if change is not None and change <= _SETTLED:
        return None
    return Fact("cycles_still_change", cycles=sheared.cycles, change=change)


def _beside_closed_form(pressed: Pressed) -> Fact | None:
    """Compare with Jäger's closed form, of bodies that pressure and shear move each alone."""
    sheared = pressed.sought.sheared
    if sheared is None or (closed := sheared.closed_form) is None:
        return None
    return Fact(
        "beside_closed_form",
        displacement=closed.displacement,
        further=sheared.displacement / closed.displacement - 1,
        energy=closed.energy * pressed.scale,
        more=sheared.energy / closed.energy - 1,
        beta=abs(pressed.pair.beta) if sheared.curve.half_space.is_coupled else None,
    )


_PATH = "of the body as it is pressed, whose load stays; slow, and without wear"
_sheared_rule = partial(_rule, source="Johnson 1985, ch. 7", differing=_force_texts)
_cycle_rule = partial(_sheared_rule, differing=_cycle_texts)


_SLIP = Rule(
    key="slip_displacement",
    name="displacement before sliding",
    symbol="u_x",
    unit="m",
    group="friction",
    formula="mu (E*/G*) d, d the approach that unloading takes back",
    symbols=_symbols,
    validity="under the largest load, kept while the tangential force grows; normal and tangential "
    "problems uncoupled",
    source="Ciavarella 1998",
    value=_until_sliding,
    differing=_slip_texts,
    answers_question=lambda pressed: not _is_sheared(pressed),
    is_given=True,
    facts=_off_where_coupled,
)
"""Tangential displacement up to which a part of the contact sticks."""

_SLIDING = _rule(
    key="sliding_force",
    name="shear force at which the last spot slides",
    symbol="Q_s",
    unit="N",
    formula="mu F",
    symbols=_symbols,
    validity="Coulomb's law at each point; F is what the bodies press with",
    source="Johnson 1985, ch. 7",
    value=_loads_until_sliding,
    is_given=True,
    is_extensive=True,
)
"""Shear force that friction bears."""

SHEAR_ANSWERS = (
    _sheared_rule(
        key="shear_displacement",
        name="displacement under the shear force",
        symbol="u_Q",
        unit="m",
        formula="slide from no shear to Q, stick and slip",
        value=_rows_of_shear(lambda sheared: sheared.displacement, of_slip=False),
        answers_question=_is_sheared,
        facts=_beside_closed_form,
    ),
    _sheared_rule(
        key="micro_slip",
        name="micro-slip under the shear force",
        symbol="s_Q",
        unit="m",
        formula="u_Q - Q / k_t0, what slip adds to it",
        value=_rows_of_shear(lambda sheared: sheared.micro_slip),
        under=lambda _pressed: ("shear_displacement", 1.0),
    ),
    _sheared_rule(
        key="stiffness_before_slip",
        name="tangential stiffness before slip",
        symbol="k_t0",
        unit="N/m",
        formula="dQ/du without shear, all of the contact stuck",
        value=_rows_of_shear(
            lambda sheared: sheared.stiffness_before, extensive=True, of_slip=False
        ),
        answers_question=_is_sheared,
        is_extensive=True,
        may_be_infinite=True,
    ),
    _sheared_rule(
        key="stiffness_on_further_shear",
        name="tangential stiffness on further shear",
        symbol="k_tQ",
        unit="N/m",
        formula="dQ/du at Q, on more of it",
        value=_rows_of_shear(lambda sheared: sheared.stiffness_on, extensive=True, by_points=True),
        under=lambda _pressed: ("stiffness_on_return", 1.0),
        is_extensive=True,
        may_be_infinite=True,
    ),
    _sheared_rule(
        key="stiffness_on_return",
        name="tangential stiffness on return",
        symbol="k_tR",
        unit="N/m",
        formula="dQ/du at Q, on less of it, all of the contact stuck",
        value=_rows_of_shear(lambda sheared: sheared.stiffness_back, extensive=True, of_slip=False),
        is_extensive=True,
        may_be_infinite=True,
    ),
    _cycle_rule(
        key="cycle_energy",
        name="energy dissipated in a cycle",
        symbol="W_c",
        unit="J",
        formula="sum of shear times slip between Q and -Q and back",
        value=_rows_of_shear(lambda sheared: sheared.energy, extensive=True),
        answers_question=_is_sheared,
        is_extensive=True,
        facts=_on_settling,
    ),
    _cycle_rule(
        key="loss_factor",
        name="loss factor",
        symbol="eta_c",
        unit="1",
        formula="W_c / (2 pi U), U = Q u / 2, 2 u the way between Q and -Q",
        value=_rows_of_shear(lambda sheared: sheared.loss_factor),
        limits=lambda _pressed: (0.0, _FULL_LOOP),
        answers_question=_is_sheared,
    ),
    _cycle_rule(
        key="sticking_share",
        name="share of the contact that never slips",
        symbol="A_s/A",
        unit="1",
        formula="points that slip less than 1/1000 of the largest slip, over those in contact",
        value=_rows_of_shear(lambda sheared: sheared.sticking_share),
        limits=lambda _pressed: (0.0, 1.0),
        in_per_cent=True,
    ),
    _cycle_rule(
        key="fretting",
        name="largest shear times slip over a cycle",
        symbol="w_f",
        unit="J/m²",
        formula="largest of mu p times the way slipped in the cycle, at a point",
        value=_rows_of_shear(lambda sheared: sheared.fretting),
    ),
)
"""Answers about a shear force that goes to and fro."""

FRICTION = (_SLIP, _SLIDING, *SHEAR_ANSWERS)
"""Answers about friction."""
