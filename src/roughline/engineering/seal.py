"""The seal that a leak is of, and what is asked of the fluid in the gap."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

from roughline.errors.checks import refuse
from roughline.units import in_si

_ACROSS = re.compile(r"\s+x\s+|\s*×\s*")
_RING = re.compile(r"\s*\.\.+\s*")
_NEEDED = (
    'give its length across the flow and its width along it, such as "100 mm x 2 mm", or the two '
    'radii of a ring, such as "20 mm .. 24 mm"'
)


@dataclass(frozen=True)
class SealShape:
    """The face of a seal: a strip that is crossed, or a ring that is crossed radially."""

    words: str
    ratio: float  # W / B, length across the flow over the way through, of a ring 2π / ln(R/r) [1]
    width: float  # W, of a ring its inner circumference [m]

    @classmethod
    def of(cls, given: Any) -> SealShape:
        """Read a shape such as "100 mm x 2 mm" or "20 mm .. 24 mm".

        Raises
        ------
        InputError
            If it is neither, or the inner radius is not below the outer one.
        UnitError
            If a length has no unit, or a wrong one.
        """
        if isinstance(given, cls):
            return given
        if not isinstance(given, str):
            refuse("seal", given, _NEEDED)
        for pattern in (_RING, _ACROSS):
            parts = pattern.split(given.strip())
            if len(parts) == 2:
                first, second = (in_si(part, "m", "seal") for part in parts)
                break
        else:
            refuse("seal", given, _NEEDED)
        if not (0 < first < math.inf and 0 < second < math.inf):
            refuse("seal", given, "positive, finite lengths are needed")
        if pattern is _ACROSS:
            return cls(given.strip(), first / second, first)
        if first >= second:
            refuse("seal", given, "the inner radius comes first, and is below the outer one")
        around = 2 * math.pi
        return cls(given.strip(), around / math.log(second / first), around * first)
