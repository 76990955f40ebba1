"""Search for the self-affine laws that explain a spectrum about as well as the best one."""

from __future__ import annotations

from functools import lru_cache
from typing import Protocol

import numpy as np

from roughline.computing import linear_algebra
from roughline.computing.arrays import Indices, Mask, Real
from roughline.spectra.response import Responses
from roughline.spectra.self_affine_laws import (
    CORNERS,
    HURSTS,
    IMPOSSIBLE,
    NODES,
    Corner,
    Explanation,
    Laws,
)

_MARGIN = 15.0  # of deviances in which a law may still turn out to be likely
FEW_NODES = slice(None, None, 3)
"""Exponents of a first search."""

_FEW_ROLLS = 4  # from roll-off to roll-off in the first search


class Compared(Protocol):
    """A spectrum with which laws are compared."""

    @property
    def rolls(self) -> Real:
        """Roll-offs to try."""

    @property
    def ends(self) -> Real:
        """Where laws may end."""

    @property
    def margins(self) -> Real:
        """Distance to the next end."""

    @property
    def responses(self) -> Responses:
        """What the instrument may do."""

    @property
    def few_ends(self) -> Indices:
        """Ends with which the first search is made; the last one is none."""

    def more_ends(self, found: Indices, most: float) -> Indices:
        """Ends near those that were found or with deviances below a bound, and the last one."""

    def deviances(
        self, corner: Corner, roll: float, nodes: slice, responses: Indices, ends: Indices
    ) -> tuple[Real, Real]:
        """Deviances and log levels of laws, over (response, node, end)."""


def laws_of(spectrum: Compared) -> Laws:
    """Compare a spectrum with every law, and keep those that are not far from it."""
    with linear_algebra.on_one_thread():  # threads gain nothing on small matrices
        kept, ends = _first_search(spectrum)
        return _second_search(spectrum, kept, ends)


def _first_search(spectrum: Compared) -> tuple[Mask, Indices]:
    """Find which corners, coarse roll-offs and responses are not far, and near which ends."""
    rolls = spectrum.rolls[::_FEW_ROLLS]
    few, every = spectrum.few_ends, np.arange(spectrum.responses.blurs.size)
    least = np.empty((len(CORNERS), rolls.size, every.size, few.size))
    for i, corner in enumerate(CORNERS):
        for j, roll in enumerate(rolls):
            deviance, _ = spectrum.deviances(corner, float(roll), FEW_NODES, every, few)
            least[i, j] = least_of_few(deviance)
    most = float(least.min()) + _MARGIN
    near: Mask = np.asarray(least <= most)
    found = few[near.any(axis=(0, 1, 2))]
    return np.asarray(near.any(axis=3)), spectrum.more_ends(found, most)


def _second_search(spectrum: Compared, kept: Mask, ends: Indices) -> Laws:
    """Compare the spectrum with all laws between those that were found."""
    shape = (HURSTS.size, spectrum.rolls.size, ends.size)
    deviance, log_level = np.full(shape, np.inf), np.zeros(shape)
    explained = np.zeros(shape, dtype=np.intp)
    explanations: list[Explanation] = []
    of_responses = np.full(kept.shape[-1], np.inf)
    finer = _between(NODES.tobytes(), HURSTS.tobytes())
    for j, roll in enumerate(spectrum.rolls):
        around = slice(j // _FEW_ROLLS, -(-j // _FEW_ROLLS) + 1)
        for i, corner in enumerate(CORNERS):
            which = np.flatnonzero(kept[i, around].any(axis=0))
            if which.size == 0:
                continue
            found = spectrum.deviances(corner, float(roll), slice(None), which, ends)
            values = finer @ found[0]
            first = len(explanations)
            explanations += [Explanation(corner, int(each)) for each in which]
            of_responses[which] = np.minimum(of_responses[which], values.min(axis=(1, 2)))
            best = values.argmin(axis=0)
            least = np.take_along_axis(values, best[np.newaxis], axis=0)[0]
            levels = np.take_along_axis(finer @ found[1], best[np.newaxis], axis=0)[0]
            better = least < deviance[:, j]
            deviance[:, j][better] = least[better]
            log_level[:, j][better] = levels[better]
            explained[:, j][better] = first + best[better]
    deviance[deviance > IMPOSSIBLE / 2] = np.inf
    return Laws(
        HURSTS,
        spectrum.rolls,
        spectrum.ends[ends],
        spectrum.margins[ends],
        deviance,
        log_level,
        explained,
        explanations,
        of_responses,
    )


def least_of_few(deviance: Real) -> Real:
    """Least deviances over all exponents, from those at few of them, over (..., few, ends)."""
    finer = _between(NODES[FEW_NODES].tobytes(), NODES.tobytes())
    return np.asarray((finer @ deviance).min(axis=-2))


@lru_cache(maxsize=4)
def _between(given: bytes, wanted: bytes) -> Real:
    """Matrix that interpolates values at some exponents to others, by cubic splines."""
    nodes, values = np.frombuffer(given), np.frombuffer(wanted)

    def basis(x: Real) -> Real:
        knots = nodes[2:-2]  # all but those next to the ends
        cubes = np.maximum(x[:, np.newaxis] - knots, 0.0) ** 3
        return np.hstack([x[:, np.newaxis] ** np.arange(4), cubes])

    return np.asarray(np.linalg.solve(basis(nodes).T, basis(values).T).T)
