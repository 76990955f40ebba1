"""How two bodies attract each other, as it is typed, and what drawing them apart takes."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from roughline.contact.arguments import STICKING, sticking_law
from roughline.engineering.described import table_rows
from roughline.errors import InputError
from roughline.errors.checks import refuse, shown
from roughline.errors.words import called
from roughline.halfspace.laws.pulling_zone import resolves_pull_off
from roughline.units import engineering, in_si

_OVER = re.compile(r"\s+over\s+", re.IGNORECASE)
_CELLS = 9.0  # across the zone that pulls, of the range that is taken where none is given
_EXAMPLE = (
    "give the work of adhesion, the range if it is known, and the law if it is not Dugdale's, such "
    'as "50 mJ/m^2", "50 mJ/m^2 over 2 nm" or "50 mJ/m^2 over 2 nm, exponential"'
)


@dataclass(frozen=True)
class Attraction:
    """How two bodies attract each other: the work of adhesion, the range and the law."""

    words: str
    work: float  # w [J / m²]
    range: float | None = None  # h_0 [m]; None for the shortest that a grid resolves
    law: str = "dugdale"  # its name
    source: str = "given by the user"

    @classmethod
    def of(cls, given: Any) -> Attraction:
        """Read "50 mJ/m^2 over 2 nm", with ", exponential" for that law, or a name of the table.

        A number is a work of adhesion in J/m², and a contact law is itself.

        Raises
        ------
        InputError
            If it is none of these, or a number is not positive and finite.
        UnitError
            If a quantity has no unit, or a wrong one.
        """
        if isinstance(given, cls):
            return given
        for name, kind in STICKING.items():
            if isinstance(given, kind):
                work, reach = given.work_of_adhesion, given.range
                words = f"{engineering(work, 'J')}/m² over {engineering(reach, 'm')}, {name}"
                return cls(words, work, reach, name)
        if isinstance(given, int | float) and not isinstance(given, bool):
            given = f"{given} J/m^2"
        if not isinstance(given, str):
            refuse("adhesion", given, _EXAMPLE)
        before, _, law = given.partition(",")
        law = law.strip().lower()
        if law and law not in STICKING:
            refuse("adhesion", given, f"the law is one of {', '.join(STICKING)}, not {shown(law)}")
        first, *ranges = _OVER.split(before.strip())
        known = attractions().get(re.sub(r"[\s_]+", "-", first.lower()))
        if known is None and not first[:1].isdigit():
            names = ", ".join(attractions())
            refuse("adhesion", given, f"{_EXAMPLE}, or a name of the table: {names}")
        found = cls(
            given.strip(),
            in_si(first, "J/m**2", "adhesion") if known is None else known.work,
            in_si(ranges[0], "m", "adhesion") if ranges else known.range if known else None,
            law or (known.law if known else cls.law),
            known.source if known else cls.source,
        )
        for value in (found.work, 1.0 if found.range is None else found.range):
            if not 0 < value < math.inf:
                refuse("adhesion", given, "a positive, finite work and range are needed")
        return found

    def on_grid(self, spacing: float, E_star: float) -> Attraction:
        """Attraction with its range, or else with a short one for a grid.

        The zone that pulls about a contact is then nine cells wide, so that grids of half and of a
        quarter of the points resolve it too. The spacing is in m, the contact modulus in Pa.
        """
        if self.range is not None:
            return self
        return replace(self, range=math.sqrt(_CELLS * math.pi * self.work * spacing / E_star))

    def refuse_too_strong(self, side: float, E_star: float) -> None:
        """Refuse bodies that pull each other farther, or more, than a body of a side [m] stands.

        The contact modulus is in Pa.
        """
        adhesion, of_side = called("rl.Adhesion"), f"the shorter side, {engineering(side, 'm')}"
        if self.range is not None and self.range > side:
            reach = engineering(self.range, "m")
            text = f"the range of {adhesion}, {reach}, is longer than {of_side}"
        elif self.work > E_star * side:
            work = engineering(self.work, "J")
            text = (
                f"the work of {adhesion}, {work}/m², is more than the contact modulus times "
                f"{of_side}"
            )
        else:
            return
        raise InputError(f"{text}: give a smaller one, and check its unit", None, "adhesion")

    def is_resolved(self, spacing: float, E_star: float) -> bool:
        """Whether the zone that pulls has cells enough on a grid for a pull-off."""
        reach = self.on_grid(spacing, E_star).range
        assert reach is not None
        return resolves_pull_off(sticking_law(self.law, self.work, reach).scaled(E_star, spacing))


@functools.cache
def attractions() -> Mapping[str, Attraction]:
    """Return the table of works of adhesion by name."""
    found = {}
    for name, row in table_rows("adhesion.csv").items():
        reach = float(row["range"]) if row["range"] else None
        found[name] = Attraction(name, float(row["work"]), reach, row["law"], row["source"])
    return MappingProxyType(found)
