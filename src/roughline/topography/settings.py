"""Settings of a body: the record of where its heights come from and of what was done to them.

The record is for people, and is stored with every result. Typed fields of the body decide how it
is treated.
"""

from __future__ import annotations

import copyreg
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from roughline.errors.checks import refuse

Settings = Mapping[str, str | int | float]


NOTHING_RECORDED: Settings = MappingProxyType({})


def read_only(settings: Any) -> MappingProxyType[str, str | int | float]:
    """Return a copy of settings that cannot be changed."""
    if not isinstance(settings, Mapping):
        refuse("settings", settings, "a mapping of names to texts and numbers is needed")
    return MappingProxyType(dict(settings))


# so that bodies, and curves with them, travel between processes
copyreg.pickle(MappingProxyType, lambda settings: (read_only, (dict(settings),)))

MEASURED = "instrument file"  # origin of what an instrument measured


def as_body(settings: Settings) -> Settings:
    """Return settings with names that say that they are a body's, for the settings of a result."""
    return {f"body_{name}": value for name, value in settings.items()}
