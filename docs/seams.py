"""What one has to open: counts of the solver and of changes, for the page on the architecture.

What a change touched is asked of the history, by its commits. A clone without history keeps the
numbers that the file has.
"""

from __future__ import annotations

import ast
import csv
import io
import re
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import grimp
from architecture import ROOT, SOURCE, import_graph, layers

PAGE = ROOT / "docs" / "architecture.md"
FILE = ROOT / "docs" / "data" / "architecture" / "changes.csv"
BEGIN, END = "<!-- counts: `make architecture` writes them -->", "<!-- end of counts -->"
SOLVER = "halfspace"

_ONE_PRESS = """
import sys
import numpy as np
import roughline as rl
rl.press(rl.Surface(np.eye(8), (1.0, 1.0)), E_star=1.0, depths=[0.5])
for name, module in sorted(sys.modules.items()):
    if name.partition(".")[0] == "roughline":
        print(module.__file__)
"""


@dataclass(frozen=True)
class Change:
    """Something that was added, by commits or by a test that needs none.

    Attributes
    ----------
    what : str
        What was added.
    commits : tuple of str
        Commits that added it.
    test : str
        Or the test that defines it, with nothing of it in the package.
    """

    what: str
    commits: tuple[str, ...] = ()
    test: str = ""


CHANGES = (
    Change("a contact law: yield, before laws were a room", ("87d841c",)),
    Change("a contact law: adhesion, its first form", ("b30579f6",)),
    Change("adhesion made whole in the solver", ("f2dff3f7",)),
    Change("layers, strips and creep; adhesion in questions and answers", ("faad8e04",)),
    Change("the flow of a fluid through the gap", ("54b6e958",)),
    Change("a fluid in questions and answers", ("330846d6",)),
    Change("the pressure that seals", ("5c82a720",)),
    Change("a fluid in Explore, before physics were declared", ("2612a566",)),
    Change("a layer in Explore, with the declaration of physics", ("31eba658",)),
    Change("a contact law: an uneven hardness", test="tests/halfspace/test_foreign_law.py"),
    Change("a half-space: a coating", test="tests/halfspace/test_foreign_half_space.py"),
    Change("an exact solution: a disc that yields at its rim", ("12afc3a",)),
    Change("an answer: the stiffness on unloading, before rules", ("2f9ce6e",)),
    Change("an answer: the mass that resonates", test="tests/assessment/test_foreign_rule.py"),
    Change("a field of a question: the area of a joint", ("00e2273", "d60321c")),
    Change("a command: `roughline about`", ("3ad058f",)),
    Change("file formats: text with any separator, lists of points", ("fff1072",)),
    Change("pictures and tasks loaded by statements, not by texts", ("12ddc21b",)),
)


def files_of_one_press() -> list[Path]:
    """Return the files of roughline that have code and are open after one press in a new process.

    ``__init__.py`` is left out: those files are names of rooms.
    """
    command = [sys.executable, "-c", _ONE_PRESS]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    paths = map(Path, told.splitlines())
    return [path.relative_to(SOURCE) for path in paths if path.name != "__init__.py"]


def arrows_of_the_solver(graph: grimp.ImportGraph) -> list[tuple[str, str]]:
    """Return every import between files of the solver, as (importer, imported)."""
    inside = sorted(name for name in graph.modules if name.startswith(f"roughline.{SOLVER}."))
    return [
        (name, other)
        for name in inside
        for other in sorted(graph.find_modules_directly_imported_by(name))
        if other in inside
    ]


def solver_room(module: str) -> str:
    """Return the room of the solver that a module lies in."""
    return module.split(".")[2]


def table_of_the_solver() -> str:
    """Return the rooms of the solver with their files, constants and imports."""
    pairs = arrows_of_the_solver(import_graph())
    lines = ["| room of the solver | files | imports |", "|---|---|---|"]
    for name in (name for row in layers(f"roughline.{SOLVER}") for name in row):
        room = SOURCE / SOLVER / name
        files = [path for path in room.rglob("*.py") if path.name != "__init__.py"]
        below = {solver_room(to) for by, to in pairs if solver_room(by) == name} - {name}
        imports = ", ".join(f"`{each}`" for each in sorted(below))
        lines.append(f"| `{SOLVER}/{name}/` | {len(files)} | {imports} |")
    opened = len(files_of_one_press())
    return "\n".join([*lines, "", f"One press of a surface opens {opened} files of the package."])


def changes() -> str:
    """Return the files and lines that changes touched, as CSV; kept rows without a history."""
    kept = {(row[0], row[1]): row for row in csv.reader(FILE.read_text("utf-8").splitlines())}
    rows = [["added", "in", "files of src/", "lines by room"]]
    for change in CHANGES:
        where = change.test or ", ".join(change.commits)
        counts = (str(_naming(change.test)), "") if change.test else _touched(change.commits)
        rows.append(kept[change.what, where] if counts is None else [change.what, where, *counts])
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def written(text: str) -> str:
    """Return a page with its counts as they are today."""
    before, _, rest = text.partition(BEGIN)
    after = rest.partition(END)[2]
    return f"{before}{BEGIN}\n\n{table_of_the_solver()}\n\n{END}{after}"


def _touched(commits: tuple[str, ...]) -> tuple[str, str] | None:
    """Tell the files of the package that commits touched, and lines by room; None if unknown."""
    if _git("rev-parse", "--is-shallow-repository") != "false":
        return None
    files: set[str] = set()
    added, removed = Counter[str](), Counter[str]()
    for commit in commits:
        # a file that moved is one that went and one that came, whatever git is set to
        told = _git("show", "--format=", "--numstat", "--no-renames", commit, "--", "src/roughline")
        if told is None:
            return None
        for line in told.splitlines():
            plus, minus, path = line.split("\t")
            room = PurePosixPath(path).relative_to("src/roughline").parts[0].partition(".")[0]
            room = room.replace("__init__", "front door")
            files.add(path)
            added[room] += int(plus) if plus != "-" else 0  # which is said of what is no text
            removed[room] += int(minus) if minus != "-" else 0
    rooms = sorted(added, key=lambda room: (-added[room], room))
    lines = (
        f"{room} +{added[room]}" + (f" −{removed[room]}" if removed[room] else "") for room in rooms
    )
    return str(len(files)), ", ".join(lines)


def _git(*arguments: str) -> str | None:
    """Return what git says, or None where it knows nothing."""
    try:
        done = subprocess.run(
            ["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True
        )
    except (OSError, subprocess.CalledProcessError):
        return None
    return done.stdout.strip()


def _naming(test: str) -> int:
    """Count the files of the package that name what a test adds: a class of ours, or a rule."""
    names = [
        name
        for each in ast.walk(ast.parse((ROOT / test).read_text("utf-8")))
        for name in _added(each)
    ]
    if not names:
        raise ValueError(f"{test} derives no class from one of rl, and makes no rl.Rule")
    found = re.compile(rf"\b({'|'.join(names)})\b")
    return sum(bool(found.search(path.read_text("utf-8"))) for path in SOURCE.rglob("*.py"))


def _added(node: ast.AST) -> list[str]:
    """The name of a class that derives from one of ours, or the key of a rule."""
    if isinstance(node, ast.ClassDef) and any(
        ast.unparse(base).startswith("rl.") for base in node.bases
    ):
        return [node.name]
    if isinstance(node, ast.Call) and ast.unparse(node.func) == "rl.Rule":
        return [ast.literal_eval(each.value) for each in node.keywords if each.arg == "key"]
    return []
