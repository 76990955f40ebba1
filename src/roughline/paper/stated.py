"""The exponents that the paper states for a fractal dimension, and how near is near enough."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import Verdict, verdict

if TYPE_CHECKING:
    from roughline.statistics.bootstrap import IntervalEstimate

ModelLabel = Literal["1D", "3D"]

EXPONENT_TOLERANCE = 0.05
"""How near exponents must come; the paper's own plots show no more."""
STIFFNESS_TOLERANCE = 0.10
"""How near stiffnesses must come, as a share."""
SMALL_DISCREPANCY = 2 * EXPONENT_TOLERANCE
"""What a "small discrepancy" of exponents may be."""
_EXTREMELY_WELL_UP_TO = 2.6  # D_f up to which the scaling argument holds "extremely well"
REDUCED_ENDS = {2.0: 0.5, 3.0: 0.75}
"""Exponents of the reduced model at the ends of the fractal dimensions (§6)."""


@dataclass(frozen=True)
class StatedExponent:
    """An exponent that the paper states."""

    value: float
    tolerance: float  # how near another must come to be the same
    where: str  # the formula or number, and where it stands in the paper

    def verdict(self, found: IntervalEstimate) -> Verdict:
        """Judge an exponent that was found, by its interval."""
        off = found - self.value
        return verdict(off.low, off.high, -self.tolerance, self.tolerance)


def is_smooth(fractal_dimension: float) -> bool:
    """Whether the scaling argument should hold extremely well."""
    return fractal_dimension <= _EXTREMELY_WELL_UP_TO + 1e-9


def stated_exponents(model: ModelLabel, fractal_dimension: float) -> tuple[StatedExponent, ...]:
    """Return what the paper states of an exponent: the scaling argument first."""
    tolerance = EXPONENT_TOLERANCE if is_smooth(fractal_dimension) else SMALL_DISCREPANCY
    scaling = StatedExponent(
        scaling_exponent(fractal_dimension), tolerance, "1 / (4 - D_f), eq. 14 and §7"
    )
    if model == "3D":
        linear = linear_exponent(fractal_dimension)
        return (scaling, StatedExponent(linear, EXPONENT_TOLERANCE, "0.2567 D_f, §7"))
    if fractal_dimension in REDUCED_ENDS:
        end = REDUCED_ENDS[fractal_dimension]
        return (scaling, StatedExponent(end, EXPONENT_TOLERANCE, f"{end:g}, §6"))
    return (scaling,)
