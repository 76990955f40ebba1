"""What a fluid carries through a seal, from the hydraulic aperture of its gap.

Every function takes apertures over loads, or a number, in SI units. The seal enters by the ratio of
its width W across the flow to its breadth B along it; of a ring that is crossed radially this is
2 π / ln(r_o / r_i).
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from roughline.engineering.fluids import ROOM, Gas, Liquid

_Value = TypeVar("_Value", float, NDArray[np.float64])


def liquid_leak(aperture: _Value, ratio: float, difference: float, liquid: Liquid) -> _Value:
    """Volume of a liquid per time, Q = (W/B) u_h³ ΔP / (12 η). [m³ / s]

    The aperture u_h is in m, the difference of pressures ΔP in Pa.
    """
    return ratio * aperture**3 * difference / (12 * liquid.viscosity)


def gas_throughput(
    permeance: _Value, ratio: float, inlet: float, outlet: float, gas: Gas
) -> _Value:
    """Pressure times volume of a gas per time, (W/B) u_s³ (P_1² - P_2²) / (24 η). [Pa m³ / s]

    The flow is isothermal. Its density is that of the local pressure, P / (R_s T), so that P² takes
    the place of the pressure of a liquid. The permeance u_s³ [m³] is the mean of P Λ(P) along the
    seal over that of P (:class:`roughline.fluid.rarefied.Rarefied`).
    """
    return ratio * permeance * (inlet**2 - outlet**2) / (24 * gas.viscosity)


def mass_of_throughput(throughput: _Value, gas: Gas) -> _Value:
    """Mass per time of a throughput at the temperature of the gas. [kg / s]"""
    return throughput / (gas.gas_constant * gas.temperature)


def throughput_at_room(throughput: _Value, gas: Gas) -> _Value:
    """Throughput of the same mass at 20 °C, as leak rates are quoted. [Pa m³ / s]"""
    return throughput * (ROOM / gas.temperature)


def reynolds_number(mass: _Value, width: float, viscosity: float) -> _Value:
    """Reynolds number of what crosses a length W of a seal, m / (W η), the mass m per time. [1]

    It is ρ v u / η with the mean speed v in a gap u, whatever the gap.
    """
    return mass / (width * viscosity)
