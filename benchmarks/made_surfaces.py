"""Surfaces as workshops make them, and maps of them as instruments see them.

A map has a side of one millimetre, and an rms height of a micrometre where not said otherwise. It
is cut from a parent, which is periodic and several times as long. Nothing here uses the spectra or
the synthesis of roughline, which are judged by these surfaces.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy import ndimage

import roughline as rl

SIDE = 1e-3
"""Side of a map. [m]"""

RMS = 1e-6
"""Rms height of a parent. [m]"""


@dataclass(frozen=True)
class Make:
    """How a parent is made; lengths are in units of the side of a map."""

    points: int = 128  # along the side of a map
    maps: int = 4  # sides of a map along the parent's side
    hurst: float = 0.8  # of what is random in it
    waves: float = 6.0  # roll-off wavelengths along the side of a map; 0 for none
    cells: float = 4.0  # points to the shortest wave; 0 if it is rough down to the grid

    @property
    def n(self) -> int:
        """Points along the side of the parent."""
        return self.points * self.maps

    def gaussian(self, power: Callable, rng) -> np.ndarray:
        """A Gaussian field of unit rms with a power for each wavevector."""
        qx = self.points * np.fft.fftfreq(self.n)[:, None]  # in waves a map
        qy = self.points * np.fft.rfftfreq(self.n)[None, :]
        white = np.fft.rfft2(rng.normal(size=(self.n, self.n)))
        white[0, 0] = 0.0
        q = np.hypot(qx, qy)
        q[0, 0] = 1.0
        if self.cells:
            white[q > self.points / self.cells] = 0.0
        return unit(np.fft.irfft2(white * np.sqrt(power(qx, qy)), (self.n, self.n)))

    def rough(self, rng, *, smooth=False, along=1.0, angle=0.0) -> np.ndarray:
        """A self-affine Gaussian field with a sharp or smooth roll-off, drawn out along a lay."""

        def power(qx, qy):
            c, s = math.cos(angle), math.sin(angle)
            q = np.hypot(along * (c * qx + s * qy), c * qy - s * qx) / math.sqrt(along)
            roll = max(self.waves, 1 / self.maps)
            q = q / roll
            law = 1 + q**2 if smooth else np.maximum(q, 1.0) ** 2
            return law ** -(1 + self.hurst)

        return self.gaussian(power, rng)

    def places(self):
        """Coordinates of the points, in units of the side of a map."""
        x = np.arange(self.n) / self.points
        return x[:, None], x[None, :]

    def waviness(self, maps, rng) -> np.ndarray:
        """One wave along each axis, so many maps long, at random places."""
        x, y = (math.tau * each / maps for each in self.places())
        first, second = rng.uniform(0, math.tau, 2)
        return np.cos(x + first) + np.cos(y + second)


def unit(heights):
    """Heights of mean zero and unit rms."""
    heights = heights - heights.mean()
    return heights / heights.std()


def lognormal(make, rng):
    """Heights with a long tail of summits."""
    return unit(np.exp(0.6 * make.rough(rng)))


def worn(make, rng):
    """Summits worn flat on a fifth of the area, with the marks of wear."""
    rough = make.rough(rng)
    return np.minimum(rough, np.quantile(rough, 0.8)) + 0.02 * make.rough(rng)


def honed(make, rng):
    """Plateau-honed: a fine plateau with the deep valleys of an earlier, rougher step."""
    return np.minimum(0.2 * make.rough(rng), make.rough(rng) + 0.7)


def hatched(make, rng):
    """Cross-hatched: two families of grooves under 30 degrees."""
    families = [make.rough(rng, along=20.0, angle=angle) for angle in (-math.pi / 6, math.pi / 6)]
    return np.minimum(*families) + 0.1 * make.rough(rng)


def turned(make, rng):
    """Feed marks of a tool, each of its own depth, on finer roughness."""
    x, _ = make.places()
    period = 1 / 12
    mark = np.floor(x / period).astype(int)
    depth = rng.normal(0, 0.3, mark.max() + 1)[mark]
    across = x / period - mark - 0.5
    return 4 * across**2 + depth * (1 - 4 * across**2) + 0.25 * make.rough(rng)


def blasted(make, rng):
    """Blasted: dents of many shots, of about the roll-off wavelength."""
    waves = max(make.waves, 2.0)
    count = rng.poisson(4 * (waves * make.maps) ** 2)
    shots = np.zeros((make.n, make.n))
    np.add.at(shots, tuple(rng.integers(0, make.n, (2, count))), rng.lognormal(0, 0.5, count))
    radius = make.points / waves / 4
    dents = ndimage.gaussian_filter(shots, radius, mode="wrap")
    return -unit(dents) + 0.15 * make.rough(rng)


def scratched(make, rng):
    """Scratches across a self-affine surface."""
    x, y = make.places()
    heights = make.rough(rng)
    for _ in range(rng.poisson(3 * make.maps)):
        slope, start = rng.integers(-2, 3), rng.uniform(0, make.maps)
        off = (x + slope * y - start + make.maps / 2) % make.maps - make.maps / 2
        off = off / math.hypot(1, slope)
        heights = heights - rng.uniform(2, 5) * np.exp(-((off / 0.02) ** 2))
    return heights


def wavy(make, rng, maps):
    """Waviness of so many maps beside the roughness."""
    waves = make.waviness(maps, rng)
    return unit(make.rough(rng) + 2 * unit(waves))


def uneven(make, rng):
    """Roughness that varies over the part by a factor of about three."""
    level = make.waviness(make.maps, rng)
    return make.rough(rng) * np.exp(0.35 * level)


def spotted(make, rng):
    """Rough spots, of about a third of a map, on a smoother surface."""
    x, y = make.places()
    level = np.ones((make.n, make.n))
    for _ in range(max(1, rng.poisson(make.maps**2 / 6))):
        cx, cy = rng.uniform(0, make.maps, 2)
        dx, dy = (
            (each - c + make.maps / 2) % make.maps - make.maps / 2 for each, c in ((x, cx), (y, cy))
        )
        level = level + 1.5 * np.exp(-(dx**2 + dy**2) / 2 / 0.17**2)
    return make.rough(rng) * level


KINDS = {
    "sharp roll-off": Make.rough,
    "smooth roll-off": partial(Make.rough, smooth=True),  # that of a K-correlation
    "no roll-off": lambda make, rng: replace(make, waves=0.0).rough(rng),
    "lognormal summits": lognormal,
    "lognormal pits": lambda make, rng: -lognormal(make, rng),
    "worn": worn,
    "plateau-honed": honed,
    "cross-hatched": hatched,
    "turned": turned,
    "ground, 3": partial(Make.rough, along=3.0, angle=0.2),
    "ground, 9": partial(Make.rough, along=9.0, angle=0.2),
    "ground, 30": partial(Make.rough, along=30.0, angle=0.2),
    "blasted": blasted,
    "scratched": scratched,
    "waviness of 4 maps": partial(wavy, maps=4),
    "waviness of 2 maps": partial(wavy, maps=2),
    "uneven roughness": uneven,
    "rough spots": spotted,
}
"""How surfaces are made: functions of a Make and a generator, which give a periodic parent."""

GAUSSIAN = ("sharp roll-off", "smooth roll-off", "no roll-off")
"""Kinds for which the models are exact: Gaussian, isotropic and alike everywhere."""


def parent_of(kind, make, rng):
    """The periodic parent of a kind, of rms height RMS."""
    heights = RMS * unit(KINDS[kind](make, rng))
    return rl.Surface(heights, (SIDE * make.maps,) * 2, unit="m", is_cut_out=False)


def piece_of(parent, make, rng, maps=1):
    """A square piece at a random place of a parent, with its own tilt, `maps` sides long."""
    points = make.points * maps
    x, y = (int(first) for first in rng.integers(0, make.n, 2))
    rolled = np.roll(parent.heights, (-x, -y), (0, 1))[:points, :points]
    return rl.Surface(rolled.copy(), (SIDE * maps,) * 2, unit="m", is_cut_out=True)


def pixel_means(fine, times, rng):
    """Pixels that are means of `times` by `times` points of a finer surface."""
    n = fine.shape[0] // times
    return fine.reshape(n, times, n, times).mean((1, 3))


def blurred(fine, times, rng, pixels):
    """An optical blur whose standard deviation is so many pixels, then points."""
    return ndimage.gaussian_filter(fine, pixels * times, mode="reflect")[::times, ::times]


def stylus(fine, times, rng, radius=5e-6):
    """A spherical tip of some radius [m] traced over the finer surface, then points."""
    step = SIDE / (fine.shape[0])
    reach = max(2, math.ceil(math.sqrt(2 * radius * 4 * RMS) / step))
    x = np.arange(-reach, reach + 1) * step
    tip = -(x[:, None] ** 2 + x[None, :] ** 2) / (2 * radius)
    return ndimage.grey_dilation(fine, structure=tip, mode="reflect")[::times, ::times]


def noisy(fine, times, rng):
    """White noise of a few hundredths of the rms height on pixels that are means."""
    pixels = pixel_means(fine, times, rng)
    return pixels + 0.03 * pixels.std() * rng.normal(size=pixels.shape)


def quantised(fine, times, rng):
    """Heights in steps of a tenth of the rms height."""
    pixels = pixel_means(fine, times, rng)
    step = 0.1 * pixels.std()
    return np.round(pixels / step) * step


def tilted(fine, times, rng):
    """A stage that is tilted by some rms heights across the map."""
    pixels = pixel_means(fine, times, rng)
    x = np.linspace(-1, 1, pixels.shape[0])
    rise = 3 * pixels.std() * rng.normal(size=2)
    return pixels + rise[0] * x[:, None] + rise[1] * x


def bowed(fine, times, rng):
    """A form of the part, or of the optics: a bow of some rms heights."""
    pixels = pixel_means(fine, times, rng)
    x = np.linspace(-1, 1, pixels.shape[0])
    return pixels + 2 * pixels.std() * (x[:, None] ** 2 + x**2)


def with_missing(fine, times, rng):
    """Spots without a reading, on about three per cent of the map."""
    pixels = pixel_means(fine, times, rng).copy()
    drawn = ndimage.gaussian_filter(rng.normal(size=pixels.shape), 2.0)
    pixels[drawn > np.quantile(drawn, 0.97)] = np.nan
    return pixels


INSTRUMENTS = {
    "pixel means": pixel_means,
    "points of a rougher surface": lambda fine, times, rng: fine[::times, ::times],
    "blur of half a pixel": partial(blurred, pixels=0.5),
    "blur of a pixel": partial(blurred, pixels=1.0),
    "stylus tip": stylus,
    "noise": noisy,
    "quantised": quantised,
    "tilted stage": tilted,
    "bow": bowed,
    "missing points": with_missing,
}
"""How an instrument sees a piece: functions of finer heights, of how much finer, a generator."""


def measured(piece, instrument, times, rng):
    """A map as an instrument sees a piece that is `times` finer; heights may be NaN."""
    return INSTRUMENTS[instrument](piece.heights, times, rng)
