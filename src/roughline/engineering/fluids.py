"""Fluids in the gap: liquids and gases, and their table."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import partial
from types import MappingProxyType

from roughline.engineering.described import chemical_formulas, described, table_rows
from roughline.errors import InputError
from roughline.errors.checks import between, refuse, shown
from roughline.errors.public import public

R = 8.31446261815324
"""Molar gas constant. [J / (mol K)]"""

ROOM = 293.15
"""20 °C. [K]"""

_TABLE = "fluids.csv"
_UNITS = {
    "viscosity": "Pa*s",
    "molar_mass": "kg/mol",
    "conductivity": "W/m/K",
    "heat_capacity_ratio": "",
    "accommodation": "",
    "temperature": "K",
}
_EXAMPLE = "viscosity=40 mPa s, or viscosity=18 uPa s molar_mass=29 g/mol of a gas"

_SYNONYMS = {"glycol": "ethylene-glycol", "glycerine": "glycerol", "natural-gas": "methane"}
_TEMPERATURE = re.compile(r"temperature\s*=\s*(.+?)(?=\s+\w+\s*=|$)")
_AT = re.compile(r"\s+at\s+(-?[\d.]+)\s*(?:°|deg)?\s*([CK])\b", re.IGNORECASE)
_OIL_FACTOR = 1.3  # factor of their viscosities' uncertainty: grade 10 %, index 80 to 140
_IRON_MOLAR_MASS = 55.85  # molar mass of the wall [g / mol]
_COLDEST, _HOTTEST = 273.15, 373.15  # between which the table knows how fluids change [K]
_GRADE = re.compile(r"^\W*(?:(?:iso|oil)\W*)*vg\W*(\d+)(?:\W*oil\b)?", re.IGNORECASE)


@public
@dataclass(frozen=True)
class Liquid:
    """A liquid of constant viscosity.

    A fluid that thins with the rate of shear leaks no more than a liquid of its least viscosity.

    Parameters
    ----------
    viscosity : float
        Dynamic viscosity. [Pa s]
    name : str, optional
        What it is called.
    source : str, optional
        Where the values come from.
    viscosity_factor : float, optional
        Factor by which the viscosity is uncertain: it lies between η / factor and η * factor. Oils
        of the table are uncertain, as a grade is fixed to 10 % at 40 °C, and how oils thin on the
        way to other temperatures differs; a given viscosity is taken as exact. [1]

    Raises
    ------
    InputError
        If the viscosity is not positive and finite, or its factor is below 1.
    """

    viscosity: float
    name: str = "given liquid"
    source: str = "given by the user"
    viscosity_factor: float = 1.0

    def __post_init__(self) -> None:
        _refuse_senseless(self)
        if not 1 <= self.viscosity_factor < math.inf:
            refuse("viscosity_factor", self.viscosity_factor, "1 or more is needed")


@public
@dataclass(frozen=True)
class Gas:
    """An ideal gas.

    Parameters
    ----------
    viscosity : float
        Dynamic viscosity, which does not depend on the pressure. [Pa s]
    molar_mass : float
        Mass of a mole. [kg / mol]
    conductivity : float, optional
        Thermal conductivity of the gas where it is not rarefied. [W / (m K)]
    heat_capacity_ratio : float, optional
        c_p / c_v, 5/3 of a monatomic gas. [1]
    accommodation : float, optional
        Thermal accommodation coefficient of both surfaces. Default: that of engineering metals
        [1]_. [1]
    temperature : float, optional
        Default: 20 °C. [K]
    name : str, optional
        What it is called.
    source : str, optional
        Where the values come from.

    Raises
    ------
    InputError
        If there is no molar mass, or a value is outside its range.

    References
    ----------
    .. [1] Song, S., Yovanovich, M. M. Correlation of thermal accommodation coefficient for
       engineering surfaces. ASME HTD 69, 107-116 (1987); to about 25 %.
    """

    viscosity: float
    molar_mass: float
    conductivity: float | None = None
    heat_capacity_ratio: float = 1.4
    accommodation: float | None = None
    temperature: float = ROOM
    name: str = "given gas"
    source: str = "given by the user"

    def __post_init__(self) -> None:
        _refuse_senseless(self)
        if self.molar_mass > 1:
            needed = "it is in kg/mol, such as 0.0040026 of helium"
            refuse("molar_mass", self.molar_mass, needed)
        if not 1 < self.heat_capacity_ratio <= 5 / 3 + 0.05:
            refuse("heat_capacity_ratio", self.heat_capacity_ratio, "1 to 5/3 is allowed")
        if self.accommodation is not None and not 0 < self.accommodation <= 1:
            refuse("accommodation", self.accommodation, "above 0, and at most 1, is allowed")

    @property
    def gas_constant(self) -> float:
        """Specific gas constant R_s. [J / (kg K)]"""
        return R / self.molar_mass

    def mean_free_path(self, pressure: float) -> float:
        """Mean free path, as viscosity tells it: (η / p) sqrt(π R_s T / 2). [m]

        The pressure is absolute [Pa]; in vacuum the path is infinite.
        """
        between("pressure", pressure, 0, math.inf, "an absolute one, 0 (vacuum) or more, is needed")
        if pressure == 0:
            return math.inf
        speed = math.sqrt(math.pi * self.gas_constant * self.temperature / 2)
        return self.viscosity / pressure * speed

    def temperature_jump(self, pressure: float) -> float:
        """Length M that the jumps of temperature at both walls add to a gap [1]_. [m]

        M = 2 (2 - a) / a · 2 γ / (γ + 1) · λ / Pr, with the accommodation coefficient a, the ratio
        of heat capacities γ and the Prandtl number Pr.

        References
        ----------
        .. [1] Yovanovich, M. M. Four decades of research on thermal contact, gap and joint
           resistance in microelectronics. IEEE Trans. Compon. Packag. Technol. 28, 182-206 (2005).
        """
        a, gamma = self.accommodated, self.heat_capacity_ratio
        jump = 2 * (2 - a) / a * 2 * gamma / (gamma + 1) / self.prandtl
        return jump * self.mean_free_path(pressure)

    @property
    def prandtl(self) -> float:
        """Prandtl number η c_p / k; by Eucken's relation where no conductivity is given. [1]"""
        gamma = self.heat_capacity_ratio
        if self.conductivity is None:
            return 4 * gamma / (9 * gamma - 5)
        return self.viscosity * gamma / (gamma - 1) * self.gas_constant / self.conductivity

    @property
    def accommodated(self) -> float:
        """Accommodation coefficient: the one given, or that of engineering metals. [1]"""
        if self.accommodation is not None:
            return self.accommodation
        is_monatomic = self.heat_capacity_ratio > 1.6
        mass = 1e3 * self.molar_mass * (1.0 if is_monatomic else 1.4)
        ratio = 1e3 * self.molar_mass / _IRON_MOLAR_MASS
        cold = math.exp(-0.57 * (self.temperature / 273.15 - 1))
        return cold * mass / (6.8 + mass) + (1 - cold) * 2.4 * ratio / (1 + ratio) ** 2


