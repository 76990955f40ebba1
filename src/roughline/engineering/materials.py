"""Materials by their names and values: a table with sources, and coated ones."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from roughline.engineering.coated import Coated, Solid
from roughline.engineering.described import chemical_formulas, described, table_rows
from roughline.engineering.material import Material
from roughline.errors import InputError, UnitError
from roughline.errors.checks import shown
from roughline.errors.public import public
from roughline.units import engineering, in_si

_TABLE = "materials.csv"
_UNITS = {
    "E": "Pa",
    "nu": "",
    "hardness": "Pa",
    "resistivity": "ohm*m",
    "conductivity": "W/m/K",
    "density": "kg/m**3",
}
_TABLE_FACTOR = 1.5
"""Uncertainty of a hardness where the table has none, a factor; published ones scatter by two."""

_ON = re.compile(r"(?<!\S)on(?!\S)", re.IGNORECASE)  # between a layer and what it lies on
_THICKNESS = re.compile(
    r"(?P<of>.*[^=\s;])[\s;]+"
    r"(?P<thickness>[-+]?([\d.,]+(e[-+]?\d+)?|inf|nan)\s*([^\W\d][\w/*^]*)?)",
    re.IGNORECASE,
)
_EXAMPLE = '"rubber 2 mm on steel"'


@public
def material(description: str) -> Solid:
    """Return a material from its name, its values, or a name with other values; or a coated one.

    Parameters
    ----------
    description : str
        Such as "copper", "steel hardness=2 GPa" or "E=70 GPa nu=0.33 density=2700 kg/m^3". A
        chemical formula stands for its name: "Cu" is copper, and "TiN" titanium nitride, where
        "tin" is the metal. Each layer of a coated body is followed by its thickness and by what it
        lies on: "gold 0.5 µm on nickel 2 µm on copper", "E=5 MPa nu=0.49 2 mm on steel".

    Returns
    -------
    Material or Coated
        A Coated body where layers are given.

    Raises
    ------
    InputError
        If the name or a property is unknown, or a name may be that of two materials; if a value is
        missing, or outside its range; if a layer has no thickness, or lies on nothing.
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
    >>> print(rl.material("gold 0.5 um on copper").layers[0][1])
    5e-07
    >>> print(rl.material("TiN 2 um on steel").name)
    titanium-nitride 2 µm on steel
    """
    *layers, base = (part.strip(" ;") for part in _ON.split(description))
    if layers and not all((*layers, base)):
        raise InputError(f'"on" stands between a layer and what it lies on, such as {_EXAMPLE}')
    _refuse_depth(base)
    lowest = _bulk(base)
    return Coated([_layer(each) for each in layers], lowest) if layers else lowest


def _bulk(text: str) -> Material:
    """A material that is not coated, or one of a coated body."""
    known, formulas = materials(), chemical_formulas(_TABLE)
    name, given = described(text, "material", formulas, _UNITS, "E=70 GPa nu=0.33")
    if not name:
        if not {"E", "nu"} <= given.keys():
            raise InputError(
                f'the material {shown(text)} needs both E and nu, such as "E=70 GPa nu=0.33"'
            )
        called = f"E={engineering(given['E'], 'Pa')} nu={given['nu']:g}"
        return Material(called, **given)  # type: ignore[arg-type]
    changed = ", ".join(given)
    source = f"{known[name].source}; {changed} given" if given else known[name].source
    found = replace(known[name], **given, source=source)  # type: ignore[arg-type]
    if "E" in given:
        found = replace(found, layer_E="")
    if "hardness" in given:
        found = replace(found, layer_hardness="", hardness_factor=1.0)
    return found


def _layer(text: str) -> tuple[Material, float]:
    """A layer of a material, and its thickness. [m]"""
    parts = _THICKNESS.fullmatch(text)
    if parts is None:
        raise InputError(
            f"{shown(text)} is no layer: write its material, and its thickness last, such as "
            f"{_EXAMPLE}"
        )
    found = _bulk(parts["of"])
    return found, in_si(parts["thickness"], "m", f"the thickness of the layer of {found.name}")


def _refuse_depth(base: str) -> None:
    """Refuse a thickness of what lies lowest."""
    depth = _THICKNESS.match(base)
    if depth is None:
        return
    try:
        in_si(depth["thickness"], "m", "thickness")
    except UnitError:
        return
    raise InputError(
        f'{shown(depth[0])} lies on nothing: add "on" and what it lies on, such as {_EXAMPLE}, or '
        f"leave out its thickness, {depth['thickness']}"
    )


@functools.cache
def materials() -> Mapping[str, Material]:
    """Return the table of common materials by name."""
    found = {
        name: Material(
            name=name,
            hardness_factor=float(row["hardness_factor"] or _TABLE_FACTOR),
            **{key: float(row[key]) if row[key] else None for key in _UNITS},  # type: ignore[arg-type]
            layer_E=row["layer_E"],
            layer_hardness=row["layer_hardness"],
            source=row["source"],
        )
        for name, row in table_rows(_TABLE).items()
    }
    return MappingProxyType(found)
