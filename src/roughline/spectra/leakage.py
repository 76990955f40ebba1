"""How a window and the removal of the mean plane smear the spectrum of a piece of a surface.

A piece of a larger surface holds no whole waves. After its plane is removed and a Hann window is
applied, each wave of the surface appears in several modes of the piece. Wavenumbers are in
units of the piece's q_low = 2 pi / L here, in which its modes are 1 apart. What square maps need is
kept in a file, which ``make square-leakage`` writes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real

_Modes = NDArray[np.intp]

RING_HALF_WIDTH = 0.25
"""Modes this near to a ring's wavenumber belong to it; wider rings would smear a steep spectrum."""
LONGER_WAVES = np.geomspace(1 / 16, 0.5, 13)
"""Ends of the ranges of waves that are longer than the piece and leave a trace in it. [q_low]"""

SQUARE_MAPS = Path(__file__).with_name("square_leakage.npz")
"""Arrays of :func:`compute_map_leakage` and :func:`compute_power_inside` for Lx = Ly."""

LONG_WAVES = 8  # wavenumber up to which a line scan's waves are those of a cosine series [q_low]
_MOST_MODES = 48  # from the longest; beyond, a power law is smeared by less than 0.3 %
_PLANE_RINGS = 12  # rings whose power the removed plane changes
_LEAKAGE_REACH = 8  # modes; a window leaks less than 1e-6 of a wave farther away
_RANGE_WIDTH = 0.25  # of the other waves
_DIRECTIONS = 24  # of waves, on a quarter of a circle
_MODES_PER_RING = 24  # that are computed of a large ring


@dataclass(frozen=True, eq=False)
class Leakage:
    """Expected power in the longest modes of a piece, from ranges of waves of its surface. [q_low]

    It is that in each ring of a map, or of each function of a scan, for a spectrum of one in a
    range of waves: C_2d for a map, C_profile for a scan.
    """

    edges: Real  # of the ranges
    waves: Real  # their middles
    response: Real  # over (ring or function, range)
    remaining: Real  # share of the waves' mean square that is left without the mean plane


@lru_cache(maxsize=8)
def map_leakage(aspect: float = 1.0) -> Leakage:
    """Leakage into the longest rings of a map of some Lx / Ly, the mean over all directions."""
    if aspect != 1.0:
        return compute_map_leakage(aspect)
    with np.load(SQUARE_MAPS) as kept:
        return Leakage(*(kept[each.name] for each in fields(Leakage)))


