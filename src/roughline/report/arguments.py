"""Arguments of the library in messages, under the names of the caller's own controls."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from roughline.errors import InputError

_ARGUMENT = re.compile(r'\b(?P<name>\w+)=(?:True|"(?P<value>[^"]*)")?|"[^"]*"')


def with_arguments_called(
    message: str | Exception, names: Mapping[str, str], quoted: Callable[[str], str]
) -> str:
    """Return a message with arguments of the library under other names.

    The argument that an InputError is about is known from the error. Others are recognised by an
    equals sign, such as "allow more (most_missing=)"; what stands in quotation marks is text that
    was typed, or is to be typed, and is kept.

    Parameters
    ----------
    message : str or Exception
        What is said.
    names : mapping of str to str
        New names of arguments; those not in it are left as they are.
    quoted : callable
        Returns the text given to an argument as it is to be written.
    """

    def called(argument: re.Match[str]) -> str:
        name, value = argument["name"], argument["value"]
        if name not in names:
            return argument[0]
        return names[name] if value is None else f"{names[name]} {quoted(value)}"

    if isinstance(message, InputError) and message.argument is not None:
        begun = names.get(message.argument, message.argument)
        return f"{begun} {_ARGUMENT.sub(called, message.statement)}"
    return _ARGUMENT.sub(called, str(message))
