"""Errors of friction against exact solutions by grid, which the handbook tells."""

from math import acos, sqrt

import numpy as np
import pytest

import roughline as rl
from halfspace.friction.test_judges import (
    DEPTH,
    FORCE,
    MU,
    NO_SIDE,
    PATH,
    RADIUS,
    SLIDES,
    disc,
    sphere,
)
from roughline.exact import spence

GRIDS = 16, 32, 64

grids = pytest.mark.parametrize("n", GRIDS)


@grids
def test_a_stuck_disc(judged, n):
    surface, radius = disc(n)
    asked = {"half_space": NO_SIDE, "friction": rl.Friction(5.0), "forces": [1e-3]}
    curve = rl.press(surface, slides=[1e-6], **asked)
    error = curve.shear_stiffness_back[0, 0, 0] / (2 * radius) - 1
    judged("disc that sticks", "tangential stiffness", n, abs(error))


@grids
def test_tresca_on_a_disc(judged, n):
    surface, a = disc(n)
    strength, c = 0.02, 0.6 * a
    force = 2 * strength * (a * a * acos(c / a) + c * sqrt(a * a - c * c))
    friction = rl.Friction(strength=strength)
    asked = {"half_space": NO_SIDE, "friction": friction, "forces": [1.0]}
    slide = rl.press(surface, shear_forces=[force], **asked).slide[0, 0]
    error = slide / (2 * strength * sqrt(a * a - c * c)) - 1
    judged("disc of constant strength", "slide", n, abs(error))


@grids
def test_cattaneo_and_mindlin(judged, n):
    share = 0.7
    shears = rl.cycle(share * MU * FORCE, per_cycle=4, cycles=1)
    asked = {"half_space": NO_SIDE, "friction": rl.Friction(MU), "forces": [FORCE] * len(shears)}
    curve = rl.press(sphere(n), shear_forces=shears, **asked)
    largest = MU * DEPTH * (1 - (1 - share) ** (2 / 3))
    judged("Cattaneo-Mindlin", "slide", n, abs(curve.slide[-1, 0] / largest - 1))
    radius = sqrt(curve.stick_fraction[-1]) / (1 - share) ** (1 / 3)
    judged("Cattaneo-Mindlin", "stick radius", n, abs(radius - 1))
    bracket = 1 - (1 - share) ** (5 / 3) - 5 * share / 6 * (1 + (1 - share) ** (2 / 3))
    energy = 3.6 * (MU * FORCE) ** 2 / RADIUS * bracket
    lost = curve.dissipated[-4:].sum() / energy - 1
    judged("Cattaneo-Mindlin", "energy of a cycle", n, abs(lost))


@grids
def test_mindlin_and_deresiewicz(judged, n):
    curve = rl.press(
        sphere(n),
        half_space=NO_SIDE,
        friction=rl.Friction(MU),
        forces=[f * FORCE for f, _ in PATH],
        shear_forces=[q * MU * FORCE for _, q in PATH],
    )
    error = float(abs(curve.slide[:, 0] / (MU * DEPTH) - SLIDES).max())
    judged("Mindlin-Deresiewicz, 9 loads", "slide, over the depth", n, abs(error))


@grids
@pytest.mark.parametrize(("poisson", "beta", "mu"), [(0.3, 2 / 7, 0.3), (0.0, 0.5, 0.2)])
def test_spence_on_a_disc(judged, n, poisson, beta, mu):
    surface, _ = disc(n)
    plain = rl.press(surface, half_space=NO_SIDE, depths=[1e-3]).force[0]
    body = rl.Homogeneous(1.0, poisson=poisson, beta=beta)
    curve = rl.press(surface, half_space=body, friction=rl.Friction(mu), depths=[1e-3])
    expected = {0.3: (0.8959447, 1.024297), 0.2: (0.2208566, 1.035950)}[mu]
    solution = f"Spence, beta {beta:.2g}, mu {mu:g}"
    judged(solution, "force", n, abs(curve.force[0] / plain / expected[1] - 1))
    judged(solution, "stick radius", n, abs(sqrt(curve.stick_fraction[0]) / expected[0] - 1))


@grids
def test_mossakovskii_on_a_disc(judged, n):
    surface, _ = disc(n)
    plain = rl.press(surface, half_space=NO_SIDE, depths=[1e-3]).force[0]
    body = rl.Homogeneous(1.0, poisson=0.0, beta=0.5)
    curve = rl.press(surface, half_space=body, friction=rl.Friction(5.0), depths=[1e-3])
    error = curve.force[0] / plain / spence.stuck_force_ratio(0.5) - 1
    judged("Mossakovskii, beta 0.5", "force", n, abs(error))


@grids
def test_spence_on_a_sphere(judged, n):
    body = rl.Homogeneous(1.0, poisson=0.3, beta=2 / 7)
    depths = DEPTH * np.geomspace(0.25, 1, 4)
    curve = rl.press(sphere(n), half_space=body, friction=rl.Friction(MU), depths=depths)
    error = sqrt(curve.stick_fraction[-1]) / 0.8959447 - 1
    judged("Spence, a sphere in 4 loads", "stick radius", n, abs(error))
