"""The flags of the command line in messages that speak of arguments."""

from __future__ import annotations

import re
import shlex

_FLAGS = {
    "E_star": "--modulus",
    "materials": "--materials",
    "loads": "--load",
    "depths": "--depth",
    "n_loads": "--loads",
    "grid_error": "--grid-error",
    "unit": "--unit",
    "channel": "--channel",
    "sizes": "--size",
    "missing": "--fill",
    "most_missing": "--max-missing",
    "trend": "--trend",
    "crop": "--crop",
    "host": "--host",
    "port": "--port",
    "password_file": "--password-file",
    "max_upload": "--max-upload",
    "max_points": "--max-points",
    "max_seconds": "--max-seconds",
    "max_memory": "--max-memory",
}
_ARGUMENT = re.compile(rf'\b({"|".join(_FLAGS)})=(?:True|"([^"]*)")?')


def in_flags(message: str) -> str:
    """Return a message with flags in the places of arguments, which have an equals sign."""
    return _ARGUMENT.sub(_flag, message)


def _flag(argument: re.Match[str]) -> str:
    """The flag of an argument, with its value if that is a text."""
    name, value = argument.groups()
    return _FLAGS[name] if value is None else f"{_FLAGS[name]} {shlex.quote(value)}"
