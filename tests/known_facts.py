"""Every kind of fact, with numbers of every shape that its words may meet."""

import ast
import itertools
import re

from architecture import SOURCE

from roughline.facts.fact import Fact
from roughline.facts.kinds import KINDS

_NAMED = {  # what stands for a longer or a shorter text than most, or is told apart by its shape
    "load": ["10 N"],
    "loads": [("10 N",), ("1 N", "10 N")],
    "unit": ["m", None],
    "material": ["titanium-nitride"],
    "fluid": ["helium"],
    "axis": ["x"],
    "along": ["x"],
    "k_i": ["k_i"],
    "assembly": ["joint"],
    "which": ["second"],
    "cells": [12],
    "points": [1234],
    "needed": [12],
    "of_layers": ["250 to 590 GPa"],
    "method": ["harmonic"],
    "how": ["median"],
    "sides": [(1.2345e-4,), (1.2345e-4, 1.2345e-4)],
    "pixel": [(1.2345e-4, 1.2345e-4)],
    "spacing": [(1.2345e-4, 1.2345e-4)],
    "shares": [(0.1,), (0.1, 0.2)],
    "left": [(0.9, 1.1)],
    "letter": ["S"],
    "what": ["map", "scan"],
    "factor": [12.345],
    "times": [12.345],
    "least": [0.1],
    "count": [12],
    "name": ["rms_height"],
    "quantity": ["conductivity"],
    "bodies": [("the first body (titanium-nitride)",), ("the first body (a)", "the second (b)")],
    "maps": [("a",), ("a", "b")],
}
_MADE_OF = {
    ("resistance_of_layers", "added"): ["added_by_layers"],
    ("wide", "causes"): ["left_open"],
    ("border_moves_flow", "directions"): ["flow_at_border"],
    ("strained", "strain"): ["strain_of_load"],
    ("without_answer", "names"): ["answer_under_loads"],
    ("without_answer", "why"): ["largest_load_unsolved"],
}
_LISTS = {",", ";", "no", "and", "and of", "few", "count", "then by"}


def examples(kind):
    """Facts of a kind, with all combinations of what its words tell apart."""
    text = KINDS[kind].short + KINDS[kind].full
    names = sorted(KINDS[kind].numbers)
    options = [_samples(kind, name, text) for name in names]
    return [
        Fact(kind, **dict(zip(names, each, strict=True))) for each in itertools.product(*options)
    ]


def _samples(kind, name, text):
    formats = set(re.findall(rf"{{{name}(?::((?:[^{{}}]|{{\w+}})*))?}}", text))
    values = [each for each in re.findall(rf"\[{name}=([^?]*)\?", text) if not each.isdigit()]
    is_optional = re.search(rf"\[{name}\?", text) is not None
    if parts := _MADE_OF.get((kind, name)):
        facts = tuple(each for part in parts for each in examples(part)[:1])
        return [facts] if formats & _LISTS else [*facts]
    if "short" in formats:
        return [Fact("flat")]
    if name == "loads" and formats & {"to in Pa"}:
        return [(1.2345e-4,), (1.2345e-4, 2.345e-4)]
    if kind == "shape_of_values":
        return [12]
    if name in _NAMED and not values:
        return [*([None] if is_optional else []), *_NAMED[name]]
    if values:
        return list(dict.fromkeys(values))
    if not formats:
        return [False, True] if is_optional else [1, 2, 3]
    found = ["interface stiffness"] if formats == {""} else [1.2345e-4]
    if formats & _LISTS:
        found = [("contact stiffness",), ("mean gap", "approach", "leak rate", "k_i")]
    return [() if formats & _LISTS else None, *found] if is_optional else found


def made_in(tree):
    """Facts that a file makes: their kinds, if they are written there, and their numbers.

    The numbers are None where some are handed over together.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "Fact":
            names = [each.arg for each in node.keywords]
            yield node, None if None in names else set(names)


def words_of_source():
    """Texts that stand alone in the code, among them the kinds of facts."""
    return {
        node.value
        for path in sorted(SOURCE.rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