@public
def fluid_of(description: str | Liquid | Gas) -> Liquid | Gas:
    """Return a fluid from its name, its values, or a name with other values.

    Parameters
    ----------
    description : str, Liquid or Gas
        Such as "water", "ISO VG 46 at 60 °C", "helium", "CO2", "viscosity=40 mPa s" or
        "viscosity=18 uPa s molar_mass=29 g/mol". A fluid is returned as it is. Fluids of the table
        are at 20 °C unless a temperature from 0 to 100 °C is given.

    Raises
    ------
    InputError
        If the name or a value is unknown, or outside its range.
    UnitError
        If a value has no unit, or a wrong one.

    Examples
    --------
    >>> import roughline as rl
    >>> helium = rl.fluid_of("He")
    >>> print(helium.name, helium.viscosity, round(1e9 * helium.mean_free_path(101325.0)))
    helium 1.96e-05 189
    >>> print(round(rl.fluid_of("ISO VG 46 at 60 °C").viscosity, 4))
    0.0175
    """
    if isinstance(description, Liquid | Gas):
        return description
    if not isinstance(description, str):
        refuse("fluid", description, 'a name such as "water", a Liquid or a Gas is needed')
    known, formulas = fluids(), chemical_formulas(_TABLE)
    text = _known_name(description)
    name, given = described(text, "fluid", formulas, _UNITS, "viscosity=40 mPa s")
    if not name and "viscosity" not in given:
        raise InputError(
            f"the fluid {shown(description)} needs a name or a viscosity, such as "
            f'"water" or "{_EXAMPLE}"'
        )
    start = asdict(known[name]) if name else {}
    if name and "temperature" in given:
        start.pop("conductivity", None)  # it is that at 20 °C
        start |= {} if "viscosity" in given else _at(name, given["temperature"], text)
    source = f"{start['source']}; {', '.join(given)} given" if name and given else ""
    if "viscosity" in given:
        start.pop("viscosity_factor", None)
    values = {**start, **given} | ({"source": source} if source else {})
    is_gas = isinstance(known[name], Gas) if name else given.keys() != {"viscosity"}
    if is_gas:
        return Gas(**values)
    for other in given.keys() - {"viscosity", "temperature"}:
        raise InputError(f"{name} is a liquid, of which the viscosity alone is used, not {other}")
    values.pop("temperature", None)
    return Liquid(**values)


