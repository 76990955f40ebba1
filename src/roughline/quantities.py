"""Quantities with units, read once at the edge; inside, everything is SI."""

from __future__ import annotations

import functools
import re
from typing import TYPE_CHECKING

from roughline.errors import UnitError

if TYPE_CHECKING:
    import pint

_NUMBER_AND_UNIT = re.compile(
    r"\s*(?P<number>[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?|[-+]?(inf|nan))\s*"
    r"(?P<unit>[^\W\d][\w*/^ .]{0,30}|1/[\w*/^ .]{1,30}|)\s*",
    re.IGNORECASE,
)


_EXAMPLES = {
    "Pa": "110 GPa",
    "m": "0.5 mm",
    "N": "10 N",
    "1/m": "2e6 1/m",
    "Hz": "5 MHz",
    "ohm*m": "1.7e-8 ohm m",
    "W/m/K": "400 W/m/K",
    "kg/m**3": "7860 kg/m^3",
}


@functools.cache
def _registry() -> pint.UnitRegistry[float]:
    import pint  # here because it loads slowly

    return pint.UnitRegistry()


def in_si(text: str, unit: str, name: str) -> float:
    """Read a quantity such as "110 GPa" and return its value in an SI unit.

    Parameters
    ----------
    text : str
        Number and unit.
    unit : str
        SI unit of the result: one for which there is an example in this module.
    name : str
        What the quantity is, for the message.

    Raises
    ------
    UnitError
        If there is no unit, or one of another dimension.
    """
    example = _EXAMPLES[unit]
    parts = _NUMBER_AND_UNIT.fullmatch(text)
    if parts and not parts["unit"]:
        raise UnitError(f'{name} is "{text}", without a unit; give one, such as "{example}"')
    try:
        if not parts:
            raise ValueError("no number with a unit")
        units = _registry().parse_units(parts["unit"])
        return float(_registry().Quantity(float(parts["number"]), units).to(unit).magnitude)
    except Exception as error:  # the parser raises whatever a senseless unit leads it to
        raise UnitError(
            f'{name} is "{text}", which is no quantity in {unit}; such as "{example}" is'
        ) from error


def metres_per(unit: str) -> float:
    """Return the length of a unit such as "nm" or "um" in metres.

    Raises
    ------
    UnitError
        If it is not a unit of length.
    """
    return in_si(f"1 {unit}", "m", "unit")


def load_in_newtons(text: str, area: float) -> float:
    """Read a load, a total force such as "10 N" or a mean pressure such as "2 MPa".

    Parameters
    ----------
    text : str
        Number and unit.
    area : float
        Nominal area that a pressure acts on. [m²]

    Raises
    ------
    UnitError
        If it is neither.
    """
    for unit, factor in (("N", 1.0), ("Pa", area)):
        try:
            return factor * in_si(text, unit, "load")
        except UnitError:
            continue
    raise UnitError(
        f'load is "{text}"; give a total force such as "10 N", or a mean pressure over the nominal '
        'area such as "2 MPa"'
    )


def engineering(value: float, unit: str, digits: int = 4) -> str:
    """Write an SI value with a prefix, such as 1.234e-6 m as "1.234 µm"."""
    quantity = _registry().Quantity(value, unit)
    return f"{quantity.to_compact():.{digits}g~P}"
