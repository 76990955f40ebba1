"""What one has to open: counts of the solver and of changes, for the page on the architecture.

What a change touched is asked of the history, by its commits. A clone without history keeps the
numbers that the page has.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import grimp
from architecture import ROOT, SOURCE, import_graph, layers

PAGE = ROOT / "docs" / "architecture.md"
BEGIN, END = "<!-- counts: `make architecture` writes them -->", "<!-- end of counts -->"
SOLVER = "halfspace"

_CONSTANT = re.compile(r"_?[A-Z][A-Z0-9_]*")
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
    Change("a contact law: an uneven hardness", test="tests/halfspace/test_foreign_law.py"),
    Change("a half-space: a coating", test="tests/halfspace/test_foreign_half_space.py"),
    Change("an exact solution: a disc that yields at its rim", ("12afc3a",)),
    Change("an answer: the stiffness on unloading, before rules", ("2f9ce6e",)),
    Change("an answer: the mass that resonates", test="tests/assessment/test_foreign_rule.py"),
    Change("a field of a question: the area of a joint", ("00e2273", "d60321c")),
    Change("a command: `roughline about`", ("3ad058f",)),
    Change("file formats: text with any separator, lists of points", ("fff1072",)),
)


def files_of_one_press() -> list[Path]:
    """Return the files of roughline that have code and are open after one press in a new process.

    ``__init__.py`` is left out: those files are names of rooms.
    """
    command = [sys.executable, "-c", _ONE_PRESS]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    paths = map(Path, told.splitlines())
    return [path.relative_to(SOURCE) for path in paths if path.name != "__init__.py"]


def constants(room: Path) -> list[str]:
    """Return the constants of the modules of a room, as file and name."""
    return [
        f"{path.relative_to(SOURCE)}, {name.id}"
        for path in sorted(room.rglob("*.py"))
        for line in ast.parse(path.read_text("utf-8")).body
        if isinstance(line, ast.Assign | ast.AnnAssign)
        for target in (line.targets if isinstance(line, ast.Assign) else [line.target])
        for name in ast.walk(target)
        if isinstance(name, ast.Name) and _CONSTANT.fullmatch(name.id)
    ]


def arrows_of_the_solver(graph: grimp.ImportGraph) -> list[tuple[str, str]]:
    """Return every import between files of the solver, as (importer, imported)."""
    inside = sorted(name for name in graph.modules if name.startswith(f"roughline.{SOLVER}."))
    return [
        (name, other)
        for name in inside
        for other in sorted(graph.find_modules_directly_imported_by(name))
        if other in inside
    ]


def arrows_up(pairs: list[tuple[str, str]]) -> list[str]:
    """Return the imports of a higher room of the solver, or of one beside, by a lower one."""
    rows = layers(f"roughline.{SOLVER}")
    floor = {name: len(rows) - i for i, row in enumerate(rows) for name in row}
    return [
        f"{importer} -> {imported}"
        for importer, imported in pairs
        if (here := solver_room(importer)) != (there := solver_room(imported))
        and floor[there] >= floor[here]
    ]


def solver_room(module: str) -> str:
    """Return the room of the solver that a module lies in."""
    return module.split(".")[2]


def table_of_the_solver() -> str:
    """Return the rooms of the solver with their files, constants and imports."""
    pairs = arrows_of_the_solver(import_graph())
    lines = [
        "| room of the solver | files | constants | imports |",
        "|---|---|---|---|",
    ]
    for name in (name for row in layers(f"roughline.{SOLVER}") for name in row):
        room = SOURCE / SOLVER / name
        files = [path for path in room.rglob("*.py") if path.name != "__init__.py"]
        below = {solver_room(to) for by, to in pairs if solver_room(by) == name} - {name}
        imports = ", ".join(f"`{each}`" for each in sorted(below))
        named = f"`{SOLVER}/{name}/` | {len(files)} | {len(constants(room))}"
        lines.append(f"| {named} | {imports} |")
    apart = [pair for pair in pairs if solver_room(pair[0]) != solver_room(pair[1])]
    return "\n".join(
        [
            *lines,
            "",
            f"Its files import each other {len(pairs)} times, {len(apart)} times across rooms and "
            f"{len(arrows_up(pairs)) or 'never'} upwards. One press of a surface opens",
            f"{len(files_of_one_press())} files of the package.",
        ]
    )


def table_of_changes(kept: str) -> str:
    """Return how many files of the package changes touched; kept rows where history is missing."""
    lines = ["| added | in | files of `src/` |", "|---|---|---|"]
    for change in CHANGES:
        where = f"`{change.test}`" if change.test else ", ".join(change.commits)
        row = f"| {change.what} | {where} |"
        count = _naming(change.test) if change.test else _touched(change.commits)
        if count is None:
            lines += [line for line in kept.splitlines() if line.startswith(row)]
        else:
            lines.append(f"{row} {count} |")
    return "\n".join(lines)


def written(text: str) -> str:
    """Return a page with its counts as they are today."""
    before, _, rest = text.partition(BEGIN)
    kept, _, after = rest.partition(END)
    tables = f"{table_of_the_solver()}\n\n{table_of_changes(kept)}"
    return f"{before}{BEGIN}\n\n{tables}\n\n{END}{after}"


def _touched(commits: tuple[str, ...]) -> int | None:
    """Count the files of the package that commits touched; None where they are not known."""
    if _git("rev-parse", "--is-shallow-repository") != "false":
        return None
    names = [_git("show", "--format=", "--name-only", each, "--", "src") for each in commits]
    if None in names:
        return None
    return len({line for told in names if told for line in told.splitlines()})


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
