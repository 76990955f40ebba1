"""Results as named arrays and texts: flattened, masked, kept and compared."""

import enum
import functools
import hashlib
import inspect
import json
import re
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from itertools import repeat, takewhile
from pathlib import Path

import attrs
import numpy as np

import roughline as rl

_PICTURE = re.compile(r"base64,([A-Za-z0-9+/=]+)")
# names of parts that are no answers, or that a value holds itself in: the material of its surface,
# the interface of a half-space
_INSIDE = {"band", "interface", "materials", "surface"}
_WORK = "convolutions"  # the name of what answers take, which may change
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_OF_THE_RUN = {"seconds", "core_seconds", "started", "cores"}  # names whose values are times
_OF_A_MOMENT = (  # texts that differ from run to run
    (re.compile(r"^.*(━|\d:\d\d:\d\d left).*\n?", re.MULTILINE), ""),
    (re.compile(r"[^\s'\"]*/recorder-\w+"), "FOLDER"),
    (re.compile(r"dashboard: \S+"), "dashboard: ADDRESS"),
    (re.compile(r"\b(about|GB and) \S+ (s|min|h)\b"), r"\1 TIME"),
    (re.compile(r"\b20\d\d-\d\d-\d\d\b"), "DATE"),
)


def flat(value, place=""):
    """Name every number and text in a value by its place; gives arrays by name."""
    if (is_dataclass(value) or attrs.has(type(value))) and not isinstance(value, type):
        value = _attributes(value)
    elif hasattr(value, "data_vars"):
        value = _of_dataset(value)
    if isinstance(value, enum.Enum):
        value = value.value
    if isinstance(value, Mapping):
        parts = {str(key): item for key, item in value.items()}
    elif isinstance(value, list | tuple) and not _is_vector(value):
        parts = {str(i): item for i, item in enumerate(value)}
    else:
        return {place: _leaf(value, place)}
    found = {} if parts else {place: np.array("nothing")}
    for name, item in parts.items():
        found |= flat(item, f"{place}/{name}" if place else name)
    return found


def _attributes(value):
    kept_in = fields(value) if is_dataclass(value) else attrs.fields(type(value))
    names = [each.name for each in kept_in]
    kinds = property | functools.cached_property
    names += [name for name, _ in inspect.getmembers(type(value), lambda m: isinstance(m, kinds))]
    found = {}
    for name in names:
        if not name.startswith("_") and name not in _INSIDE:
            try:
                found[name] = getattr(value, name)
            except rl.RoughlineError as error:
                found[name] = f"{type(error).__name__}: {error}"
    return found


def _of_dataset(data):
    variables = {
        str(name): {
            "dims": " ".join(map(str, variable.dims)),
            "values": variable.values,
            **{f"attr {key}": item for key, item in variable.attrs.items()},
        }
        for name, variable in data.variables.items()
    }
    return {"variables": variables, "attributes": dict(data.attrs)}


def _is_vector(values):
    return len({type(each) for each in values}) == 1 and isinstance(values[0], float | int)


def _leaf(value, place):
    if value is None:
        return np.array("None")
    array = np.array(str(value) if isinstance(value, Path) else value)
    if array.dtype.kind == "O":
        array = array.astype(str)
    if array.dtype.kind not in "biufU":
        raise TypeError(f"{place} is a {type(value).__name__}, which is not recorded")
    return array


def masked(values, paths=()):
    """Replace what is of this run or machine: times, dates, addresses, versions, given paths."""
    found = {}
    for name, array in values.items():
        if _OF_THE_RUN & set(name.split("/")):
            array = np.array("TIME")
        elif array.dtype.kind == "U":
            array = np.array([_masked_text(text, paths) for text in array.ravel().tolist()])
            array = array.reshape(values[name].shape)
        found[name] = array
    return found


def _masked_text(text, paths):
    for path, name in paths:
        text = text.replace(str(path), name)
    text = text.replace(rl.__version__, "VERSION")
    for pattern, name in _OF_A_MOMENT:
        text = pattern.sub(name, text)
    return text


def contents(folder):
    """All files below a folder by their names, decoded."""
    folder, found = Path(folder), {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder)).replace("/", " > ")
        if path.is_file():
            found[name] = _decoded(path)
        elif path.suffix == ".zarr":
            found[f"{name} decoded"] = _of_zarr(path)
    return found


def _decoded(path):
    if path.suffix == ".nc":
        import xarray

        with xarray.open_dataset(path, decode_cf=False) as data:
            return _of_dataset(data.load())
    if path.suffix == ".json":
        return json.loads(path.read_text(encoding="utf-8"))
    if path.suffix == ".log":
        return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    if path.suffix in (".csv", ".txt", ".md", ".toml"):
        return path.read_bytes().decode("utf-8")
    if path.suffix == ".html":
        page = path.read_text(encoding="utf-8")
        return _PICTURE.sub(lambda found: _digest(found[1].encode()), page)
    data = path.read_bytes()
    if b"ReportLab" in data:  # carries the time and is compressed
        return {"pages": data.count(b"/Type /Page\n")}
    return _digest(data)


