"""Levels of the lines of a scan, from the points that are known."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from roughline.computing.arrays import Real

Levelling = Literal["median", "tilt", "differences"]
LEVELLINGS: tuple[Levelling, ...] = ("median", "tilt", "differences")


def line_levels(heights: Any, how: Levelling) -> Real:
    """Return what levelling takes from each point of a map, which may be masked; its mean is zero.

    A line is `heights[:, j]`. "median" takes the median of each line. "tilt" takes a straight line:
    the median slope between points a quarter of a line apart, which one step along it does not
    change, and the median of what departs from it. "differences" shifts each line so that the
    median of its differences from the one before is zero, which keeps a plateau on most of its
    lines if it comes and goes little by little. Medians do not mind a few missing points, or
    particles. The level of a line without any known point lies between those beside it.
    """
    known = ~np.ma.getmaskarray(heights)
    points = np.where(known, np.ma.getdata(heights), np.nan)
    lines = np.flatnonzero(known.any(axis=0))
    known_lines = points[:, lines]
    middles, slopes = np.zeros(lines.size), np.zeros(lines.size)
    x = np.arange(len(points)) - (len(points) - 1) / 2
    if how == "differences":
        middles[1:] = np.cumsum(_medians(np.diff(known_lines, axis=1)))
    else:
        if how == "tilt":
            quarter = max(1, len(points) // 4)
            slopes = _medians(known_lines[quarter:] - known_lines[:-quarter]) / quarter
        middles = _medians(known_lines - slopes * x[:, np.newaxis])
    everywhere = np.arange(points.shape[1])
    middles, slopes = (np.interp(everywhere, lines, each) for each in (middles, slopes))
    return np.asarray(middles - middles.mean() + slopes * x[:, np.newaxis])


def _medians(values: Real) -> Real:
    """Medians of columns over what is known of them; zero where nothing is."""
    found = np.zeros(values.shape[1])
    some = ~np.isnan(values).all(axis=0)
    found[some] = np.nanmedian(values[:, some], axis=0)
    return found
