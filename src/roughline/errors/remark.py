"""Remarks that stand with answers: what each is about, and whether it is grave."""

from __future__ import annotations

from collections.abc import Iterable

DATA = "What was done to the data"
INTERVALS = "What the intervals include"
LIMITS = "Limits"


class Remark(str):
    """A sentence that stands with answers.

    Attributes
    ----------
    about : str
        DATA, INTERVALS or LIMITS.
    is_grave : bool
        Whether the answers do not hold, or are of something else than was asked about.
    """

    about: str
    is_grave: bool

    def __new__(cls, text: str, about: str = "", *, is_grave: bool = False) -> Remark:
        """Say something; a remark that is said in other words stays what it is."""
        made = super().__new__(cls, text)
        made.about = about or getattr(text, "about", LIMITS)
        made.is_grave = is_grave or getattr(text, "is_grave", False)
        return made

    def reworded(self, text: str) -> Remark:
        """Say it in other words."""
        return Remark(text, self.about, is_grave=self.is_grave)


def remarks(texts: Iterable[str], about: str = "", *, is_grave: bool = False) -> list[Remark]:
    """Return sentences as remarks about one thing; those that are remarks keep what they are."""
    return [Remark(each, about, is_grave=is_grave) for each in texts]


def grave_first(texts: Iterable[str]) -> list[Remark]:
    """Return remarks in their order, but for grave ones, which come first."""
    return sorted(remarks(texts), key=lambda each: not each.is_grave)
