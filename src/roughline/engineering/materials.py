"""Bulk materials: their properties for contact stiffness, conductance and ultrasound."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType

from roughline.engineering.described import described, rows_of
from roughline.errors import InputError
from roughline.errors.checks import shown
from roughline.errors.public import public

_UNITS = {
    "nu": "",
    "E": "Pa",
    "hardness": "Pa",
    "resistivity": "ohm*m",
    "conductivity": "W/m/K",
    "density": "kg/m**3",
}
_TABLE_FACTOR = 1.5
"""Uncertainty of hardnesses of the table, a factor; published ones scatter by two in all."""


@public
@dataclass(frozen=True)
class Material:
    """An isotropic bulk material at room temperature.

    Parameters
    ----------
    name : str
        Name of the material.
    E : float
        Young's modulus; infinite for a rigid body. [Pa]
    nu : float
        Poisson's ratio, -1 to 0.5. [1]
    hardness : float, optional
        Indentation hardness of the surface. [Pa]
    resistivity : float, optional
        Electrical resistivity. [ohm m]
    conductivity : float, optional
        Thermal conductivity. [W / (m K)]
    density : float, optional
        Mass density. [kg / m³]
    source : str, optional
        Where the values come from.
    hardness_factor : float, optional
        Factor by which the hardness H is uncertain: it lies between H / factor and H * factor.
        Hardnesses of the table are uncertain, as hardness varies with heat treatment, cold work
        and depth; a given one is taken as exact. [1]

    Raises
    ------
    InputError
        If a value is outside its range.
    """

    name: str
    E: float
    nu: float
    hardness: float | None = None
    resistivity: float | None = None
    conductivity: float | None = None
    density: float | None = None
    source: str = "given by the user"
    hardness_factor: float = 1.0

    def __post_init__(self) -> None:
        if not self.E > 0:
            raise InputError(f"E of {self.name} is {self.E}; a positive modulus is needed")
        if not -1 < self.nu <= 0.5:
            raise InputError(f"nu of {self.name} is {self.nu}; allowed is -1 to 0.5")
        for name in ("hardness", "resistivity", "conductivity", "density"):
            value = getattr(self, name)
            if value is not None and not 0 < value < math.inf:
                raise InputError(
                    f"{name} of {self.name} is {value}; a positive, finite number is needed"
                )

        if not 1 <= self.hardness_factor < math.inf:
            raise InputError(
                f"hardness_factor of {self.name} is {self.hardness_factor}; 1 or more is needed"
            )

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + nu)). [Pa]"""
        return self.E / (2 * (1 + self.nu))

    @property
    def carries_sound(self) -> bool:
        """Whether longitudinal waves have a finite speed: not in rigid or incompressible bodies."""
        return not math.isinf(self.E) and self.nu != 0.5

    @property
    def impedance(self) -> float | None:
        """Acoustic impedance of longitudinal waves, density times their speed. [kg / (m² s)]

        None without a density, and for a rigid or an incompressible material.
        """
        if self.density is None or not self.carries_sound:
            return None
        nu = self.nu
        return math.sqrt(self.density * self.E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)))


@public
def material(description: str) -> Material:
    """Return a material from its name, its values, or a name with other values.

    Parameters
    ----------
    description : str
        Such as "copper", "steel hardness=2 GPa" or "E=70 GPa nu=0.33 density=2700 kg/m^3".

    Raises
    ------
    InputError
        If the name or a property is unknown, a value is missing, or outside its range.
    UnitError
        If a value has no unit, or a wrong one.

    Examples
    --------
    >>> import roughline as rl
    >>> copper = rl.material("copper")
    >>> print(copper.E, copper.nu)
    129800000000.0 0.343
    >>> print(rl.material("steel hardness=2 GPa").hardness)
    2000000000.0
    """
    known = materials()
    name, given = described(description, "material", known, _UNITS, "E=70 GPa nu=0.33")
    if not name:
        if not {"E", "nu"} <= given.keys():
            raise InputError(
                f'the material {shown(description)} needs both E and nu, such as "E=70 GPa nu=0.33"'
            )
        return Material("given", **given)  # type: ignore[arg-type]
    changed = ", ".join(given)
    source = f"{known[name].source}; {changed} given" if given else known[name].source
    factor = 1.0 if "hardness" in given else known[name].hardness_factor
    return replace(known[name], **given, source=source, hardness_factor=factor)  # type: ignore[arg-type]


@functools.cache
def materials() -> Mapping[str, Material]:
    """Return the table of common materials by name."""
    others = ("name", "source", "hardness_factor")
    numbers = [item.name for item in fields(Material) if item.name not in others]
    found = {
        name: Material(
            name=name,
            source=row["source"],
            hardness_factor=_TABLE_FACTOR,
            **{key: float(row[key]) if row[key] else None for key in numbers},  # type: ignore[arg-type]
        )
        for name, row in rows_of("materials.csv").items()
    }
    return MappingProxyType(found)
