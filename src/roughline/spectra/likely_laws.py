"""Self-affine laws that a spectrum leaves likely, and the intervals that they span."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import special

from roughline.computing.arrays import Indices, Real
from roughline.spectra.self_affine_laws import HURSTS, Laws

Interval = tuple[float, float]


@dataclass(frozen=True, eq=False)
class LikelyLaws:
    """Laws that explain a spectrum hardly worse than the best one."""

    laws: Laws  # all that were tried
    hursts: Indices  # of each likely law
    rolls: Indices
    ends: Indices
    responses: Indices  # what the instrument may do with one of them

    @classmethod
    def of(cls, laws: Laws, level: float) -> LikelyLaws:
        """Take the laws within a level of the profile likelihood."""
        # a chi-squared variable with one degree of freedom is twice a gamma variable of shape 1/2
        most = 2 * special.gammaincinv(0.5, level)
        most += laws.deviance.min()
        responses = np.flatnonzero(laws.of_responses <= most)
        hursts, rolls, ends = np.nonzero(laws.deviance <= most)
        return cls(laws, hursts, rolls, ends, responses)

    @property
    def hurst_interval(self) -> Interval:
        """Exponents of likely laws, and one step further, as those between were not tried. [1]"""
        step = HURSTS[1] - HURSTS[0]
        return float(HURSTS[self.hursts.min()] - step), float(HURSTS[self.hursts.max()] + step)

    @property
    def roll_interval(self) -> Interval:
        """Roll-offs of likely laws, and the next that was tried on either side. [q_low]

        It begins at zero if a likely law has its roll-off beyond the longest waves of the piece.
        """
        tried, first, last = self.laws.rolls, self.rolls.min(), self.rolls.max()
        begin = tried[max(first - 1, 0)] if tried[first] > 1 else 0.0
        end = tried[min(last + 1, tried.size - 1)]
        return float(begin), float(max(end, 1.0))

    @property
    def end_interval(self) -> Interval:
        """Ends of likely laws, with their margins; infinite if one has no end. [q_low]"""
        ends, margins = self.laws.ends, self.laws.margins
        return float((ends - margins)[self.ends].min()), float((ends + margins)[self.ends].max())

    def blur_interval(self, blurs: Real) -> Interval:
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
