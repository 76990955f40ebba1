"""Displacements of free layers under shear and pressure on cells, by quadrature over their waves.

A wave at the angle phi is displaced along itself, across itself and into the body. On the surface,
at the distance r and the angle theta, each is an integral over wavenumbers with J_0, J_1 or J_2,
here beside the material of the top layer, by panels and Gauss's rule, without tables.
"""

import math

import numpy as np
from scipy import special

import roughline as rl
from halfspace.friction.dense_friction import dense_matrix


def top_of(layers):
    """The half-space of the top layer's material, beside a rigid body."""
    return rl.Homogeneous.of(layers.young[0], layers.poisson[0])


def beside_top(layers, offset, spacing, points=8):
    """Return xx, yy, xy, x, y and zz at an offset from a cell, beside those of the top layer.

    The last three are displacements towards the cell by pressure, and into the body.
    """
    nodes, weights = np.polynomial.legendre.leggauss(points)
    x, y = np.meshgrid(
        *(at + side / 2 * nodes for at, side in zip(offset, spacing, strict=True)), indexing="ij"
    )
    r, theta = np.hypot(x, y).ravel(), np.arctan2(y, x).ravel()
    of_cell = np.outer(weights, weights).ravel() * math.prod(spacing) / 4
    h = layers.thickness[0]
    step = min(2 / h, 12 / r.max())
    edges = np.union1d(np.geomspace(1e-9, 0.5, 40) / h, np.arange(0, 22 / h, step))
    gauss, shares = np.polynomial.legendre.leggauss(16)
    half = np.diff(edges)[:, np.newaxis] / 2
    q = (edges[:-1, np.newaxis] + half * (1 + gauss)).ravel()
    along, across, coupling, into = (
        (here - alone) * q * (half * shares).ravel() / (2 * math.pi)
        for here, alone in zip(waves_of(layers, q), waves_of(top_of(layers), q), strict=True)
    )
    j0, j1, j2 = (special.jv(order, np.outer(r, q)) for order in range(3))
    mean, difference = j0 @ (along + across) / 2, j2 @ (along - across) / 2
    towards = j1 @ coupling
    found = (
        mean - difference * np.cos(2 * theta),
        mean + difference * np.cos(2 * theta),
        -difference * np.sin(2 * theta),
        towards * np.cos(theta),
        towards * np.sin(theta),
        j0 @ into,
    )
    return [float(of_cell @ each) for each in found]


def waves_of(body, q):
    """Return displacements along and across waves, by coupling, and into the body."""
    return *body.shear_spectrum(q), body.coupling_spectrum(q), body.spectrum(q)


def layered_matrix(layers, shape, spacing):
    """Return the displacements (x, y, z) of all cells under shear and pressure (x, y, z)."""
    top, (i, j) = top_of(layers), np.divmod(np.arange(math.prod(shape)), shape[1])
    n = top.poisson / (1 - top.poisson)
    alone = dense_matrix(shape, spacing, n=n, beta=top.beta, periodic=False, E_star=top.E_star)
    kernels = np.array(
        [
            [beside_top(layers, (k * spacing[0], m * spacing[1]), spacing) for m in range(shape[1])]
            for k in range(shape[0])
        ]
    )
    to_x, to_y = np.subtract.outer(i, i), np.subtract.outer(j, j)
    xx, yy, xy, x, y, zz = np.moveaxis(kernels[abs(to_x), abs(to_y)], -1, 0)
    xy, x, y = xy * np.sign(to_x) * np.sign(to_y), x * np.sign(to_x), y * np.sign(to_y)
    return alone + np.block([[xx, xy, -x], [xy, yy, -y], [x, y, zz]])
