"""Arguments of the library in messages, under the names of the caller's own controls."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

_ARGUMENT = re.compile(r'(?<!")\b(\w+)=(?:True|"([^"]*)")?')


def with_arguments_called(
    message: str, names: Mapping[str, str], quoted: Callable[[str], str]
) -> str:
    """Return a message with arguments (recognised by an equals sign) replaced by other names.

    Parameters
    ----------
    message : str
        Such as "allow more (most_missing=)". A name directly after a quotation mark, such as
        "hardness=...", is text to be typed, not an argument, and is kept.
    names : mapping of str to str
        New names of arguments; those not in it are left as they are.
    quoted : callable
        Returns the text given to an argument as it is to be written.
    """

    def called(argument: re.Match[str]) -> str:
        name, value = argument.groups()
        if name not in names:
            return argument[0]
        return names[name] if value is None else f"{names[name]} {quoted(value)}"

    return _ARGUMENT.sub(called, message)
