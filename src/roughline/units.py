"""Quantities with units: input is converted to SI once, and all computations are in SI."""

from __future__ import annotations

import functools
import math
import re
from decimal import Decimal
from typing import TYPE_CHECKING

from roughline.errors import UnitError
from roughline.errors.checks import number, shown

if TYPE_CHECKING:
    import pint

_NUMBER_AND_UNIT = re.compile(
    r"\s*(?P<number>[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?|[-+]?(inf|nan))\s*"
    r"(?P<unit>°?[^\W\d][\w*/^ .()·-]{0,30}|1/[\w*/^ .()·-]{1,30}|)\s*",
    re.IGNORECASE,
)
_EXPONENT = re.compile(r"(?<=[^\W\d_])(-?\d+)\b")  # of "mm2", "m-3"
_MIL = re.compile(r"\bmils?\b")  # the inch's thousandth, which the registry takes for an angle
_DECIMAL_COMMA = re.compile(r"\d+,\d+")

SI = ("m", "m²", "N", "N/m", "Pa", "J")
"""Units that get a prefix where values are shown."""

_PREFIXES = dict(zip(range(-18, 19, 3), (*"afpnµm", "", *"kMGTPE"), strict=True))
_POWERS = {each: power for power, each in _PREFIXES.items()} | {"u": -6, "μ": -6, "c": -2}
_PREFIXED = re.compile(r"(?P<prefix>[afpnuµμmkMGTPE]?)(?P<unit>m|N|Pa|Hz)")
_PLAIN: dict[str, tuple[int, dict[str, int]]] = {
    "m": (0, {"m": 1}),
    "s": (0, {"s": 1}),
    "g": (-3, {"N": 1, "s": 2, "m": -1}),
    "K": (0, {"K": 1}),
    "mol": (0, {"mol": 1}),
    "N": (0, {"N": 1}),
    "Pa": (0, {"N": 1, "m": -2}),
    "bar": (5, {"N": 1, "m": -2}),
    "J": (0, {"N": 1, "m": 1}),
    "W": (0, {"N": 1, "m": 1, "s": -1}),
    "Hz": (0, {"s": -1}),
    "ohm": (0, {"ohm": 1}),
}
"""Powers of ten and of other units in those that are read without the registry."""
_PLAIN_FACTOR = re.compile(
    rf"(?P<prefix>[afpnuµμmckMGTPE]??)(?P<unit>{'|'.join(_PLAIN)})"
    r"((\^|\*\*)?(?P<exponent>-?[1-9]))?"
)
_PLAIN_JOINT = re.compile(r" ?((?<!\*)\*(?!\*)|[·/ ]) ?")
_RAISED = str.maketrans("²³", "23")
_SIGNS = {"ohm": "Ω", "ohm m²": "Ω m²"}
_WITHOUT_PREFIX = ("mbar l/s",)  # units that people write without a prefix
_DIMENSIONS = {"m²": 2, "m³/s": 3}  # of lengths that get a prefix
MOST_DIGITS = 4
"""Significant digits of values that are shown."""

_VALUE_ROUNDING = 1e-9  # of a value: an end that is no further away is the value itself
_OTHER_LENGTHS = ("in", "inch", "mil", "Å", "angstrom")
_EXACT = 15  # decimal digits that double precision always keeps

_EXAMPLES = {
    "hardness": "2 GPa",
    "inlet": "6 bar",
    "outlet": "1 bar",
    "Pa": "110 GPa",
    "m": "0.5 mm",
    "m^2": "2 cm^2",
    "N": "10 N",
    "J/m**2": "50 mJ/m^2",
    "1/m": "2e6 1/m",
    "Hz": "5 MHz",
    "ohm*m": "1.7e-8 ohm m",
    "W/m/K": "400 W/m/K",
    "kg/m**3": "7860 kg/m^3",
    "Pa*s": "40 mPa s",
    "kg/mol": "29 g/mol",
    "K": "300 K",
    "s": "10 s",
}


@functools.cache
def _registry() -> pint.UnitRegistry[float]:
    import pint  # here because it loads slowly

    return pint.UnitRegistry()


