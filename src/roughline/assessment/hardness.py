"""The hardness that a question is answered with."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.assessment.question import Question


@dataclass(frozen=True)
class Hardness:
    """Hardness of the softer body: it lies between value / factor and value * factor."""

    value: float  # [Pa]
    factor: float

    @property
    def ends(self) -> tuple[float, float]:
        """The softest and the hardest that the body may be. [Pa]"""
        return self.value / self.factor, self.value * self.factor


def hardness_of(question: Question) -> Hardness | None:
    """Return the hardness that a question is answered with; None if the bodies are elastic."""
    if question.elastic:
        return None
    if question.hardness is not None:
        return Hardness(question.hardness, 1.0) if question.hardness < float("inf") else None
    pair = question.pair
    if pair is None or pair.hardness is None:
        return None
    return Hardness(pair.hardness, pair.hardness_factor)
