"""The fluid in the gap: what leaks through a seal, and what a gas conducts beside the contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, get_args

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.measures import Measure
from roughline.engineering.fluids import Gas
from roughline.engineering.leak import (
    mass_of_throughput,
    reynolds_number,
    throughput_at_room,
)
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Rule, always
from roughline.engineering.rules.thermal import conductance_of_interface
from roughline.engineering.sealing import Closing, Fluid, SealShape
from roughline.engineering.symbols import Symbol
from roughline.facts.fact import Fact
from roughline.fluid.flow import too_steep
from roughline.fluid.gap import Along
from roughline.fluid.measures import (
    equivalent_aperture,
    flow_factor,
    inverse_gap,
    largest_share,
    slope_of_flow,
)
from roughline.fluid.rarefied import Rarefied
from roughline.fluid.reopening import Reopening
from roughline.fluid.sealing_pressure import SealingPressure
from roughline.units import engineering

_MAIN_CHANNEL_SHARE = 0.5  # share of the flow from which on one channel is told
_DENSITY = 1000.0  # of a liquid, to tell whether inertia counts [kg/m³]
_INERT = 1.0  # Reynolds number times slope from which it does; 12 is as large as viscosity
_RARE_GAS = 0.1  # free path over the aperture beyond which how walls reflect molecules counts
_WIDE_RING = 0.1  # of the mean pressure of the fluid, by which a ring's may differ from a strip's
_MENTIONED = 0.1  # pressure of a fluid left out over the load's, from which on it is said
_MOLECULES = 3e-9  # ten diameters of a molecule of water; those of oils are larger [m]
_MBAR_LITRES = 10.0  # in a Pa m³

_THIN, _STILL = "laminar, thin gap", "a thin gap without convection or radiation"
_MAP_VALIDITY = (
    "of the map, which is one place of the seal: near sealing, another place may leak far more or "
    f"less; {_THIN}"
)
_QUARTERS_VALIDITY = "of the map; the interval holds what its quarters and its grid leave open"
_STIFF_FACES = (
    "stiff faces, which stay parallel, and a ring narrow beside its radius; soft ones open from "
    "the inlet on, as soon as the fluid is p above the outside there"
)
_rule = partial(Rule, group="sealing", validity=_MAP_VALIDITY, source="Reynolds 1886")

_Needed = Callable[[Fluid], Sequence[Measure]]
"""What is taken from the fields of every load, from what is asked."""


def _along_each(*measures_of: Callable[[Rarefied, Along], Measure]) -> _Needed:
    """Measures of the fluid along each direction that is asked for."""
    return lambda fluid: [
        of(fluid.rarefied, along) for along in fluid.directions for of in measures_of
    ]


def _with_fluid(
    needed: _Needed,
) -> Callable[[MaterialPair, Fluid | None], Sequence[Measure]]:
    """What is needed where a fluid is asked for, and nothing elsewhere."""
    return lambda _pair, fluid: () if fluid is None else needed(fluid)


_APERTURES = _along_each(equivalent_aperture)
_FACTORS = _along_each(flow_factor)
_SHARES = _along_each(largest_share)
_SLOPES = _along_each(slope_of_flow)


def _inverse_gap(fluid: Fluid) -> Sequence[Measure]:
    """What a gas of known conductivity finds; in vacuum there is none."""
    if fluid.gas is None or not fluid.conductivity:
        return []
    return [inverse_gap(fluid.gas.temperature_jump(fluid.mean_pressure))]


def _with_slip(pressed: Pressed) -> Real | None:
    """Aperture of plates that let as much of a liquid through as a gas finds, in rows. [m]"""
    fluid, aperture = pressed.sealing, _largest(pressed, _APERTURES)
    if fluid is None or fluid.free_path == 0 or aperture is None:
        return None
    return np.cbrt(fluid.rarefied.plates(aperture))


def _largest(pressed: Pressed, needed: _Needed) -> Real | None:
    """A measure along the direction in which it is larger, in rows; None where it is not taken."""
    measures = [] if pressed.sealing is None else needed(pressed.sealing)
    rows = [found for each in measures if (found := pressed.measure(each.name)) is not None]
    return np.maximum.reduce(rows) if rows else None


def _along(along: Along, pressed: Pressed) -> Real | None:
    """Aperture along one direction, where both are asked for."""
    if pressed.sealing is None or len(pressed.sealing.directions) == 1:
        return None
    return pressed.measure(equivalent_aperture(pressed.sealing.rarefied, along).name)


def _placed(pressed: Pressed) -> Mapping[str, str]:
    """Of which surface an answer is, where that is not the map alone."""
    return {"validity": f"{pressed.place}; {_THIN}"} if pressed.place else {}


def _with_direction(name: str, pressed: Pressed) -> Mapping[str, str]:
    """The name of an answer with the direction that it is of."""
    along = "both" if pressed.sealing is None else pressed.sealing.along
    direction = "leakier direction" if along == "both" else f"along {along}"
    return {"name": f"{name}, {direction}", **_placed(pressed)}


def _leak(pressed: Pressed) -> Real | None:
    """Volume of a liquid, or pressure times volume of a gas, per time, in rows. [m³/s, Pa m³/s]"""
    fluid, aperture = pressed.sealing, _largest(pressed, _APERTURES)
    if fluid is None or aperture is None:
        return None
    found = fluid.leak(aperture)
    if found is None:
        return None
    found = np.where(_lift(pressed) >= 1, np.nan, found)
    medium = fluid.medium
    if isinstance(medium, Gas) or len(found) == 1:
        return found
    factor = medium.viscosity_factor
    return np.stack([found[0], found[1] / factor, found[2] * factor])


def _lift(pressed: Pressed) -> Real:
    """Mean pressure of the fluid above the outside, over that of the load, (loads,)."""
    fluid = pressed.sealing
    excess = 0.0 if fluid is None else fluid.excess
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(excess > 0, excess / pressed.load_pressure, 0.0)


def _carried(pressed: Pressed) -> Real:
    """Share of the load that the fluid carries, all of it where it lifts the bodies, (loads,)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        share = 1 - pressed.force / pressed.load
    return np.where(pressed.lifted, 1.0, np.nan_to_num(share))


