"""Loads along the surface, by shear forces or by slides, checked before anything is solved."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.arguments import checked_count
from roughline.errors import InputError
from roughline.errors.checks import number, positive, refuse
from roughline.errors.public import public_names
from roughline.errors.words import called
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.law import ContactLaw

LARGEST_SHARE_HELD = 1 - 1e-9
"""Of what friction bears; more of it slides."""

_BYTES_PER_LOAD = 200  # of a pair of numbers in a list
_MOST_STEPS = 1e18  # that are counted


@dataclass(frozen=True, eq=False)
class ShearLoads:
    """Checked loads along the surface, one with each load, and the friction that bears them."""

    friction: Friction
    control: Literal["shear_forces", "slides"]  # what is prescribed
    values: Real  # shape (loads, 2) [force] or [length]


@dataclass(frozen=True)
class GivenShear:
    """Friction and loads along the surface as the caller gave them, not checked yet."""

    friction: Friction | None
    shear_forces: Any
    slides: Any

    @property
    def is_nothing(self) -> bool:
        """Whether nothing of it is given."""
        return self.friction is None and self.shear_forces is None and self.slides is None

    def refuse_beside(self, *, n_loads: bool, grid_error: bool) -> None:
        """Refuse what is not known along a path with friction."""
        if self.is_nothing:
            return
        if n_loads:
            raise InputError(
                f"{called('n_loads')} spaces loads that only press; with friction each has its "
                "shear: give depths or forces"
            )
        if grid_error:
            raise InputError(
                f"{called('grid_error')} is not known with friction: leave it out, and press the "
                "surface with fewer points to see what the grid changes"
            )

    def checked(
        self,
        control: str,
        loads: Real,
        half_space: HalfSpace,
        law: ContactLaw,
        shape: tuple[int, int],
    ) -> ShearLoads | None:
        """Return the checked loads along the surface; None without friction."""
        if self.friction is None:
            self._refuse_without_friction()
            return None
        if not isinstance(self.friction, Friction):
            refuse("friction", self.friction, "an rl.Friction is needed, such as rl.Friction(0.3)")
        if self.shear_forces is not None and self.slides is not None:
            raise InputError("shear_forces and slides are given; give one of the two")
        _refuse_law(law)
        refuse_unknown_shear(half_space)
        self.friction.refuse_other_grids(shape)
        name: Literal["shear_forces", "slides"] = (
            "shear_forces" if self.slides is None else "slides"
        )
        given = self.shear_forces if self.slides is None else self.slides
        values = np.zeros((loads.size, 2)) if given is None else checked_vectors(name, given)
        if len(values) != loads.size:
            raise InputError(
                f"{name} are {len(values)} and {control} are {loads.size}; give as many of both, "
                "one with each load"
            )
        if name == "shear_forces":
            self._refuse_sliding(control, loads, values)
        return ShearLoads(self.friction, name, values)

    def _refuse_without_friction(self) -> None:
        for name in ("shear_forces", "slides"):
            if getattr(self, name) is not None:
                raise InputError(
                    f"{name} are given without friction, and bodies without it bear no shear: give "
                    "friction=rl.Friction(0.3) too"
                )

    def _refuse_sliding(self, control: str, loads: Real, values: Real) -> None:
        """Refuse shear where nothing presses, and more of it than friction bears."""
        shear = np.hypot(*values.T)
        without = (loads <= 0) & (shear > 0)
        if without.any():
            at = int(without.argmax())
            raise InputError(
                f"shear_forces[{at}] is {_written(values[at])} at {control}[{at}] = "
                f"{loads[at]:g}, where nothing presses; give (0, 0) there"
            )
        assert self.friction is not None
        if control != "forces" or not isinstance(self.friction.coefficient, float):
            return
        limit = self.friction.coefficient * loads
        beyond = shear > LARGEST_SHARE_HELD * limit
        beyond &= shear > 0
        if beyond.any():
            at = int(beyond.argmax())
            raise InputError(
                f"shear_forces[{at}] is {_written(values[at])}, of the size {shear[at]:.6g}, and "
                f"friction bears less than mu F = {limit[at]:.6g} there, so that the bodies slide: "
                "give less, or slides"
            )


def _refuse_law(law: ContactLaw) -> None:
    """Refuse bodies that stick to each other."""
    if law.memory == "path":
        raise InputError(
            "friction of bodies that stick to each other is not solved: leave "
            f"{called('friction')} out, or the law"
        )


def refuse_unknown_shear(half_space: HalfSpace) -> None:
    """Refuse a half-space of which the friction is not solved."""
    half_space.shear_spectrum(np.ones(1))  # which refuses one that does not know it
    if not all(half_space.repeats):  # which is refused if it does not know its kernel
        nothing = np.empty((0, 0))
        half_space.shear_kernel(0, (1.0, 1.0), (nothing, nothing, nothing))


def checked_vectors(name: str, given: Any) -> Real:
    """Return pairs of finite numbers; single numbers are along x."""
    needed = "pairs of finite numbers (x, y) are needed, or numbers along x"
    try:
        values = np.atleast_1d(np.ma.filled(np.ma.asarray(given), np.nan))
    except (TypeError, ValueError):
        refuse(name, given, needed)
    if values.dtype.kind not in "iuf" or values.ndim > 2 or not values.size:
        refuse(name, given, needed)
    values = values.astype(np.float64)
    if values.ndim == 1:
        values = np.stack([values, np.zeros_like(values)], axis=1)
    if values.shape[1] != 2:
        refuse(name, given, needed)
    wrong = ~np.isfinite(values).all(axis=1)
    if wrong.any():
        at = int(wrong.argmax())
        raise InputError(f"{name}[{at}] is {_written(values[at])}; {needed}")
    return values


def _written(vector: Real) -> str:
    return f"({vector[0]:g}, {vector[1]:g})"


@public_names
def cycle(
    amplitude: float, mean: float = 0.0, *, per_cycle: int = 32, cycles: int = 3, angle: float = 0.0
) -> list[tuple[float, float]]:
    """Return the shear forces, or slides, of a load that goes up and down evenly.

    It begins at zero, rises to the mean plus the amplitude, falls to the mean less the amplitude,
    and goes on between both; each cycle ends at the larger one. Where bodies are coupled, it takes
    some cycles until one is as the one before.

    Parameters
    ----------
    amplitude : float
        Positive. [force] or [length]
    mean : float, optional
        [force] or [length]
    per_cycle : int, optional
        Loads in a cycle; even.
    cycles : int, optional
        Number of cycles.
    angle : float, optional
        Direction of the load, from x towards y. [rad]

    Returns
    -------
    list of tuple of float
        Pairs (x, y): zero, ``per_cycle / 4`` or more loads up to the largest, and all cycles.

    Examples
    --------
    >>> import roughline as rl
    >>> print([round(x, 2) for x, _ in rl.cycle(1.0, per_cycle=4, cycles=1)])
    [0.0, 1.0, 0.0, -1.0, 0.0, 1.0]
    """
    amplitude, mean = positive("amplitude", amplitude), number("mean", mean)
    per_cycle, cycles = checked_count("per_cycle", per_cycle, 2), checked_count("cycles", cycles, 1)
    if per_cycle % 2:
        refuse("per_cycle", per_cycle, "an even number is needed, half of it for each way")
    angle, half = number("angle", angle), per_cycle // 2
    highest = mean + amplitude
    steps = min(abs(highest) / amplitude * half / 2 * (1 - 1e-12), _MOST_STEPS)
    rising = max(1, math.ceil(steps))
    refuse_beyond_memory(
        _BYTES_PER_LOAD * (rising + per_cycle * cycles),
        f"a list of {rising:.3g} loads up to the largest and {per_cycle * cycles:.3g} of cycles",
        "give fewer cycles, or a larger amplitude for this mean",
    )
    sizes = [highest * i / rising for i in range(rising + 1)]
    # the same numbers up and down, and zero itself in the middle
    falling = [mean + amplitude * ((half - 2 * i) / half) for i in range(1, half + 1)]
    sizes += [*falling, *falling[-2::-1], highest] * cycles
    return [(size * math.cos(angle), size * math.sin(angle)) for size in sizes]
