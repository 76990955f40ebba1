"""Texts that describe a material or a fluid by a name, values, or both; and tables of the names."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from importlib import resources

from roughline.engineering.names import find_name
from roughline.errors import InputError, UnitError
from roughline.errors.checks import shown
from roughline.units import in_si, refuse_decimal_comma

_SETTING = re.compile(r"(\w+)\s*=\s*([^=;]+?)\s*(?=;|\s\w+\s*=|$)")


def described(
    description: str, what: str, formulas: Mapping[str, str], units: Mapping[str, str], example: str
) -> tuple[str, dict[str, float]]:
    """Return the name in a text such as "steel hardness=2 GPa", and its values in SI units.

    `formulas` are the chemical ones by the names that are known. `units` are those of the values
    that such a thing has, empty of a plain number. The name is empty where values alone are given.
    An unknown name, an unknown or a senseless value raise an InputError or a UnitError.
    """
    start = re.search(r"\w+\s*=", description)
    typed = (description[: start.start()] if start else description).strip(" ;")
    given = _settings(description[start.start() :] if start else "", description, what, units)
    return find_name(typed, what, formulas, example) if typed else "", given


def chemical_formulas(table: str) -> dict[str, str]:
    """Return the chemical formulas in a table, with spaces between, by what they name."""
    return {name: row["formula"] for name, row in table_rows(table).items()}


def table_rows(table: str) -> dict[str, dict[str, str]]:
    """Return the lines of a table that comes with the package, by what they name."""
    text = resources.files("roughline.engineering").joinpath(table).read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return {row["name"]: row for row in rows}


def _settings(text: str, description: str, what: str, units: Mapping[str, str]) -> dict[str, float]:
    """Read "name=value" pairs."""
    given: dict[str, float] = {}
    rest = _SETTING.sub("", text).replace(";", "").strip()
    if rest:
        raise InputError(
            f'{shown(rest)} in the {what} {shown(description)} is not of the form "name=value"'
        )
    for name, value in _SETTING.findall(text):
        if name in given:
            raise InputError(f"the {what} {shown(description)} gives {name} twice")
        if name not in units:
            raise InputError(f"a {what} has no {shown(name)}; it has {', '.join(units)}")
        given[name] = in_si(value, units[name], name) if units[name] else _number(value, name)
    return given


def _number(value: str, name: str) -> float:
    refuse_decimal_comma(value, name)
    try:
        return float(value)
    except ValueError:
        raise UnitError(f"{name} is {shown(value)}; a number such as 0.3 is needed") from None
