"""Self-affine laws compared with a measured spectrum: which of them explain it about as well.

Wavenumbers are in units of q_low = 2 pi / L here, and powers are those of modes, as in `means`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from functools import cached_property, lru_cache
from typing import ClassVar, Literal, NamedTuple

import numpy as np

from roughline.computing import linear_algebra
from roughline.computing.arrays import Indices, Mask, Real
from roughline.measurement.means import Means
from roughline.measurement.response import Responses
from roughline.topography.provenance import Instrument

Corner = Literal["sharp", "smooth"]
"""Of a law at its roll-off: a plateau up to it, or 1 + (q / q_roll)² to a power."""

IMPOSSIBLE = 1e30  # deviance of laws that cannot be

_CORNERS: tuple[Corner, ...] = ("sharp", "smooth")  # both are tried
_HURSTS = np.linspace(-0.49, 1.5, 200)  # exponents that are tried
_NODES = np.linspace(_HURSTS[0], _HURSTS[-1], 25)
"""Exponents with which deviances are computed; they are smooth in between."""

_DEVIANCE_MARGIN = 15.0  # of deviances in which a law may still turn out to be likely
_FEW_NODES = slice(None, None, 3)  # exponents of a first search
_FEW_ROLLS = 4  # from roll-off to roll-off in the first search
_FEW_ENDS = 6  # that are tried in the first search
_FEW_BLURS = 2  # from blur to blur with which all ends are tried; a blurred law may end too


def power_law(q: Real, hursts: Real, roll: float, corner: Corner = "sharp") -> Real:
    """Logarithm of C_2d with a plateau of one, over (hurst, q)."""
    if corner == "smooth":
        return np.outer(-(hursts + 1), np.log1p((q / roll) ** 2))
    return np.outer(-2 * (hursts + 1), np.log(np.maximum(1.0, q / roll)))


class Law(NamedTuple):
    """A law with what explains how it appears in a spectrum."""

    hurst: float
    roll: float
    end: float
    corner: Corner
    response: int  # number of what the instrument does


@dataclass(frozen=True, eq=False)
class _Laws:
    """Deviances of laws from a spectrum, each at its best level, corner and response.

    A deviance is minus twice the logarithm of the likelihood, up to a constant. Arrays are over
    (exponent of :data:`_HURSTS`, roll-off, end).
    """

    rolls: Real  # those up to 1 are beyond the longest waves of the piece
    ends: Real  # infinite if the law goes on beyond the shortest waves
    margins: Real  # distance to the next end that was tried
    deviance: Real  # infinite for laws that are far from the spectrum
    log_level: Real  # logarithm of the power of a mode on the plateau
    explained: Indices  # which explanation is the best
    explanations: Sequence[tuple[Corner, int]]  # corner and response
    of_responses: Real  # least deviance of the laws that each response of the instrument explains

    @cached_property
    def best(self) -> tuple[int, int, int]:
        """Indices of the law that explains most."""
        hurst, roll, end = np.unravel_index(np.argmin(self.deviance), self.deviance.shape)
        return int(hurst), int(roll), int(end)

    def at(self, hurst: int, roll: int, end: int) -> Law:
        """The law of some indices, with its best explanation."""
        corner, response = self.explanations[self.explained[hurst, roll, end]]
        h, q_roll, q_end = map(float, (_HURSTS[hurst], self.rolls[roll], self.ends[end]))
        return Law(h, q_roll, q_end, corner, response)

    def drawn(self, count: int, generator: np.random.Generator) -> tuple[Indices, Indices, Indices]:
        """Draw laws by their likelihood, as indices.

        All exponents are equally likely beforehand, and so are all logarithms of roll-offs.
        """
        likelihood = np.exp((self.deviance.min() - self.deviance) / 2)
        likelihood *= np.gradient(np.log(self.rolls))[:, np.newaxis]
        chances = likelihood.ravel() / likelihood.sum()
        flat = generator.choice(chances.size, count, p=chances)
        hurst, roll, end = np.unravel_index(flat, self.deviance.shape)
        return hurst, roll, end


@dataclass(frozen=True, eq=False)
class LikelyLaws:
    """_Laws that explain a spectrum hardly worse than the best one."""

    laws: _Laws  # all that were tried
    hursts: Indices  # of each likely law
    rolls: Indices
    ends: Indices
    responses: Indices  # what the instrument may do with one of them

    @classmethod
    def of(cls, laws: _Laws, level: float) -> LikelyLaws:
        """Take the laws within a level of the profile likelihood."""
        from scipy import special  # here because it loads slowly

        # a chi-squared variable with one degree of freedom is twice a gamma variable of shape 1/2
        most = 2 * special.gammaincinv(0.5, level)
        most += laws.deviance.min()
        responses = np.flatnonzero(laws.of_responses <= most)
        hursts, rolls, ends = np.nonzero(laws.deviance <= most)
        return cls(laws, hursts, rolls, ends, responses)

    @property
    def hurst_interval(self) -> tuple[float, float]:
        """Exponents of likely laws, and one step further, as those between were not tried. [1]"""
        step = _HURSTS[1] - _HURSTS[0]
        return float(_HURSTS[self.hursts.min()] - step), float(_HURSTS[self.hursts.max()] + step)

    @property
    def roll_interval(self) -> tuple[float, float]:
        """Roll-offs of likely laws, and the next that was tried on either side. [q_low]

        It begins at zero if a likely law has its roll-off beyond the longest waves of the piece.
        """
        tried, first, last = self.laws.rolls, self.rolls.min(), self.rolls.max()
        begin = tried[max(first - 1, 0)] if tried[first] > 1 else 0.0
        end = tried[min(last + 1, tried.size - 1)]
        return float(begin), float(max(end, 1.0))

    @property
    def end_interval(self) -> tuple[float, float]:
        """LawEnds of likely laws, with their margins; infinite if one has no end. [q_low]"""
        ends, margins = self.laws.ends, self.laws.margins
        return float((ends - margins)[self.ends].min()), float((ends + margins)[self.ends].max())

    def blur_interval(self, blurs: Real) -> tuple[float, float]:
        """Blurs of likely responses, and the next that was tried on either side. [spacings]"""
        tried = np.unique(blurs)
        likely = np.searchsorted(tried, blurs[self.responses])
        first, last = int(likely.min()), int(likely.max())
        return float(tried[max(first - 1, 0)]), float(tried[min(last + 1, tried.size - 1)])

    def outline(self) -> Iterator[tuple[int, int, int]]:
        """Give the likely laws with the least and largest exponent and end at each roll-off."""
        for roll in np.unique(self.rolls):
            of_roll = np.flatnonzero(self.rolls == roll)
            corners = {
                int(of_roll[find(values[of_roll])])
                for values in (self.hursts, self.ends)
                for find in (np.argmin, np.argmax)
            }
            for each in sorted(corners):
                yield int(self.hursts[each]), int(roll), int(self.ends[each])


@dataclass(frozen=True, eq=False)
class LawEnds:
    """LawEnds of laws, and the means that each leaves unchanged, changes, or ignores."""

    at: Real  # wavenumbers; the last is infinite, and no end
    margins: Real  # distance to the next end
    inside: Mask  # means that hold the law's power, over (end, mean)
    log_share: Real  # logarithm of the share of it that they have
    free_deviance: Real  # of the means beyond, where the spectrum is free

    def taken(self, which: Indices) -> LawEnds:
        """Return some of the ends."""
        return LawEnds(*(getattr(self, each.name)[which] for each in fields(self)))

    @cached_property
    def inside_weights(self) -> Real:
        """One for means that hold the law's power, over (mean, end), else zero."""
        return np.ascontiguousarray(self.inside.T, dtype=np.float64)

    @cached_property
    def log_share_inside(self) -> Real:
        """Logarithm of the share of that power, over (mean, end)."""
        return self.inside_weights * self.log_share.T

    @cached_property
    def inverse_share(self) -> Real:
        """One over that share, over (mean, end), zero for other means."""
        return self.inside_weights * np.exp(-self.log_share.T)


