"""The hardness that a question is answered with, and which loads it bears."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.assessment.question import Question
from roughline.errors import InputError
from roughline.errors.words import called
from roughline.units import engineering


@dataclass(frozen=True)
class Hardness:
    """Hardness of the softer body.

    Attributes
    ----------
    value : float
        [Pa]
    factor : float
        By how much it is uncertain: it lies between value / factor and value * factor. [1]
    """

    value: float
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


def refuse_beyond_hardness(question: Question, area: float) -> None:
    """Refuse loads that a body of some nominal area [m²] does not bear.

    Raises
    ------
    InputError
        If all of the area would yield.
    """
    hardness = hardness_of(question)
    if hardness is None:
        return
    bearer = "the softer body" if question.pair is None else question.pair.bearer
    for heading, force in zip(question.headings, question.forces(area), strict=False):
        if force >= hardness.value * area * (1 - 1e-12):  # of a joint it is rounded
            most = engineering(hardness.value * area * question.scale(area), "N")
            on, joint = "the joint", ""
            if question.joint is None:
                on, joint = (
                    "the map",
                    f"the area of the joint that carries them ({called('rl.Joint')}), ",
                )
            raise InputError(
                f"load {heading} is a mean pressure of {engineering(force / area, 'Pa')}, and "
                f"{bearer}, of hardness {engineering(hardness.value, 'Pa')}, bears less than "
                f"{most} on {on} (H A_0): give smaller loads, {joint}or a larger hardness "
                f"({called('hardness')}) if the body has it"
            )
