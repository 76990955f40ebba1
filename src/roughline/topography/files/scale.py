"""Lengths of a file in metres, from the unit and the sizes that it states, or that are given."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.errors import InputError, UnitError
from roughline.errors.checks import shown
from roughline.errors.words import called
from roughline.units import in_si, metres_per, refuse_decimal_comma

Sizes = float | str | Sequence[float | str]  # sides of a file as a caller gives them


@dataclass(frozen=True, eq=False)
class Scale:
    """Unit and sides of a file; each is stated by the file or given by the caller."""

    file: str  # name of the file, for messages
    points: tuple[int, ...]  # points along each axis
    stated_unit: str | None  # of all lengths, by the file
    given_unit: str | None  # the same by the caller
    # sides of the map, or length of the line, by the file [unit of the file]
    stated_sizes: tuple[float, ...] | None
    # the same by the caller; one length makes a square; texts have units of their own, numbers are
    # in `given_unit`, and in metres without one
    given_sizes: Sizes | None

    def obstacles(self) -> list[InputError]:
        """List what neither the file nor the caller states: the unit, the sizes."""
        obstacles: list[InputError] = []
        if self.stated_unit or self.given_unit:
            _ = self.metres
        else:
            obstacles.append(self._unit_needed())
        if self.stated_sizes is not None and self.given_sizes is not None:
            raise InputError(f"{self.file} states its sizes; leave {called('sizes')} out")
        if self.stated_sizes is None and self.given_sizes is None:
            obstacles.append(self._sizes_needed())
        return obstacles

    @cached_property
    def metres(self) -> float:
        """Metres in the unit of the file."""
        if self.stated_unit and self.given_unit:
            raise UnitError(
                f"{self.file} states its unit, {self.stated_unit}; "
                f"leave unit = {self.given_unit} out"
            )
        unit = self.stated_unit or self.given_unit
        if not unit:
            raise self._unit_needed()
        return metres_per(unit)

    @property
    def sides(self) -> tuple[float, ...]:
        """Sides of the map, or length of the line. [m]"""
        if self.stated_sizes is not None:
            return tuple(self.metres * float(size) for size in self.stated_sizes)
        given = self.given_sizes
        if given is None:
            raise self._sizes_needed()
        if isinstance(given, str):
            refuse_decimal_comma(given, "sizes")
            given = given.split(",")
        lengths = np.atleast_1d(np.array(given, object))
        factor = self.metres if self.given_unit else 1.0
        try:
            sides = tuple(
                in_si(length, "m", "sizes") if isinstance(length, str) else factor * float(length)
                for length in lengths
            )
        except TypeError:
            sides = ()
        if len(sides) == 1 and len(set(self.points)) == 1:
            sides *= len(self.points)
        if len(sides) != len(self.points) or not all(0 < side < math.inf for side in sides):
            raise self._sizes_refused()
        return sides

    @property
    def _points_and_example(self) -> tuple[str, str]:
        points = " x ".join(map(str, self.points))
        return points, "1 mm, 0.5 mm" if len(self.points) == 2 else "1 mm"

    def _unit_needed(self) -> UnitError:
        return UnitError(
            f"{self.file} states no unit; give the unit of its lengths, such as "
            f"{called('unit', 'um')}"
        )

    def _sizes_needed(self) -> InputError:
        points, example = self._points_and_example
        return InputError(
            f"{self.file} states no sizes for its {points} points; give them, such as "
            f"{called('sizes', example)}"
        )

    def _sizes_refused(self) -> InputError:
        points, example = self._points_and_example
        axes = len(self.points)
        lengths = "a positive length" if axes == 1 else f"{axes} positive lengths"
        return InputError(
            f"is {shown(self.given_sizes)}; {self.file} has {points} points: give {lengths}, such "
            f'as "{example}"; numbers without a unit are in {self.given_unit or "m"}',
            "sizes",
        )
