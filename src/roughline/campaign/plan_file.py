"""Plans in TOML: read and checked as a whole before anything is computed.

A plan has a ``name``, a ``seed`` and tables ``[[ensemble]]``. Lists of points, of roll-off ratios
or of hardnesses make one ensemble for each combination, named after it.
"""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Callable, Iterable
from itertools import product
from pathlib import Path
from typing import Any

from roughline.campaign.plan import Ensemble, Plan, decades, evenly
from roughline.errors import InputError

_MOST_VALUES = 10_000  # of one range; more values are a typing error


def read_plan(path: str | Path) -> Plan:
    """Read a plan from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file; its form is in ``docs/how-to/campaign.md``.

    Raises
    ------
    InputError
        If the file cannot be read, is not valid TOML, or has an unknown key; the message names the
        place and the nearest known key.
    """
    path = Path(path)
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise InputError(f"{path} does not exist; a plan in TOML is needed") from error
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path} cannot be read ({error}); a plan in TOML is needed") from error
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path} is not valid TOML: {error}") from error
    try:
        return plan_from(content, default_name=path.stem)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def plan_from(content: dict[str, Any], default_name: str = "campaign") -> Plan:
    """Make a plan of the content of a TOML file.

    Parameters
    ----------
    content : dict
        Keys ``name``, ``seed`` and ``ensemble``, the last a list of dicts.
    default_name : str, optional
        Name of a plan that states none.

    Raises
    ------
    InputError
        As for :func:`read_plan`.
    """
    top = _Table(content, "the plan")
    name = top.take("name", _text, default_name)
    seed = top.take("seed", _whole, 0)
    tables = top.take("ensemble", _tables)
    top.refuse_what_is_left()
    ensembles = [
        ensemble
        for number, table in enumerate(tables, 1)
        for ensemble in _ensembles(_Table(table, f"ensemble {number}"), seed)
    ]
    return Plan(name, tuple(ensembles))


def _ensembles(table: _Table, seed: int) -> Iterable[Ensemble]:
    name = table.take("name", _text)
    table.place = f"ensemble {name!r}"
    model = table.take("model", _text)
    dimensions = table.take("fractal_dimensions", _numbers)
    points = table.take("points", _wholes)
    roll_offs = table.take("roll_off_ratios", _numbers, (1.0,))
    realisations = table.take("realisations", _whole)
    forces = table.take("force_bars", _numbers)
    cutoff = table.take("cutoff_ratio", _number, None)
    boundary = table.take("boundary", _text, "none" if model == "reduced" else "free")
    hardnesses = table.take("hardness_bar", _numbers, (math.inf,))
    table.refuse_what_is_left()
    for n, roll_off, hardness in product(points, roll_offs, hardnesses):
        parts = [name]
        parts += [f"n{n}"] if len(points) > 1 else []
        parts += [f"roll{roll_off:g}"] if len(roll_offs) > 1 else []
        yielding = f"hardness{hardness:g}" if hardness < math.inf else "elastic"
        parts += [yielding] if len(hardnesses) > 1 else []
        yield Ensemble(
            name="-".join(parts),
            model=model,
            fractal_dimensions=dimensions,
            n=n,
            realisations=realisations,
            force_bars=forces,
            seed=seed,
            boundary=boundary,
            roll_off_ratio=roll_off,
            cutoff_ratio=cutoff,
            hardness_bar=hardness,
        )


_NEEDED: Any = object()


class _Table:
    """A table of the file; keys are taken from it one by one, and none may be left."""

    def __init__(self, content: dict[str, Any], place: str) -> None:
        self.place = place
        self._left = dict(content)
        self._known: list[str] = []

    def take(self, key: str, kind: Callable[[Any], Any], default: Any = _NEEDED) -> Any:
        """Take a key's value, of the right kind, or its default."""
        self._known.append(key)
        if key not in self._left:
            if default is _NEEDED:
                # a misspelt key is the likelier mistake: it is named first
                near = difflib.get_close_matches(key, self._left, 1)
                hint = f"; {near[0]!r} is not known: was it meant?" if near else ""
                raise InputError(f"{self.place} has no {key!r}{hint}")
            return default
        value = self._left.pop(key)
        try:
            return kind(value)
        except _WrongKindError as error:
            raise InputError(f"{self.place}: {key} is {value!r}; {error} is needed") from None

    def refuse_what_is_left(self) -> None:
        """Raise if keys were not taken."""
        for key in self._left:
            near = difflib.get_close_matches(key, self._known, 1)
            hint = f"did you mean {near[0]!r}?" if near else f"known are {', '.join(self._known)}"
            raise InputError(f"{self.place}: {key!r} is not known; {hint}")


class _WrongKindError(Exception):
    """A value is not of the kind that the message names."""


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise _WrongKindError("a text")
    return value


def _whole(value: Any) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise _WrongKindError("a whole number")
    return value


def _number(value: Any) -> float:
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise _WrongKindError("a number")
    return float(value)


def _tables(value: Any) -> list[dict[str, Any]]:
    if not isinstance(value, list) or not all(isinstance(item, dict) for item in value):
        raise _WrongKindError("a list of tables [[ensemble]]")
    return value


def _wholes(value: Any) -> tuple[int, ...]:
    values = value if isinstance(value, list) else [value]
    if not values:
        raise _WrongKindError("at least one whole number")
    return tuple(_whole(item) for item in values)


def _numbers(value: Any) -> tuple[float, ...]:
    """A number, a list, or a range {from, to, count} or {from, to, per_decade}."""
    if isinstance(value, dict):
        return _range(value)
    values = value if isinstance(value, list) else [value]
    if not values:
        raise _WrongKindError("at least one number")
    return tuple(_number(item) for item in values)


def _range(value: dict[str, Any]) -> tuple[float, ...]:
    step = "per_decade" if "per_decade" in value else "count"
    if set(value) != {"from", "to", step}:
        raise _WrongKindError("a number, a list, or {from, to, count} or {from, to, per_decade}")
    low, high, count = _number(value["from"]), _number(value["to"]), _whole(value[step])
    if step == "count":
        if not (2 <= count <= _MOST_VALUES and low < high):
            raise _WrongKindError(f"from < to and a count of 2 to {_MOST_VALUES}")
        return evenly(low, high, count)
    if not (1 <= count <= 1000 and 0 < low < high):
        raise _WrongKindError("0 < from < to and 1 to 1000 values per_decade")
    return decades(low, high, count)
