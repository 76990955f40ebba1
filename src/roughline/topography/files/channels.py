"""Channels of a file: which of them hold heights, and which one is meant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from roughline.errors import InputError
from roughline.errors.checks import shortened

_DIGITS = 9  # of the number of a channel, at most


@dataclass(frozen=True)
class Channel:
    """A channel, as a file lists it."""

    name: str
    why_none: str = ""  # why it holds no heights, in words; empty if it does
    about: str = ""  # what tells it from another one of the same name, such as "retrace"

    def __str__(self) -> str:
        name = shortened(self.name) or "one without a name"
        return f"{name} ({self.about})" if self.about else name


def find_channel(
    channels: Sequence[Channel], wanted: int | str | None, file: str, first: int = 0
) -> int:
    """Find a channel of heights by number or name; by default the first one, or one before it."""
    known = numbered(channels)
    if wanted is None:
        order = [first, *range(len(channels))] if channels else []
        number = next((i for i in order if not channels[i].why_none), None)
        if number is None:
            each_one = (f"{each} ({shortened(each.why_none)})" for each in channels)
            found = ", ".join(each_one) or "no channel"
            raise InputError(f"{file} holds no heights; it has {found}: export the heights")
        return number
    text = str(wanted)
    if text.isdecimal() and len(text) < _DIGITS and int(text) < len(channels):
        number = int(text)
    else:
        named = [
            i
            for i, each in enumerate(channels)
            if text.lower() in (each.name.lower(), str(each).lower())
        ]
        if not named:
            raise InputError(f"{file} has no channel {shortened(text)!r}; it has {known}")
        if len(named) > 1:
            raise InputError(
                f"{file} has {len(named)} channels {shortened(text)!r}: choose one by its number: "
                f"{known}"
            )
        number = named[0]
    if channels[number].why_none:
        why = shortened(channels[number].why_none)
        raise InputError(
            f"channel {shortened(text)!r} of {file} holds no heights ({why}); it has {known}"
        )
    return number


def numbered(channels: Sequence[Channel]) -> str:
    """The channels of a file with their numbers, for a message."""
    return shortened(", ".join(f"{i} {str(each)!r}" for i, each in enumerate(channels)))


def listed(channels: Sequence[Channel]) -> tuple[str, ...]:
    """The channels of a file with their numbers, and what holds no heights."""
    return tuple(
        f"{i} {each}" + (" (no heights)" if each.why_none else "")
        for i, each in enumerate(channels)
    )