def compute_map_leakage(aspect: float) -> Leakage:
    """Compute :func:`map_leakage`."""
    sides = _sides(aspect)
    reach = _LEAKAGE_REACH / min(sides)
    edges = _edges(_MOST_MODES + reach)
    waves, widths = (edges[1:] + edges[:-1]) / 2, np.diff(edges)
    response, remaining = np.zeros((_MOST_MODES, waves.size)), np.ones(waves.size)
    low = waves < _PLANE_RINGS + reach
    means, remaining[low] = _without_plane(waves[low], sides)
    response[:_PLANE_RINGS, low] = 2 * math.pi * waves[low] * widths[low] * means
    offset, power = _patch(8)
    mx, my, ring = _ring_modes(sides, _MOST_MODES)
    for k in range(_PLANE_RINGS + 1, _MOST_MODES + 1):
        members = np.flatnonzero(ring == k)
        members = members[:: -(-members.size // _MODES_PER_RING)]
        for x, y in zip(mx[members], my[members], strict=True):
            q = _wavenumbers((x + offset) / sides[0], (y + offset) / sides[1])
            wave = LONGER_WAVES.size - 1 + ((q - LONGER_WAVES[-1]) / _RANGE_WIDTH).astype(np.intp)
            by_wave = np.bincount(wave, power, minlength=waves.size)
            response[k - 1] += by_wave[: waves.size] / members.size
    return Leakage(edges, waves, response, remaining)


@lru_cache(maxsize=1)
def scan_leakage() -> Leakage:
    """Leakage into the longest waves of a line scan, those of a cosine series.

    Its functions are sqrt(2) cos(pi k (x + 1/2)) over a unit length, k = 2, 3, ..., with the
    wavenumbers k / 2.
    """
    edges = np.append(
        LONGER_WAVES,
        np.arange(LONGER_WAVES[-1] + _RANGE_WIDTH / 2, 4 * LONG_WAVES, _RANGE_WIDTH / 2),
    )
    waves, widths = (edges[1:] + edges[:-1]) / 2, np.diff(edges)
    k = np.arange(2, 2 * LONG_WAVES + 1)[:, np.newaxis]
    turn = np.exp(0.5j * np.pi * k)
    left = (turn * np.sinc(waves + k / 2) + np.conj(turn) * np.sinc(waves - k / 2)) / math.sqrt(2)
    # the slope of exp(2 pi i q x) over a unit length is -6i / pi sinc'(q)
    ramp = np.where(k % 2, -2 * math.sqrt(2) / (np.pi * k) ** 2, 0.0)
    left -= ramp * -6j / math.pi * _sinc_slope(waves)
    removed = np.sinc(waves) ** 2 + 3 / math.pi**2 * _sinc_slope(waves) ** 2
    return Leakage(edges, waves, 2 * np.abs(left) ** 2 * widths, 1 - removed)


@lru_cache(maxsize=8)
def power_inside(aspect: float = 1.0) -> tuple[Real, Real]:
    """Share of a ring's power that comes from waves below an end of the spectrum.

    It is computed far from the longest waves, where it depends alone on the distance to the end,
    which is its wavenumber less the ring's. The distances rise, and the share from 0 to 1.
    """
    if aspect != 1.0:
        return compute_power_inside(aspect)
    with np.load(SQUARE_MAPS) as kept:
        return kept["distances"], kept["share"]


def compute_power_inside(aspect: float) -> tuple[Real, Real]:
    """Compute :func:`power_inside`."""
    sides = _sides(aspect)
    far, steps = 200.0, 16
    offset, power = _patch(steps)
    reach = math.hypot(*(_LEAKAGE_REACH / side for side in sides)) + 1
    edges = np.arange(-reach, reach + 1 / steps, 1 / steps)
    share = np.zeros(edges.size - 1)
    angles = (np.arange(steps) + 0.5) / steps * math.pi / 2
    for ring in far + RING_HALF_WIDTH * np.linspace(-1, 1, 5):
        for angle in angles:
            x, y = ring * math.cos(angle), ring * math.sin(angle)
            q = _wavenumbers(x + offset / sides[0], y + offset / sides[1])
            beyond = ((q - far + reach) * steps).astype(np.intp)
            share += np.bincount(beyond, power, minlength=share.size)
    return edges, np.append(0.0, np.cumsum(share)) / share.sum()


def _ring_modes(sides: tuple[float, float], rings: int) -> tuple[_Modes, _Modes, _Modes]:
    """Numbers along x and y >= 0, and ring, of the modes that belong to rings."""
    most = [int((rings + 0.5) * side) for side in sides]
    mx, my = np.meshgrid(np.arange(-most[0], most[0] + 1), np.arange(most[1] + 1), indexing="ij")
    along = np.hypot(mx / sides[0], my / sides[1])
    ring = np.rint(along).astype(np.intp)
    members = (np.abs(along - ring) <= RING_HALF_WIDTH) & (ring >= 1) & (ring <= rings)
    return mx[members], my[members], ring[members]


def _hann(distance: Real) -> Real:
    """Amplitude that a wave has in a mode at a distance, under a Hann window of mean square 1.

    This is the Fourier transform of the window about its middle.
    """
    around = (np.sinc(distance - 1) + np.sinc(distance + 1)) / 2
    return math.sqrt(2 / 3) * (np.sinc(distance) + around)


def _hann_slope(distance: Real) -> Real:
    """Derivative of :func:`_hann`."""
    around = (_sinc_slope(distance - 1) + _sinc_slope(distance + 1)) / 2
    return math.sqrt(2 / 3) * (_sinc_slope(distance) + around)


def _sinc_slope(distance: Real) -> Real:
    """Derivative of sin(pi x) / (pi x)."""
    other = np.where(distance == 0, 1.0, distance)
    slope = (np.cos(np.pi * other) - np.sinc(other)) / other
    return np.where(distance == 0, 0.0, slope)


def _without_plane(q: Real, sides: tuple[float, float]) -> tuple[Real, Real]:
    """Power of waves in the longest rings, over (ring, q), and the share of their mean square left.

    The mean plane is removed. The mean and the slopes of exp(2 pi i (x + y)) over a unit square
    are products of sinc and of its derivative, and so are the transforms of that plane.
    """
    along_x, along_y, ring = _ring_modes(sides, _PLANE_RINGS)
    (mx, of_x), (my, of_y) = (
        np.unique(each.astype(np.float64), return_inverse=True) for each in (along_x, along_y)
    )
    flat_x, flat_y = _hann(mx)[of_x], _hann(my)[of_y]
    tilted_x, tilted_y = _hann_slope(mx)[of_x], _hann_slope(my)[of_y]
    tilted = 3 / math.pi**2  # 12 / (2 pi)², from the transform of x over its mean square
    power, remaining = np.zeros((ring.size, q.size)), np.zeros(q.size)
    angles = (np.arange(_DIRECTIONS) + 0.5) / _DIRECTIONS * math.pi / 2
    for angle in angles:
        for sign in (1, -1):
            x, y = (
                sign * side * q * of_angle
                for side, of_angle in zip(sides, (math.cos(angle), math.sin(angle)), strict=True)
            )
            mean_x, mean_y, slope_x, slope_y = (
                np.sinc(x),
                np.sinc(y),
                _sinc_slope(x),
                _sinc_slope(y),
            )
            left = _hann(mx[:, np.newaxis] - x)[of_x] * _hann(my[:, np.newaxis] - y)[of_y]
            left -= np.outer(flat_x * flat_y, mean_x * mean_y)
            left -= tilted * np.outer(tilted_x * flat_y, slope_x * mean_y)
            left -= tilted * np.outer(flat_x * tilted_y, mean_x * slope_y)
            power += left**2
        removed = (mean_x * mean_y) ** 2
        removed += tilted * (slope_x * mean_y) ** 2
        removed += tilted * (mean_x * slope_y) ** 2
        remaining += 1 - removed
    counts = np.bincount(ring, minlength=_PLANE_RINGS + 1)[1:]
    sums = np.zeros((_PLANE_RINGS + 1, q.size))
    np.add.at(sums, ring, power)
    means = sums[1:] / np.maximum(counts, 1)[:, np.newaxis]
    return means / (2 * angles.size), remaining / angles.size


def _wavenumbers(along_x: Real, along_y: Real) -> Real:
    """Wavenumbers on a grid, as one row."""
    squares: Real = np.add.outer(along_x**2, along_y**2).ravel()
    return np.sqrt(squares, out=squares)


def _patch(steps: int) -> tuple[Real, Real]:
    """Offsets from a mode along one side, and the power of the window over both sides, as a row."""
    offset = (np.arange(2 * steps * _LEAKAGE_REACH) + 0.5) / steps - _LEAKAGE_REACH
    along = _hann(offset) ** 2 / steps
    return offset, np.outer(along, along).ravel()


def _edges(last: float) -> Real:
    return np.append(
        LONGER_WAVES, np.arange(LONGER_WAVES[-1] + _RANGE_WIDTH, last + _RANGE_WIDTH, _RANGE_WIDTH)
    )


def _sides(aspect: float) -> tuple[float, float]:
    """Both sides in units of L, the root of their product."""
    return math.sqrt(aspect), 1 / math.sqrt(aspect)