def _at(name: str, temperature: float, text: str) -> dict[str, float | str]:
    """What differs at a temperature [K]: by Vogel's law in liquids, by powers of it in gases.

    A message repeats the temperature as it stands in the text.
    """
    texts = {"name", "formula", "source"}
    row = {key: float(value) for key, value in _rows()[name].items() if value and key not in texts}
    if not _COLDEST <= temperature <= _HOTTEST or not {"vogel_B", "viscosity_power"} & row.keys():
        typed = _TEMPERATURE.search(text)
        came = shown(typed[1]) if typed else f"{temperature:g} K"
        raise InputError(
            f"is {came}, where the table does not know {name}; give its viscosity "
            'there, such as "viscosity=40 mPa s"',
            "temperature",
        )
    called, viscosity = f"{name} at {temperature - 273.15:.4g} °C", row["viscosity"]
    if "vogel_B" in row:
        B, C = row["vogel_B"], row["vogel_C"]
        viscosity *= math.exp(B / (temperature - C) - B / (ROOM - C))
        return {"name": called, "viscosity": viscosity}
    warmth = temperature / ROOM
    return {
        "name": called,
        "viscosity": viscosity * warmth ** row["viscosity_power"],
        "conductivity": row["conductivity"] * warmth ** row["conductivity_power"],
    }


def _known_name(description: str) -> str:
    """Replace a synonym or a viscosity grade at the start of a text by its name in the table."""
    warm = _AT.sub(
        lambda at: f" temperature={at[1]} {'K' if at[2] in 'kK' else '°C'}", description.strip()
    )
    graded = _GRADE.sub(r"oil-vg-\1", warm)
    first, *rest = re.split(r"\s+(?=\w+\s*=)", graded, maxsplit=1)
    name = re.sub(r"[\s_]+", "-", first.strip().lower())
    return " ".join([_SYNONYMS.get(name, first), *rest])


@functools.cache
def fluids() -> Mapping[str, Liquid | Gas]:
    """Return the table of common fluids by name."""
    found: dict[str, Liquid | Gas] = {}
    for name, row in _rows().items():
        numbers = {key: float(row[key]) for key in _UNITS if row.get(key)}
        kind = Gas if "molar_mass" in numbers else Liquid
        if name.startswith("oil-"):
            numbers["viscosity_factor"] = _OIL_FACTOR
        found[name] = kind(**numbers, name=name, source=row["source"])
    return MappingProxyType(found)


_rows = functools.cache(partial(table_rows, _TABLE))


def _refuse_senseless(fluid: Liquid | Gas) -> None:
    """Refuse values that are not positive and finite."""
    for key in _UNITS:
        value = getattr(fluid, key, None)
        if value is not None and not (0 < value < math.inf):
            raise InputError(
                f"of {fluid.name} is {value}; a positive, finite number is needed", key
            )
