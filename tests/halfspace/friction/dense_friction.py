"""Contact with friction on all cells at once: a dense matrix, solved node by node.

It knows no sets of nodes, no transforms and no tangents. Each node in turn takes the pressure and
the shear that its own conditions ask for, until nothing changes [1]_.

References
----------
.. [1] M. Jean, "The non-smooth contact dynamics method", Comput. Methods Appl. Mech. Eng. 177,
   235-257 (1999).
"""

from dataclasses import dataclass

import numpy as np
from numba import njit


def dense_matrix(shape, spacing, *, n, beta, periodic, E_star=1.0):
    """Return the displacements (x, y, z) of all cells under shear and pressure (x, y, z)."""
    count = shape[0] * shape[1]
    kernels = (_waves if periodic else _rectangles)(shape, spacing)
    one, xx, xy, yy, x, y = (each / E_star for each in kernels)
    matrix = np.block(
        [
            [one + n * xx, n * xy, -beta * x],
            [n * xy, one + n * yy, -beta * y],
            [beta * x, beta * y, one],
        ]
    )
    assert matrix.shape == (3 * count, 3 * count)
    return matrix


def _rectangles(shape, spacing):
    """Return 1/r, x²/r³, xy/r³, y²/r³, x/r² and y/r² over pi, integrated over cells."""
    i, j = np.divmod(np.arange(shape[0] * shape[1]), shape[1])
    x, y = (np.subtract.outer(k, k) * side for k, side in zip((i, j), spacing, strict=True))

    def asinh(a, b):
        return a * np.arcsinh(b / np.abs(a))

    corners = (
        lambda x, y: asinh(x, y) + asinh(y, x),
        lambda x, y: asinh(y, x),
        lambda x, y: -np.hypot(x, y),
        lambda x, y: asinh(x, y),
        lambda x, y: y * np.log(np.hypot(x, y)) + x * np.arctan(y / x),
        lambda x, y: x * np.log(np.hypot(x, y)) + y * np.arctan(x / y),
    )
    right, left = x + spacing[0] / 2, x - spacing[0] / 2
    top, bottom = y + spacing[1] / 2, y - spacing[1] / 2
    return [
        (f(right, top) - f(left, top) - f(right, bottom) + f(left, bottom)) / np.pi for f in corners
    ]


def _waves(shape, spacing):
    """Return the same of cells that repeat, each as the transform of its symbol."""
    qx, qy = (2 * np.pi * np.fft.fftfreq(n, side) for n, side in zip(shape, spacing, strict=True))
    qx = qx[:, np.newaxis]
    q = np.hypot(qx, qy)
    q[0, 0] = 1.0
    even, own_x, own_y = 2 / q, np.zeros(shape, bool), np.zeros(shape, bool)
    even[0, 0] = 0.0
    if shape[0] % 2 == 0:
        own_x[shape[0] // 2] = True
    if shape[1] % 2 == 0:
        own_y[:, shape[1] // 2] = True
    c, s = qx / q, qy / q
    symbols = (
        even,
        even * s**2,  # of x²/r³: shear along a wave displaces by 2/q, and across it by more
        np.where(own_x | own_y, 0.0, -even * c * s),
        even * c**2,
        np.where(own_x | own_y, 0.0, -1j * even * c),
        np.where(own_x | own_y, 0.0, -1j * even * s),
    )
    i, j = np.divmod(np.arange(shape[0] * shape[1]), shape[1])
    di, dj = np.subtract.outer(i, i) % shape[0], np.subtract.outer(j, j) % shape[1]
    return [np.fft.ifft2(symbol).real[di, dj] for symbol in symbols]


@dataclass
class DenseState:
    """Tractions and place of the indenter."""

    traction: np.ndarray  # (3, cells): x, y, pressure
    slide: np.ndarray
    depth: float
    gap: np.ndarray


class DensePath:
    """States along a path of depths and slides, each from the one before."""

    def __init__(self, matrix, separation, coefficient, strength=np.inf, hardness=np.inf):
        count = separation.size
        self.matrix, self.separation = matrix, separation.ravel()
        self.coefficient = np.broadcast_to(np.ravel(coefficient), count).copy()
        self.strength = np.broadcast_to(np.ravel(strength), count).copy()
        self.hardness, touch = hardness, self.separation.min()
        self.state = DenseState(np.zeros((3, count)), np.zeros(2), touch, self.separation - touch)

    def to(self, depth, slide, sweeps=20000):
        """Go to the next depth and slide."""
        before, slide = self.state, np.asarray(slide, float)
        moved = (self.matrix @ before.traction.ravel()).reshape(3, -1)
        target = np.array(
            [
                slide[0] - before.slide[0] + moved[0],
                slide[1] - before.slide[1] + moved[1],
                depth - self.separation,
            ]
        )
        traction = before.traction.copy()
        bounds = self.coefficient, self.strength, self.hardness
        _sweep(self.matrix, target, np.maximum(before.gap, 0.0), *bounds, traction, sweeps)
        there = (self.matrix @ traction.ravel()).reshape(3, -1)
        gap = np.where(traction[2] > 0, 0.0, there[2] - target[2])
        yields = traction[2] >= self.hardness
        self.separation = self.separation + np.where(yields, target[2] - there[2], 0.0)
        self.state = DenseState(traction, slide, depth, gap)
        return self.state


@njit(cache=True)
def _sweep(matrix, target, gap, coefficient, strength, hardness, traction, sweeps):
    count = target.shape[1]
    flat = traction.reshape(-1)
    for _ in range(sweeps):
        changed = 0.0
        for i in range(count):
            for axis in (2, 0):
                if axis == 2:
                    row = matrix[2 * count + i]
                    off = target[2, i] - row @ flat
                    new = min(max(0.0, traction[2, i] + off / row[2 * count + i]), hardness)
                    changed = max(changed, abs(new - traction[2, i]))
                    traction[2, i] = new
                else:
                    along, across = matrix[i], matrix[count + i]
                    stiff = max(along[i], across[count + i])
                    x, y = traction[0, i], traction[1, i]
                    off_x, off_y = target[0, i] - along @ flat, target[1, i] - across @ flat
                    if gap[i] > 0.0 and traction[2, i] > 0.0:  # what it moved before it joined
                        own = (along[i] + across[count + i]) / 2
                        row = matrix[2 * count + i]
                        dent = max(0.0, target[2, i] - row @ flat) * (traction[2, i] >= hardness)
                        spring = own * gap[i] / (row[2 * count + i] * traction[2, i] + dent)
                        off_x, off_y = off_x - spring * x, off_y - spring * y
                        stiff += spring
                    x, y = x + off_x / stiff, y + off_y / stiff
                    most = min(coefficient[i] * traction[2, i], strength[i])
                    if traction[2, i] == 0.0:
                        most = 0.0
                    size = np.sqrt(x * x + y * y)
                    if size > most:
                        x, y = x * most / size, y * most / size
                    changed = max(changed, abs(x - traction[0, i]), abs(y - traction[1, i]))
                    traction[0, i], traction[1, i] = x, y
        if changed < 1e-14 * np.abs(flat).max():
            break
