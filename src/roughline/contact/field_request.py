"""What is asked of the fields of loads: which are kept, and which numbers are taken from them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from roughline.contact.measures import Measure


@dataclass(frozen=True)
class FieldRequest:
    """Loads, by their numbers, whose fields are kept, and measures that are taken of every load."""

    loads: frozenset[int] = frozenset()
    measures: Sequence[Measure] = ()