def in_si(text: str, unit: str, name: str) -> float:
    """Read a quantity such as "110 GPa" and return its value in an SI unit.

    The SI unit is one of those with an example in this module. Without a unit, with one of another
    dimension, or with a decimal comma, it raises a UnitError about the name.
    """
    example = example_for(unit, name)
    refuse_decimal_comma(text, name)
    parts = _NUMBER_AND_UNIT.fullmatch(text)
    if parts and not parts["unit"]:
        raise UnitError(f'is {shown(text)}, without a unit; give one, such as "{example}"', name)
    try:
        if not parts:
            raise ValueError("no number with a unit")
        plain, wanted = _plain(parts["unit"]), _plain(unit)
        if plain is not None and wanted is not None:  # the registry loads slowly
            if plain[1] != wanted[1]:
                raise ValueError(f"no quantity in {unit}")
            value = float(Decimal(parts["number"]).scaleb(plain[0] - wanted[0]))
            return float(f"{value:.{_EXACT}g}")
        written = _MIL.sub("thou", parts["unit"].replace("·", "*"))
        units = _registry().parse_units(_EXPONENT.sub(r"**\1", written))
        value = _registry().Quantity(float(parts["number"]), units).to(unit).magnitude
        return float(f"{value:.{_EXACT}g}")  # 0.3 mN are 0.0003 N, without the prefix's rounding
    except Exception as error:  # of a senseless unit the parser raises errors of any type
        vickers = "; 1 HV is 10.6 MPa on the projected indent" if "HV" in text else ""
        raise UnitError(
            f'is {shown(text)}, which is no quantity in {unit}; give one such as "{example}"'
            f"{vickers}",
            name,
        ) from error


@functools.cache
def _plain(written: str) -> tuple[int, dict[str, int]] | None:
    """Read a unit such as "mm^2" as a power of ten, and units with powers.

    None for one that is not a product of plain units.
    """
    first, *rest = _PLAIN_JOINT.split(written.translate(_RAISED))
    factors = zip(["*", *rest[::2]], [first, *rest[1::2]], strict=True)
    ten, powers = 0, dict[str, int]()
    for joint, factor in factors:
        found = _PLAIN_FACTOR.fullmatch(factor)
        if found:
            exponent = int(found["exponent"] or 1) * (-1 if joint == "/" else 1)
            tens, units = _PLAIN[found["unit"]]
            ten += exponent * (_POWERS[found["prefix"]] + tens)
            for unit, times in units.items():
                powers[unit] = powers.get(unit, 0) + exponent * times
        elif factor != "1":
            return None
    return ten, {unit: power for unit, power in powers.items() if power}


def as_si(given: float | str, unit: str, name: str) -> float:
    """Return a number in an SI unit, or read a text with a unit of its own."""
    if isinstance(given, str):
        return in_si(given, unit, name)
    example = example_for(unit, name)
    return number(name, given, f'a number in {unit}, or a text such as "{example}", is needed')


def lengths(text: str, name: str) -> list[float]:
    """Read lengths with units between commas, such as "0 um, 50 um", as :func:`in_si` does. [m]"""
    refuse_decimal_comma(text, name)
    return [in_si(part, "m", name) for part in text.split(",")]


def refuse_decimal_comma(text: str, name: str) -> None:
    """Refuse a number such as 0,33, with or without a unit, by a UnitError of a name."""
    if comma := _DECIMAL_COMMA.search(text):
        raise UnitError(
            f'is {shown(text)}, with a comma in "{comma[0]}"; numbers take a decimal point, such '
            "as 0.33, and no commas",
            name,
        )


def example_for(unit: str, name: str) -> str:
    """Return a quantity in an SI unit as it may be typed."""
    return _EXAMPLES.get(name, _EXAMPLES[unit])


def is_unit_of_length(unit: str) -> bool:
    """Whether a text is a metre with or without a prefix, an inch, a mil or an angstrom."""
    prefixed = _PREFIXED.fullmatch(unit)
    return unit in _OTHER_LENGTHS or (prefixed is not None and prefixed["unit"] == "m")


