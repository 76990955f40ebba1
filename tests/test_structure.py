"""What keeps the code readable: no circles, no hidden imports, no room or function too large.

That imports go one way is checked by import-linter, in `make check`.
"""

import ast
import re
import tomllib
from collections import defaultdict
from pathlib import Path

import architecture
import pytest
from architecture import (
    MAY_BE_LONGER,
    MAY_HAVE_MORE,
    SOURCE,
    circles,
    import_graph,
    large_functions,
    rooms,
)

ROOT = Path(__file__).parents[1]
LARGEST_SHARE = 0.15


@pytest.fixture(scope="module")
def graph():
    return import_graph()


def test_no_room_is_much_larger_than_the_others(graph):
    """A room within a room counts for itself: the server, which knows no view, and friction.

    Friction stands on the other rooms of the half-space, of which none imports it.
    """
    lines = {name: room.lines for name, room in rooms(graph).items()}
    total = sum(lines.values())
    for within in ("lab/server", "halfspace/friction"):
        lines[within] = sum(
            len(path.read_text("utf-8").splitlines()) for path in (SOURCE / within).glob("*.py")
        )
        lines[within.partition("/")[0]] -= lines[within]
    assert not [name for name in lines if lines[name] > LARGEST_SHARE * total]


def test_no_files_import_each_other(graph):
    assert circles(graph) == []


