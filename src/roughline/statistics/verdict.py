"""Verdicts on statements: whether an interval lies within what is allowed, outside, or across."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


class Verdict(StrEnum):
    """What a sample says of a statement.

    Attributes
    ----------
    CONFIRMED
        The whole interval lies within what the statement allows.
    REFUTED
        The whole interval lies outside.
    UNDECIDED
        The interval lies across the limit, or there is none: this sample cannot tell.
    """

    CONFIRMED = "confirmed"
    REFUTED = "refuted"
    UNDECIDED = "undecided"


def verdict(low: float, high: float, least: float, most: float) -> Verdict:
    """Judge an interval, low to high, by the range that a statement allows, least to most."""
    if least <= low and high <= most:
        return Verdict.CONFIRMED
    if high < least or low > most:
        return Verdict.REFUTED
    return Verdict.UNDECIDED


def of_all(verdicts: Iterable[Verdict]) -> Verdict:
    """Judge a statement about several cases: one that is refuted refutes it."""
    found = set(verdicts)
    if Verdict.REFUTED in found:
        return Verdict.REFUTED
    return Verdict.CONFIRMED if found == {Verdict.CONFIRMED} else Verdict.UNDECIDED
