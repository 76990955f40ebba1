"""Random contact problems of every kind: sizes, aspects, roughness, scales, loads, bounds."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import roughline as rl

E_STAR = 3.0
_KINDS = (
    "fractal",
    "fractal",
    "rolled off",
    "white noise",
    "plateaus",
    "needle",
    "asperity",
    "flat punch",
    "two levels",
)


@dataclass(frozen=True)
class Problem:
    """A surface and its loads, with words for what they are; elastic without a hardness."""

    kind: str
    surface: rl.Surface
    periodic: bool
    loads: dict
    loading: str
    hardness: float | None = None


def random_problem(rng: np.random.Generator, largest: int = 130) -> Problem:
    """Draw a problem; every one of them has a solution within double precision."""
    shape = _shape(rng, largest)
    kind = str(rng.choice(_KINDS))
    heights = _heights(rng, kind, shape)
    spacing = 10 ** rng.uniform(-1, 0, 2)
    if rng.random() < 0.3:
        spacing = np.array([1.0, 10.0])[rng.permutation(2)]
    scale = 10.0 ** rng.integers(-12, 13)
    sizes = (shape[0] * spacing[0], shape[1] * spacing[1])
    surface = rl.Surface(heights * scale, sizes)
    periodic = bool(rng.random() < 0.4)
    loading, loads = _loads(rng, surface, periodic)
    return Problem(kind, surface, periodic, loads, loading)


def random_history(rng: np.random.Generator, largest: int = 130) -> Problem:
    """Draw a problem of a body that yields, with loads that rise and fall.

    The hardness lies from far above the elastic pressures to far below them. One in twenty of the
    histories goes beyond what the body bears.
    """
    problem = random_problem(rng, largest)
    surface = problem.surface
    cell = np.sqrt(surface.area / surface.heights.size)
    steep = E_STAR * (surface.rms_height or 1.0) / cell
    hardness = steep * 10.0 ** rng.uniform(-6, 2)
    ((control, loads),) = problem.loads.items()
    loads = np.asarray(loads)
    if control == "forces" and rng.random() < 0.95:
        most = hardness * surface.area
        loads = loads * min(1.0, rng.uniform(0, 1) * most / loads.max())
    history = np.append(loads, rng.choice(np.append(loads, 0.0), rng.integers(0, 6)))
    if rng.random() < 0.5:  # on the way between, too
        history[1:] *= rng.uniform(0, 1, history.size - 1)
    return replace(problem, loads={control: history}, hardness=float(hardness))


def _shape(rng: np.random.Generator, largest: int) -> tuple[int, int]:
    kind = rng.choice(["any", "any", "square", "strip", "prime"])
    nx, ny = (int(n) for n in np.exp(rng.uniform(np.log(2), np.log(largest), 2)))
    if kind == "square":
        return nx, nx
    if kind == "strip":
        return ((1, ny * 4), (nx * 4, 1))[rng.integers(2)]
    if kind == "prime":
        primes = np.array([3, 5, 7, 11, 17, 31, 61, 97, 127])
        nx, ny = (int(n) for n in rng.choice(primes[primes <= max(largest, 3)], 2))
    return nx, ny


def _heights(rng: np.random.Generator, kind: str, shape: tuple[int, int]) -> np.ndarray:
    nx, ny = shape
    n = max(3, nx, ny)
    if kind == "white noise":
        return rng.normal(size=shape)
    if kind == "needle":
        heights = 0.01 * rng.normal(size=shape)
        heights[rng.integers(nx), rng.integers(ny)] = 10 ** rng.uniform(-1, 2)
        return heights
    if kind == "asperity":
        x, y = np.meshgrid(np.linspace(-1, 1, nx), np.linspace(-1, 1, ny), indexing="ij")
        return -((x - rng.uniform(-1, 1)) ** 2) - (y - rng.uniform(-1, 1)) ** 2
    if kind == "flat punch":
        return np.ones(shape)
    if kind == "two levels":
        return np.where(rng.random(shape) < rng.uniform(0.05, 0.95), 1.0, 0.0)
    q_roll = 2 * np.pi * rng.uniform(1, n / 3 + 1) if kind == "rolled off" else None
    spectrum = rl.SelfAffine(hurst=rng.uniform(0, 1), rms_height=1.0, q_roll=q_roll)
    heights = spectrum.surface(n, int(rng.integers(1e9))).heights[:nx, :ny]
    return np.round(3 * heights) if kind == "plateaus" else heights


def _loads(rng: np.random.Generator, surface: rl.Surface, periodic: bool) -> tuple[str, dict]:
    height = surface.rms_height or 1.0
    unit = E_STAR * height * surface.length
    deepest = float(np.mean(surface.heights.max() - surface.heights)) or height
    reachable = not (periodic and surface.rms_height == 0)
    loading = str(rng.choice(["forces", "light", "heavy", "depths" if reachable else "forces"]))
    if loading == "light":
        return loading, {"forces": [unit * 10 ** rng.uniform(-9, -5)]}
    if loading == "heavy":
        return loading, {"forces": [unit * 10 ** rng.uniform(1, 5)]}
    count = int(rng.integers(1, 6))
    if loading == "forces":
        forces = unit * np.geomspace(1e-4, 10 ** rng.uniform(-2, 3), count + 1)
        return loading, {"forces": forces[1:]}
    fractions = np.sort(rng.uniform(0, 0.9999 if periodic else 3, count))
    return loading, {"depths": deepest * fractions}
