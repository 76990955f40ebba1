"""Arguments of the library in messages, called as the caller's own controls are."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

_ARGUMENT = re.compile(r'(?<!")\b(\w+)=(?:True|"([^"]*)")?')


def with_arguments_called(
    message: str, names: Mapping[str, str], quoted: Callable[[str], str]
) -> str:
    """Return a message with other names in the places of arguments, which have an equals sign.

    Parameters
    ----------
    message : str
        Such as "allow more (most_missing=)". What follows a quotation mark, such as
        "hardness=...", is no argument but text to be typed, and stays.
    names : mapping of str to str
        What arguments are called; others are left as they are.
    quoted : callable
        How a text that is given to an argument is written.
    """

    def called(argument: re.Match[str]) -> str:
        name, value = argument.groups()
        if name not in names:
            return argument[0]
        return names[name] if value is None else f"{names[name]} {quoted(value)}"

    return _ARGUMENT.sub(called, message)
