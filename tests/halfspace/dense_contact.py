"""Small contacts between bounds of pressure, solved with dense matrices and principal pivots.

Under each load low <= p <= high minimises 1/2 p K p - p (d - separation). The conditions are a
linear complementarity problem with bounds, which block principal pivoting solves exactly [1]_: sets
are exchanged whole while that helps, else node by node from the last, which always ends. It shares
nothing with ours but the kernel, which has judges of its own.

References
----------
.. [1] J. J. Júdice and F. M. Pires, "A block principal pivoting algorithm for large-scale strictly
   monotone linear complementarity problems", Computers Ops Res. 21, 587-596 (1994).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.elasticity.kernel import love

_ROUNDING = 1e-12  # of what is compared with zero, over the largest of its kind
_PATIENCE = 10  # exchanges of whole sets that may not help
LOW, BETWEEN, HIGH = 0, 1, 2  # where a pressure is between its bounds


def love_matrix(shape: tuple[int, int], spacing: tuple[float, float]) -> np.ndarray:
    """Displacements of all cells of a grid under unit pressures on single ones, for E* = 1."""
    x, y = (each.ravel() for each in np.indices(shape))
    table = love(np.arange(shape[0]), np.arange(shape[1]), *spacing)
    return table[abs(x[:, None] - x), abs(y[:, None] - y)]


@dataclass(frozen=True)
class Body:
    """Heights on a grid over a half-space."""

    heights: np.ndarray
    sizes: tuple[float, float]
    E_star: float
    periodic: bool

    @property
    def cell(self) -> float:
        """Area of a cell."""
        return self.sizes[0] * self.sizes[1] / self.heights.size

    @property
    def separation(self) -> np.ndarray:
        """Distance from the other body at first touch, flat."""
        return (self.heights.max() - self.heights).ravel()

    def matrix(self) -> np.ndarray:
        """Displacements under unit pressures on single nodes."""
        shape = self.heights.shape
        index = [each.ravel() for each in np.indices(shape)]
        dx, dy = (size / n for size, n in zip(self.sizes, shape, strict=True))
        if not self.periodic:
            return love_matrix(shape, (dx, dy)) / self.E_star
        q = [2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(shape, (dx, dy), strict=True)]
        magnitude = np.hypot(q[0][:, None], q[1])
        magnitude[0, 0] = np.inf
        response = np.fft.ifft2(2 / (self.E_star * magnitude)).real
        i, j = ((each[:, None] - each) % n for each, n in zip(index, shape, strict=True))
        return response[i, j]


@dataclass(frozen=True)
class BodyOn(Body):
    """Heights over any half-space, by its kernel or by its waves."""

    half_space: rl.HalfSpace | None = None

    @classmethod
    def of(cls, surface: rl.Surface, half_space: rl.HalfSpace) -> BodyOn:
        """Put a surface over a half-space."""
        given = surface.heights, surface.sizes, half_space.E_star, half_space.periodic
        return cls(*given, half_space)

    def matrix(self) -> np.ndarray:
        """Displacements under unit pressures on single nodes."""
        shape = self.heights.shape
        spacing = tuple(size / n for size, n in zip(self.sizes, shape, strict=True))
        i, j = (each.ravel()[:, np.newaxis] - each.ravel() for each in np.indices(shape))
        if self.periodic:
            return np.fft.ifft2(eigenvalues(self.half_space, shape, spacing)).real[i, j]
        table = np.empty(shape)
        self.half_space.kernel(0, spacing, table)
        return table[abs(i), abs(j)]


def eigenvalues(half_space, shape, spacing) -> np.ndarray:
    """Displacement over pressure of all waves of a periodic grid; zero where it has no bound."""
    q = [2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(shape, spacing, strict=True)]
    with np.errstate(divide="ignore"):
        found = half_space.spectrum(np.hypot(q[0][:, np.newaxis], q[1]))
    return np.where(np.isfinite(found), found, 0.0)


class DenseContact:
    """One body; each contact starts from the sets of the last.

    Of a periodic body K says nothing of even pressure. Here it displaces all nodes alike, which
    leaves the contact under a force as it is and is taken off the depth in the end. The `level` of
    the other body is the depth with what even pressure displaces.
    """

    def __init__(self, body: Body):
        self.body = body
        self.K = body.matrix()
        self.even = float(self.K.max()) if body.periodic else 0.0
        self._definite = self.K + self.even
        self.where = np.zeros(body.heights.size, int)

    @property
    def between(self) -> np.ndarray:
        """Which nodes are between their bounds, and follow a change of the load."""
        return self.where == BETWEEN

    def under_force(self, separation, force, low, high) -> tuple[float, np.ndarray]:
        """Return depth and pressures under a force that pushes."""

        def lacking(level):
            pressure = self._pressures(level - separation, low, high)
            return force - self.body.cell * float(pressure.sum())

        step = force / (self.body.E_star * np.sqrt(self.body.cell))
        level = self._level(lacking, self._of_followers, float(separation.min()), force, step)
        return self._at_level(level, separation, low, high)

    def at_depth(self, separation, depth, low, high) -> tuple[float, np.ndarray]:
        """Return the depth itself, and the pressures there."""
        if not self.even:
            return self._at_level(depth, separation, low, high)

        def lacking(level):
            pressure = self._pressures(level - separation, low, high)
            return depth - level + self.even * float(pressure.sum())

        def slope():
            return 1 - self.even * self._of_followers() / self.body.cell

        height = float(np.ptp(separation))
        level = self._level(lacking, slope, depth, height, height)
        return self._at_level(level, separation, low, high)

    def stiffness(self, nodes) -> float:
        """Force on a rigid punch that touches in these nodes, per depth.

        It is infinite where the whole of a periodic body moves as one.
        """
        stiffness = self._of_punch(nodes)
        if stiffness == 0:
            return 0.0
        compliance = 1 / stiffness - self.even / self.body.cell
        return 1 / compliance if compliance > _ROUNDING / stiffness else np.inf

    def _at_level(self, level, separation, low, high) -> tuple[float, np.ndarray]:
        pressure = self._pressures(level - separation, low, high)
        return level - self.even * float(pressure.sum()), pressure

    def _level(self, lacking, slope, start, scale, step) -> float:
        """Find the level by Newton's method, which is exact on the last linear piece."""
        low = high = start
        while lacking(low) < 0:
            low, step = low - step, 2 * step
        while lacking(high) > 0:
            high, step = high + step, 2 * step
        level = (low + high) / 2
        for _ in range(200):
            missing = lacking(level)
            if abs(missing) <= 1e-13 * scale or high - low <= 4 * np.spacing(abs(high)):
                return level
            low, high = (level, high) if missing > 0 else (low, level)
            steepness = slope()
            level = level + missing / steepness if steepness > 0 else low
            if not low < level < high:
                level = (low + high) / 2
        raise AssertionError("the oracle finds no depth")

    def _of_followers(self) -> float:
        return self._of_punch(self.between)

    def _of_punch(self, nodes) -> float:
        block = self._definite[np.ix_(nodes, nodes)]
        return self.body.cell * float(np.linalg.solve(block, np.ones(len(block))).sum())

    def _pressures(self, aim, low, high) -> np.ndarray:
        """Solve low <= p <= high by principal pivots, from the sets of the last call."""
        low, high = (np.broadcast_to(np.asarray(each, float), aim.shape) for each in (low, high))
        where = np.where((self.where == HIGH) & np.isinf(high), BETWEEN, self.where)
        rounding = _ROUNDING * np.abs(aim).max()
        fewest, patience = aim.size + 1, _PATIENCE
        while True:
            pressure = np.select([where == LOW, where == HIGH], [low, high], 0.0)
            free = where == BETWEEN
            missing = aim[free] - self._definite[free] @ pressure
            pressure[free] = np.linalg.solve(self._definite[np.ix_(free, free)], missing)
            gap = self._definite @ pressure - aim
            within = np.clip(pressure, low, high)
            slack = _ROUNDING * np.abs(within).max()
            to_free = (where == LOW) & (gap < -rounding) | (where == HIGH) & (gap > rounding)
            to_low = free & (pressure < low - slack)
            to_high = free & (pressure > high + slack)
            wrong = to_free | to_low | to_high
            count = int(np.count_nonzero(wrong))
            if count == 0:
                self.where = where
                return within
            fewest, patience = (count, _PATIENCE) if count < fewest else (fewest, patience - 1)
            if patience < 0:  # one by one, from the last: this cannot go round in circles
                wrong[: np.flatnonzero(wrong)[-1]] = False
            where = where.copy()
            where[wrong & to_free] = BETWEEN
            where[wrong & to_low] = LOW
            where[wrong & to_high] = HIGH


