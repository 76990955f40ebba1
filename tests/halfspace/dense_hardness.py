"""Contact with a hardness on small grids, solved with dense matrices and principal pivots.

Under each load 0 <= p <= H minimises 1/2 p K p - p (d - separation). The conditions are a linear
complementarity problem with bounds, which block principal pivoting solves exactly [1]_: sets are
exchanged whole while that helps, else node by node from the last, which always ends. It shares
nothing with ours but the kernel, which has judges of its own.

References
----------
.. [1] J. J. Júdice and F. M. Pires, "A block principal pivoting algorithm for large-scale strictly
   monotone linear complementarity problems", Computers Ops Res. 21, 587-596 (1994).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.halfspace.elasticity.kernel import love

_ROUNDING = 1e-12  # of what is compared with zero, over the largest of its kind
_AT_HARDNESS = 1e-9  # a node so near, over H, bears H: after reloading it does to rounding
_PATIENCE = 10  # exchanges of whole sets that may not help


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

    def matrix(self) -> np.ndarray:
        """Displacements under unit pressures on single nodes."""
        shape = self.heights.shape
        index = [each.ravel() for each in np.indices(shape)]
        dx, dy = (size / n for size, n in zip(self.sizes, shape, strict=True))
        if not self.periodic:
            x, y = index[0] * dx, index[1] * dy
            return love(x[:, None] - x, y[:, None] - y, dx, dy) / self.E_star
        q = [2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(shape, (dx, dy), strict=True)]
        magnitude = np.hypot(q[0][:, None], q[1])
        magnitude[0, 0] = np.inf
        response = np.fft.ifft2(2 / (self.E_star * magnitude)).real
        i, j = ((each[:, None] - each) % n for each, n in zip(index, shape, strict=True))
        return response[i, j]


@dataclass(frozen=True)
class State:
    """What one load leaves; fields are flat."""

    depth: float
    force: float
    pressure: np.ndarray
    displacement: np.ndarray
    contact: np.ndarray
    plastic: np.ndarray
    indentation: np.ndarray
    stiffness: float
    unloading_stiffness: float
    work: float
    dissipated_work: float


class History:
    """Loads one after another; each starts from the surface that the last one left.

    Of a periodic body K says nothing of even pressure. Here it displaces all nodes alike, which
    leaves the contact under a force as it is and is taken off the depth in the end.
    """

    def __init__(self, body: Body, hardness: float):
        self.body, self.hardness = body, hardness
        self.K = body.matrix()
        self.separation = (body.heights.max() - body.heights).ravel()
        self.indentation = np.zeros(self.separation.size)
        self._even = float(self.K.max()) if body.periodic else 0.0
        self._definite = self.K + self._even
        self._bounded = np.zeros(self.separation.size, int)  # 0: p = 0, 1: in between, 2: p = H

    def press(self, force: float) -> State:
        """Solve the contact under a force, and keep its indentations."""
        before = self.separation + self.indentation
        level = self._level(force)
        pressure = self._pressures(level) if force > 0 else np.zeros(before.size)
        displacement = self.K @ pressure
        depth = level - self._even * float(pressure.sum())
        plastic = pressure >= (1 - _AT_HARDNESS) * self.hardness
        overlap = np.maximum(depth - displacement - before, 0.0)
        self.indentation = self.indentation + np.where(plastic, overlap, 0.0)
        contact = pressure > 0
        cell = self.body.cell
        dissipated = cell * self.hardness * float(self.indentation.sum())
        return State(
            depth=depth,
            force=cell * float(pressure.sum()),
            pressure=pressure,
            displacement=displacement,
            contact=contact,
            plastic=plastic,
            indentation=self.indentation,
            stiffness=self._without_even(self._stiffness(contact & ~plastic)),
            unloading_stiffness=self._without_even(self._stiffness(contact)),
            work=dissipated + cell * float(pressure @ displacement) / 2,
            dissipated_work=dissipated,
        )

    def _level(self, force: float) -> float:
        """Find the depth by Newton's method, which is exact on the last linear piece."""
        low = float((self.separation + self.indentation).min())
        if force == 0:
            return low
        high = depth = low + force / (self.body.E_star * np.sqrt(self.body.cell))
        while self._force(high) < force:
            high = low + 2 * (high - low)
        for _ in range(200):
            missing = force - self._force(depth)
            if abs(missing) <= 1e-13 * force or high - low <= 4 * np.spacing(high):
                return depth
            low, high = (depth, high) if missing > 0 else (low, depth)
            stiffness = self._stiffness(self._bounded == 1)
            depth = depth + missing / stiffness if stiffness > 0 else low
            if not low < depth < high:
                depth = (low + high) / 2
        raise AssertionError("the oracle finds no depth")

    def _force(self, level: float) -> float:
        return self.body.cell * float(self._pressures(level).sum())

    def _stiffness(self, nodes: np.ndarray) -> float:
        """Force on a rigid punch that touches in these nodes, per depth."""
        block = self._definite[np.ix_(nodes, nodes)]
        return self.body.cell * float(np.linalg.solve(block, np.ones(len(block))).sum())

    def _without_even(self, stiffness: float) -> float:
        """Take off what even pressure displaces; infinite where the whole body moves as one."""
        if stiffness == 0:
            return 0.0
        compliance = 1 / stiffness - self._even / self.body.cell
        return 1 / compliance if compliance > _ROUNDING / stiffness else np.inf

    def _pressures(self, level: float) -> np.ndarray:
        """Solve 0 <= p <= H by principal pivots, from the sets of the last call."""
        aim = level - self.separation - self.indentation
        bounded = self._bounded
        rounding = _ROUNDING * np.abs(aim).max(), _ROUNDING * self.hardness
        fewest, patience = aim.size + 1, _PATIENCE
        while True:
            pressure = np.where(bounded == 2, self.hardness, 0.0)
            free = bounded == 1
            missing = aim[free] - self._definite[free] @ pressure
            pressure[free] = np.linalg.solve(self._definite[np.ix_(free, free)], missing)
            gap = self._definite @ pressure - aim
            to_free = (bounded == 0) & (gap < -rounding[0]) | (bounded == 2) & (gap > rounding[0])
            to_zero = free & (pressure < -rounding[1])
            to_hardness = free & (pressure > self.hardness + rounding[1])
            wrong = to_free | to_zero | to_hardness
            count = int(np.count_nonzero(wrong))
            if count == 0:
                self._bounded = bounded
                return np.clip(pressure, 0.0, self.hardness)
            fewest, patience = (count, _PATIENCE) if count < fewest else (fewest, patience - 1)
            if patience < 0:  # one by one, from the last: this cannot go round in circles
                wrong[: np.flatnonzero(wrong)[-1]] = False
            bounded = bounded.copy()
            bounded[wrong & to_free] = 1
            bounded[wrong & to_zero] = 0
            bounded[wrong & to_hardness] = 2