def test_rooms_are_imported_by_statements_that_checkers_see():
    """And by no name in a text; the front door apart, whose names the types of users list.

    The modules of users that plans name are imported by these names.
    """
    hidden = {"import_module", "__import__", "resolve_name", "locate", "run_module"}
    found = [
        f"{path.relative_to(SOURCE)}, line {node.lineno}: {ast.unparse(node)}"
        for path in sorted(SOURCE.rglob("*.py"))
        if path not in (SOURCE / "__init__.py", SOURCE / "campaign/by_name.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Name | ast.Attribute | ast.alias)
        and (ast.unparse(node).split(".")[-1]).split(" ")[0] in hidden
    ]
    assert found == []


def test_no_function_is_too_large():
    assert large_functions() == []


def test_what_may_be_larger_is_larger_and_says_why(monkeypatch):
    reasons = MAY_HAVE_MORE | MAY_BE_LONGER
    for limits in ("MAY_HAVE_MORE", "MAY_BE_LONGER"):
        monkeypatch.setattr(architecture, limits, {})
    assert {each.partition(":")[0] for each in large_functions()} == {*reasons}
    assert all(reasons.values())


def test_every_file_that_the_code_reads_is_in_the_package():
    """Beside modules, of which all are."""
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    patterns = declared["tool"]["setuptools"]["package-data"]["roughline"]
    packed = {path for pattern in patterns for path in SOURCE.glob(pattern)}
    found = {path for path in SOURCE.rglob("*") if path.is_file()}
    found = {path for path in found if "__pycache__" not in path.parts}
    left_out = {path for path in found - packed if path.suffix != ".py"}
    assert sorted(path.relative_to(SOURCE).as_posix() for path in left_out) == []


def test_every_target_of_make_is_declared_once_and_its_programs_are_there():
    text = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = re.findall(r"^([a-z-]+):", text, flags=re.MULTILINE)
    assert len(targets) == len(set(targets))
    (declared,) = re.findall(r"^\.PHONY: (.*)$", text, flags=re.MULTILINE)
    assert set(declared.split()) == set(targets)
    modules = [name.replace(".", "/") + ".py" for name in re.findall(r"-m (studies\.\S+)", text)]
    named = re.findall(r"-m studies (?:reduce (\w+)|publish ([\w ]+))", text)
    modules += [f"studies/{study}/study.py" for each in named for study in " ".join(each).split()]
    for program in modules + re.findall(r"\S+/\S+\.(?:py|toml)\b", text):
        assert program == "pyproject.toml" or (ROOT / program).is_file(), program


_SHOWN_OR_STORED = ("report/", "topography/files/netcdf.py")
_OTHER_SETTINGS = ("lab/server/", "cli/lab.py")  # those of the server


def _reads_of_settings(tree):
    """Uses of the settings of a body, a curve or a law, but for copies of all of them."""
    parents = {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}
    for node in ast.walk(tree):
        if not isinstance(node, ast.Attribute) or node.attr != "settings":
            continue
        parent = parents[node]
        if isinstance(parent, ast.IfExp) and parent.test is not node:
            parent = parents[parent]
        is_copied = (
            isinstance(parent, ast.Dict)
            or (isinstance(parent, ast.Attribute) and parent.attr == "items")
            or (isinstance(parent, ast.keyword) and parent.arg == "settings")
            or (isinstance(parent, ast.Call) and ast.unparse(parent.func) == "as_body")
        )
        if not is_copied:
            yield parent


def test_settings_decide_nothing():
    """They are for people: only what writes or shows them looks a single one up."""
    found = [
        f"{name}, line {node.lineno}: {ast.unparse(node)}"
        for path in sorted(SOURCE.rglob("*.py"))
        if not (name := path.relative_to(SOURCE).as_posix()).startswith(
            _SHOWN_OR_STORED + _OTHER_SETTINGS
        )
        for node in _reads_of_settings(ast.parse(path.read_text("utf-8")))
    ]
    assert found == []


@pytest.mark.parametrize(
    ("line", "is_read"),
    [
        ('body.settings["tilt"]', True),
        ('body.settings.get("tilt")', True),
        ('"tilt" in curve.settings', True),
        ("known = body.settings", True),
        ("Instrument.of(body.settings)", True),
        ("replace(body, settings={**body.settings, **more})", False),
        ("Line(heights, 1.0, settings=body.settings)", False),
        ("as_body(body.settings)", False),
    ],
)
def test_every_way_to_look_a_setting_up_is_seen(line, is_read):
    assert bool(list(_reads_of_settings(ast.parse(line)))) is is_read


_NOT_GENITIVES = {"fluid_of"}  # public
_BARE_WORDS = {
    *("ALIKE", "ALL", "AROUND", "BEYOND", "CLOSE", "EDGE", "EVEN", "FAR", "FARTHEST", "FEW"),
    *("FEWEST", "FINE", "FURTHER", "KEPT", "STRAINED"),
    *("LARGE", "LARGEST", "LEAST", "LONGER", "LONGEST", "MANY", "MORE", "MOST", "MUCH", "NEAR"),
    *("NEARER", "NEAREST", "ROUNDING", "SAME", "SHORTEST", "SMALL", "SMALLEST", "STEEP"),
}


def _riddles(tree):
    """Functions that are named as genitives, and constants that say no quantity."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            name = node.name.lstrip("_")
            if re.match("of_|.*_of$", name) and name not in _NOT_GENITIVES:
                yield node.name
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            for target in targets:
                for each in ast.walk(target):
                    name = each.id.lstrip("_") if isinstance(each, ast.Name) else ""
                    if name in _BARE_WORDS or name.startswith("OF_"):
                        yield each.id


def test_names_say_what_a_function_gives_and_what_a_constant_bounds():
    found = [
        f"{path.relative_to(SOURCE).as_posix()}: {riddle}"
        for path in sorted(SOURCE.rglob("*.py"))
        for riddle in _riddles(ast.parse(path.read_text("utf-8")))
    ]
    assert found == []


@pytest.mark.parametrize(
    ("line", "is_riddle"),
    [
        ("def of_places(): ...", True),
        ("def _of_yield(): ...", True),
        ("def steepening_of(): ...", True),
        ("def fluid_of(): ...", False),
        ("def work_of_adhesion(): ...", False),
        ("_LEAST = 8", True),
        ("_LEAST, _MOST = 1e-40, 1e40", True),
        ("_OF_HARDNESS: float = 0.4", True),
        ("_FEWEST_POINTS = 8", False),
        ("largest = max(values)", False),
    ],
)
def test_every_kind_of_riddle_is_seen(line, is_riddle):
    assert bool(list(_riddles(ast.parse(line)))) is is_riddle


_EXPLAINED = {
    *("alike", "bare", "beyond", "borne", "felt", "judged", "kept", "missed", "said", "sought"),
    *("told", "untold"),
}


def _words_in_names(tree):
    """Words of the names of functions, classes, arguments, variables and fields."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            name = node.name
        elif isinstance(node, ast.arg):
            name = node.arg
        elif isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Store):
            name = node.id if isinstance(node, ast.Name) else node.attr
        else:
            continue
        yield from re.sub("(?<=[a-z])(?=[A-Z])", "_", name).lower().split("_")