def _above_outside(fluid: Fluid) -> dict[str, Any]:
    """The fluid, and how far its pressure is above the outside. [Pa]"""
    return {"fluid": fluid.medium.name, "excess": fluid.excess}


def _lifts(pressed: Pressed) -> Fact | None:
    """Say under which loads the fluid would lift the bodies apart, if it is not to carry any."""
    fluid, lift = pressed.sealing, _lift(pressed)
    if fluid is None or not (lift >= 1).any():
        return None
    return Fact("fluid_would_lift", **_above_outside(fluid))


def _ends(values: Real) -> tuple[float, ...]:
    """The least and the largest of values, or the only one."""
    return tuple(dict.fromkeys((float(values.min()), float(values.max()))))


def _carries(pressed: Pressed) -> Fact | None:
    """Say which part of the load the fluid carries."""
    fluid = pressed.sealing
    if fluid is None:
        return None
    share, loads = _carried(pressed), pressed.load_pressure
    counts = (share > 0) & ~pressed.lifted
    if not counts.any():
        return None
    return Fact(
        "fluid_carries",
        **_above_outside(fluid),
        **_wide_ring(fluid),
        shares=_ends(share[counts]),
        loads=_ends(loads[counts]),
        opens_faces=bool(fluid.opens_soft_faces(loads[counts]).any()),
        yields=pressed.yields,
        sticks=pressed.attraction is not None,
    )


def _wide_ring(fluid: Fluid) -> dict[str, float | None]:
    """Mean pressures in a ring that is not narrow beside its radius; None of others. [Pa]"""
    both = fluid.excess_in_ring
    is_narrow = max(abs(each - fluid.excess) for each in both) <= _WIDE_RING * fluid.excess
    return dict(zip(("inside", "outside"), (None, None) if is_narrow else both, strict=True))


def _left_out(pressed: Pressed) -> Fact | None:
    """Say where the fluid would carry a part of the load, but is not to."""
    fluid, lift = pressed.sealing, _lift(pressed)
    part = lift[(lift >= _MENTIONED) & (lift < 1)]
    if fluid is None or fluid.carries is not False or not part.size:
        return None
    return Fact("fluid_left_out", **_above_outside(fluid), share=float(part.max()))


