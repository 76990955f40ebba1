"""Plans in TOML: read and checked as a whole before anything is computed.

A plan has a ``name``, a ``seed`` and tables ``[[ensemble]]``. Lists of points, of roll-off ratios
or of hardnesses make one ensemble for each combination, named after it.
"""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

from roughline.campaign.plan import Ensemble, Plan, decades, evenly
from roughline.errors import InputError
from roughline.errors.checks import refuse, shown
from roughline.errors.public import public

_MOST_VALUES = 10_000  # of one range; more values are a typing error


@public
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


@public
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
    if not isinstance(content, Mapping):
        refuse("content", content, "a dict as tomllib reads it is needed; a file: read_plan(path)")
    top = _Table(content, "the plan", _PLAN_KEYS)
    name = top.take("name", _text, default_name)
    seed = top.take("seed", _whole, 0)
    tables = top.take("ensemble", _tables)
    ensembles = [
        ensemble
        for number, table in enumerate(tables, 1)
        for ensemble in _ensembles(_table_of_ensemble(table, number), seed)
    ]
    return Plan(name, tuple(ensembles))


def _table_of_ensemble(table: dict[str, Any], number: int) -> _Table:
    """The table of an ensemble, called by its name, or by its number where it has none."""
    name = table.get("name")
    return _Table(
        table, f"ensemble {name!r}" if isinstance(name, str) else f"ensemble {number}", _KEYS
    )


def _ensembles(table: _Table, seed: int) -> Iterable[Ensemble]:
    name = table.take("name", _text)
    model = table.take("model", _text)
    dimensions = table.take("fractal_dimensions", _numbers)
    points = table.take("points", _wholes)
    roll_offs = table.take("roll_off_ratios", _numbers, (1.0,))
    realisations = table.take("realisations", _whole)
    forces = table.take("force_bars", _numbers)
    cutoff = table.take("cutoff_ratio", _number, None)
    boundary = table.take("boundary", _text, "none" if model == "reduced" else "free")
    hardnesses = table.take("hardness_bar", _numbers, (math.inf,))
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
_PLAN_KEYS = ("name", "seed", "ensemble")
_KEYS = (
    "name",
    "model",
    "fractal_dimensions",
    "points",
    "roll_off_ratios",
    "realisations",
    "force_bars",
    "cutoff_ratio",
    "boundary",
    "hardness_bar",
)
"""Keys of an ensemble."""

_MEANT = {
    "hurst": ("fractal_dimensions,", "which are 3 - H"),
    "H": ("fractal_dimensions,", "which are 3 - H"),
    "n": ("points",),
    "surfaces": ("realisations",),
    "hardness": ("hardness_bar,", "H / (E* times the rms slope)"),
    "forces": ("force_bars,", "F / (E* h L)"),
    "loads": ("force_bars,", "F / (E* h L)"),
    "periodic": ("boundary", '= "periodic"'),
}
"""Keys that others may be meant by, and how."""


class _Table:
    """A table of the file, of which all keys are known; they are taken from it one by one."""

    def __init__(self, content: Mapping[str, Any], place: str, known: Sequence[str]) -> None:
        self.place = place
        self._content = content
        for key in content:
            if key not in known:
                raise InputError(f"{place}: {key!r} is not known; {_hint(key, known)}")

    def take(self, key: str, kind: Callable[[Any], Any], default: Any = _NEEDED) -> Any:
        """Take a key's value, of the right kind, or its default."""
        if key not in self._content:
            if default is _NEEDED:
                raise InputError(f"{self.place} has no {key!r}, which is needed")
            return default
        value = self._content[key]
        try:
            return kind(value)
        except _WrongKindError as error:
            raise InputError(f"{self.place}: {key} is {shown(value)}; {error} is needed") from None


def _hint(key: str, known: Sequence[str]) -> str:
    """What may be meant by an unknown key."""
    if key in _MEANT and _MEANT[key][0].rstrip(",") in known:
        return f"give {' '.join(_MEANT[key])}"
    near = difflib.get_close_matches(key, known, 1)
    return f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known)}"


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