def test_words_that_say_no_quantity_stand_in_their_list():
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    _, _, listed = text.partition("Words that have one meaning in the code:")
    known = re.findall(r"^\| (.*?) \|", listed.partition("\n## ")[0], flags=re.MULTILINE)
    found = {
        word
        for path in SOURCE.rglob("*.py")
        for word in _words_in_names(ast.parse(path.read_text("utf-8")))
    }
    assert len(known) == len(set(known))
    assert (found & _EXPLAINED) - {word for each in known for word in each.split(", ")} == set()


_WRITTEN_BY_HAND = ("src", "tests", "benchmarks", "studies", "docs")


def _starred_literals(tree):
    """Arguments that a call is given by their places in a literal."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            for each in node.args:
                is_literal = isinstance(each, ast.Starred) and isinstance(
                    each.value, ast.Tuple | ast.List
                )
                if is_literal:
                    yield node


def test_no_arguments_hide_in_a_starred_literal():
    found = [
        f"{path.relative_to(ROOT).as_posix()}, line {node.lineno}"
        for folder in _WRITTEN_BY_HAND
        for path in sorted((ROOT / folder).rglob("*.py"))
        for node in _starred_literals(ast.parse(path.read_text("utf-8")))
    ]
    assert found == []


@pytest.mark.parametrize(
    ("line", "is_starred"),
    [
        ('Quantity(*("t", "s"), "time")', True),
        ('invoke("press", *["--load", load])', True),
        ('invoke("press", *options)', False),
        ('Quantity(symbol="t", unit="s")', False),
        ('HEADER = (*("t", "F"), *others)', False),
    ],
)
def test_every_starred_literal_in_a_call_is_seen(line, is_starred):
    assert bool(list(_starred_literals(ast.parse(line)))) is is_starred


_EACH_ITS_OWN = {"Real"}  # `exact` imports no other room, so that it names this array type again


def _names_of_types(tree):
    """Classes, and types that a module names; a leading underscore makes no other name."""
    classes = [node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef)]
    named = [
        target.id
        for node in tree.body
        if isinstance(node, ast.Assign) and not _is_type_variable(node)
        for target in node.targets
        if isinstance(target, ast.Name) and re.match("_*[A-Z]+[a-z]", target.id)
    ]
    return {name.lstrip("_") for name in classes + named}


def _is_type_variable(node):
    return isinstance(node.value, ast.Call) and ast.unparse(node.value.func) == "TypeVar"


def _type_variables(tree):
    found = (node for node in tree.body if isinstance(node, ast.Assign) and _is_type_variable(node))
    return {node.targets[0].id.lstrip("_") for node in found}


def test_the_name_of_a_class_has_one_meaning():
    """Type variables stand for any type, and may share a name with each other, not with a class."""
    trees = {
        path.relative_to(SOURCE).as_posix(): ast.parse(path.read_text("utf-8"))
        for path in sorted(SOURCE.rglob("*.py"))
    }
    homes = defaultdict(list)
    for file, tree in trees.items():
        for name in _names_of_types(tree):
            homes[name].append(file)
    variables = {name for tree in trees.values() for name in _type_variables(tree)}
    twice = {name: files for name, files in homes.items() if len(files) > 1}
    assert {name: twice[name] for name in twice.keys() - _EACH_ITS_OWN} == {}
    assert variables & homes.keys() == set()


@pytest.mark.parametrize(
    ("lines", "names"),
    [
        ("class Case: ...", {"Case"}),
        ("class _Case: ...", {"Case"}),
        ("def judged():\n    class _Case: ...", {"Case"}),
        ("Case = tuple[float, float]", {"Case"}),
        ('_Case = Literal["free", "periodic"]', {"Case"}),
        ('InCase = NewType("InCase", Indices)', {"InCase"}),
        ('_Case = TypeVar("_Case")', set()),
        ("_CASES = 8", set()),
        ("E_star = 1.0", set()),
    ],
)
def test_every_kind_of_named_type_is_seen(lines, names):
    assert _names_of_types(ast.parse(lines)) == names