def _opens(pressed: Pressed) -> Fact | None:
    """Say under which loads the fluid lifts the bodies apart."""
    fluid, lifted = pressed.sealing, pressed.lifted
    if fluid is None or not lifted.any():
        return None
    numbers = {
        "loads": _ends(pressed.load_pressure[lifted]),
        "sticks": pressed.attraction is not None,
    }
    return Fact("fluid_lifts", **_above_outside(fluid), **_wide_ring(fluid), **numbers)


def _opening_pressure(pressed: Pressed) -> Real | None:
    """Absolute pressure at the inlet from which on the fluid lifts the bodies. [Pa]"""
    fluid = pressed.sealing
    return None if fluid is None or fluid.inlet is None else fluid.opens_at(pressed.load_pressure)


def _opening_texts(pressed: Pressed) -> Mapping[str, str]:
    """How the mean pressure follows along the way, and of which outlet."""
    fluid = pressed.sealing
    if fluid is None:
        return {}
    mean = "(P1 + P2) / 2" if fluid.gas is None else "2/3 (P1² + P1 P2 + P2²) / (P1 + P2)"
    texts = {"formula": f"P1 at which {mean} is p above the outside"}
    if pressed.attraction is not None:
        texts["validity"] = f"{_STIFF_FACES}; bodies that stick hold out longer"
    return texts


def _carried_at_sealing(pressed: Pressed) -> float:
    """Mean pressure that the fluid carries under the load that seals. [Pa]"""
    fluid, closing = pressed.sealing, pressed.sought.closing
    if fluid is None or closing is None:
        return 0.0
    seals = closing.pressure.value
    return float(fluid.load_on(np.array([seals]), 1.0)[0]) - seals


def _load_that_seals(pressed: Pressed) -> Fact | None:
    """Say what the load that seals is more, where the fluid carries a part of it."""
    carried = _carried_at_sealing(pressed)
    return Fact("load_that_seals", carried=carried) if carried > 0 else None


def _bodies_alone_texts(pressed: Pressed, *, share: bool) -> Mapping[str, str]:
    """What the fluid adds to pressures and loads that are of the contact alone."""
    fluid, carried = pressed.sealing, _carried_at_sealing(pressed)
    if fluid is None or pressed.sought.closing is None:
        return {}
    if share:
        carried = fluid.excess if (_carried(pressed) > 0).any() else 0.0
    if not carried > 0:
        return {}
    excess = engineering(carried, "Pa")
    own = f"of what the bodies press with, beside the {excess} that the fluid carries"
    return {"validity": f"{own}; {_QUARTERS_VALIDITY}"}


def _liquid_leak(pressed: Pressed) -> Real | None:
    return None if pressed.sealing is None or pressed.sealing.gas else _leak(pressed)


def _gas_leak(quantity: Callable[[Real, Gas], Real], pressed: Pressed) -> Real | None:
    """What follows from the pressure times volume of a gas that leaks."""
    gas = None if pressed.sealing is None else pressed.sealing.gas
    leak = None if gas is None else _leak(pressed)
    return None if gas is None or leak is None else quantity(leak, gas)


def _reynolds(pressed: Pressed) -> Real | float:
    """Reynolds number of what leaks, zero where no leak is asked for. [1]"""
    fluid, leak = pressed.sealing, _leak(pressed)
    if fluid is None or fluid.seal is None or leak is None:
        return 0.0
    mass = _DENSITY * leak[0] if fluid.gas is None else mass_of_throughput(leak[0], fluid.gas)
    return np.abs(reynolds_number(mass, fluid.seal.width, fluid.medium.viscosity))


def _through_seal(pressed: Pressed) -> Mapping[str, str]:
    fluid = pressed.sealing
    if fluid is None or fluid.seal is None or fluid.inlet is None:
        return {}
    medium = fluid.medium
    factor = 1.0 if isinstance(medium, Gas) else medium.viscosity_factor
    known = "" if factor == 1 else f", viscosity known to a factor of {factor:g}"
    place = _placed(pressed).get("validity", _MAP_VALIDITY)
    if fluid.gas is not None:
        place += "; kinetic theory at the local pressure and gap (Cercignani 1963)"
    return {
        "validity": f"{medium.name}{known}, {engineering(fluid.inlet, 'Pa')} to "
        f"{engineering(fluid.outlet, 'Pa')} absolute, seal {fluid.seal.words}; {place}"
    }


