"""Bodies that the recorder presses from Python, and how."""

import math
from dataclasses import replace
from functools import partial as of

import numpy as np

import roughline as rl


def spectrum(*, hurst=0.8, roll=1.0, cut=None, length=1.0, height=1.0):
    """A self-affine spectrum; roll-off and cutoff over the longest wave's wavenumber."""
    q_low = math.tau / length
    return rl.SelfAffine(
        hurst=hurst,
        length=length,
        rms_height=height,
        q_roll=roll * q_low,
        q_high=None if cut is None else cut * q_low,
    )


def rough(n, seed, amplitudes="fixed", **law):
    return spectrum(**law).surface(n, seed, amplitudes)


def line(n, seed, amplitudes="fixed", **law):
    return spectrum(**law).line(n, seed, amplitudes)


def strip(shape, sizes, seed):
    """A piece of a random surface on a rectangle of any sides."""
    nx, ny = shape
    return rl.Surface(rough(max(*shape, 3), seed).heights[:nx, :ny], sizes)


def scan(n, seed, length=1.0, **law):
    """A straight cut through a random surface."""
    heights = rough(n, seed, length=length, **law).heights[:, n // 3]
    return rl.Line(heights, length, kind="profile")


def tilted(n, seed):
    """A piece of a larger surface, with its tilt."""
    piece = rough(2 * n, seed).cropped((0, n), (0, n))
    heights = piece.heights + 2.0 * np.arange(n)[:, np.newaxis] / n
    return replace(piece, heights=heights)


def shape(name, n):
    """A smooth or stepped body of a known shape, n points along a side."""
    x = (np.arange(n) + 0.5) / n - 0.5
    r = np.hypot(x[:, np.newaxis], x)
    heights = {
        "parabola": -(r**2) / 2,
        "parabola beside the middle": -((x[:, np.newaxis] - 0.13) ** 2 + (x + 0.2) ** 2) / 2,
        "cone": -r,
        "sphere": np.sqrt(1 - r**2) - 1,
        "flat": np.full((n, n), 3.0),
        "round punch": np.where(r < 0.3, 0.0, -1.0),
        "two plateaus": np.where(x[:, np.newaxis] < 0, 0.0, -0.01) + np.zeros(n),
        "wave": np.cos(math.tau * x)[:, np.newaxis] + np.zeros(n),
        "waves": np.cos(math.tau * x)[:, np.newaxis] * np.cos(2 * math.tau * x),
        "four peaks": -np.abs(np.abs(x)[:, np.newaxis] - 0.25) - np.abs(np.abs(x) - 0.25),
        "noise": np.random.default_rng(5).standard_normal((n, n)),
    }[name]
    return rl.Surface(heights, (1.0, 1.0))


LOADS = [0.003, 0.03, 0.3, 3.0]
_DEEP = [0.01, 0.1, 0.5, 1.0]
_MANY = np.geomspace(1e-3, 5, 9)
_HISTORY = [0.1, 0.3, 1.0, 0.4, 0.1, 0.7, 1.3]
_NEARLY = [2.3, 2.5, 2.558]
_STEEL = {"E_star": 1.1e11}

_NEARER_AND_APART = [-0.5, 0.0, 0.5, 1.0, 0.6, 0.1, -0.4, -1.0, -2.0, 0.3]
_PUSHES_AND_PULLS = [0.3, 1.0, 0.1, 0.0, -0.01, 0.5, -10.0, 0.2]
_DUGDALE = {"law": rl.Dugdale(work_of_adhesion=0.1, range=0.3), "throw": False}
_EXPONENTIAL = {"law": rl.Exponential(work_of_adhesion=0.1, range=0.2), "throw": False}

PERIODIC = {"forces": LOADS, "periodic": True}

PRESSED = {
    # name: (how the body is made, options of rl.press)
    "free 16": (of(rough, 16, 1), {"n_loads": 8}),
    "free 17, odd": (of(rough, 17, 2), {"forces": LOADS}),
    "free 32": (of(rough, 32, 7), {"n_loads": 12, "fields": True}),
    "free 48": (of(rough, 48, 3, hurst=0.3), {"forces": LOADS, "fields": [0, 2]}),
    "free 64": (of(rough, 64, 3, hurst=0.7), {"n_loads": 10, "grid_error": True}),
    "free 96": (of(rough, 96, 4, hurst=1.0), {"forces": _MANY}),
    "free 128": (of(rough, 128, 5, hurst=0.5, roll=4), {"forces": LOADS}),
    "free 192": (of(rough, 192, 6, cut=24), {"forces": LOADS}),
    "free 256": (of(rough, 256, 8, hurst=0.6, roll=2, cut=64), {"forces": LOADS}),
    "free 256 depths": (of(rough, 256, 9, hurst=0.9), {"depths": _DEEP}),
    "free very rough": (of(rough, 64, 10, hurst=0.0), {"n_loads": 8}),
    "free Gaussian": (of(rough, 64, 11, "gaussian"), {"forces": LOADS}),
    "free 512": (of(rough, 512, 87), {"forces": LOADS}),
    "free depths": (of(rough, 64, 12), {"depths": _DEEP, "fields": [1]}),
    "free light": (of(rough, 64, 13), {"forces": [1e-30, 1e-12, 1e-5]}),
    "free heavy": (of(rough, 32, 14), {"forces": [10.0, 1e3, 1e8]}),
    "free one load": (of(rough, 64, 15), {"forces": [0.2]}),
    "free in metres": (of(rough, 64, 16, length=1e-3, height=1e-6), {"n_loads": 8, **_STEEL}),
    "free small numbers": (
        of(rough, 32, 17, length=3e-8, height=2e-10),
        {"depths": [1e-11, 1e-10], "E_star": 7e9},
    ),
    "free double": (of(rough, 64, 18), {"forces": LOADS, "solver": rl.Solver(precision="float64")}),
    "free single": (
        of(rough, 64, 18),
        {"forces": LOADS, "solver": rl.Solver(precision="float32"), "rtol": 1e-3},
    ),
    "free mixed": (of(rough, 64, 18), {"forces": LOADS, "solver": rl.Solver(precision="mixed")}),
    "free loose": (of(rough, 64, 19), {"forces": LOADS, "rtol": 1e-2}),
    "free tight": (of(rough, 64, 20), {"forces": LOADS, "rtol": 1e-10}),
    "free grid error, odd": (of(rough, 51, 21), {"forces": LOADS, "grid_error": True}),
    "periodic 16": (of(rough, 16, 31), {"n_loads": 8, "periodic": True}),
    "periodic 32": (of(rough, 32, 32), {"n_loads": 12, "periodic": True, "fields": True}),
    "periodic 63, odd": (of(rough, 63, 33, hurst=0.4), PERIODIC),
    "periodic 64": (
        of(rough, 64, 34, hurst=0.7, roll=4),
        {"n_loads": 10, "grid_error": True, "periodic": True, "E_star": 2.5},
    ),
    "periodic 128": (of(rough, 128, 35, cut=16), {"forces": _MANY, "periodic": True}),
    "periodic 256": (of(rough, 256, 36, roll=8), PERIODIC),
    "periodic depths": (of(rough, 64, 37), {"depths": _DEEP, "periodic": True, "fields": [3]}),
    "periodic too deep": (of(rough, 32, 37), {"depths": [0.1, 50.0], "periodic": True}),
    "periodic double": (of(rough, 64, 38), PERIODIC | {"solver": rl.Solver(precision="float64")}),
    "periodic single": (
        of(rough, 64, 38),
        PERIODIC | {"solver": rl.Solver(precision="float32"), "rtol": 1e-3},
    ),
    "periodic full": (of(rough, 32, 39), {"forces": [5.0, 20.0, 100.0], "periodic": True}),
    "periodic 512": (of(rough, 512, 88), PERIODIC),
    "periodic nearly full": (of(rough, 64, 40, cut=8), {"depths": _NEARLY, "periodic": True}),
    "yielding": (of(rough, 64, 121), {"forces": _MANY, "hardness": 8.0, "fields": [8]}),
    "yielding 256": (of(rough, 256, 122), {"forces": LOADS, "hardness": 4.0}),
    "yielding depths": (of(rough, 96, 123), {"depths": _DEEP, "hardness": 2.0}),
    "yielding, back and forth": (of(rough, 64, 124), {"forces": _HISTORY, "hardness": 3.0}),
    "yielding, by depth back and forth": (
        of(rough, 64, 125, hurst=0.5),
        {"depths": [0.2, 1.0, 0.7, 0.4, 0.8, 1.2], "hardness": 3.0, "fields": True},
    ),
    "yielding periodic": (
        of(rough, 128, 126, cut=16),
        {"forces": _HISTORY, "hardness": 4.0, "periodic": True},
    ),
    "yielding everywhere": (of(rough, 32, 127), {"forces": [0.1, 0.5], "hardness": 0.6}),
    "sticking": (of(rough, 32, 131), {"depths": _NEARER_AND_APART, **_DUGDALE, "fields": True}),
    "sticking by force": (of(rough, 32, 132), {"forces": _PUSHES_AND_PULLS, **_DUGDALE}),
    "sticking periodic": (
        of(rough, 96, 133, cut=12),
        {"depths": _NEARER_AND_APART, **_DUGDALE, "periodic": True, "fields": [4]},
    ),
    "sticking strip": (
        of(strip, (48, 16), (1.0, 0.5), 134),
        {"depths": _NEARER_AND_APART, **_DUGDALE, "periodic": "y"},
    ),
    "sticking cycle": (of(rough, 32, 135, cut=6), {"n_loads": 16, **_EXPONENTIAL}),
    "sticking exponentially": (
        of(rough, 64, 136),
        {"depths": _NEARER_AND_APART, **_EXPONENTIAL, "grid_error": True},
    ),
    "sticking, unresolved": (of(rough, 64, 137), {"depths": [0.1], "law": rl.Dugdale(2.0, 0.1)}),
    "strip 16 x 64": (of(strip, (16, 64), (0.25, 1.0), 41), {"n_loads": 8}),
    "strip 128 x 8": (of(strip, (128, 8), (4.0, 0.25), 42), {"forces": LOADS, "fields": True}),
    "strip 48 x 32, cells not square": (
        of(strip, (48, 32), (1.0, 3.0), 43),
        {"forces": LOADS, "grid_error": True},
    ),
    "strip 1 x 64": (of(strip, (1, 64), (0.1, 1.0), 44), {"forces": LOADS, "fields": True}),
    "strip 64 x 1": (of(strip, (64, 1), (1.0, 0.1), 45), {"n_loads": 6}),
    "strip 1 x 2": (of(strip, (1, 2), (1.0, 1.0), 46), {"forces": [0.1, 1.0]}),
    "strip periodic 64 x 16": (of(strip, (64, 16), (2.0, 1.0), 47), PERIODIC | {"fields": True}),
    "strip periodic 1 x 32": (of(strip, (1, 32), (0.2, 1.0), 48), PERIODIC),
    "parabola": (of(shape, "parabola", 64), {"depths": [0.003, 0.02], "fields": True}),
    "parabola aside": (of(shape, "parabola beside the middle", 48), {"n_loads": 8}),
    "parabola grid error": (
        of(shape, "parabola", 64),
        {"n_loads": 8, "grid_error": True, "E_star": 3.0},
    ),
    "cone": (of(shape, "cone", 65), {"forces": [1e-4, 1e-2], "fields": [1]}),
    "sphere": (of(shape, "sphere", 64), {"n_loads": 6, "E_star": 7.0}),
    "flat": (of(shape, "flat", 32), {"forces": [1e-3, 1.0], "fields": True}),
    "flat periodic": (of(shape, "flat", 16), {"forces": [1e-3, 1.0], "periodic": True}),
    "flat, number of loads": (of(shape, "flat", 16), {"n_loads": 5}),
    "round punch": (of(shape, "round punch", 64), {"depths": [0.01, 0.5, 1.5], "fields": [0]}),
    "two plateaus": (of(shape, "two plateaus", 32), {"depths": [0.001, 0.1], "grid_error": True}),
    "wave": (of(shape, "wave", 64), {"n_loads": 8, "periodic": True, "fields": [4]}),
    "waves": (of(shape, "waves", 64), {"n_loads": 8, "periodic": True}),
    "four peaks": (of(shape, "four peaks", 32), {"n_loads": 6}),
    "noise": (of(shape, "noise", 32), {"n_loads": 6, "grid_error": True}),
    "noise periodic": (of(shape, "noise", 32), {"n_loads": 6, "periodic": True}),
    "tilted piece": (of(tilted, 32, 51), {"forces": LOADS}),
    "tilted piece periodic": (of(tilted, 32, 52), PERIODIC),
    "line 1024": (of(line, 1024, 61), {"n_loads": 12}),
    "line 65536": (of(line, 65536, 62, hurst=0.5), {"forces": np.geomspace(1e-5, 10, 25)}),
    "line depths": (of(line, 4096, 63, "gaussian"), {"depths": _DEEP, "E_star": 0.7}),
    "line in metres": (
        of(line, 4096, 64, length=1e-3, height=1e-6, roll=3),
        {"n_loads": 10, **_STEEL},
    ),
    "line of three": (of(line, 3, 65), {"forces": [0.1, 1.0]}),
    "line, periodic": (of(line, 64, 66), {"n_loads": 3, "periodic": True}),
    "profile": (of(scan, 64, 67), {"n_loads": 3}),
    "failing": (of(rough, 32, 71), {"forces": _MANY, "solver": rl.Solver(8), "throw": False}),
    "failing periodic": (
        of(rough, 32, 72),
        {"forces": _MANY, "solver": rl.Solver(25), "throw": False, "periodic": True},
    ),
    "failing depths": (
        of(rough, 32, 73),
        {"depths": _DEEP, "solver": rl.Solver(15), "throw": False, "fields": True},
    ),
    "failing grid error": (
        of(rough, 64, 74),
        {"forces": LOADS, "solver": rl.Solver(20), "throw": False, "grid_error": True},
    ),
    "failing at once": (of(rough, 32, 75), {"forces": LOADS, "solver": rl.Solver(1)}),
    "failing loudly": (of(rough, 32, 76), {"n_loads": 6, "solver": rl.Solver(12)}),
    "refused: no loads": (of(rough, 16, 1), {}),
    "refused: both": (of(rough, 16, 1), {"forces": [1.0], "depths": [1.0]}),
    "refused: falling": (of(rough, 16, 1), {"forces": [1.0, 0.5]}),
    "refused: zero": (of(line, 16, 1), {"depths": [0.0, 0.5]}),
    "refused: one load": (of(line, 16, 1), {"n_loads": 1}),
    "refused: not finite": (of(rough, 16, 1), {"forces": [math.nan]}),
    "refused: too light": (of(rough, 16, 1), {"forces": [1e-300]}),
    "refused: too heavy": (of(rough, 16, 1), {"forces": [1e300]}),
    "refused: single, tight": (
        of(rough, 16, 1),
        {"forces": [1.0], "solver": rl.Solver(precision="float32")},
    ),
    "refused: modulus": (of(rough, 16, 1), {"forces": [1.0], "E_star": -1.0}),
    "refused: tolerance": (of(rough, 16, 1), {"forces": [1.0], "rtol": 0.5}),
    "refused: solver": (of(rough, 16, 1), {"forces": [1.0], "solver": 0}),
    "refused: fields": (of(rough, 16, 1), {"forces": [1.0], "fields": [4]}),
    "refused: few points": (of(rough, 12, 1), {"forces": [1.0], "grid_error": True}),
    "refused: array": (of(np.ones, (4, 4)), {"forces": [1.0]}),
}


def press(make, options):
    """Press a problem; the curve, what it writes of itself, and what it told on the way."""
    body, told = make(), []
    options = {"E_star": 1.0, **options}
    curve = rl.press(body, progress=lambda *counts: told.append(list(counts)), **options)
    return {"body": body, "curve": curve, "dataset": curve.to_dataset(), "told": told}
