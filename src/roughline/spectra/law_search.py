"""A measured spectrum compared with self-affine laws: which of them explain it about as well."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar

import numpy as np

from roughline.computing import linear_algebra
from roughline.computing.arrays import Indices, Mask, Real
from roughline.spectra.response import Instrument, Responses
from roughline.spectra.self_affine_laws import (
    CORNERS,
    HURSTS,
    IMPOSSIBLE,
    NODES,
    Corner,
    Law,
    Laws,
    Means,
)

_MARGIN = 15.0  # of deviances in which a law may still turn out to be likely
_FEW_NODES = slice(None, None, 3)  # exponents of a first search
_FEW_ROLLS = 4  # from roll-off to roll-off in the first search
_FEW_ENDS = 6  # that are tried in the first search
_FEW_BLURS = 2  # from blur to blur with which all ends are tried; a blurred law may end too


@dataclass(frozen=True, eq=False)
class Ends:
    """Ends of laws, and the means that each leaves unchanged, changes, or ignores."""

    at: Real  # wavenumbers; the last is infinite, and no end
    margins: Real  # distance to the next end
    inside: Mask  # means that hold the law's power, over (end, mean)
    log_share: Real  # logarithm of the share of it that they have
    beyond: Real  # deviance of the means beyond, where the spectrum is free


@dataclass(frozen=True, eq=False)
class Observed(ABC):
    """Mean powers of a spectrum, and how laws of its surface appear in them.

    Wavenumbers are in units of q_low = 2 pi / L.
    """

    means: Means
    nyquist: float
    instrument: Instrument
    dimensions: ClassVar[int]

    @property
    @abstractmethod
    def modes(self) -> Real:
        """Number of modes that each mean stands for."""

    @property
    @abstractmethod
    def rolls(self) -> Real:
        """Roll-offs to try."""

    @property
    @abstractmethod
    def ends(self) -> Ends:
        """Ends to try."""

    @abstractmethod
    def expected(self, hursts: Real, roll: float, corner: Corner, ends: Real) -> tuple[Real, Real]:
        """Logarithm of the expected powers for a plateau of one, over (hurst, mean, end).

        The last axis is 1 where an end changes nothing before it. And that of the law at Nyquist's
        wavenumber, over hursts, for the last of the ends.
        """

    @abstractmethod
    def mean_square(self, law: Law) -> tuple[float, float]:
        """Mean squares of a surface as large as the piece, and of the piece, for a plateau of one.

        That of the piece lacks the mean plane and what its instrument does not see, and has what
        longer waves and folded ones add.
        """

    @cached_property
    def responses(self) -> Responses:
        """What the instrument may do, at the means and at all exponents that are computed."""
        return Responses.of(self.instrument, self.means.q / self.nyquist, NODES, self.dimensions)

    @cached_property
    def _weights(self) -> tuple[Real, Real]:
        """Weights of the means for each response, and what they add to the deviance."""
        return self.means.weighed(self.responses.unknown)

    @cached_property
    def laws(self) -> Laws:
        """Laws that are not far from the spectrum."""
        with linear_algebra.on_one_thread():  # threads gain nothing on small matrices
            kept, ends = self._first_search()
            return self._second_search(kept, ends)

    def log_powers(self, law: Law, *, seen: bool = True) -> Real:
        """Logarithm of the expected power in each mean for a plateau of one; -inf beyond its end.

        As the instrument sees it, or that of the surface.
        """
        hurst, roll, end, corner, response = law
        values, last = self.expected(np.array([hurst]), roll, corner, np.array([end]))
        power = values[0, :, 0]
        if seen:
            node = int(np.abs(NODES - hurst).argmin())
            nodes = slice(node, node + 1)
            power = self.responses.seen(response, nodes, values[:, :, 0], last)[0]
        return np.where(self.means.q <= end, power, -math.inf)

    def deviances(
        self, corner: Corner, roll: float, nodes: slice, responses: Indices, ends: Indices
    ) -> tuple[Real, Real]:
        """Deviances and log levels of laws, over (response, node, end); the last end is none."""
        means, at = self.means, self.ends.at[ends]
        weight, added = (each[responses] for each in self._weights)
        inside, log_share = self.ends.inside[ends].T, self.ends.log_share[ends].T
        law, last = self.expected(NODES[nodes], roll, corner, at)
        shares = self.responses.log_share[responses]
        total = (weight @ inside)[:, np.newaxis]
        scaled = weight * means.power * np.exp(-shares)
        kept = np.exp(-law) * (inside * np.exp(-log_share))
        log_level = np.log(np.tensordot(scaled, kept, (1, 1)) / total)
        logs = np.tensordot(weight, (law + log_share) * inside, (1, 1))
        logs += ((weight * (shares - np.log(means.power))) @ inside)[:, np.newaxis]
        deviance = 2 * (logs + total * log_level) + self.ends.beyond[ends]
        deviance += (added @ inside)[:, np.newaxis]
        two_ends = np.outer(self.responses.is_second_end[responses], np.isfinite(at))
        deviance += math.log(means.weight.sum() + 1) * two_ends[:, np.newaxis]
        folds = np.flatnonzero(self.responses.reaches[responses] > 1)
        if folds.size:  # of laws without an end alone
            deviance[folds] = IMPOSSIBLE
            seen = self.responses.seen(responses[folds], nodes, law[:, :, -1], last)
            found = means.endless(seen, weight[folds], added[folds])
            deviance[folds, :, -1], log_level[folds, :, -1] = found
        return deviance, log_level

    def _first_search(self) -> tuple[Mask, Indices]:
        """Find which corners, coarse roll-offs and responses are not far, and with which ends."""
        rolls = self.rolls[::_FEW_ROLLS]
        none, every = self.ends.at.size - 1, np.arange(self.responses.blurs.size)
        blurs = np.flatnonzero(self.responses.reaches == 1)[::_FEW_BLURS]

        def least(corner: Corner, responses: Indices, ends: Indices) -> Real:
            """Least deviances of few laws, over (roll-off, response, end)."""
            tried = [
                self.deviances(corner, float(roll), _FEW_NODES, responses, ends)[0]
                for roll in rolls
            ]
            finer = _between(NODES[_FEW_NODES].tobytes(), NODES.tobytes())
            return np.array([(finer @ each).min(axis=1) for each in tried])

        of_ends = least("sharp", blurs, np.arange(none + 1)).min(axis=(0, 1))
        few = np.append(np.argsort(of_ends[:-1], kind="stable")[:_FEW_ENDS], none)
        found = np.array([least(corner, every, few).min(axis=2) for corner in CORNERS])
        most = float(found.min()) + _MARGIN
        return found <= most, np.append(np.flatnonzero(of_ends[:-1] <= most), none)

    def _second_search(self, kept: Mask, ends: Indices) -> Laws:
        """Compare the spectrum with all laws between those that were found."""
        shape = (HURSTS.size, self.rolls.size, ends.size)
        deviance, log_level = np.full(shape, np.inf), np.zeros(shape)
        explained = np.zeros(shape, dtype=np.intp)
        explanations: list[tuple[Corner, int]] = []
        of_responses = np.full(kept.shape[-1], np.inf)
        finer = _between(NODES.tobytes(), HURSTS.tobytes())
        for j, roll in enumerate(self.rolls):
            around = slice(j // _FEW_ROLLS, -(-j // _FEW_ROLLS) + 1)
            for i, corner in enumerate(CORNERS):
                which = np.flatnonzero(kept[i, around].any(axis=0))
                if which.size == 0:
                    continue
                found = self.deviances(corner, float(roll), slice(None), which, ends)
                values = finer @ found[0]
                first = len(explanations)
                explanations += [(corner, int(each)) for each in which]
                of_responses[which] = np.minimum(of_responses[which], values.min(axis=(1, 2)))
                best = values.argmin(axis=0)
                least = np.take_along_axis(values, best[np.newaxis], axis=0)[0]
                levels = np.take_along_axis(finer @ found[1], best[np.newaxis], axis=0)[0]
                better = least < deviance[:, j]
                deviance[:, j][better] = least[better]
                log_level[:, j][better] = levels[better]
                explained[:, j][better] = first + best[better]
        deviance[deviance > IMPOSSIBLE / 2] = np.inf
        at, margins = self.ends.at[ends], self.ends.margins[ends]
        return Laws(
            self.rolls, at, margins, deviance, log_level, explained, explanations, of_responses
        )


@lru_cache(maxsize=4)
def _between(given: bytes, wanted: bytes) -> Real:
    """Matrix that interpolates values at some exponents to others, by cubic splines."""
    nodes, values = np.frombuffer(given), np.frombuffer(wanted)

    def basis(x: Real) -> Real:
        knots = nodes[2:-2]  # all but those next to the ends
        cubes = np.maximum(x[:, np.newaxis] - knots, 0.0) ** 3
        return np.hstack([x[:, np.newaxis] ** np.arange(4), cubes])

    return np.asarray(np.linalg.solve(basis(nodes).T, basis(values).T).T)