def _one_channel(pressed: Pressed) -> Fact | None:
    """Say where a single channel carries half of the flow."""
    share, aperture = _largest(pressed, _SHARES), _largest(pressed, _APERTURES)
    if share is None or aperture is None:
        return None
    shares = np.where(aperture[0] > 0, share[0], 0.0)
    if not np.nanmax(shares, initial=0.0) >= _MAIN_CHANNEL_SHARE:
        return None
    worst = int(np.nanargmax(shares))
    pressure = float(pressed.load_pressure[worst])
    return Fact("one_channel", share=float(shares[worst]), pressure=pressure)


def _sealed(pressed: Pressed) -> Fact | None:
    """Say under which loads no path is open, and whether that is sure."""
    aperture = _largest(pressed, _APERTURES)
    if aperture is None:
        return None
    sealed = (aperture[0] == 0) & (_lift(pressed) < 1)
    if not sealed.any():
        return None
    loads = pressed.load_pressure
    return Fact(
        "no_path",
        **{"count": int(sealed.sum()), "all": sealed.size},
        **{"least": float(loads[sealed].min()), "most": float(loads[sealed].max())},
        # on the way back dents may seal where nothing did before
        are_highest=not (np.diff(loads) < 0).any(),
        may_be_open=bool(aperture.shape[0] == 3 and (aperture[2][sealed] > 0).any()),
    )


def _without_interval(pressed: Pressed) -> Fact | None:
    """Say why a leak has no interval where the contact has."""
    aperture = _largest(pressed, _APERTURES)
    if aperture is None or len(aperture) > 1 or pressed.intervals is None or not pressed.place:
        return None
    return Fact("leak_without_interval", fact=pressed.place)


def _thin_gap_limits(pressed: Pressed) -> list[Fact | None]:
    """Say where the equation of thin gaps is no longer good, and where walls count."""
    fluid, steep = pressed.sealing, _largest(pressed, _SLOPES)
    aperture = _largest(pressed, _APERTURES)
    if steep is None or fluid is None or aperture is None:
        return []
    found = [too_steep(float(np.nanmax(steep[0], initial=0.0)))]
    if (inertia := float(np.nanmax(_reynolds(pressed) * steep[0], initial=0.0))) > _INERT:
        found.append(Fact("inertia_counts", number=inertia, limit=_INERT))
    is_open = aperture[0] > 0
    if not is_open.any():
        return found
    narrowest = float(np.nanmin(aperture[0][is_open]))
    if fluid.gas is None and narrowest < _MOLECULES:
        found.append(Fact("few_molecules", aperture=narrowest, limit=_MOLECULES))
    if fluid.gas is not None and (rare := fluid.free_path / narrowest) > _RARE_GAS:
        found.append(Fact("gas_is_rare", fluid=fluid.medium.name, ratio=rare, limit=_RARE_GAS))
    return found


def _bisected(
    which: Callable[[Closing], SealingPressure | Reopening | None], pressed: Pressed
) -> Real | None:
    """What bisection found, the same under all loads, with its ends where they are known."""
    closing = pressed.sought.closing
    found = None if closing is None else which(closing)
    if found is None:
        return None
    rows = [found.value] if np.isnan(found.interval).any() else [found.value, *found.interval]
    known = pressed.curve.converged | pressed.lifted
    return np.where(known, np.array(rows)[:, np.newaxis], np.nan)


def _stays_tight(pressed: Pressed) -> Fact | None:
    """Say where the load may be taken off altogether."""
    closing = pressed.sought.closing
    reopens = None if closing is None else closing.reopening
    return None if reopens is None or reopens.low > 0 else Fact("stays_tight")


def _without_leak(pressed: Pressed) -> bool:
    """Whether a fluid is asked for, but neither its leak nor the pressure that seals."""
    fluid = pressed.sealing
    is_of_leak = fluid is not None and fluid.seal is not None
    return fluid is not None and not is_of_leak and pressed.sought.closing is None