def assert_contacts_are_dense(curve, dense, depths):
    """Compare contacts at depths, with their fields, with those of a dense solution."""
    for i, depth in enumerate(depths):
        _, pressure = dense.at_depth(dense.body.separation, depth, 0.0, np.inf)
        found, contact = curve.fields[i], pressure > 0
        assert np.abs(found.pressure.ravel() - pressure).max() <= 1e-6 * pressure.max()
        np.testing.assert_array_equal(found.contact.ravel(), contact)
        assert curve.stiffness[i] == pytest.approx(dense.stiffness(contact), rel=1e-6)


def assert_history_is_dense(curve, history, forces):
    """Compare contacts of bodies that yield, with their fields, with a dense history of forces."""
    for i, each in enumerate(forces):
        state, found = history.press(each), curve.fields[i]
        scale = max(float(state.pressure.max()), 1e-300)
        assert np.abs(found.pressure.ravel() - state.pressure).max() <= 1e-6 * scale
        np.testing.assert_array_equal(found.contact.ravel(), state.contact)
        np.testing.assert_array_equal(found.plastic.ravel(), state.plastic)
        assert curve.depth[i] == pytest.approx(state.depth, rel=1e-6, abs=1e-9)
        for name in ("stiffness", "unloading_stiffness"):
            assert getattr(curve, name)[i] == pytest.approx(getattr(state, name), rel=1e-6)
