"""Names one after the other."""

from __future__ import annotations

from collections.abc import Sequence

MOST_NAMED = 3
"""Answers that a sentence names one by one."""


def listed(names: Sequence[str]) -> str:
    """Write names one after the other."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def listed_in_short(names: Sequence[str]) -> str:
    """Write names one after the other; of many the first, and how many more there are."""
    further = len(names) - MOST_NAMED
    return listed([*names[:MOST_NAMED], f"{further} more"] if further > 0 else names)
