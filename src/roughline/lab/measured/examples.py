"""Three artificial measurements, written as an instrument would write them."""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

import roughline as rl


def write_example(key: str, folder: Path) -> Path:
    """Where an example lies in a folder; it is written there if it is not there yet."""
    path = folder / EXAMPLES[key].file
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=folder) as begun:
            written = Path(begun) / path.name
            EXAMPLES[key].write(written)
            written.replace(path)
    return path


def _ground_steel(path: Path) -> None:
    """A ground face under an optical profiler: lay, tilt, dark spots, and spikes of dust."""
    n, length = 320, 0.6e-3
    rng = np.random.default_rng(7)
    lay = _rough(0.6, length, 0.07e-6, 25e-6).surface(n, 8).heights[:, :1]  # runs along y
    heights = _rough(0.75, length, 0.16e-6, 60e-6).surface(n, 7).heights + lay
    x, y = np.meshgrid(*2 * [np.arange(n) / n], indexing="ij")
    heights += 2.4e-6 * x - 1.1e-6 * y  # the stage
    unknown = np.zeros((n, n), dtype=bool)
    for _ in range(26):  # steep spots send too little light back
        cx, cy, radius = rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0.003, 0.014)
        unknown |= (x - cx) ** 2 + ((y - cy) / 1.6) ** 2 < radius**2
    unknown[rng.integers(0, n, 40), rng.integers(0, n, 40)] = True
    for i, j in rng.integers(4, n - 4, (7, 2)):
        heights[i, j] += rng.uniform(1.0e-6, 1.5e-6)
    _write_x3p(path, np.ma.MaskedArray(heights, unknown), (length, length))


def _sputtered_film(path: Path) -> None:
    """A sputtered film under an atomic force microscope: a self-affine law with a roll-off."""
    n, length = 384, 4e-6
    heights = _rough(0.8, length, 3.2e-9, 0.5e-6).surface(n, 11).heights
    x, y = np.meshgrid(*2 * [np.arange(n) / n], indexing="ij")
    _write_x3p(path, np.ma.MaskedArray(heights + 9e-9 * x + 4e-9 * y), (length, length))


def _turned_shaft(path: Path) -> None:
    """A stylus along a turned shaft: feed marks, roughness, and a tilted bed."""
    n, step = 4000, 0.5e-6
    length = n * step
    x = (np.arange(n) + 0.5) * step
    rough = _rough(0.7, length, 0.25e-6, 0.15e-3).surface(1024, 5).heights[:, 0]
    heights = np.interp(x, np.linspace(0, length, rough.size), rough)
    heights += 0.12e-6 * np.cos(2 * math.pi * x / 83e-6) + 1.5e-3 * x
    lines = [
        "# Channel: height",
        "# Lateral units: µm",
        "# Value units: nm",
        *(f"{1e6 * a:.2f} {1e9 * b:.2f}" for a, b in zip(x, heights, strict=True)),
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _rough(hurst: float, length: float, rms_height: float, longest: float) -> rl.SelfAffine:
    """A law whose waves are so long at most. [m]"""
    q_roll = 2 * math.pi / longest
    return rl.SelfAffine(hurst=hurst, length=length, rms_height=rms_height, q_roll=q_roll)


def _write_x3p(path: Path, heights: Any, sizes: tuple[float, float]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ImportWarning)  # MPI is absent, and not needed
        from SurfaceTopography import Topography  # here because it loads slowly

    Topography(heights, sizes, unit="m").to_x3p(
        str(path), manufacturer="roughline", model="example"
    )


@dataclass(frozen=True)
class _Example:
    """A measurement made by ourselves."""

    file: str  # name of its file
    name: str  # what the page calls it
    meaning: str  # one sentence
    write: Callable[[Path], None]


EXAMPLES = {
    "ground": _Example(
        "ground-steel.x3p",
        "ground steel, optical profiler",
        "A map of 0.6 mm with a tilt, missing points and spikes of dust.",
        _ground_steel,
    ),
    "film": _Example(
        "sputtered-film.x3p",
        "sputtered film, AFM",
        "A map of 4 µm that follows a self-affine law with a roll-off.",
        _sputtered_film,
    ),
    "shaft": _Example(
        "turned-shaft.txt",
        "turned shaft, stylus",
        "A line scan of 2 mm along feed marks.",
        _turned_shaft,
    ),
}
"""By their keys in the address."""

if __name__ == "__main__":
    write_example(sys.argv[1], Path())
