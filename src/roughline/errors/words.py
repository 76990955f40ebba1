"""Arguments in messages, by the names that whoever asks knows them by.

Like a language, these words are in force from the outside: the command line and the pages of the
lab say once what they call an argument, and every message that is made meanwhile says it so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True)
class Words:
    """What a caller calls arguments.

    Attributes
    ----------
    names : mapping of str to str
        Its names of arguments, and of classes as "rl.Name"; others keep those of Python.
    quoted : callable
        Writes a text as it is given to an argument.
    """

    names: Mapping[str, str]
    quoted: Callable[[str], str]


_IN_FORCE: ContextVar[Words | None] = ContextVar("words of the caller", default=None)


@contextmanager
def speaking(words: Words | None) -> Iterator[None]:
    """Call arguments by these words meanwhile; None stands for Python's own."""
    before = _IN_FORCE.set(words)
    try:
        yield
    finally:
        _IN_FORCE.reset(before)


def called(name: str, value: str | bool | None = None, *, in_python: str = "") -> str:
    """Name an argument as it is to be written: loads=, unit="um" or rl.Joint in Python.

    What Python has within a value of another argument is written out for it.
    """
    words = _IN_FORCE.get()
    if words is not None and name in words.names:
        word = words.names[name]
        return f"{word} {words.quoted(value)}" if isinstance(value, str) else word
    if in_python or name.startswith("rl."):  # or a class
        return in_python or name
    return f"{name}=" + (f'"{value}"' if isinstance(value, str) else f"{value or ''}")


def named(name: str) -> str:
    """Name an argument at the beginning of a sentence about it."""
    words = _IN_FORCE.get()
    return name if words is None else words.names.get(name, name)