def _gas_conductance(pressed: Pressed) -> Real | None:
    fluid, inverse = pressed.sealing, _largest(pressed, _inverse_gap)
    return None if fluid is None or inverse is None else fluid.conductivity * inverse


def _joint_conductance(pressed: Pressed) -> Real | None:
    gas, solid = _gas_conductance(pressed), conductance_of_interface(pressed)
    if gas is None or solid is None:
        return None
    return gas + solid if gas.shape == solid.shape else gas[:1] + solid[:1]


def _fluid_symbols(pressed: Pressed) -> list[Symbol]:
    """What formulas name of a fluid, of the gap and of the seal that it crosses."""
    fluid = pressed.sealing
    if fluid is None:
        return []
    found = [
        *_seal_symbols(fluid.seal),
        Symbol("P1", "absolute pressure at the inlet", "Pa", fluid.inlet),
        Symbol("P2", "absolute pressure at the outlet", "Pa", fluid.outlet),
        Symbol("eta", f"viscosity of {fluid.medium.name}", "Pa s", fluid.medium.viscosity),
        Symbol("u", "gap", "m"),
    ]
    gas = fluid.gas
    if gas is None:
        return found
    return [
        *found,
        Symbol("R_s", "specific gas constant", "J/(kg K)", gas.gas_constant),
        Symbol("T", "temperature of the gas", "K", gas.temperature),
        Symbol("k_g", "thermal conductivity of the gas", "W/(m K)", gas.conductivity),
        Symbol("M", "temperature jump length", "m", gas.temperature_jump(fluid.mean_pressure)),
    ]


def _seal_symbols(seal: SealShape | None) -> list[Symbol]:
    """The face that a fluid crosses; sides of a ring have no value of their own."""
    if seal is not None and seal.is_ring:
        meaning = "of the ring, whose radii are r and R: 2 pi / ln(R/r)"
        return [Symbol("W/B", meaning, "1", seal.ratio)]
    length, width = (None, None) if seal is None else (seal.width, seal.width / seal.ratio)
    return [
        Symbol("W", "length of the seal across the flow", "m", length),
        Symbol("B", "width of the seal along the flow", "m", width),
    ]


