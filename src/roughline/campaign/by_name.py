"""Contact laws and half-spaces in plans and stores: the name of a class, and its own fields.

A class of the package goes by its name, such as "Dugdale", and any other by its module too, such
as "my_laws:PowerLaw". That module is imported where a plan is read, and by each worker.
"""

from __future__ import annotations

import dataclasses
import importlib
import math
from collections.abc import Mapping
from typing import Any

import attrs
import numpy as np

import roughline as rl
from roughline.errors import InputError
from roughline.errors.checks import shown

_KEY = "name"


def described(value: Any) -> dict[str, Any]:
    """Return the name of a value's class and its own fields, as JSON holds them."""
    return {_KEY: _name(type(value)), **{key: _plain(each) for key, each in _fields(value).items()}}


def made(kind: type, table: Mapping[str, Any]) -> Any:
    """Make a value of a table with the name of its class and its fields.

    Raises
    ------
    InputError
        If there is no such class, or it does not take the fields.
    """
    name, example = table.get(_KEY), '{ name = "Dugdale", ... } or { name = "module:Class", ... }'
    if not isinstance(name, str):
        raise InputError(f"is {shown(table)}; its name is needed, as in {example}")
    module, _, of_module = name.rpartition(":")
    try:
        found = getattr(importlib.import_module(module) if module else rl, of_module, None)
    except ImportError as error:
        raise InputError(
            f"is {name}, and {error}: install it, or add its folder to PYTHONPATH, here and on "
            "every worker"
        ) from error
    if not (isinstance(found, type) and issubclass(found, kind)):
        raise InputError(f"is {name}, which is no rl.{kind.__name__}; give one as {example}")
    try:
        return found(**{key: each for key, each in table.items() if key != _KEY})
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: {error}") from error


def _name(kind: type) -> str:
    """What a class is called: by its name alone where that is one of the package."""
    name = kind.__qualname__
    return name if getattr(rl, name, None) is kind else f"{kind.__module__}:{name}"


def _fields(value: Any) -> dict[str, Any]:
    """What a value is made of, by name."""
    if dataclasses.is_dataclass(value):
        names = [each.name for each in dataclasses.fields(value) if each.init]
    elif attrs.has(type(value)):
        names = [each.alias for each in attrs.fields(type(value)) if each.init]
    else:
        names = [name for name in vars(value) if not name.startswith("_")]
    return {name: getattr(value, name) for name in names}


def _plain(value: Any) -> Any:
    """Return a field as JSON holds it."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if dataclasses.is_dataclass(value) or attrs.has(type(value)):
        return described(value)
    raise InputError(
        f"holds {shown(value)}; numbers, texts, arrays, and values that are made of them, are "
        "needed, so that a store can tell it again"
    )
