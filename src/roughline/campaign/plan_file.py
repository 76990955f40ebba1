"""Plans in TOML: read and checked as a whole before anything is computed.

A plan has a ``name``, a ``seed`` and tables ``[[ensemble]]``. Lists of points, of roll-off ratios,
of hardnesses or of laws make one ensemble for each combination, named after it.
"""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

from roughline.campaign.by_name import made
from roughline.campaign.plan import Ensemble, Plan, decades, evenly
from roughline.errors import InputError
from roughline.errors.checks import refuse, shown
from roughline.errors.public import public
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.laws.law import ContactLaw

_Reader = Callable[[Any], Any]
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
    plan = _values(content, "the plan", _PLAN, name=default_name, seed=0)
    ensembles = [
        ensemble
        for number, table in enumerate(plan["ensemble"], 1)
        for ensemble in _ensembles(table, number, plan["seed"])
    ]
    return Plan(plan["name"], tuple(ensembles))


def _ensembles(table: dict[str, Any], number: int, seed: int) -> Iterable[Ensemble]:
    """The ensembles of a table, which is called by its name, or by its number if it has none."""
    called = repr(table["name"]) if isinstance(table.get("name"), str) else number
    settings = _values(
        table,
        f"ensemble {called}",
        _ENSEMBLE,
        roll_off_ratios=(1.0,),
        cutoff_ratio=None,
        boundary="",
        hardness_bar=(math.inf,),
        law=(None,),
        half_space=None,
        friction=None,
        shear_bars=None,
    )
    name, several = settings.pop("name"), ("points", "roll_off_ratios", "hardness_bar", "law")
    points, roll_offs, hardnesses, laws = (settings.pop(key) for key in several)
    for n, roll_off, hardness, (number, law) in product(
        points, roll_offs, hardnesses, enumerate(laws, 1)
    ):
        parts = [name]
        parts += [f"n{n}"] if len(points) > 1 else []
        parts += [f"roll{roll_off:g}"] if len(roll_offs) > 1 else []
        yielding = f"hardness{hardness:g}" if hardness < math.inf else "elastic"
        parts += [yielding] if len(hardnesses) > 1 else []
        parts += [f"law{number}"] if len(laws) > 1 else []
        own = {"n": n, "seed": seed, "roll_off_ratio": roll_off, "hardness_bar": hardness}
        own["law"] = law
        yield Ensemble(name="-".join(parts), **own, **settings)


def _values(
    table: Mapping[str, Any], place: str, kinds: Mapping[str, _Reader], **left_out: Any
) -> dict[str, Any]:
    """The values of a table by their keys, each of its kind, and of those that are left out."""
    for key in table:
        if key not in kinds:
            raise InputError(f"{place}: {key!r} is not known; {_hint(key, list(kinds))}")
    found = {}
    for key, kind in kinds.items():
        if key in table:
            try:
                found[key] = kind(table[key])
            except InputError as error:
                raise InputError(f"{place}: {key} {error}") from error
            except _WrongKindError as error:
                message = f"{place}: {key} is {shown(table[key])}; {error} is needed"
                raise InputError(message) from None
        elif key not in left_out:
            raise InputError(f"{place} has no {key!r}, which is needed")
    return left_out | found


def _hint(key: str, known: Sequence[str]) -> str:
    """What may be meant by an unknown key."""
    if key in _MEANT_KEYS and _MEANT_KEYS[key][0].rstrip(",") in known:
        return f"give {' '.join(_MEANT_KEYS[key])}"
    near = difflib.get_close_matches(key, known, 1)
    return f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known)}"


class _WrongKindError(Exception):
    """A value is not of the kind that the message names."""


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise _WrongKindError("a text")
    return value


def _integer(value: Any) -> int:
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


def _integers(value: Any) -> tuple[int, ...]:
    values = value if isinstance(value, list) else [value]
    if not values:
        raise _WrongKindError("at least one whole number")
    return tuple(_integer(item) for item in values)


def _numbers(value: Any) -> tuple[float, ...]:
    """A number, a list, or a range {from, to, count} or {from, to, per_decade}."""
    if isinstance(value, dict):
        return _range(value)
    values = value if isinstance(value, list) else [value]
    if not values:
        raise _WrongKindError("at least one number")
    return tuple(_number(item) for item in values)


def _laws(value: Any) -> tuple[ContactLaw, ...]:
    """A contact law, or a list of them, each itself or as a table with its name and fields."""
    values = value if isinstance(value, list) else [value]
    if not values:
        raise _WrongKindError("at least one law")
    return tuple(_made_by_name(ContactLaw, item) for item in values)


def _half_space(value: Any) -> HalfSpace:
    found: HalfSpace = _made_by_name(HalfSpace, value)
    return found


def _friction(value: Any) -> Friction:
    """A coefficient of friction, or a friction itself or as a table with its name and fields."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Friction(value)
    found: Friction = _made_by_name(Friction, value)
    return found


def _made_by_name(kind: type, value: Any) -> Any:
    if isinstance(value, kind):
        return value
    if not isinstance(value, dict):
        raise _WrongKindError('a table such as { name = "Dugdale", work_of_adhesion = 0.2, ... }')
    return made(kind, value)


def _range(value: dict[str, Any]) -> tuple[float, ...]:
    step = "per_decade" if "per_decade" in value else "count"
    if set(value) != {"from", "to", step}:
        raise _WrongKindError("a number, a list, or {from, to, count} or {from, to, per_decade}")
    low, high, count = _number(value["from"]), _number(value["to"]), _integer(value[step])
    if step == "count":
        if not (2 <= count <= _MOST_VALUES and low < high):
            raise _WrongKindError(f"from < to and a count of 2 to {_MOST_VALUES}")
        return evenly(low, high, count)
    if not (1 <= count <= 1000 and 0 < low < high):
        raise _WrongKindError("0 < from < to and 1 to 1000 values per_decade")
    return decades(low, high, count)


_PLAN = {"name": _text, "seed": _integer, "ensemble": _tables}
_ENSEMBLE = {
    "name": _text,
    "model": _text,
    "fractal_dimensions": _numbers,
    "points": _integers,
    "roll_off_ratios": _numbers,
    "realisations": _integer,
    "force_bars": _numbers,
    "cutoff_ratio": _number,
    "boundary": _text,
    "hardness_bar": _numbers,
    "law": _laws,
    "half_space": _half_space,
    "friction": _friction,
    "shear_bars": _numbers,
}
"""Keys of an ensemble, and of what kind each is."""

_MEANT_LAW = (
    "law",
    '= { name = "Dugdale", work_of_adhesion = ..., range = ... }, w L / (E* h²) and h_0 / h',
)
_MEANT_KEYS = {
    "hurst": ("fractal_dimensions,", "which are 3 - H"),
    "H": ("fractal_dimensions,", "which are 3 - H"),
    "n": ("points",),
    "surfaces": ("realisations",),
    "hardness": ("hardness_bar,", "H / (E* times the rms slope)"),
    **dict.fromkeys(("work_bar", "range_bar", "work_of_adhesion", "range"), _MEANT_LAW),
    "attraction": ("law", '= { name = "Exponential", ... }'),
    "forces": ("force_bars,", "F / (E* h L)"),
    "loads": ("force_bars,", "F / (E* h L)"),
    "periodic": ("boundary", '= "periodic"'),
    **dict.fromkeys(("shear", "shears", "shear_forces"), ("shear_bars,", "Q / (E* h L)")),
    **dict.fromkeys(("mu", "coefficient_of_friction"), ("friction", "= 0.3")),
}
"""Keys that others may be meant by, and how."""
