"""What the code says of its own architecture: rooms, layers, imports, and the figures of both.

A room is a package or a module at the top of roughline whose name has no underscore; a file belongs
to the room that it lies in. Imports for types alone count as all others do.
"""

from __future__ import annotations

import ast
import json
import tomllib
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import grimp
from scipy import sparse
from scipy.sparse.csgraph import connected_components

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "roughline"
PICTURE = ROOT / "docs" / "figures" / "architecture.svg"

LONGEST_FUNCTION = 60
MOST_PARAMETERS = 7
MAY_HAVE_MORE = {
    "contact/press.py, press": "one for each thing that may be asked of a contact (decision 27)",
    "contact/estimates.py, estimate": "one for each of these that takes memory or time",
}
MAY_BE_LONGER = {
    "contact/estimates.py, estimate": "its docstring says what each of its parameters is",
    "contact/press.py, press": "its docstring says what each of its parameters is",
    "creep/press_creep.py, press_creep": "its docstring says on which principle it rests",
}
"""Functions that are over a limit, and why."""


@dataclass(frozen=True)
class Room:
    """One room: its files, its lines of code and the rooms that it imports."""

    files: int
    lines: int
    imports: tuple[str, ...]


def layers(container: str = "roughline") -> list[list[str]]:
    """Return the rooms of each layer, the highest first, as pyproject.toml allows their imports."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    rows = next(
        each["layers"]
        for each in contracts["contracts"]
        if each["type"] == "layers" and each["containers"] == [container]
    )
    return [[name.strip() for name in row.split("|")] for row in rows]


def import_graph() -> grimp.ImportGraph:
    """Return every import between files, also those inside functions and those for types."""
    return grimp.build_graph("roughline", cache_dir=None)


def rooms(graph: grimp.ImportGraph) -> dict[str, Room]:
    """Return the rooms by name; the doors and the version at the top are none."""
    files: dict[str, list[Path]] = {}
    for path in _source_files():
        files.setdefault(path.relative_to(SOURCE).parts[0].removesuffix(".py"), []).append(path)
    imports: dict[str, set[str]] = {name: set() for name in files}
    for importer, imported in _imports(graph):
        here, there = _room_of(importer), _room_of(imported)
        if here != there and here in files and there in files:
            imports[here].add(there)
    return {
        name: Room(len(paths), sum(map(_lines, paths)), tuple(sorted(imports[name])))
        for name, paths in sorted(files.items())
    }


def arrows(found: dict[str, Room]) -> list[tuple[str, str]]:
    """Return every import of one room by another, as (importer, imported)."""
    return [(name, other) for name, room in found.items() for other in room.imports]


def circles(graph: grimp.ImportGraph) -> list[list[str]]:
    """Return the groups of files that import each other, directly or on a detour."""
    names = sorted(graph.modules)
    numbers = {name: i for i, name in enumerate(names)}
    pairs = [(numbers[a], numbers[b]) for a, b in _imports(graph)]
    ends = tuple(zip(*pairs, strict=True))
    matrix = sparse.csr_array(([1] * len(pairs), ends), shape=(len(names), len(names)))
    _, group = connected_components(matrix, connection="strong")
    members: dict[int, list[str]] = {}
    for name, number in zip(names, group, strict=True):
        members.setdefault(number, []).append(name)
    return [each for each in members.values() if len(each) > 1]


def large_functions() -> list[str]:
    """Return the functions with more lines or parameters than a function may have.

    The options of a command are the parameters of its function, which may be larger. Others that
    may have more are named in :data:`MAY_HAVE_MORE`, with the reason.
    """
    return [
        f"{where}: {_length(function)} lines, {_parameters(function)} parameters"
        for path in _source_files()
        for function in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(function, ast.FunctionDef) and not _is_command(path, function)
        for where in [f"{path.relative_to(SOURCE)}, {function.name}"]
        if (_length(function) > LONGEST_FUNCTION and where not in MAY_BE_LONGER)
        or (_parameters(function) > MOST_PARAMETERS and where not in MAY_HAVE_MORE)
    ]


def facts(graph: grimp.ImportGraph) -> dict[str, Any]:
    """Return what a picture of the rooms shows, as JSON has it."""
    found = {name: asdict(room) for name, room in rooms(graph).items()}
    return json.loads(json.dumps({"layers": layers(), "rooms": found}))


def facts_in(picture: Path) -> dict[str, Any]:
    """Return the facts that a picture was drawn from."""
    described = ElementTree.parse(picture).iter("{http://purl.org/dc/elements/1.1/}description")
    return json.loads(next(described).text or "")


def figures() -> str:
    """Return the figures of the architecture, one on a line."""
    graph = import_graph()
    found = rooms(graph)
    total = sum(room.lines for room in found.values())
    largest = max(found, key=lambda name: found[name].lines)
    counted = {
        f"functions over {LONGEST_FUNCTION} lines or {MOST_PARAMETERS} parameters": (
            large_functions()
        ),
        "circles of imports": [", ".join(each) for each in circles(graph)],
    }
    lines = [
        f"{len(found)} rooms, {sum(room.files for room in found.values())} files, {total} lines",
        f"{len(arrows(found))} arrows between rooms",
        f"largest room: {largest}, {found[largest].lines / total:.1%} of the lines",
    ]
    for what, which in counted.items():
        lines += [f"{len(which)} {what}", *(f"    {each}" for each in which)]
    return "\n".join(lines)


def _source_files() -> list[Path]:
    return sorted(path for path in SOURCE.rglob("*.py") if path.parent != SOURCE or _is_room(path))


def _is_room(path: Path) -> bool:
    return not path.stem.startswith("_")


def _imports(graph: grimp.ImportGraph) -> list[tuple[str, str]]:
    return [
        (importer, imported)
        for importer in sorted(graph.modules)
        for imported in sorted(graph.find_modules_directly_imported_by(importer))
    ]


def _room_of(module: str) -> str:
    return module.partition(".")[2].partition(".")[0]


def _lines(path: Path) -> int:
    return len(path.read_text("utf-8").splitlines())


def _length(function: ast.FunctionDef) -> int:
    """Lines of a function, without the examples at the end of its docstring."""
    told = ast.get_docstring(function, clean=False) or ""
    examples = told.partition("    Examples\n    --------\n")[2]
    written = (function.end_lineno or function.lineno) - function.lineno + 1
    return written - (3 + examples.count("\n") if examples else 0)  # and the heading


def _parameters(function: ast.FunctionDef) -> int:
    given = function.args
    names = [each.arg for each in (*given.posonlyargs, *given.args, *given.kwonlyargs)]
    rest = (given.vararg is not None) + (given.kwarg is not None)
    return len([name for name in names if name not in ("self", "cls")]) + rest


def _is_command(path: Path, function: ast.FunctionDef) -> bool:
    return path.parent.name == "cli" and not function.name.startswith("_")
