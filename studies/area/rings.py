"""Surfaces of another family: the waves of two narrow rings, with as much slope in one as in other.

    python -m studies.area.rings

presses them, in two minutes on one core, and writes ``rings.json``. They show how far the common
law of kappa over Nayak's parameter holds beyond the self-affine spectra that it was fitted to.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

import roughline as rl
from roughline._version import __version__
from roughline.computing.arrays import Real
from roughline.statistics.bootstrap import IntervalEstimate
from studies.area.measure import log_kappa

DATA = Path(__file__).parent / "rings.json"
POINTS = 512
SHORT_WAVES = (60, 64)
LONG_WAVES = ((14, 16), (7, 8), (4, 5))
"""Waves along a side, from and to: the short ring of all surfaces, and the long ring of each kind.

The shortest wave has eight cells, as in the study."""
COUNT = 24
SEED = 2031
PRESSURES = (0.019, 0.024, 0.03)
"""p / (E* g), around 5 % in contact."""


@dataclass(frozen=True, eq=False)
class Rings:
    """Surfaces of two rings of waves."""

    long_waves: tuple[int, int]  # waves along a side of the long ring, from and to
    nayak: float  # Nayak's parameter of the spectrum
    area: Real  # shape (realisations, loads): A / A_0, corrected

    def kappa(self, level: float, confidence: float = 0.95) -> IntervalEstimate:
        """Return kappa where a share of the area is in contact."""
        found = log_kappa(self.area, np.array(PRESSURES), level)
        return found.interval_estimate(confidence).exp()


def rings_surface(long_waves: tuple[int, int], number: int) -> tuple[rl.Surface, float]:
    """Return one of these surfaces, of side 1 and rms slope 1, and Nayak's parameter."""
    noise = np.fft.fft2(np.random.default_rng([SEED, number]).standard_normal((POINTS, POINTS)))
    waves = np.hypot(*np.meshgrid(*[np.fft.fftfreq(POINTS, 1 / POINTS)] * 2))
    power = np.zeros_like(waves)
    for low, high in (long_waves, SHORT_WAVES):
        ring = (waves >= low) & (waves <= high)
        power[ring] = 0.5 / ((2 * np.pi * waves[ring]) ** 2).sum()  # each has half of the slope
    moments = [float((power * (2 * np.pi * waves) ** order).sum()) for order in (0, 2, 4)]
    heights = np.fft.ifft2(np.sqrt(power) * noise / np.abs(noise)).real * POINTS**2
    return rl.Surface(heights, sizes=(1.0, 1.0)), 1.5 * moments[0] * moments[2] / moments[1] ** 2


def area_of(surface: rl.Surface) -> Real:
    """Return the corrected areas of one surface under the pressures, over that of the surface."""
    curve = rl.press(surface, E_star=1.0, forces=list(PRESSURES), periodic=True)
    assert curve.area_fraction_corrected is not None  # of a surface
    return curve.area_fraction_corrected


@cache
def rings() -> list[Rings]:
    """Return the surfaces of all kinds."""
    kinds = json.loads(DATA.read_text(encoding="utf-8"))["kinds"]
    return [
        Rings((low, high), each["nayak"], np.array(each["area"]))
        for each in kinds
        for low, high in [each["long_waves"]]
    ]


def version() -> str:
    """Return the version of roughline that pressed them."""
    return str(json.loads(DATA.read_text(encoding="utf-8"))["roughline_version"])


def main() -> None:
    """Press all of them."""
    kinds = []
    for waves in LONG_WAVES:
        bodies = [rings_surface(waves, number) for number in range(COUNT)]
        areas = [[float(f"{area:.7g}") for area in area_of(surface)] for surface, _ in bodies]
        kinds.append({"long_waves": waves, "nayak": bodies[0][1], "area": areas})
    content = {"roughline_version": __version__, "kinds": kinds}
    DATA.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
