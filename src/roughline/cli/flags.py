"""The flags of the command line in messages that speak of arguments."""

from __future__ import annotations

import shlex

from roughline.report.arguments import with_arguments_called

_FLAGS = {
    "E_star": "--modulus",
    "materials": "--materials",
    "loads": "--load",
    "depths": "--depth",
    "against": "--against",
    "hardness": "--hardness",
    "elastic": "--elastic",
    "friction": "--friction",
    "history": "--history",
    "unload": "--unload",
    "joint_area": "--joint-area",
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


def in_flags(message: str) -> str:
    """Return a message with flags in the places of arguments, which have an equals sign."""
    return with_arguments_called(message, _FLAGS, shlex.quote)
