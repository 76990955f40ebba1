"""The constants of the margins, as the code has them, and the package with one of them changed.

A constant is a name in capitals at the top of a module whose value is made of numbers. What it
bounds is said beside it, above it, or in the text below it; what some of them have in common, above
the first, with a colon.
"""

import ast
import importlib.abc
import importlib.machinery
import io
import re
import sys
import tokenize
from dataclasses import dataclass
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "src" / "roughline"
MODULES = (
    "margins/*.py",
    "contact/grid_error.py",
    "contact/terraces.py",
    "fluid/one_map.py",
    "fluid/reopening.py",
    "fluid/sealing_pressure.py",
    "fluid/trials.py",
    *(f"assessment/{name}.py" for name in ("bounds", "facts", "part_facts")),
    *(f"question/{name}.py" for name in ("assumptions", "case", "extrapolation", "films", "meant")),
    "measurement/*.py",
    "statistics/bootstrap.py",
    "statistics/places.py",
)
"""Where intervals, and what is said of them, are decided."""

OF_ARGUMENTS = {"_LARGER_FACTOR"}
"""Which values of an argument are allowed; they bound no answer."""

_CAPITALS = re.compile(r"_?[A-Z][A-Z0-9_]*")
_READ, _CHANGED = "__read__", "__changed__"
_NEAR_ONE = 0.1  # from one, within which the rest to one is doubled


@dataclass(frozen=True)
class Constant:
    """A number, or several, by which margins are decided."""

    file: str  # within the package
    name: str
    value: str  # as it is written
    bounds: str  # what it bounds

    @property
    def key(self):
        return f"{self.file}:{self.name}"

    @property
    def module(self):
        return f"roughline.{self.file.removesuffix('.py').replace('/', '.')}"


def constants():
    """All constants of the margins, file by file."""
    files = dict.fromkeys(path for each in MODULES for path in sorted(SOURCE.glob(each)))
    return [each for path in files for each in _of_file(path)]


def _of_file(path):
    text, file = path.read_text("utf-8"), path.relative_to(SOURCE).as_posix()
    lines, body = text.splitlines(), ast.parse(text).body
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    notes = {
        each.start[0]: each.string.lstrip("# ") for each in tokens if each.type == tokenize.COMMENT
    }
    group, end = "", 0  # what some constants have in common, and where the last of them ends
    for node, below in zip(body, [*body[1:], None], strict=True):
        name, above = _name_of(node), _above(node, lines)
        if name is None or not _is_numeric(node.value) or name in OF_ARGUMENTS:
            continue
        if above.endswith(":"):
            group = above
        elif node.lineno != end + 1:
            group = ""
        end = node.end_lineno
        beside = " ".join(notes[i] for i in range(node.lineno, end + 1) if i in notes)
        said = f"{group} {beside}".strip() if beside else above or _text(below)
        yield Constant(file, name, ast.unparse(node.value), said)


def _above(node, lines):
    """The lines of comment right above a constant, which may be over others that they tell of."""
    first = node.lineno - 1
    while first > 0 and lines[first - 1].startswith("#"):
        first -= 1
    return " ".join(each.lstrip("# ") for each in lines[first : node.lineno - 1])


def _text(node):
    """A text that stands below a constant."""
    is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return " ".join(node.value.value.split()) if is_text else ""


def _name_of(node):
    if isinstance(node, ast.Assign) and len(node.targets) == 1:
        target = node.targets[0]
    elif isinstance(node, ast.AnnAssign) and node.value is not None:
        target = node.target
    else:
        return None
    is_capital = isinstance(target, ast.Name) and _CAPITALS.fullmatch(target.id)
    return target.id if is_capital else None


def _is_numeric(node):
    """Whether a value is made of numbers, perhaps by functions of them, or beside what they are of.

    A number within a function that is defined there is part of its law.
    """
    if isinstance(node, ast.Constant):
        return isinstance(node.value, int | float) and not isinstance(node.value, bool)
    if isinstance(node, ast.Tuple | ast.List):
        return any(map(_is_numeric, node.elts))
    if isinstance(node, ast.Call):
        is_named = ast.unparse(node.func) in ("slice", "math.log") or "np." in ast.unparse(
            node.func
        )
        return is_named and any(map(_is_numeric, node.args))
    if isinstance(node, ast.BinOp):
        return _is_numeric(node.left) or _is_numeric(node.right)
    return isinstance(node, ast.UnaryOp) and _is_numeric(node.operand)


