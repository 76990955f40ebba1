"""What friction bears at a point: Coulomb's law, a constant strength, or the lesser of both."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.errors.checks import as_number, refuse
from roughline.errors.public import public_making

_MOST_FRICTION = 5.0  # that of rubber on dry glass is about 4


@public_making
@dataclass(frozen=True, eq=False)
class Friction:
    """Friction between the bodies: the largest shear that a point in contact bears [1]_.

    It is g = mu p of Coulomb's law, a strength tau of its own, or the lesser of both. A point whose
    shear is less sticks. One that slips bears g, in the direction in which the other body slips.
    With :func:`roughline.press` it goes along a path of loads. Asked in a
    :class:`~roughline.Question`, where it has one coefficient, it gives partial slip at the largest
    load.

    Parameters
    ----------
    coefficient : float or array_like, shape (nx, ny), optional
        Coefficient of friction mu, above 0 and up to 5. [1]
    strength : float or array_like, shape (nx, ny), optional
        Largest shear of a point in contact, whatever its pressure. [pressure]

    Raises
    ------
    InputError
        If neither is given, or one is out of its range somewhere.

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §7.1.
    """

    coefficient: float | Real | None = None
    strength: float | Real | None = None

    def __post_init__(self) -> None:
        if self.coefficient is None and self.strength is None:
            raise InputError("a friction needs a coefficient, a strength, or both; give one")
        for name, argument, most, needed in (
            (
                "coefficient",
                "friction",
                _MOST_FRICTION,
                f"a number above 0 and up to {_MOST_FRICTION:g} is needed, such as 0.3",
            ),
            ("strength", "strength", None, "a positive, finite pressure is needed"),
        ):
            if (given := getattr(self, name)) is not None:
                object.__setattr__(self, name, _in_range(argument, given, most, needed))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Friction):
            return NotImplemented
        return all(map(np.array_equal, self._both, other._both))

    def __hash__(self) -> int:
        return hash(tuple(map(np.shape, self._both)))

    @property
    def _both(self) -> tuple[Any, Any]:
        return self.coefficient, self.strength

    @property
    def is_even(self) -> bool:
        """Whether it is a single coefficient of friction, the same everywhere."""
        return isinstance(self.coefficient, float) and self.strength is None

    def bound(self, pressure: Real, nodes: Indices) -> Real:
        """Return the largest shear of nodes under their pressures. [pressure]

        Parameters
        ----------
        pressure : ndarray, shape (nodes,)
            Their pressures; friction bears nothing where bodies pull. [pressure]
        nodes : ndarray of int
            Their flat indices in the grid.
        """
        bears = np.full(pressure.size, math.inf)
        if self.coefficient is not None:
            bears = _at(self.coefficient, nodes) * np.maximum(pressure, 0.0)
        if self.strength is not None:
            bears = np.minimum(bears, _at(self.strength, nodes))
        return bears

    def slope(self, pressure: Real, nodes: Indices) -> Real:
        """Return how much more shear nodes bear under more pressure. [1]

        Parameters
        ----------
        pressure, nodes
            As of :meth:`bound`.
        """
        if self.coefficient is None:
            return np.zeros(pressure.size)
        slope = np.broadcast_to(_at(self.coefficient, nodes), pressure.shape)
        if self.strength is None:
            return slope.copy()
        return np.where(slope * pressure < _at(self.strength, nodes), slope, 0.0)

    def scaled(self, pressure: float) -> Friction:
        """Return the same friction where pressures are in another unit."""
        strength: Any = self.strength
        return Friction(self.coefficient, None if strength is None else strength / pressure)

    def on(self, take: Callable[[Real], Real]) -> Friction:
        """Return the friction on another grid, to which fields are taken."""
        both: list[Any] = [
            take(each) if isinstance(each, np.ndarray) else each
            for each in (self.coefficient, self.strength)
        ]
        return Friction(*both)

    def refuse_other_grids(self, shape: tuple[int, int]) -> None:
        """Refuse fields of another shape than the grid's."""
        for name in ("coefficient", "strength"):
            given = getattr(self, name)
            if isinstance(given, np.ndarray) and given.shape != shape:
                raise InputError(
                    f"{name} of the friction has the shape {given.shape} and the surface "
                    f"{shape}; a number or a field of the surface's shape is needed"
                )


def _at(given: Any, nodes: Indices) -> Real | float:
    """Return a number, or a field at nodes."""
    return given.ravel()[nodes] if isinstance(given, np.ndarray) else given


def _in_range(argument: str, given: Any, most: float | None, needed: str) -> Any:
    """Return a number, or a field of numbers, that is positive, finite and at most so large."""
    value = as_number(given)
    numbers: Any = value
    if value is None:
        try:
            numbers = np.ma.filled(np.ma.asarray(given), np.nan)
        except (TypeError, ValueError):
            refuse(argument, given, needed)
        if numbers.dtype.kind not in "iuf" or numbers.ndim != 2 or not numbers.size:
            refuse(argument, given, f"{needed}, or a field of such with the surface's shape")
        numbers = np.array(numbers, dtype=np.float64)
        numbers.flags.writeable = False
    wrong = ~((np.asarray(numbers) > 0) & np.isfinite(numbers))
    if most is not None:
        wrong |= np.asarray(numbers) > most
    if wrong.any():
        refuse(argument, given if value is not None else float(numbers[wrong][0]), needed)
    return numbers