SEALING = (
    _rule(
        key="sealing_pressure",
        name="sealing pressure",
        symbol="p_s",
        unit="Pa",
        formula="mean pressure at which the last channel closes on first loading, by bisection",
        validity=_QUARTERS_VALIDITY,
        source="Dapp et al. 2012",
        value=partial(_bisected, lambda closing: closing.pressure),
        differing=partial(_bodies_alone_texts, share=False),
        facts=_load_that_seals,
        answers_question=always,
    ),
    _rule(
        key="reopening",
        name="load left when ten times as much leaks",
        symbol="F_10/F",
        unit="1",
        formula="share of the largest load down to which it may be taken off, by bisection",
        validity=_QUARTERS_VALIDITY,
        source="Pérez-Ràfols, Larsson and Almqvist 2016",
        value=partial(_bisected, lambda closing: closing.reopening),
        differing=partial(_bodies_alone_texts, share=True),
        facts=_stays_tight,
        answers_question=always,
        limits=lambda _pressed: (0.0, 1.0),
        in_per_cent=True,
    ),
    _rule(
        key="leak_rate",
        name="leak rate",
        symbol="Q",
        unit="m³/s",
        formula="(W/B) u_h³ (P1 - P2) / (12 eta)",
        symbols=_fluid_symbols,
        value=_liquid_leak,
        unknown=_lifts,
        differing=_through_seal,
        answers_question=always,
    ),
    _rule(
        key="leak_throughput",
        name="leak rate",
        symbol="q_pV",
        unit="mbar l/s",
        formula="(W/B) u_s³ (P1² - P2²) / (24 eta), at 20 °C; u_s with slip",
        symbols=_fluid_symbols,
        unknown=_lifts,
        value=partial(_gas_leak, lambda leak, gas: _MBAR_LITRES * throughput_at_room(leak, gas)),
        differing=_through_seal,
        answers_question=always,
    ),
    _rule(
        key="leak_mass",
        name="mass that leaks",
        symbol="m_dot",
        unit="kg/s",
        formula="(W/B) u_s³ (P1² - P2²) / (24 eta R_s T)",
        symbols=_fluid_symbols,
        value=partial(_gas_leak, mass_of_throughput),
        unknown=_lifts,
        differing=_through_seal,
    ),
    _rule(
        key="opening_pressure",
        name="opens at",
        symbol="P_o",
        unit="Pa",
        formula="P1 at which the fluid is p above the outside, in the mean of the gap",
        symbols=_fluid_symbols,
        validity=_STIFF_FACES,
        source="",
        value=_opening_pressure,
        differing=_opening_texts,
        facts=_opens,
        leads=lambda pressed: bool((_carried(pressed) > 0).any()),
        is_given=True,
    ),
    _rule(
        key="fluid_share",
        name="share of the load that the fluid carries",
        symbol="s_f",
        unit="1",
        formula="1 - F_b / F, F_b the force with which the bodies press",
        validity="other answers are of what is left: their F and p are (1 - s_f) of the load",
        source="",
        value=lambda pressed: share if (share := _carried(pressed)).any() else None,
        facts=_carries,
        in_per_cent=True,
        is_given=True,
    ),
    _rule(
        key="hydraulic_aperture",
        name="hydraulic aperture",
        symbol="u_h",
        unit="m",
        formula="gap of flat plates that let as much through, (12 eta Q B/(W (P1 - P2)))^(1/3)",
        symbols=_fluid_symbols,
        value=partial(_largest, needed=_APERTURES),
        differing=partial(_with_direction, "hydraulic aperture"),
        facts=lambda pressed: (
            _left_out(pressed),
            _without_interval(pressed),
            *_thin_gap_limits(pressed),
            _sealed(pressed),
        ),
        leads=always,
        answers_question=_without_leak,
        measures=_with_fluid(_APERTURES),
    ),
    _rule(
        key="aperture_with_slip",
        name="aperture with slip",
        symbol="u_s",
        unit="m",
        formula="gap of flat plates between which as much of a liquid would flow",
        value=_with_slip,
        differing=partial(_with_direction, "aperture with slip"),
    ),
    *(
        _rule(
            key=f"hydraulic_aperture_{along}",
            name=f"hydraulic aperture along {along}",
            symbol=f"u_h{along}",
            unit="m",
            formula=f"the same, along {along} over the map",
            value=partial(_along, along),
            differing=_placed,
        )
        for along in get_args(Along)
    ),
    _rule(
        key="pressure_flow_factor",
        name="pressure flow factor",
        symbol="phi_p",
        unit="1",
        formula="(u_h / u_m)³",
        source="Patir and Cheng 1978",
        value=partial(_largest, needed=_FACTORS),
        differing=partial(_with_direction, "pressure flow factor"),
        measures=_with_fluid(_FACTORS),
    ),
    _rule(
        key="largest_channel",
        name="share of the strongest channel",
        symbol="s_1",
        unit="1",
        formula="largest flow between two places of contact on a line across it, over all of it",
        validity="of the map; the larger one of both directions",
        source="",
        value=partial(_largest, needed=_SHARES),
        facts=_one_channel,
        limits=lambda _pressed: (0.0, 1.0),
        in_per_cent=True,
        measures=_with_fluid(_along_each(largest_share, slope_of_flow)),
    ),
    _rule(
        key="gas_conductance",
        name="thermal conductance per area of the gas",
        symbol="h_g",
        unit="W/(m² K)",
        group="thermal",
        formula="k_g <1 / (u + M)> of the open gap, M the temperature jump length",
        symbols=_fluid_symbols,
        validity=f"of the map; {_STILL}",
        differing=lambda pressed: {"validity": f"{pressed.place or 'of the map'}; {_STILL}"},
        source="Yovanovich 2005",
        value=_gas_conductance,
        measures=_with_fluid(_inverse_gap),
    ),
    _rule(
        key="joint_conductance",
        name="thermal conductance per area with the gas",
        symbol="h_j",
        unit="W/(m² K)",
        group="thermal",
        formula="h_c + h_g",
        validity="spots and gas side by side; their intervals are added",
        source="Yovanovich 2005",
        value=_joint_conductance,
        leads=always,
        answers_question=_without_leak,
        may_be_infinite=True,
        measures=_with_fluid(_inverse_gap),
    ),
)
"""Answers about a fluid in the gap, in their order."""
