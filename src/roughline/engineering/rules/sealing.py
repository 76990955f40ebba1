"""The fluid in the gap: what leaks through a seal, and what a gas conducts beside the contact."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.measures import Measure
from roughline.engineering.fluids import Gas
from roughline.engineering.leak import (
    beyond_slip,
    gas_throughput,
    liquid_leak,
    mass_of_throughput,
    reynolds_number,
    throughput_at_room,
)
from roughline.engineering.pressed import Pressed
from roughline.engineering.rule import Rule, always
from roughline.engineering.rules.thermal import conductance_of_interface
from roughline.engineering.sealing import Sealing
from roughline.fluid.flow import Along, why_too_steep
from roughline.fluid.measures import (
    flow_factor,
    hydraulic_aperture,
    inverse_gap,
    largest_share,
    slope_of_flow,
)
from roughline.units import decimal, engineering

_rule = partial(Rule, group="sealing")

_HALF = 0.5  # share of the flow from which on one channel is told
_DENSITY = 1000.0  # of a liquid, to tell whether inertia counts [kg/m³]
_INERT = 1.0  # Reynolds number times slope from which it does; 12 is as large as viscosity
_RARE = 0.1  # free path over the aperture beyond which slip is not all that a thin gas does
_MBAR_LITRES = 10.0  # in a Pa m³

_OF_THE_MAP = (
    "of the map, which is one place of the seal: near sealing, another place may leak far more or "
    "less; laminar, thin gap"
)
_PUBLISHED = "Reynolds 1886"


def _along_each(
    measure_of: Callable[[Along], Measure],
) -> Callable[[Sealing], Sequence[Measure]]:
    """A measure along each direction that is asked for."""
    return lambda asked: [measure_of(along) for along in asked.directions]


def _with_slip(asked: Sealing) -> Sequence[Measure]:
    """Apertures that a gas finds at its mean pressure."""
    if asked.gas is None:
        return []
    return [hydraulic_aperture(along, asked.free_path) for along in asked.directions]


def _largest(pressed: Pressed, measure_of: Callable[[Along], Measure]) -> Real | None:
    """A measure along the direction in which it is larger, in rows."""
    if pressed.sealing is None:
        return None
    rows = [pressed.measure(measure_of(along).name) for along in pressed.sealing.directions]
    known = [each for each in rows if each is not None]
    return np.maximum.reduce(known) if len(known) == len(rows) else None


def _along(pressed: Pressed, along: Along) -> Real | None:
    """Aperture along one direction, where both are asked for."""
    if pressed.sealing is None or len(pressed.sealing.directions) == 1:
        return None
    return pressed.measure(hydraulic_aperture(along).name)


def _aperture(pressed: Pressed) -> Real | None:
    return _largest(pressed, hydraulic_aperture)


def _of_direction(name: str) -> Callable[[Pressed], Mapping[str, str]]:
    """The name of an answer with the direction that it is of."""

    def texts(pressed: Pressed) -> Mapping[str, str]:
        if pressed.sealing is None:
            return {}
        both = pressed.sealing.along == "both"
        return {
            "name": f"{name}, {'leakier direction' if both else 'along ' + pressed.sealing.along}"
        }

    return texts


def _crossed(pressed: Pressed) -> Sealing | None:
    """What is asked, if a seal is crossed under known pressures."""
    asked = pressed.sealing
    return None if asked is None or asked.seal is None or asked.inlet is None else asked


def _liquid_leak(pressed: Pressed) -> Real | None:
    asked, aperture = _crossed(pressed), _aperture(pressed)
    if asked is None or aperture is None or isinstance(asked.fluid, Gas):
        return None
    assert asked.seal is not None
    assert asked.inlet is not None
    found = liquid_leak(aperture, asked.seal.ratio, asked.inlet - asked.outlet, asked.fluid)
    return _widened(found, asked.fluid.viscosity_factor, asked.fluid.viscosity_factor)


def _throughput(pressed: Pressed) -> Real | None:
    """Pressure times volume of a gas that leaks, in rows. [Pa m³ / s]"""
    asked = _crossed(pressed)
    if asked is None or asked.gas is None:
        return None
    aperture = _largest(pressed, partial(_slipped, asked))
    if aperture is None:
        return None
    assert asked.seal is not None
    assert asked.inlet is not None
    found = gas_throughput(aperture, asked.seal.ratio, asked.inlet, asked.outlet, asked.gas)
    without_slip = _aperture(pressed)
    if without_slip is None:
        return found
    widest = np.where(without_slip[0] > 0, without_slip[0], without_slip[-1])
    gap = np.where(widest > 0, widest, np.inf)  # nothing leaks, however rare the gas
    return _widened(found, 1.0, beyond_slip(asked.free_path / gap))


def _widened(rows: Real, less: float, more: Real | float) -> Real:
    """A quantity in rows that may be so many times smaller and larger than its interval says."""
    return rows if len(rows) == 1 else np.stack([rows[0], rows[1] / less, rows[2] * more])


def _slipped(asked: Sealing, along: Along) -> Measure:
    return hydraulic_aperture(along, asked.free_path)


def _mass(pressed: Pressed) -> Real | None:
    throughput, asked = _throughput(pressed), pressed.sealing
    if throughput is None or asked is None or asked.gas is None:
        return None
    return mass_of_throughput(throughput, asked.gas)


def _reynolds(pressed: Pressed) -> Real:
    """Reynolds number of what leaks, zero where no leak is asked for. [1]"""
    asked, mass, volume = _crossed(pressed), _mass(pressed), _liquid_leak(pressed)
    if mass is None and volume is not None:
        mass = _DENSITY * volume
    if asked is None or asked.seal is None or mass is None:
        return np.zeros(pressed.curve.force.shape)
    return np.abs(reynolds_number(mass[0], asked.seal.width, asked.fluid.viscosity))


def _in_mbar_litres(pressed: Pressed) -> Real | None:
    throughput, asked = _throughput(pressed), pressed.sealing
    if throughput is None or asked is None or asked.gas is None:
        return None
    return throughput_at_room(throughput, asked.gas) * _MBAR_LITRES


def _through_seal(pressed: Pressed) -> Mapping[str, str]:
    asked = _crossed(pressed)
    if asked is None or asked.seal is None or asked.inlet is None:
        return {}
    factor = 1.0 if isinstance(asked.fluid, Gas) else asked.fluid.viscosity_factor
    known = "" if factor == 1 else f", viscosity known to a factor of {factor:g}"
    return {
        "validity": f"{asked.fluid.name}{known}, {engineering(asked.inlet, 'Pa')} to "
        f"{engineering(asked.outlet, 'Pa')} absolute, seal {asked.seal.words}; {_OF_THE_MAP}"
    }


def _one_channel(pressed: Pressed) -> str:
    """Say where a single channel carries half of the flow."""
    share, aperture = _largest(pressed, largest_share), _aperture(pressed)
    if share is None or aperture is None:
        return ""
    shares = np.where(aperture[0] > 0, share[0], 0.0)
    if not np.nanmax(shares, initial=0.0) >= _HALF:
        return ""
    worst = int(np.nanargmax(shares))
    return (
        f"a single channel of the map carries {100 * shares[worst]:.0f}% of the flow at a mean "
        f"pressure of {engineering(pressed.pressure[worst], 'Pa')}: the leak hangs on one place, "
        "and that of another map of the same part may differ by a large factor; press several"
    )


def _sealed(pressed: Pressed) -> str:
    """Say under which loads no path is open, and whether that is sure."""
    aperture = _aperture(pressed)
    if aperture is None or not (aperture[0] == 0).any():
        return ""
    least = pressed.pressure[aperture[0] == 0].min()
    text = (
        f"no path leads through the map from {engineering(least, 'Pa')} on: the leak is exactly "
        "zero on this map and its grid"
    )
    open_still = aperture.shape[0] == 3 and (aperture[2][aperture[0] == 0] > 0).any()
    return text + (", but coarser grids or waves that no grid here has leak" if open_still else "")


def _beyond_reynolds(pressed: Pressed) -> str:
    """Say where the equation of thin gaps, or slip, is no longer good."""
    steep, asked, aperture = _largest(pressed, slope_of_flow), pressed.sealing, _aperture(pressed)
    if steep is None or asked is None or aperture is None:
        return ""
    found = []
    if too_steep := why_too_steep(float(np.nanmax(steep[0], initial=0.0))):
        found.append(too_steep)
    if (inertia := float(np.nanmax(_reynolds(pressed) * steep[0], initial=0.0))) > _INERT:
        found.append(
            f"the Reynolds number times the slope of the gap is {decimal(inertia, 2)}: inertia, "
            f"which counts beyond {_INERT:g}, is left out, and less than this flows"
        )
    is_open = aperture[0] > 0
    if asked.gas is not None and is_open.any():
        rare = asked.free_path / float(np.nanmin(aperture[0][is_open]))
        if rare > _RARE:
            found.append(
                f"the mean free path of {asked.fluid.name} is {decimal(rare, 2)} of the hydraulic "
                f"aperture: beyond {_RARE:g}, slip of the first order gives too little, half at 5"
            )
    return "; ".join(found)


def _sealing_pressure(pressed: Pressed) -> Real | None:
    """Under all loads the same."""
    if pressed.closing is None:
        return None
    found = pressed.closing.pressure
    return _under_all(pressed, found.value, found.interval)


def _reopening(pressed: Pressed) -> Real | None:
    if pressed.closing is None or pressed.closing.reopening is None:
        return None
    found = pressed.closing.reopening
    return _under_all(pressed, found.value, found.interval)


def _stays_tight(pressed: Pressed) -> str:
    """Say where the load may be taken off altogether."""
    if pressed.closing is None or pressed.closing.reopening is None:
        return ""
    if pressed.closing.reopening.low > 0:
        return ""
    return (
        "once the largest load was on, less than ten times as much leaks however far it is taken "
        "off: its dents stay"
    )


def _under_all(pressed: Pressed, value: float, ends: tuple[float, float]) -> Real:
    """A value in rows that is the same under all loads, with its ends where they are known."""
    rows = [value] if np.isnan(ends).any() else [value, *ends]
    return np.where(pressed.curve.converged, np.array(rows)[:, np.newaxis], np.nan)


def _gas_conductance(pressed: Pressed) -> Real | None:
    asked = pressed.sealing
    if asked is None or not (measures := _inverse_gap(asked)):
        return None
    inverse = pressed.measure(measures[0].name)
    if inverse is None or asked.gas is None or asked.gas.conductivity is None:
        return None
    return asked.gas.conductivity * inverse


def _inverse_gap(asked: Sealing) -> Sequence[Measure]:
    """What a gas of known conductivity finds; in vacuum there is none."""
    if asked.gas is None or not asked.conducts:
        return []
    return [inverse_gap(asked.gas.temperature_jump(asked.mean_pressure))]


def _joint_conductance(pressed: Pressed) -> Real | None:
    gas, solid = _gas_conductance(pressed), conductance_of_interface(pressed)
    if gas is None or solid is None:
        return None
    return gas + solid if gas.shape == solid.shape else gas[:1] + solid[:1]


SEALING = (
    _rule(
        key="leak_rate",
        name="leak rate",
        symbol="Q",
        unit="m³/s",
        formula="(W/B) u_h³ (P1 - P2) / (12 eta)",
        validity=_OF_THE_MAP,
        source=_PUBLISHED,
        value=_liquid_leak,
        differing=_through_seal,
        leads=always,
    ),
    _rule(
        key="leak_throughput",
        name="leak rate",
        symbol="q_pV",
        unit="mbar l/s",
        formula="(W/B) u_s³ (P1² - P2²) / (24 eta), at 20 °C; u_s with slip",
        validity=_OF_THE_MAP,
        source=_PUBLISHED,
        value=_in_mbar_litres,
        differing=_through_seal,
        leads=always,
        measured_with=_with_slip,
    ),
    _rule(
        key="leak_mass",
        name="mass that leaks",
        symbol="m_dot",
        unit="kg/s",
        formula="(W/B) u_s³ (P1² - P2²) / (24 eta R_s T)",
        validity=_OF_THE_MAP,
        source=_PUBLISHED,
        value=_mass,
        differing=_through_seal,
        measured_with=_with_slip,
    ),
    _rule(
        key="hydraulic_aperture",
        name="hydraulic aperture",
        symbol="u_h",
        unit="m",
        formula="gap of flat plates that let as much through, (12 eta Q B/(W (P1 - P2)))^(1/3)",
        validity=_OF_THE_MAP,
        source=_PUBLISHED,
        value=_aperture,
        differing=_of_direction("hydraulic aperture"),
        warning=_beyond_reynolds,
        note=_sealed,
        leads=always,
        measured_with=_along_each(hydraulic_aperture),
    ),
    _rule(
        key="hydraulic_aperture_x",
        name="hydraulic aperture along x",
        symbol="u_hx",
        unit="m",
        formula="the same, along x over the map",
        validity=_OF_THE_MAP,
        source=_PUBLISHED,
        value=partial(_along, along="x"),
    ),
    _rule(
        key="hydraulic_aperture_y",
        name="hydraulic aperture along y",
        symbol="u_hy",
        unit="m",
        formula="the same, along y over the map",
        validity=_OF_THE_MAP,
        source=_PUBLISHED,
        value=partial(_along, along="y"),
    ),
    _rule(
        key="pressure_flow_factor",
        name="pressure flow factor",
        symbol="phi_p",
        unit="1",
        formula="(u_h / u_m)³",
        validity=_OF_THE_MAP,
        source="Patir and Cheng 1978",
        value=partial(_largest, measure_of=flow_factor),
        differing=_of_direction("pressure flow factor"),
        measured_with=_along_each(flow_factor),
    ),
    _rule(
        key="largest_channel",
        name="share of the strongest channel",
        symbol="s_1",
        unit="1",
        formula="largest flow between two places of contact on a line across it, over all of it",
        validity="of the map; the larger one of both directions",
        value=partial(_largest, measure_of=largest_share),
        warning=_one_channel,
        limits=lambda _pressed: (0.0, 1.0),
        in_per_cent=True,
        measured_with=lambda asked: [
            each(along) for along in asked.directions for each in (largest_share, slope_of_flow)
        ],
    ),
    _rule(
        key="sealing_pressure",
        name="sealing pressure",
        symbol="p_s",
        unit="Pa",
        formula="mean pressure at which the last channel closes on first loading, by bisection",
        validity="of the map; the interval holds what its quarters and its grid leave open",
        source="Dapp et al. 2012",
        value=_sealing_pressure,
        leads=always,
    ),
    _rule(
        key="reopening",
        name="load left when ten times as much leaks",
        symbol="F_10/F",
        unit="1",
        formula="share of the largest load down to which it may be taken off, by bisection",
        validity="of the map",
        source="Pérez-Ràfols, Larsson and Almqvist 2016",
        value=_reopening,
        note=_stays_tight,
        limits=lambda _pressed: (0.0, 1.0),
        in_per_cent=True,
    ),
    _rule(
        key="gas_conductance",
        name="thermal conductance per area of the gas",
        symbol="h_g",
        unit="W/(m² K)",
        group="thermal",
        formula="k_g <1 / (u + M)> of the open gap, M the temperature jump length",
        validity="of the map; a thin gap without convection or radiation",
        source="Yovanovich 2005",
        value=_gas_conductance,
        measured_with=_inverse_gap,
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
        is_of_interface=True,
        may_be_infinite=True,
        measured_with=_inverse_gap,
    ),
)
"""Answers about a fluid in the gap, in their order."""