def _of_zarr(path):
    import zarr

    root, found = zarr.open_group(path, mode="r", use_consolidated=False), {}
    for name, member in [("root", root), *root.members(max_depth=None)]:
        found[f"{name.replace('/', ' > ')} attributes"] = dict(member.attrs)
        if hasattr(member, "dtype"):
            found[name.replace("/", " > ")] = member[...]
    return found


def _digest(data):
    return f"{len(data)} bytes, sha256 {hashlib.sha256(data).hexdigest()}"


def keep(values, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("wb") as file:
        numbered = {f"v{i}": array for i, array in enumerate(values.values())}
        np.savez_compressed(file, names=np.array(list(values)), **numbered)


def kept(path):
    with np.load(path, allow_pickle=False) as stored:
        return {str(name): stored[f"v{i}"] for i, name in enumerate(stored["names"])}


def differences(first, second, rtol=None):
    """List how two sets of named arrays differ, as (kind, name, how).

    With a tolerance, or the one that was asked for where that is larger, values that agree to it
    are of the kind "bits", and convolutions of the kind "work".
    """
    if rtol is not None:
        asked = [float(values) for name, values in first.items() if name.endswith("/rtol")]
        rtol = max([rtol, *asked])
    found = []
    for name in dict.fromkeys([*first, *second]):
        if name not in second:
            found.append(("lost", name, f"was {_shown(first[name])}"))
        elif name not in first:
            found.append(("new", name, f"is {_shown(second[name])}"))
        elif how := _difference(first[name], second[name]):
            # where the bodies touch everywhere, a gap is compared with what moves
            moved = first.get(name.replace("/gap", "/displacement"), first[name])
            kind = _kind(name, first[name], second[name], rtol, moved)
            found.append((kind, name, how))
    return found


def _kind(name, before, after, rtol, scale):
    """Of what kind a difference is."""
    texts = "U" in (before.dtype.kind, after.dtype.kind)
    if rtol is not None and before.dtype.kind == after.dtype.kind and before.shape == after.shape:
        if _WORK in name:
            return "work"
        if _agree(name, before, after, rtol, scale):
            return "bits"
    return "text" if texts else "number"


def _agree(name, before, after, rtol, scale):
    """Whether values agree to a part of the largest; of residuals, whether those fit that did."""
    if before.dtype.kind == "U":
        return "residual" in name or all(map(_texts_agree, before.flat, after.flat, repeat(rtol)))
    finite = np.isfinite(before)
    if before.dtype.kind != "f" or (finite != np.isfinite(after)).any():
        return False
    before, after = before[finite], after[finite]
    if "residual" in name:
        return bool(((before <= rtol) == (after <= rtol)).all())
    largest = max(abs(values[np.isfinite(values)]).max(initial=0.0) for values in (before, scale))
    return bool((abs(after - before) <= rtol * largest).all())


def _texts_agree(before, after, rtol):
    """Whether two texts differ in numbers only, and those agree."""
    numbers = [np.array(_NUMBER.findall(text), dtype=float) for text in (before, after)]
    words = [_NUMBER.sub("#", text) for text in (before, after)]
    return words[0] == words[1] and np.allclose(*numbers, rtol=rtol, atol=0.0)


def _difference(before, after):
    """How two arrays differ; empty if they are equal bit for bit, or both NaN."""
    if before.shape != after.shape:
        return f"shape {before.shape} became {after.shape}"
    if before.dtype.kind == "U" and after.dtype.kind == "U":
        if (before == after).all():
            return ""
        return _text_difference("\n".join(before.ravel()), "\n".join(after.ravel()))
    if before.dtype != after.dtype:
        return f"{before.dtype} {_shown(before)} became {after.dtype} {_shown(after)}"
    equal = _bits(before) == _bits(after)
    if before.dtype.kind == "f":
        equal |= np.isnan(before) & np.isnan(after)
    if equal.all():
        return ""
    one = tuple(np.argwhere(~equal)[0])
    count = f"{np.count_nonzero(~equal)} of {equal.size} values, the first of them "
    return f"{count if equal.size > 1 else ''}{before[one]!s} became {after[one]!s}"


def _bits(array):
    # a scalar would come back with one axis
    return np.ascontiguousarray(array).view(f"u{array.itemsize}").reshape(array.shape)


def _text_difference(before, after):
    lines, others = before.splitlines(), after.splitlines()
    for i, (line, other) in enumerate(zip(lines, others, strict=False)):
        if line != other:
            same = zip(line, other, strict=False)
            start = max(0, sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], same)) - 30)
            shown = f"{line[start : start + 110]!r} became {other[start : start + 110]!r}"
            return shown if len(lines) == 1 else f"line {i + 1}: {shown}"
    more = [*lines[len(others) :], *others[len(lines) :]]
    return (
        f"{len(lines)} lines became {len(others)}; the first further one is {(more or [''])[0]!r}"
    )


def _shown(array):
    text = " ".join(str(array).split())
    return text if len(text) <= 100 else f"{text[:97]}..."