@dataclass(frozen=True, eq=False)
class Observed(ABC):
    """Mean powers of a spectrum, and how laws of its surface appear in them.

    Wavenumbers are in units of q_low = 2 pi / L.
    """

    means: Means
    nyquist: float
    instrument: Instrument  # its lengths in spacings
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
    def ends(self) -> LawEnds:
        """LawEnds to try."""

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
        return Responses.of(self.instrument, self.means.q / self.nyquist, _NODES, self.dimensions)

    @cached_property
    def _weights(self) -> tuple[Real, Real]:
        """Weights of the means for each response, and what they add to the deviance."""
        return self.means.weighed(self.responses.unknown)

    @cached_property
    def laws(self) -> _Laws:
        """_Laws that are not far from the spectrum."""
        with linear_algebra.on_one_thread():  # threads gain nothing on small matrices
            selected, ends = self._first_search()
            return self._second_search(selected, self.ends.taken(ends))

    def log_powers(self, law: Law, *, seen: bool = True) -> Real:
        """Logarithm of the expected power in each mean for a plateau of one; -inf beyond its end.

        As the instrument sees it, or that of the surface.
        """
        hurst, roll, end, corner, response = law
        values, last = self.expected(np.array([hurst]), roll, corner, np.array([end]))
        power = values[0, :, 0]
        if seen:
            node = int(np.abs(_NODES - hurst).argmin())
            nodes = slice(node, node + 1)
            power = self.responses.seen(response, nodes, values[:, :, 0], last)[0]
        return np.where(self.means.q <= end, power, -math.inf)

    def deviances(
        self, corner: Corner, roll: float, nodes: slice, responses: Indices, ends: LawEnds
    ) -> tuple[Real, Real]:
        """Deviances and log levels of laws, over (response, node, end); the last end is none."""
        means, inside = self.means, ends.inside_weights
        weight, added = (each[responses] for each in self._weights)
        law, last = self.expected(_NODES[nodes], roll, corner, ends.at)
        shares = self.responses.log_share[responses]
        total = (weight @ inside)[:, np.newaxis]
        scaled = weight * means.power * np.exp(-shares)
        log_level = np.log(_sums_over_means(scaled, np.exp(-law), ends.inverse_share) / total)
        logs = _sums_over_means(weight, law, inside)
        logs += (weight @ ends.log_share_inside)[:, np.newaxis]
        logs += ((weight * (shares - np.log(means.power))) @ inside)[:, np.newaxis]
        deviance = 2 * (logs + total * log_level) + ends.free_deviance
        deviance += (added @ inside)[:, np.newaxis]
        two_ends = np.outer(self.responses.is_second_end[responses], np.isfinite(ends.at))
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

        def least(corner: Corner, responses: Indices, ends: LawEnds) -> Real:
            """Least deviances of few laws, over (roll-off, response, end)."""
            tried = [
                self.deviances(corner, float(roll), _FEW_NODES, responses, ends)[0]
                for roll in rolls
            ]
            finer = _between(_NODES[_FEW_NODES].tobytes(), _NODES.tobytes())
            return np.array([(finer @ each).min(axis=1) for each in tried])

        of_ends = least("sharp", blurs, self.ends).min(axis=(0, 1))
        few = np.append(np.argsort(of_ends[:-1], kind="stable")[:_FEW_ENDS], none)
        of_few = self.ends.taken(few)
        found = np.array([least(corner, every, of_few).min(axis=2) for corner in _CORNERS])
        most = float(found.min()) + _DEVIANCE_MARGIN
        return found <= most, np.append(np.flatnonzero(of_ends[:-1] <= most), none)

    def _second_search(self, selected: Mask, ends: LawEnds) -> _Laws:
        """Compare the spectrum with all laws between those that were found."""
        shape = (_HURSTS.size, self.rolls.size, ends.at.size)
        deviance, log_level = np.full(shape, np.inf), np.zeros(shape)
        explained = np.zeros(shape, dtype=np.intp)
        explanations: list[tuple[Corner, int]] = []
        of_responses = np.full(selected.shape[-1], np.inf)
        finer = _between(_NODES.tobytes(), _HURSTS.tobytes())
        for j, roll in enumerate(self.rolls):
            around = slice(j // _FEW_ROLLS, -(-j // _FEW_ROLLS) + 1)
            for i, corner in enumerate(_CORNERS):
                which = np.flatnonzero(selected[i, around].any(axis=0))
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
        return _Laws(
            self.rolls,
            ends.at,
            ends.margins,
            deviance,
            log_level,
            explained,
            explanations,
            of_responses,
        )


def _sums_over_means(weights: Real, laws: Real, shares: Real) -> Real:
    """Sums of products over (response, mean), (node, mean, end or 1) and (mean, end).

    They are over (response, node, end).
    """
    if laws.shape[2] > 1:
        return np.tensordot(weights, laws * shares, (1, 1))
    rows = weights[:, np.newaxis] * laws[:, :, 0]
    return (rows.reshape(-1, weights.shape[1]) @ shares).reshape(*rows.shape[:2], -1)


@lru_cache(maxsize=4)
def _between(given: bytes, wanted: bytes) -> Real:
    """Matrix that interpolates values at some exponents to others, by cubic splines."""
    nodes, values = np.frombuffer(given), np.frombuffer(wanted)

    def basis(x: Real) -> Real:
        knots = nodes[2:-2]  # all but those next to the ends
        cubes = np.maximum(x[:, np.newaxis] - knots, 0.0) ** 3
        return np.hstack([x[:, np.newaxis] ** np.arange(4), cubes])

    return np.asarray(np.linalg.solve(basis(nodes).T, basis(values).T).T)
