"""Every kind of fact, with numbers of every shape that its words may meet."""

import importlib
import inspect
import itertools
import pkgutil
import types
import typing

from roughline import facts
from roughline.facts.fact import Fact, FactKind

_SAMPLES = {
    int: [1234],
    float: [1.2345e-4],
    str: ["interface stiffness"],
    bool: [False, True],
    type(None): [None],
    tuple[str, ...]: [("contact stiffness",), ("mean gap", "approach", "leak rate", "k_i")],
}
_NAMED = {  # what stands for a longer or a shorter text than most
    "load": ["10 N"],
    "loads": [("10 N",), ("1 N", "10 N")],
    "unit": ["m", None],
    "causes": [
        (("the grid", "finer pixels", 12.0),),
        (("the scatter", "a test", 4.0), ("one map", "many", 3.0)),
    ],
    "material": ["titanium-nitride"],
    "fluid": ["helium"],
    "axis": ["x"],
    "along": ["x"],
    "k_i": ["k_i"],
    "assembly": ["joint"],
    "which": ["second"],
    "cells": [12, "1.8"],
    "of_layers": ["250 to 590 GPa"],
    "method": ["harmonic"],
    "what": ["map", "scan"],
    "how": ["median"],
    "sides": [(1.2345e-4,), (1.2345e-4, 1.2345e-4)],
    "added": [((1.2345e-4, "m² K/W", "heat"), (1.2345e-4, "Ω m²", "electricity"))],
}


def all_kinds():
    """The kinds of all modules of the room, by their names."""
    found = {}
    for module in pkgutil.iter_modules(facts.__path__, "roughline.facts."):
        for name, each in vars(importlib.import_module(module.name)).items():
            if isinstance(each, FactKind) and each.__module__ == module.name:
                assert name == each.name
                assert name not in found, f"two kinds of facts are called {name}"
                found[name] = each
    return found


def examples(kind):
    """Facts of a kind, with all combinations of what its words tell apart."""
    hints = typing.get_type_hints(kind.words)
    hints.pop("return")
    options = [_samples(name, hint) for name, hint in hints.items()]
    return [kind(**dict(zip(hints, each, strict=True))) for each in itertools.product(*options)]


def _samples(name, hint):
    if hint is Fact:
        return [_inner()]
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if origin is typing.Literal:
        return list(parts)
    if name in _NAMED and hint != tuple[float, float]:
        return _NAMED[name]
    if hint in _SAMPLES:
        return _SAMPLES[hint]
    if origin in (typing.Union, types.UnionType):
        return [each for part in parts for each in _samples("", part)]
    assert origin is tuple, (name, hint)
    if parts[-1] is Ellipsis:
        return [tuple(_samples("", parts[0])[:1]), tuple(_samples("", parts[0])[:1] * 4)]
    return [tuple(_samples("", part)[0] for part in parts)]


def _inner():
    return importlib.import_module("roughline.facts.heights").flat()


def parameters(kind):
    """Names of the numbers of a kind."""
    return list(inspect.signature(kind.words).parameters)
