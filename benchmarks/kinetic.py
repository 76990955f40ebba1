"""The kinetic equation of a gas between two plates, solved: what judges the flow of a rare gas."""

import math

import numpy as np
from scipy import integrate


def kinetic(path, cells=200):
    """Flow of a gas between flat plates a gap of 1 apart, over that without slip.

    The BGK equation with diffuse reflection, for the velocity over the gap; its kernel is the
    integral of exp(-c² - |x - w| / c) / c, here over each cell (Cercignani and Daneri 1963).
    """
    width = math.sqrt(math.pi) / 2 / path  # gap over the thermal speed and the rate of collisions
    ends = np.arange(2 * cells + 1) * width / cells / 2
    tails = [
        integrate.quad(lambda c, end=end: math.exp(-c * c - end / c) if c else 0.0, 0, 8)[0]
        for end in ends
    ]
    distance = np.abs(np.subtract.outer(np.arange(cells), np.arange(cells)))
    kernel = np.array(
        [2 * (tails[0] - tails[1])] + [tails[2 * k - 1] - tails[2 * k + 1] for k in range(1, cells)]
    )[distance]
    source = np.linalg.solve(np.eye(cells) - kernel / math.sqrt(math.pi), np.ones(cells))
    return 6 / width**2 * float((source - 1).mean())
