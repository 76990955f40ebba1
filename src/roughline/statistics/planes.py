"""Force and stiffness of an ensemble at fixed places of the rigid plane, not at fixed force."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real


def at_levels(
    force_bar: ArrayLike, depth: ArrayLike, stiffness: ArrayLike, highest: ArrayLike, levels: int
) -> tuple[Real, Real]:
    """Force and stiffness of every realisation, shape (realisations, levels), at common levels.

    The level is the height of the rigid plane above the mean of the heights, from the highest to
    the lowest that all realisations reach. Forces rise; depths since touch and stiffness are over
    (realisation, load). Depths and the height of each highest point above the mean are over h.

    A realisation whose highest point lies below the plane carries no force. Between touch and its
    smallest load it follows the power laws of the depth that its first two loads determine. An
    ensemble that is averaged at fixed level shows other exponents than at fixed force, because its
    highest realisations dominate.
    """
    depths = np.asarray(depth, dtype=np.float64)
    highest_points = np.asarray(highest, dtype=np.float64)[:, np.newaxis]
    planes = highest_points - depths
    common = np.linspace(planes[:, 0].max(), planes[:, -1].max(), levels)
    return _at(highest_points - common, force_bar, depths, stiffness)


def at_depths(
    force_bar: ArrayLike, depth: ArrayLike, stiffness: ArrayLike, depths: int
) -> tuple[Real, Real]:
    """Force and stiffness of every realisation at common depths since its first touch.

    They rise with even logarithms from the smallest that a realisation has to the largest that all
    have; the rest is as for :func:`at_levels`.
    """
    known = np.asarray(depth, dtype=np.float64)
    common = np.geomspace(known[:, 0].min(), known[:, -1].min(), depths)
    wanted = np.broadcast_to(common, (len(known), depths))
    return _at(wanted, force_bar, known, stiffness)


def _at(wanted: Real, force_bar: ArrayLike, depth: Real, stiffness: ArrayLike) -> tuple[Real, Real]:
    """Force and stiffness at depths since touch, shape (realisations, places); zero above touch."""
    log_force = np.log(np.asarray(force_bar, dtype=np.float64))
    log_stiffness = np.log(np.asarray(stiffness, dtype=np.float64))
    found = np.zeros((2, *wanted.shape))
    for i, log_depth in enumerate(np.log(depth)):
        touches = wanted[i] > 0
        x = np.log(wanted[i, touches])
        for values, log_values in zip(found, (log_force, log_stiffness[i]), strict=True):
            slope = (log_values[1] - log_values[0]) / (log_depth[1] - log_depth[0])
            below = np.minimum(x - log_depth[0], 0.0) * slope
            values[i, touches] = np.exp(np.interp(x, log_depth, log_values) + below)
    return found[0], found[1]
