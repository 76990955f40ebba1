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


def gas_throughput(aperture: _Value, ratio: float, inlet: float, outlet: float, gas: Gas) -> _Value:
    """Pressure times volume of a gas per time, (W/B) u_s³ (P_1² - P_2²) / (24 η). [Pa m³ / s]

    The flow is isothermal. Its density is that of the local pressure, P / (R_s T), so that P² takes
    the place of the pressure of a liquid. The aperture u_s [m] is that with slip at the mean
    pressure: the flux is (u³ P + 6 λ P u²) ∇P, and λ P is a constant of the gas, so that this is
    exact between flat plates, down to vacuum. Where the gap varies, throats at the inlet have
    less slip than this and those at the outlet more. Of two gaps in series, one twice as wide as
    the other, it is off by 5 % at most, and by 15 % if it is ten times as wide, where the gas flows
    into vacuum. It is off by a third of that if it flows into half of its pressure.
    """
    return ratio * aperture**3 * (inlet**2 - outlet**2) / (24 * gas.viscosity)


def beyond_slip(path_over_gap: _Value) -> _Value:
    """How much more than slip of the first order lets through kinetic theory does. [1]

    It is that of flat plates, by the BGK equation [1]_, between mean free paths of a hundredth and
    of twenty gaps, and goes on with the logarithm of the path from there.

    References
    ----------
    .. [1] Cercignani, C., Daneri, A. Flow of a rarefied gas between two parallel plates. J. Appl.
       Phys. 34, 3509-3513 (1963).
    """
    rare = np.log(np.maximum(path_over_gap, _PATHS[0]))
    paths, more = np.log(_PATHS), np.array(_MORE)
    rise = (more[-1] - more[-2]) / (paths[-1] - paths[-2])
    return np.interp(rare, paths, more) + rise * np.maximum(rare - paths[-1], 0.0)


_PATHS = (0.01, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 20.0)  # mean free paths over the gap
_MORE = (1.0, 1.09, 1.21, 1.33, 1.49, 1.69, 2.01, 2.63)  # flow at these over that with slip


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
