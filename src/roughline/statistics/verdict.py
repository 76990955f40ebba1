"""Verdicts on statements: an interval is compared with the range that a statement allows."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


class Verdict(StrEnum):
    """What a sample says of a statement.

    Attributes
    ----------
    CONFIRMED
        The whole interval lies within the range that the statement allows.
    REFUTED
        The whole interval lies outside that range.
    UNDECIDED
        The interval lies partly within the range, or there is no interval: the sample does not
        decide.
    """

    CONFIRMED = "confirmed"
    REFUTED = "refuted"
    UNDECIDED = "undecided"


def verdict(low: float, high: float, least: float, most: float) -> Verdict:
    """Judge an interval, low to high, by the range that the statement allows, least to most."""
    if least <= low and high <= most:
        return Verdict.CONFIRMED
    if high < least or low > most:
        return Verdict.REFUTED
    return Verdict.UNDECIDED


def joint_verdict(verdicts: Iterable[Verdict]) -> Verdict:
    """Judge a statement about several cases: one refuted case refutes the statement."""
    different = set(verdicts)
    if Verdict.REFUTED in different:
        return Verdict.REFUTED
    return Verdict.CONFIRMED if different == {Verdict.CONFIRMED} else Verdict.UNDECIDED
