"""One body of the study: its micro-slip, its loops and its stiffness along the surface.

Bodies have rms height, side and E* 1, so that forces are F̄, and no roll-off. What is measured
stands beside what follows of the same body under normal loads alone [1]_.

References
----------
.. [1] J. Jäger, "A new principle in contact mechanics", J. Tribol. 120, 677 (1998).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

import roughline as rl
from roughline.computing.arrays import Real

SEED = 2017
BAND = 16
"""q_high / q_low."""
POINTS, COUPLED_POINTS = 128, 64
"""Points along a side, and where pressure displaces along the surface."""
SHARES = (0.1, 0.3, 0.5, 0.8)
"""Shear forces over mu F on the first way up; cycles go between the last and its opposite."""
CYCLES = 3
GROWTH = 8
"""Loads in which the contact of coupled bodies grows; others grow in one."""
_A_QUARTER = 2  # loads in a quarter of a cycle
_RTOL = 1e-4  # of the residuals: slides are then right to 1e-5 of them

Measured = dict[str, float | list[float]]


@dataclass(frozen=True)
class Case:
    """Bodies that differ in nothing but their seeds."""

    hurst: float
    force_bar: float  # F / (E* h L)
    poisson: float = 0.3
    beta: float = 0.0  # Dundurs'
    friction: float = 0.3  # mu

    @property
    def is_coupled(self) -> bool:
        """Whether pressure displaces along the surface."""
        return self.beta != 0

    @property
    def points(self) -> int:
        """Points along a side."""
        return COUPLED_POINTS if self.is_coupled else POINTS

    @property
    def spectrum(self) -> rl.SelfAffine:
        """The spectrum of the surfaces, and of their reduced lines."""
        return rl.SelfAffine(hurst=self.hurst, rms_height=1.0, q_high=BAND * 2 * math.pi)

    @cached_property
    def half_space(self) -> rl.Homogeneous:
        """What the bodies are pressed into."""
        return rl.Homogeneous(1.0, poisson=self.poisson, beta=self.beta)

    @property
    def mindlin(self) -> float:
        """G* / E*, which is k_t / k_n of a disc that sticks: 2 (1 - nu) / (2 - nu)."""
        return 2 * (1 - self.poisson) / (2 - self.poisson)

    @property
    def forces(self) -> Real:
        """The force, and those of Jäger's principle: Q / mu less."""
        return self.force_bar * (1 - np.array([0.0, *SHARES]))

    def surface(self, number: int) -> rl.Surface:
        """Return the surface of a number."""
        seed = np.random.SeedSequence(SEED, spawn_key=(number,))
        return self.spectrum.surface(self.points, rng=seed)


def measured(case: Case, number: int, *, is_sheared: bool = True) -> Measured:
    """Measure the body of a number, sheared or only pressed; it depends on nothing else.

    Bodies of one material are sheared along x, and along y. Those of two are sheared along x, and
    so are the same bodies without coupling.
    """
    surface = case.surface(number)
    found = beside_jaeger(case, lambda forces: _pressed(surface, forces))
    if not is_sheared:
        return found
    if not case.is_coupled:
        return found | _sheared(case, surface, "x") | _sheared(case, surface, "y")
    alone = _sheared(replace(case, beta=0.0), surface, "x")
    return found | _sheared(case, surface, "x") | {f"alone_{key}": alone[key] for key in alone}


def _pressed(surface: rl.Surface, forces: Real) -> tuple[Real, Real, Real]:
    """Depth, stiffness and work of a surface under normal loads."""
    curve = rl.press(surface, E_star=1.0, forces=forces)
    assert curve.work is not None  # surfaces have it
    return curve.depth, curve.stiffness, curve.work


def beside_jaeger(case: Case, pressed: Callable[[Real], tuple[Real, Real, Real]]) -> Measured:
    """Return the normal stiffness, and by Jäger's principle the slides and the loop.

    Under the shear force Q the body has slid by mu E* / G* times what it comes nearer from
    F - Q / mu to F. A cycle dissipates 8 mu² E* / G* times what lies between F(d) and its chord.

    Parameters
    ----------
    case : Case
        The body's.
    pressed : callable
        Returns depths, stiffnesses and works under forces.
    """
    forces = case.forces
    depth, stiffness, work = pressed(forces)
    nearer = depth[0] - depth[1:]
    chord = (forces[0] + forces[-1]) / 2 * nearer[-1]
    loop = 8 * case.friction**2 / case.mindlin * (chord - (work[0] - work[-1]))
    return {
        "normal": float(stiffness[0]),
        "depth": float(depth[0]),
        "jaeger": (case.friction / case.mindlin * nearer).tolist(),
        "jaeger_loop": float(loop),
    }


def _sheared(case: Case, surface: rl.Surface, along: str) -> Measured:
    """Press a body, shear it along an axis through its cycles, and measure that.

    What follows a load that is not solved is not a number.
    """
    axis = "xy".index(along)
    grows, cycles = (GROWTH, CYCLES) if case.is_coupled else (1, 1)
    ways = [SHARES[-1] * (1 - i / _A_QUARTER) for i in range(1, 2 * _A_QUARTER + 1)]
    cycle = [*ways, *(-share for share in ways)]
    shares = [0.0] * grows + [*SHARES] + cycle * cycles
    forces = np.full(len(shares), case.force_bar)
    forces[:grows] *= np.arange(1, grows + 1) / grows
    shear = np.zeros((len(shares), 2))
    shear[:, axis] = case.friction * case.force_bar * np.array(shares)
    curve = rl.press(
        surface,
        half_space=case.half_space,
        friction=rl.Friction(case.friction),
        forces=forces,
        shear_forces=shear,
        rtol=_RTOL,
        throw=False,
    )
    assert isinstance(curve, rl.SlidingCurve)
    pressed, first = grows - 1, grows + len(SHARES)
    slides = curve.slide[:, axis]
    dissipated = curve.dissipated[first:].reshape(cycles, len(cycle)).sum(axis=1)
    return {
        f"slides_{along}": (slides[grows:first] - slides[pressed]).tolist(),
        f"loops_{along}": dissipated.tolist(),
        f"stiffness_{along}": float(curve.shear_stiffness_back[pressed, axis, axis]),
        f"depth_{along}": float(curve.depth[pressed]),
    }
