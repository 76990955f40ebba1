"""The formats that are read: what of each, what not, and with what it was compared."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Format:
    """A format of files with topographies."""

    name: str  # as people call it
    suffixes: tuple[str, ...]  # of its files, with their dots
    written_by: str  # programs and instruments
    is_read: str  # what of it
    is_not_read: str = ""  # what of it, and what is said
    compared: str = ""  # with which public files or programs


FORMATS: tuple[Format, ...] = ()
