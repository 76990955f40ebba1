"""Tilt and bow of a piece, compared with what waves of its own spectrum explain.

Heights are projected on products of Legendre polynomials. Those of one degree share waves of about
the same length: a plateau of the spectrum gives each of them the same mean square, and waves longer
than the piece appear in the first degrees alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from roughline.computing.arrays import Real
from roughline.measurement.fit import SelfAffineFit
from roughline.topography.body import Body, Line, point_spacings, side_lengths
from roughline.topography.trend import polynomials, slopes_of_plane

_DEGREE_COUNT = 8  # of polynomials, from 0
_FIRST_OWN_DEGREE = 4  # from which on waves are the piece's own
_LOWEST_WAVENUMBER = 1 / 32  # of a law without a roll-off [q_low]
_HIGHEST_WAVENUMBER = 32.0  # of waves that leave a trace in these degrees [q_low]
_WAVES, _DIRECTIONS = 160, 48
_PLANE_ROUNDING = 1e-12  # share of the mean square, below which a plane is rounding


@dataclass(frozen=True)
class LongShape:
    """The part of heights that lies in polynomials of one degree."""

    degree: int  # 1 for a tilt, 2 for a bow
    rms: float  # its rms height [length]
    explained: float  # that which waves of the piece's own spectrum have in the mean [length]
    share: float  # its mean square over that of the heights without it
    chance: float  # of as much or more


def known_tilt(body: Body) -> tuple[float, ...] | None:
    """Slopes of the plane that a body had before it was levelled; None if it is not known. [1]"""
    left = slopes_of_plane(body.heights, point_spacings(body))
    removed = body.provenance.tilt.removed or (0.0,) * len(left)
    found = [slope + before for slope, before in zip(left, removed, strict=True)]
    lies = float(np.square(np.multiply(found, side_lengths(body))).sum()) / 12
    if not any(removed) and lies < _PLANE_ROUNDING * body.rms_height**2:
        return None
    return tuple(found)


def long_shapes(bodies: Sequence[Body], fit: SelfAffineFit) -> Iterator[LongShape]:
    """Yield the tilt, the bow and the third degree of pieces of one surface, in the mean.

    As far as they are known. A tilt that several pieces have is the mounting's; it counts how much
    they are tilted differently.
    """
    from scipy import special  # here because it loads slowly

    level = [body.detrended() for body in bodies]
    found = [_mean_squares(each) for each in level]
    squares, counts = np.mean([each for each, _ in found], axis=0), found[0][1]
    free, rest = counts * len(bodies), float(np.mean([each.rms_height**2 for each in level]))
    known = [tilt for body in bodies if (tilt := _own_tilt(body)) is not None]
    if len(known) == len(bodies):
        tilts = known - np.mean(known, axis=0) * (len(known) > 1)
        lies = float(np.square(tilts * side_lengths(bodies[0])).sum()) / 12
        squares[1] = lies / max(1, len(known) - 1)
        free[1] -= counts[1] * (len(known) > 1)
    laws = [_expected(bodies[0], fit.hurst, roll) for roll in _rolls(fit)]
    own = slice(_FIRST_OWN_DEGREE, _DEGREE_COUNT)
    for degree in range(1, _FIRST_OWN_DEGREE):
        if squares[degree] <= _PLANE_ROUNDING * rest:  # removed, and not known
            continue
        chances = []
        for law in laws:
            level_of_law = float((squares[own] / law[own]).sum() / counts[own].sum())
            explained = law[degree] * level_of_law
            ratio = squares[degree] / counts[degree] / explained
            chance = float(special.fdtrc(free[degree], free[own].sum(), ratio))
            chances.append((chance, explained * counts[degree]))
        chance, explained = max(chances)
        without = max(rest - (squares[degree] if degree > 1 else 0.0), _PLANE_ROUNDING * rest)
        share, rms = float(squares[degree]) / without, math.sqrt(squares[degree])
        yield LongShape(degree, rms, math.sqrt(explained), share, chance)


def _own_tilt(body: Body) -> tuple[float, ...] | None:
    """The tilt of a body if it is known, and not its mounting's."""
    return None if body.provenance.tilt.is_of_mounting else known_tilt(body)


def _rolls(fit: SelfAffineFit) -> list[float]:
    """Roll-offs of the law and of both ends of its interval. [q_low]"""
    ends = [*fit.q_roll_interval] if fit.q_roll is None else [*fit.q_roll_interval, fit.q_roll]
    return [max(each / fit.q_low, _LOWEST_WAVENUMBER) for each in ends]


def _mean_squares(body: Body) -> tuple[Real, Real]:
    """Sums of mean squares over the polynomials of each degree, and their number."""
    heights = body.heights - body.heights.mean()
    shares = heights
    for n in heights.shape:
        shares = np.tensordot(shares, polynomials(n, min(_DEGREE_COUNT, n) - 1), axes=(0, 0))
    degree = np.indices(shares.shape).sum(axis=0).ravel()
    sums = np.bincount(degree, shares.ravel() ** 2 / heights.size)
    counts = np.bincount(degree).astype(np.float64)
    return np.array(sums[:_DEGREE_COUNT], dtype=np.float64), counts[:_DEGREE_COUNT]


def _expected(body: Body, hurst: float, roll: float) -> Real:
    """Expected mean square in one polynomial of each degree, for a law with some level."""
    if isinstance(body, Line):
        q, response = _scan_response()
        k = np.geomspace(_LOWEST_WAVENUMBER / 4, 64 * _HIGHEST_WAVENUMBER, 400)
        along = np.hypot(q[:, np.newaxis], k)
        law = np.trapezoid(np.maximum(along / roll, 1.0) ** (-2 - 2 * hurst), k, axis=1)
    else:
        q, response = _map_response(round(body.sizes[0] / body.sizes[1], 2))
        law = np.maximum(q / roll, 1.0) ** (-2 - 2 * hurst)
    return response @ law


@lru_cache(maxsize=8)
def _map_response(aspect: float) -> tuple[Real, Real]:
    """Waves of a surface, and what each leaves in one polynomial of each degree of a map."""
    q = np.geomspace(_LOWEST_WAVENUMBER, _HIGHEST_WAVENUMBER, _WAVES)
    angle = (np.arange(_DIRECTIONS) + 0.5) / _DIRECTIONS * math.pi / 2
    sides = math.sqrt(aspect), 1 / math.sqrt(aspect)
    along_x, along_y = (
        _legendre(np.outer(q, of_angle) * side)
        for of_angle, side in zip((np.cos(angle), np.sin(angle)), sides, strict=True)
    )
    response = np.zeros((_DEGREE_COUNT, q.size))
    for degree in range(_DEGREE_COUNT):
        pairs = [along_x[a] * along_y[degree - a] for a in range(degree + 1)]
        response[degree] = np.mean(pairs, axis=(0, 2)) * 2 * math.pi * q**2
    return q, response


@lru_cache(maxsize=1)
def _scan_response() -> tuple[Real, Real]:
    """Waves of a scan, and what each leaves in the polynomial of each degree."""
    q = np.geomspace(_LOWEST_WAVENUMBER, _HIGHEST_WAVENUMBER, _WAVES)
    return q, _legendre(q) * q


def _legendre(q: Real) -> Real:
    """Mean square of a unit wave in the Legendre polynomial of each degree, over a side of 1."""
    from scipy import special  # here because it loads slowly

    degrees = np.arange(_DEGREE_COUNT).reshape(-1, *[1] * q.ndim)
    return np.asarray((2 * degrees + 1) * special.spherical_jn(degrees, math.pi * q) ** 2)