def metres_per(unit: str) -> float:
    """Return the length of a unit such as "nm" or "um" in metres; raise a UnitError of others."""
    try:
        return in_si(f"1 {unit}", "m", "unit")
    except UnitError as error:
        needed = 'a unit of length is needed, such as "um", "mm" or "m"'
        raise UnitError(f"is {shown(unit)}; {needed}", "unit") from error


def load_in_newtons(text: str, area: float, name: str = "loads") -> float:
    """Read a load: a force such as "10 N", or a pressure such as "2 MPa" on a nominal area [m²]."""
    refuse_decimal_comma(text, name)
    for unit, factor in (("N", 1.0), ("Pa", area)):
        try:
            return factor * in_si(text, unit, name)
        except UnitError:
            continue
    raise UnitError(
        f'is {shown(text)}; give a total force such as "10 N", or a mean pressure over the nominal '
        'area such as "2 MPa"',
        name,
    )


def engineering(value: float, unit: str, digits: int = MOST_DIGITS) -> str:
    """Write an SI value with a prefix, such as 1.234e-6 m as "1.234 µm"."""
    factor, prefixed = prefix(value, unit, digits)
    return f"{decimal(value * factor, digits)} {prefixed}"


def prefix(value: float, unit: str, digits: int = MOST_DIGITS) -> tuple[float, str]:
    """Return the factor from a unit such as "N/m" or "m²" to one with a prefix, and that unit.

    The prefix suits a value that is written with some digits: one that rounds to 1000 gets the
    next.
    """
    sign = _SIGNS.get(unit, unit)
    if value == 0 or not math.isfinite(value) or unit in _WITHOUT_PREFIX:
        return 1.0, sign
    if unit.startswith("kg"):  # which has a prefix of its own
        factor, prefixed = prefix(1e3 * value, unit.removeprefix("k"), digits)
        return 1e3 * factor, prefixed
    if unit == "N/m³":  # a stiffness per area is said as a pressure over a distance
        factor, prefixed = prefix(1e-3 * value, "Pa/mm", digits)
        return 1e-3 * factor, prefixed
    exponent = int(f"{value:.{digits - 1}e}".partition("e")[2])
    power = _DIMENSIONS.get(unit, 1)  # that the prefix has; areas run from 0.01 to 10000
    thousands = 3 * ((exponent + 2 * (power - 1)) // (3 * power))
    thousands = min(max(thousands, min(_PREFIXES)), max(_PREFIXES))
    return 10.0 ** (-power * thousands), f"{_PREFIXES[thousands]}{sign}"


def supported_digits(
    value: float, ends: tuple[float, float] | None, most: int = MOST_DIGITS
) -> int:
    """Return with how many significant digits a value is written: with those that are known.

    The last digit is that of a third of the shorter side of its interval, so that rounding moves
    the value by a sixth of that side at most, unless a single digit is left. A value that is known
    better, or whose interval is not known, has the most.
    """
    sides = [abs(value - end) for end in ends or () if math.isfinite(end)]
    sides = [side for side in sides if side > _VALUE_ROUNDING * abs(value)]
    if not sides or not value or not math.isfinite(value):
        return most
    last = math.floor(math.log10(min(sides) / 3))
    return min(max(math.floor(math.log10(abs(value))) - last + 1, 1), most)


def decimal(value: float, digits: int) -> str:
    """Write a number with significant digits, without an exponent where that is short."""
    return (
        f"{float(f'{value:.{digits}g}'):.10g}"
        if 1e-4 <= abs(value) < 1e6
        else f"{value:.{digits}g}"
    )


def in_words(value: float, unit: str | None, digits: int = MOST_DIGITS) -> str:
    """Write a value with its unit; SI units get a prefix, None gives the number alone."""
    if unit in SI:
        return engineering(value, unit, digits)
    return f"{decimal(value, digits)} {unit or ''}".strip()


def digits_known(value: float, error: float | None) -> int:
    """Return how many digits of a value v its error e supports: v / (1 + e / v) to v + e."""
    if error is None or not value > 0:
        return MOST_DIGITS
    return supported_digits(value, (value / (1 + error / value), value + error))
