"""Parameters of the waves of a surface: how long they are, and whether they have a direction.

The autocorrelation of a periodic surface is its circular one. That of a piece is the mean product
over the points that overlap under a lag, over the mean square of all; sums that are not divided by
the overlap fall with the lag whatever the surface is like.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.fft import good_size, half_spectrum, synthesise
from roughline.texture.found import Found
from roughline.texture.parameters import DECAYED
from roughline.units import decimal

_FEWEST_POINTS = 8  # points along a side that can show a wave
_TURN = 0.5  # between directions [degree]
_BISECTIONS = 24
_SMOOTHED = 6.0  # standard deviation over which the angular spectrum is smoothed [degree]
_PEAK_HALF_WIDTH = 20.0  # about the peak, where wave vectors are averaged [degree]
_ISOTROPIC = 0.5  # texture aspect ratio from which on no direction is told (ISO 25178-2)


@dataclass(frozen=True)
class _Decay:
    """How far the autocorrelation reaches along each direction. [length]"""

    directions: Real  # in the grid, from x towards y [degree]
    lags: Real  # at which it has decayed; infinite where it does not within the map
    known: Real  # lags up to which it is looked at

    @property
    def least(self) -> float:
        """Least lag of all directions; NaN where another may have a smaller one."""
        shortest = float(self.lags.min())
        open_ends = self.known[np.isinf(self.lags)]
        return shortest if shortest <= open_ends.min(initial=math.inf) else math.nan


def wave_parameters(heights: Real, spacings: tuple[float, float], *, is_periodic: bool) -> Found:
    """Return Sal, Str and Std of mean-free heights."""
    if float(np.ptp(heights)) == 0:
        cause = "all heights are equal"
        return {"Sal": cause, "Str": cause, "Std": cause}
    if min(heights.shape) < _FEWEST_POINTS:
        cause = f"a side has less than {_FEWEST_POINTS} points, which show no wave"
        return {"Sal": cause, "Str": cause, "Std": cause}
    heights = heights / np.abs(heights).max()  # whose squares are numbers
    decay = _decay(heights, spacings, is_periodic=is_periodic)
    if math.isnan(decay.least):
        cause = f"the autocorrelation does not fall to {DECAYED} within half of the map"
        return {"Sal": cause, "Str": cause, "Std": cause}
    longest = int(decay.lags.argmax())
    if math.isfinite(decay.lags[longest]):
        ratio: float | str = decay.least / float(decay.lags[longest])
    else:
        bound = decay.least / float(decay.known[np.isinf(decay.lags)].max())
        along = in_picture(float(decay.directions[longest]))
        ratio = (
            f"the autocorrelation does not fall to {DECAYED} within half of the map along "
            f"{along:g}°: Str is below {decimal(bound, 2)}"
        )
    if isinstance(ratio, float) and ratio >= _ISOTROPIC:
        cause = f"Str is {decimal(ratio, 2)}: from {_ISOTROPIC} on no direction stands out"
        return {"Sal": decay.least, "Str": ratio, "Std": cause}
    direction = _strongest(heights, spacings, is_periodic=is_periodic)
    return {"Sal": decay.least, "Str": ratio, "Std": direction}


def in_picture(angle: float) -> float:
    """Return an angle of the grid, from x towards y, as a picture shows it.

    Pictures have the first row, y = 0, at the top, and angles count counter-clockwise from x.
    """
    return (round(-angle, 9) + 0.0) % 180.0


def autocorrelation(heights: Real, *, is_periodic: bool) -> Real:
    """Return the autocorrelation at lags up to half of each side, lag zero in the middle.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        Heights less their mean. [length]
    """
    nx, ny = heights.shape
    half = nx // 2, ny // 2
    mx, my = (nx, ny) if is_periodic else (good_size(nx + half[0]), good_size(ny + half[1]))
    padded = np.zeros((mx, my))
    padded[:nx, :ny] = heights
    modes = half_spectrum(padded)
    sums = synthesise(np.abs(modes) ** 2 + 0j, my) / (mx * my)
    lags = [np.arange(-end, end + 1) for end in half]
    found = sums[np.ix_(lags[0] % mx, lags[1] % my)]
    if not is_periodic:
        overlaps = np.outer(nx - np.abs(lags[0]), ny - np.abs(lags[1]))
        found = found * (nx * ny) / overlaps
    return np.asarray(found / found[half])


def _decay(heights: Real, spacings: tuple[float, float], *, is_periodic: bool) -> _Decay:
    """Look for the first lag along each direction at which the autocorrelation has decayed."""
    from scipy import ndimage

    correlation = autocorrelation(heights, is_periodic=is_periodic)
    spline = ndimage.spline_filter(correlation, order=3, mode="mirror")
    middle = [(n - 1) / 2 for n in correlation.shape]
    directions = np.arange(0.0, 180.0, _TURN)
    units = np.stack([np.cos(np.radians(directions)), np.sin(np.radians(directions))])
    units[np.abs(units) < 1e-12] = 0.0
    per_length = units / np.array(spacings)[:, None]  # points along each side, of a unit of length
    with np.errstate(divide="ignore"):
        known = np.min([end / np.abs(row) for end, row in zip(middle, per_length, strict=True)], 0)

    def at(lags: Real) -> Real:
        places = [end + lags * row for end, row in zip(middle, per_length, strict=True)]
        return np.asarray(ndimage.map_coordinates(spline, places, mode="mirror", prefilter=False))

    step = 0.5 / np.abs(per_length).max(axis=0)  # half a point along one side, half or less on both
    inside = np.full(directions.size, math.inf)
    for first in range(0, math.ceil(float((known / step).max())), 64):
        open_ones = np.isinf(inside)
        if not open_ones.any():
            break
        lags = step * (first + np.arange(1, 65)[:, None])
        below = (at(lags) < DECAYED) & (lags <= known)
        fell = open_ones & below.any(axis=0)
        inside[fell] = (lags[below.argmax(axis=0), np.arange(directions.size)] - step)[fell]
    decayed = np.isfinite(inside)
    low = np.where(decayed, inside, 0.0)
    high = low + step
    for _ in range(_BISECTIONS):
        between = (low + high) / 2
        is_beyond = at(between) < DECAYED
        low, high = np.where(is_beyond, low, between), np.where(is_beyond, between, high)
    return _Decay(directions, np.where(decayed, high, math.inf), known)


def _strongest(heights: Real, spacings: tuple[float, float], *, is_periodic: bool) -> float:
    """Direction of the peak of the angular spectrum, as a picture shows it. [degree]

    Borders of a piece are faded out first: their steps are waves along both sides. The grid of wave
    vectors is coarse for long waves, so the peak is that of a smoothed spectrum, and the direction
    is that of the mean wave vector around it.
    """
    nx, ny = heights.shape
    faded = heights if is_periodic else heights * np.outer(_window(nx), _window(ny))
    power = np.abs(half_spectrum(np.ascontiguousarray(faded))) ** 2
    power[:, 1 : (ny + 1) // 2] *= 2  # for the half that is not stored
    qx, qy = np.meshgrid(
        np.fft.fftfreq(nx, spacings[0]), np.fft.rfftfreq(ny, spacings[1]), indexing="ij"
    )
    power[np.hypot(qx, qy) > min(0.5 / each for each in spacings)] = 0.0  # in the corners
    power[0, 0] = 0.0
    bins = round(180 / _TURN)
    places = np.rint(np.degrees(np.arctan2(qy, qx)) / _TURN).astype(np.intp) % bins
    spectrum = np.bincount(places.ravel(), weights=power.ravel(), minlength=bins)
    distance = np.minimum(np.arange(bins), bins - np.arange(bins)) * _TURN
    kernel = np.exp(-0.5 * (distance / _SMOOTHED) ** 2)
    peak = np.radians(np.fft.irfft(np.fft.rfft(spectrum) * np.fft.rfft(kernel), bins).argmax())
    peak *= _TURN
    along, across = np.cos(peak) * qx + np.sin(peak) * qy, np.cos(peak) * qy - np.sin(peak) * qx
    power[np.abs(across) > math.tan(math.radians(_PEAK_HALF_WIDTH)) * np.abs(along)] = 0.0
    aside = math.atan2(float((power * np.sign(along) * across).sum()), (power * abs(along)).sum())
    return in_picture(math.degrees(float(peak) + aside))


def _window(n: int) -> Real:
    """Hann's window, at the middles of n cells."""
    return np.asarray(np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2)