def doubled(value):
    """A constant twice as large, and how it was changed, in words.

    A share or probability that would pass one is halved, and of a number near one the rest to one
    is doubled. Of values that are tried, there are twice as many.
    """
    import numpy as np  # here because the package is not loaded where constants are listed alone

    if isinstance(value, np.ndarray):
        places = np.linspace(0, value.size - 1, 2 * value.size - 1)
        return np.interp(places, np.arange(value.size), value), "twice as many"
    if isinstance(value, slice):
        return slice(value.start, value.stop, 2 * value.step), "× 2"
    if isinstance(value, list | tuple):
        parts = [doubled(each) for each in value]
        how = [how for _, how in parts if how]
        return type(value)(each for each, _ in parts), how[0] if how else ""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value, ""
    if isinstance(value, int) or value == 1:
        return 2 * value, "× 2"
    if abs(value - 1) < _NEAR_ONE:
        return 1 + 2 * (value - 1), "its difference from 1 × 2"
    return (value / 2, "÷ 2") if 0.5 <= value < 1 else (2 * value, "× 2")


class _Rewriting(importlib.machinery.SourceFileLoader):
    """Loads a module from its source, rewritten, and stores nothing."""

    def __init__(self, name, path, rewriter):
        super().__init__(name, path)
        self.rewriter = rewriter

    def get_code(self, fullname):
        path = self.get_filename(fullname)
        tree = self.rewriter.visit(ast.parse(self.get_data(path)))
        return compile(ast.fix_missing_locations(tree), path, "exec", dont_inherit=True)

    def exec_module(self, module):
        vars(module).update(self.rewriter.known)
        super().exec_module(module)


class _Finder(importlib.abc.MetaPathFinder):
    """Finds the modules of the package that are rewritten."""

    def __init__(self, rewriter_of):
        self.rewriter_of = rewriter_of

    def find_spec(self, fullname, path, target=None):
        rewriter = self.rewriter_of(fullname) if fullname.startswith("roughline.") else None
        if rewriter is None:
            return None
        spec = importlib.machinery.PathFinder.find_spec(fullname, path, target)
        spec.loader = _Rewriting(fullname, spec.origin, rewriter)
        return spec


class _Changer(ast.NodeTransformer):
    """Changes what a name at the top of a module is."""

    def __init__(self, name, how):
        self.name, self.known = name, {_CHANGED: lambda value: self._changed(value, how)}

    @staticmethod
    def _changed(value, how):
        found, told = doubled(value)
        how.append(told)
        return found

    def visit_Module(self, tree):
        for node in tree.body:
            if _name_of(node) == self.name:
                node.value = ast.Call(ast.Name(_CHANGED, ast.Load()), [node.value], [])
        return tree


class _Tracer(ast.NodeTransformer):
    """Tells of each use of a constant within functions and at the top, but where it is defined."""

    def __init__(self, module, keys, seen):
        self.module, self.keys = module, keys
        self.of_names = {}
        self.known = {_READ: lambda key, value: (seen.add(key), value)[1]}

    def visit_Module(self, tree):
        own = {key.rpartition(":")[2]: key for key in self.keys.get(self.module, ())}
        self.of_names |= own
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                there = {key.rpartition(":")[2]: key for key in self.keys.get(node.module, ())}
                self.of_names |= {
                    each.asname or each.name: there[each.name]
                    for each in node.names
                    if each.name in there
                }
        return self.generic_visit(tree) if self.of_names else tree

    def visit_FunctionDef(self, node):
        # compiled functions are translated as they are; annotations are no uses
        if any("compiled" in ast.unparse(each) for each in node.decorator_list):
            return node
        return self.generic_visit(node)

    def visit_Name(self, node):
        key = self.of_names.get(node.id)
        if key is None or not isinstance(node.ctx, ast.Load):
            return node
        arguments = [ast.Constant(key), node]
        return ast.copy_location(ast.Call(ast.Name(_READ, ast.Load()), arguments, []), node)


def change(constant, how):
    """Load the package with a constant changed from now on; `how` is told how."""
    changer = _Changer(constant.name, how)
    sys.meta_path.insert(0, _Finder(lambda name: changer if name == constant.module else None))


def trace(seen):
    """Load the package so that keys of constants are added to `seen` whenever they are used."""
    keys = {}
    for each in constants():
        keys.setdefault(each.module, []).append(each.key)
    sys.meta_path.insert(0, _Finder(lambda name: _Tracer(name, keys, seen)))
