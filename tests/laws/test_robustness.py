"""Random problems of every kind end certified: sizes, aspects, roughness, scales, loads, bounds."""

import numpy as np
import pytest

import roughline as rl


def random_body(rng):
    nx, ny = rng.integers(2, 70, 2)
    kind = rng.choice(["fractal", "fractal", "white noise", "plateaus", "needle"])
    whole = rl.SelfAffine(hurst=rng.uniform(0, 1), rms_height=1.0).surface(
        72, int(rng.integers(1e9))
    )
    heights = whole.heights[:nx, :ny]
    if kind == "white noise":
        heights = rng.normal(size=(nx, ny))
    elif kind == "plateaus":
        heights = np.round(3 * heights)
    elif kind == "needle":
        heights = np.zeros((nx, ny))
        heights[rng.integers(nx), rng.integers(ny)] = rng.uniform(0.1, 10)
    spacing = 10 ** rng.uniform(-1, 0, 2)
    scale = 10.0 ** rng.integers(-12, 13)
    return rl.Surface(heights * scale, (nx * spacing[0], ny * spacing[1]))


def random_loads(rng, surface, E_star, periodic):
    if rng.random() < 0.6:
        unit = E_star * surface.rms_height * surface.length
        return {"forces": unit * np.geomspace(1e-4, 10 ** rng.uniform(-1, 4), rng.integers(1, 6))}
    deepest = float(np.mean(surface.heights.max() - surface.heights))
    return {"depths": deepest * np.sort(rng.uniform(0, 0.9999 if periodic else 3, 3))}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_random_problems_are_certified(seed):
    rng = np.random.default_rng(seed)
    problems = 0
    while problems < 150:
        surface = random_body(rng)
        if surface.rms_height == 0:
            continue
        periodic = bool(rng.random() < 0.4)
        loads = random_loads(rng, surface, 3.0, periodic)
        curve = rl.press(surface, E_star=3.0, periodic=periodic, **loads)
        assert curve.converged.all()
        assert (curve.residual <= 1e-6).all()
        assert (curve.stiffness > 0).all()
        rising = curve.stiffness[1:] >= (1 - 1e-6) * curve.stiffness[:-1]
        assert rising.all()
        problems += 1
