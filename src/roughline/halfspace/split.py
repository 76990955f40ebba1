"""The half-space split into near and far, for products that cost what the contact costs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import erfc

from roughline.computing import fft
from roughline.computing.arrays import Indices, Real, Single
from roughline.halfspace import split_loops as loops
from roughline.halfspace.convolution import Convolution
from roughline.halfspace.operator import GridNodes, Operator, Precision

_WIDTH = 1.2  # of the smoothing, in coarse cells
_REACH = 2  # of the near part, in coarse cells
_APART = 8  # nodes of a row so close are summed together


@dataclass(frozen=True, eq=False)
class Split:
    """K = far + near."""

    operator: Operator
    ratio: int
    far: Convolution
    taps: Single
    reach: Indices
    weights: Single

    @property
    def shape(self): return self.operator.shape
    @property
    def spacing(self): return self.operator.spacing
    @property
    def cell_area(self): return self.operator.cell_area
    @property
    def zero_mean(self): return self.operator.zero_mean
    @property
    def periods(self): return self.operator.periods
    @property
    def spectrum(self): return self.operator.spectrum

    @classmethod
    def of(cls, operator, ratio):
        mx, my = operator.periods
        cx, cy = mx // ratio, my // ratio
        dx, dy = operator.spacing
        kx, ky = np.arange(cx // 2 + 1)[:, np.newaxis], np.arange(cy // 2 + 1)
        unit = max(dx, dy)
        q = 2 * np.pi * np.hypot(kx / (mx * dx), ky / (my * dy))
        smooth = operator.spectrum[: cx // 2 + 1, : cy // 2 + 1] * erfc(
            q * (_WIDTH * ratio * unit / 2)
        )
        margin = _REACH * ratio
        lags = np.arange(margin + 1)
        from roughline.halfspace.preconditioner import _even_sum
        near = _even_sum(operator, operator.spectrum, [lags, lags])
        res = smooth
        for axis, (period, coarse) in enumerate(zip(operator.periods, (cx, cy))):
            modes = np.arange(coarse // 2 + 1)
            w = np.full(modes.size, 2.0)
            w[0] = 1
            if coarse % 2 == 0:
                w[-1] = 1
            res = np.moveaxis(np.tensordot(w * np.cos(2 * np.pi / period * np.outer(lags, modes)), res, axes=(1, axis)), 0, axis)
        near = near - res
        distance = np.hypot(lags[:, None] * dx, lags * dy) / (margin * unit)
        near[distance > 1] = 0
        taps = np.zeros((2 * margin + 1, 2 * margin + 4), np.float32)
        taps[margin:, margin : 2 * margin + 1] = near
        taps[margin:, :margin] = near[:, :0:-1]
        taps[:margin] = taps[: margin : -1]
        reach = np.array([int(np.sqrt(margin**2 - a**2)) for a in range(-margin, margin + 1)])
        symbol = [(4 + 2 * np.cos(2 * np.pi * np.arange(c // 2 + 1) / c)) / 6 for c in (cx, cy)]
        spectrum = smooth / (symbol[0][:, None] * symbol[1]) ** 2
        nx, ny = operator.shape
        shape = (-(-nx // ratio) + 3, -(-ny // ratio) + 3)
        far = Convolution(shape, (dx * ratio, dy * ratio), (cx, cy), spectrum, False)
        t = np.arange(ratio) / ratio
        weights = np.stack(
            [(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3], axis=1
        ) / 6
        return cls(operator, ratio, far, taps, reach, weights.astype(np.float32))

    @cached_property
    def grid(self):
        nx, ny = self.operator.shape
        margin = _REACH * self.ratio
        return np.zeros((nx + 2 * margin, ny + 2 * margin + 16), np.float32)

    @cached_property
    def coarse(self):
        return np.zeros(self.far.shape, np.float32), np.zeros(self.far.shape, np.float32)

    @cached_property
    def scratch(self):
        return {}

    def displacement(self, pressure, sources, targets=None, precision="float32", out=None):
        assert targets is not None
        if out is None:
            out = np.empty(targets.indices.size)
        largest = float(np.abs(pressure).max(initial=0.0)) or 1.0
        p = (pressure / largest).astype(np.float32)
        ratio, margin, weights = self.ratio, _REACH * self.ratio, self.weights
        nc = self.far.shape[1]
        lines = np.empty((sources.rows.size, nc), np.float32)
        place = np.full(self.shape[0], -1)
        place[sources.rows] = np.arange(sources.rows.size)
        load, moved = self.coarse

        loops.scatter(p, sources.starts, sources.columns, sources.rows, margin, self.grid)
        blocks(lambda a, b: loops.spread_along_rows(p, sources.starts, sources.columns, weights, a, b, lines), sources.rows.size)
        blocks(lambda a, b: loops.spread_across_rows(lines, place, weights, a, b, load), load.shape[0])
        touched = np.unique(sources.rows // ratio)
        rows = np.unique(touched[:, None] + np.arange(4))
        coarse_sources = GridNodes(None, rows, np.arange(rows.size + 1) * nc, np.tile(np.arange(nc, dtype=np.int32), rows.size))
        self.far.displacement(load[rows].ravel(), coarse_sources, None, "float32", moved)
        lines = np.empty((targets.rows.size, nc), np.float32)
        blocks(lambda a, b: loops.interpolate_rows(moved, targets.rows, weights, a, b, lines), targets.rows.size)
        runs = runs_of(targets)
        result = np.empty(targets.indices.size, np.float32)
        longest = int(runs[:, 3].max(initial=0))
        def work(a, b):
            loops.sum_near_and_far(self.grid, self.taps, self.reach, runs, targets.columns, targets.rows, lines, weights, a, b, np.empty(longest, np.float32), result)
        blocks(work, len(runs))
        loops.scatter(p[:0], sources.starts, sources.columns, sources.rows, margin, self.grid)
        np.multiply(result, largest, out=out)
        return out


def runs_of(nodes):
    runs = nodes.__dict__.get("runs")
    if runs is None:
        runs = np.empty((nodes.indices.size, 4), np.int32)
        count = loops.find_runs(nodes.starts, nodes.columns, _APART, runs)
        runs = runs[:count].copy()
        nodes.__dict__["runs"] = runs
    return runs


def blocks(work, count):
    parts = min(16, count)
    edges = np.linspace(0, count, parts + 1).astype(int)
    fft.share_out(lambda i: work(edges[i], edges[i + 1]), parts)


class Splits:
    """The splits of an operator, made as they are needed."""

    def __init__(self, operator):
        self._operator = operator
        self._made = {}
        smallest = min(operator.shape)
        dx, dy = operator.spacing
        self.possible = [
            m for m in (4, 8)
            if smallest >= 16 * m and all(p % m == 0 for p in operator.periods) and max(dx, dy) < 1.5 * min(dx, dy)
            and not operator.zero_mean
        ]

    def best(self, nodes):
        if not self.possible:
            return None
        cells = int(runs_of(nodes)[:, 3].sum())
        points = self._operator.shape[0] * self._operator.shape[1]
        ratio = self.possible[-1 if cells < 0.025 * points else 0]
        if ratio not in self._made:
            self._made[ratio] = Split.of(self._operator, ratio)
        return self._made[ratio]
