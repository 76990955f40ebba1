"""A claim as a row of a page: its numbers as dots over the range that it allows, and a verdict."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from roughline.statistics.verdict import Claim, verdict

if TYPE_CHECKING:
    from roughline.statistics.bootstrap import IntervalEstimate

_MIDDLE, _HALF = 54.0, 11.0  # of the allowed range, in the middle of its strip [% of the strip]
_FARTHEST_DOT = 4.0  # from the middle, in halves of that range; what lies beyond is at the edge


@dataclass(frozen=True)
class Dot:
    """A number on a strip: its place, and the ends of its bar. [% of the strip]"""

    at: float
    low: float
    high: float
    verdict: str
    words: str  # the number and its interval
    beyond: str = ""  # an arrow where it lies beyond the strip


@dataclass(frozen=True)
class JudgedClaim:
    """A claim, and the same one as a larger study judges it, where there is one."""

    claim: Claim
    by_more: Claim | None = None

    band: ClassVar[tuple[float, float]] = (_MIDDLE - _HALF, 2 * _HALF)
    """Where the allowed range begins, and its width. [% of the strip]"""

    @property
    def dots(self) -> Sequence[tuple[str, Dot, Dot | None]]:
        """For each case its name, its number, and that of the larger study."""
        more = self.by_more.numbers if self.by_more else {}
        return [
            (
                where.rpartition(" ")[2],
                self._dot(number),
                self._dot(more[where]) if where in more else None,
            )
            for where, number in self.claim.numbers.items()
        ]

    @property
    def allowed_ends(self) -> tuple[str, str]:
        """Both ends of the range that it allows."""
        low, high = (f"{end:g}".replace("-", "−") for end in self.claim.within)
        return low, high

    @property
    def otherwise(self) -> str:
        """The verdict of the larger study, where it is another one."""
        more = self.by_more
        return str(more.verdict) if more and more.verdict is not self.claim.verdict else ""

    @property
    def in_words(self) -> Sequence[tuple[str, str]]:
        """What the row does not say."""
        claim, more = self.claim, self.by_more
        words = [
            *([("Found here", claim.found)] if claim.numbers else []),
            ("95 % interval", claim.interval),
            ("Allowed", claim.allowed),
            ("Window, averaging, grid", claim.basis),
            ("Verdict", claim.cases),
            *([("Full study", f"{more.cases}. It found {more.found}")] if more else []),
        ]
        return [(name, text) for name, text in words if text != "-"]

    def _dot(self, number: IntervalEstimate) -> Dot:
        least, most = self.claim.within
        ends = (number.low, number.high) if math.isfinite(number.low) else (number.value,) * 2
        words = f"{number.value:.3f}"
        if math.isfinite(number.low):
            words += f" ({number.low:.3f} to {number.high:.3f})"
        off = (2 * number.value - least - most) / (most - least)
        return Dot(
            at=self._place(number.value),
            low=self._place(ends[0]),
            high=self._place(ends[1]),
            verdict=verdict(number.low, number.high, least, most),
            words=words,
            beyond="" if abs(off) <= _FARTHEST_DOT else "▸" if off > 0 else "◂",
        )

    def _place(self, value: float) -> float:
        """Where a number stands on the strip."""
        least, most = self.claim.within
        off = (2 * value - least - most) / (most - least)
        return round(_MIDDLE + _HALF * min(max(off, -_FARTHEST_DOT), _FARTHEST_DOT), 2)
