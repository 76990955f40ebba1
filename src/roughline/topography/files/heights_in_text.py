"""Text as a measurement: a matrix, a line scan or a list of points, with what its head states."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.errors import InputError
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.text import TextTable, read_table
from roughline.topography.files.text_head import Head, length_unit, ratio, read_head
from roughline.topography.settings import MEASURED

_IN_BRACKETS = re.compile(r"[\[(]\s*([^\])]+?)\s*[\])]")
_POINTS = re.compile(
    r"\W*(?:number of |no\.? of |num[-_ ]?)?(?:data[-_ ]?)?(?:points|samples|columns|rows|lines|"
    r"n[xy]|[xy][-_ ]?(?:points|pixels))\W+(\d+)\W*",
    re.IGNORECASE,
)
_LENGTH = re.compile(
    r"\W*(?:(?:scan|profile|traverse|measuring)[-_ ]?)?length\W+([\d.]+)\s*(\w+)\W*", re.IGNORECASE
)
_KEY_AND_VALUE = re.compile(r"\W*([^:=;,\t]+)[:=;,\t](.*)")
_ALL_UNITS = re.compile(r"(?:all |length )?units?", re.IGNORECASE)
_POSITION_UNITS = re.compile(r"(?:lateral|position|[xy])[- _]?units?", re.IGNORECASE)
_HEIGHT_UNITS = re.compile(r"(?:value|height|z)[- _]?units?", re.IGNORECASE)
_MORE_THAN_A_LIST = 6  # columns; a list of points has x, y, z and little more
_STATED_LENGTH_SHARE = 0.98  # of the length that a line scan states
_AXES = ("x", "y", "z")
_STEP_TOLERANCE = 0.15  # within which positions are one, or are on a node; of a step
_NODES_PER_POINT = 20  # of the grid, for each point of a list, at most


def read_text(path: Path, _: int | str | None, name: str) -> Measurement | None:
    """Read heights from text; None if the file is no text, or that of a program's own format."""
    table = read_table(path, name)
    if table is None:
        return None
    titles = _titles(table)
    named = _named(titles)
    rows, columns = table.rows.shape
    _refuse_fewer_points(table, name)
    head = Head() if named else read_head(table, name)
    if rows == 1:
        raise InputError(
            f"{name} has one row of numbers: it was cut short, or a line scan stands in a row; "
            "write one height, or x and z, in each line"
        )
    if head.sides is not None and not _begins_with_positions(table.rows):
        return _read_matrix(table, head, name)  # however few columns it has
    if columns == 1:
        return _measured(
            name, kind="profile", heights=head.factor * table.rows[:, 0], unit=head.unit
        )
    if columns <= len(_AXES) or named:
        return _read_points(table, titles, named, name)
    _refuse_unnamed_list(table, titles, name)
    if rows == 2:
        raise InputError(f"{name} has two rows of numbers: write a line scan as lines of x z")
    _refuse_positions_beside_heights(table.rows, name)
    return _read_matrix(table, head, name)


def _read_matrix(table: TextTable, head: Head, name: str) -> Measurement:
    """A map, or a line scan where the matrix has one column."""
    heights = table.rows[:, ::-1] if head.are_columns else table.rows.T
    if head.factor != 1:
        heights = head.factor * heights
    along = [i for i, n in enumerate(heights.shape) if n > 1]
    is_map = len(along) == 2
    settings = {"channel": head.channel} if head.channel else {}
    return _measured(
        name,
        kind="surface" if is_map else "profile",
        heights=heights if is_map else heights.ravel(),
        unit=head.unit,
        unit_of_sides=head.unit_of_sides,
        sizes=tuple(head.sides[i] for i in along) if head.sides else None,
        channel=head.channel,
        format=head.format,
        settings={"origin": MEASURED, "file": name, **settings},
    )


def _measured(name: str, **others: Any) -> Measurement:
    stated: dict[str, Any] = {"unit": None, "sizes": None, "format": "Text"}
    stated["settings"] = {"origin": MEASURED, "file": name}
    return Measurement(file=name, **stated | others)


def _read_points(
    table: TextTable, titles: list[list[str]], named: dict[str, int], name: str
) -> Measurement:
    """A line scan or a map from a list of points."""
    rows = table.rows
    order = named or dict(zip(_AXES if rows.shape[1] == 3 else ("x", "z"), range(3), strict=False))
    of_positions, unit, factor = _units_of_columns(table, titles, order, name)
    stated = {"unit": unit, "unit_of_sides": None if unit else of_positions}
    columns = {axis: rows[:, i] for axis, i in order.items()}
    if not all(np.isfinite(columns[axis]).all() for axis in columns if axis != "z"):
        raise InputError(f"{name} lists points without a position: delete them")
    x, y, z = columns["x"], columns.get("y"), columns["z"] * factor
    if y is not None and (along := _along_a_line(x, y)) is not None:
        x, y = along, None
    if y is not None:
        heights, sides = gridded_map(x, y, z, name)
        return _measured(name, kind="surface", heights=heights, sizes=sides, **stated)
    heights, positions, length = sorted_line(x, z, name)
    _refuse_shorter_scan(table, of_positions, length, name)
    return _measured(
        name, kind="profile", heights=heights, sizes=(length,), positions=positions, **stated
    )


def _along_a_line(x: Real, y: Real) -> Real | None:
    """Positions along a straight line of points; None if they are spread over a map."""
    if x[0] == x[-1] and y[0] == y[-1]:
        return None
    if _is_even(x, 1e-9) and abs(x[1] - x[0]) == 1 and x[0] in (0, 1) and len(np.unique(y)) > 2:
        return y  # the first column counts the points
    dx, dy = x - x[0], y - y[0]
    length = float(np.hypot(dx[-1], dy[-1]))  # not 0: the ends differ
    aside = np.abs(dx * dy[-1] - dy * dx[-1]).max() / length
    return (dx * dx[-1] + dy * dy[-1]) / length if aside < 1e-6 * length else None


def _titles(table: TextTable) -> list[list[str]]:
    """The titles of columns in the last line above the rows, or their names and units in two."""
    found: list[list[str]] = []
    for line in reversed(table.head[-2:]):
        text = re.sub(r"\s+([\[(])", r"\1", line.lstrip("#%!/ "))
        cells = [each.strip(' "') for each in text.strip(" ;,\t").split(table.separator)]
        if len(cells) != table.rows.shape[1] or any(re.match(r"[-+.\d]|$", cell) for cell in cells):
            break
        found.append(cells)
        if not all(length_unit(cell.strip("[]()")) for cell in cells):
            break  # these are the names
    return found


def _named(titles: list[list[str]]) -> dict[str, int]:
    """The columns that titles call x, y and z; empty if x or z is not among them."""
    for cells in titles:
        found = {
            axis: i
            for axis in _AXES
            for i, cell in enumerate(cells)
            if re.match(rf"{axis}(?![a-z])", cell, re.IGNORECASE)
        }
        if {"x", "z"} <= set(found):
            return found
    return {}


def _refuse_unnamed_list(table: TextTable, titles: list[list[str]], name: str) -> None:
    """Refuse what is no matrix of heights: columns with titles, points with more than heights."""
    if titles:
        raise InputError(
            f"{name} has titles above its columns ({', '.join(titles[-1])[:60]}): call those of "
            "positions and heights x, y and z, or delete the titles above a matrix of heights"
        )
    rows, columns = table.rows.shape
    if columns > _MORE_THAN_A_LIST or rows < columns**2:
        return
    x, y = table.rows[:, 0], table.rows[:, 1]
    if _is_grid(x, y):
        raise InputError(
            f"{name} has {columns} columns, and the first two are positions on a grid: keep x, y "
            "and z alone, or call the columns so in a line above them"
        )


def _units_of_columns(
    table: TextTable, titles: list[list[str]], order: dict[str, int], name: str
) -> tuple[str | None, str | None, float]:
    """The units of positions and of all lengths, and that of heights over it; None if not stated.

    Where that of the heights is not stated, whoever reads the file may give it.
    """
    units: dict[str, str] = {}
    for line in table.head:
        stated = _KEY_AND_VALUE.match(line)
        key, value = (each.strip(' ;,\t"') for each in stated.groups()) if stated else ("", "")
        unit = length_unit(value)
        if not unit:
            continue
        if _ALL_UNITS.fullmatch(key) or _POSITION_UNITS.fullmatch(key):
            units["x"] = unit
        if _ALL_UNITS.fullmatch(key) or _HEIGHT_UNITS.fullmatch(key):
            units["z"] = unit
    for cells in titles:
        found = {axis: _unit_in(cells[i]) for axis, i in order.items()}
        units.update({axis: unit for axis, unit in found.items() if unit})
    if not units:
        return None, None, 1.0
    if "x" not in units or ratio(units.get("y", units["x"]), units["x"]) != 1:
        listed = ", ".join(f"{axis} in {unit}" for axis, unit in units.items())
        raise InputError(
            f"{name} states units of some columns alone ({listed}), or different ones of x and y: "
            "name one unit for the positions and one for the heights above the list, or none"
        )
    if "z" not in units:
        return units["x"], None, 1.0
    return units["x"], units["x"], ratio(units["z"], units["x"])


def _unit_in(title: str) -> str | None:
    """The unit in the title of a column, such as "x [mm]", "Lateral um" or "mm"."""
    in_brackets = _IN_BRACKETS.search(title)
    candidate = in_brackets[1] if in_brackets else re.split(r"[\s/_]+", title)[-1]
    return length_unit(candidate)


def _refuse_fewer_points(table: TextTable, name: str) -> None:
    """Refuse a table that has another number of rows and columns than its head says."""
    rows, columns = table.rows.shape
    for line in table.head:
        stated = _POINTS.fullmatch(line)
        possible = (rows,) if columns <= len(_AXES) else (rows, columns, rows * columns)
        if stated and int(stated[1]) not in possible:
            raise InputError(
                f'{name} says "{line[:40]}" and has {rows} rows of {columns} numbers: it was cut '
                "short or changed; export it again"
            )


def _refuse_shorter_scan(table: TextTable, unit: str | None, length: float, name: str) -> None:
    """Refuse a line scan that is shorter than its head says."""
    for line in table.head:
        stated = _LENGTH.fullmatch(line)
        other = length_unit(stated[2]) if stated else None
        if not (stated and unit and other):
            continue
        if length < _STATED_LENGTH_SHARE * float(stated[1]) * ratio(other, unit):
            raise InputError(
                f'{name} says "{line[:40]}" and ends at {length:g} {unit}: it was cut short; '
                "export it again"
            )


def _is_even(positions: Real, tolerance: float = 0.01) -> bool:
    """Whether positions are as far apart as each other, within a share of their distance."""
    even = np.linspace(positions[0], positions[-1], positions.size)
    step = abs(even[1] - even[0])
    return bool(step > 0 and np.abs(positions - even).max() <= tolerance * step)


def _refuse_positions_beside_heights(rows: Real, name: str) -> None:
    """Refuse a matrix whose first row or column holds positions or counts, not heights."""
    for what, table in (("row", rows), ("column", rows.T)):
        first, second = table[0, 1:], table[1, 1:]
        if min(first.size, 8) == 8 and _is_even(first, 1e-4) and not _is_even(second, 1e-4):
            raise InputError(
                f"{name} has numbers that rise or fall evenly in its first {what}, as positions "
                f"do: delete that {what}, and give the sizes instead"
            )


def sorted_line(x: Real, z: Real, name: str) -> tuple[Real, Real | None, float]:
    """Return the heights of a line in order, the positions if they are uneven, and the length."""
    if x.size < 2:
        raise InputError(f"{name} lists {x.size} point: at least 2 are needed; it was cut short")
    if x[0] > x[-1]:
        x, z = x[::-1], z[::-1]
    steps = np.diff(x)
    if not (steps > 0).all():
        i = int((steps <= 0).argmax())
        raise InputError(
            f"{name} lists positions that do not rise from point to point: {x[i]:g} stands before "
            f"{x[i + 1]:g}; a line scan has each position once, in order"
        )
    if _is_even(x):
        return z, None, float((x[-1] - x[0]) / (x.size - 1) * x.size)
    return z, x, float(x[-1] - x[0])


def gridded_map(x: Real, y: Real, z: Real, name: str) -> tuple[Real, tuple[float, float]]:
    """Return the heights of a list of points on their grid, and the sides of the map.

    Nodes of the grid that the list leaves out are NaN.

    Refused are points on no regular grid, two heights at one place, and a last row that alone lacks
    its end, as in a file that was cut short.
    """
    (i, dx), (j, dy) = (_nodes(positions, name, axis) for positions, axis in ((x, "x"), (y, "y")))
    if dx == 0 or dy == 0:
        raise _irregular(name, "they have one position along a side")
    shape = (int(i.max()) + 1, int(j.max()) + 1)
    if shape[0] * shape[1] > _NODES_PER_POINT * z.size:
        raise _irregular(name, f"{z.size} points would lie on a grid of {shape[0]} x {shape[1]}")
    heights = np.full(shape, np.nan)
    heights[i, j] = z
    twice = ~((heights[i, j] == z) | np.isnan(z))
    if twice.any():
        k = int(twice.argmax())
        raise InputError(
            f"{name} lists two heights at x = {x[k]:g}, y = {y[k]:g}: delete one of them"
        )
    listed = np.zeros(shape, dtype=bool)
    listed[i, j] = True
    if not listed.all():
        _refuse_cut_list(i, j, listed, name)
    return heights, (dx * shape[0], dy * shape[1])


def _begins_with_positions(rows: Real) -> bool:
    """Whether a narrow table lists positions before its heights."""
    if rows.shape[1] not in (2, 3) or len(rows) < 3 or not np.isfinite(rows[:, :-1]).all():
        return False
    return _is_even(rows[:, 0]) or (rows.shape[1] == 3 and _is_grid(rows[:, 0], rows[:, 1]))


def _is_grid(x: Real, y: Real) -> bool:
    """Whether points lie on a regular grid, one at nearly each node."""
    try:
        (i, _), (j, _) = _nodes(x, "", "x"), _nodes(y, "", "y")
    except InputError:
        return False
    columns, rows = int(i.max()) + 1, int(j.max()) + 1
    return min(columns, rows) > 1 and x.size <= columns * rows < 1.2 * x.size


def _nodes(positions: Real, name: str, axis: str) -> tuple[Indices, float]:
    """The node of each position along an axis, from 0, and the distance of nodes."""
    values, inverse = np.unique(positions, return_inverse=True)
    gaps = np.diff(values)
    if not gaps.size:
        return np.zeros(positions.size, np.intp), 0.0
    # rounding makes gaps far smaller than the steps between columns
    is_step = gaps > _STEP_TOLERANCE * np.median(gaps[gaps > 0.1 * gaps.max()])
    column = np.concatenate([[0], np.cumsum(is_step)])
    centres = np.bincount(column, values) / np.bincount(column)
    steps = np.diff(centres)
    nodes = np.concatenate([[0], np.cumsum(np.rint(steps / np.median(steps)))])
    if nodes.size > 2:
        step = float(np.polyfit(nodes, centres, 1)[0]) if nodes[-1] else 0.0
    else:
        step = float(steps[0])
    offsets = values - centres[0] - step * nodes[column]
    if step <= 0 or (np.diff(nodes) < 1).any() or np.ptp(offsets) > 2 * _STEP_TOLERANCE * step:
        raise _irregular(name, f"positions along {axis} are {gaps.min():.3g} to {gaps.max():.3g}")
    return nodes.astype(np.intp)[column][inverse], step


def _irregular(name: str, why: str) -> InputError:
    return InputError(
        f"{name} lists points that lie on no regular grid ({why}): interpolate them to one first"
    )


def _refuse_cut_list(i: Indices, j: Indices, listed: Mask, name: str) -> None:
    """Refuse a list whose last row alone, in the order of the file, lacks its end."""
    rising = [bool((np.diff(each) >= 0).all() or (np.diff(each) <= 0).all()) for each in (i, j)]
    if not any(rising):
        return  # in no order that an instrument measures in
    slow, fast, rows = (i, j, listed) if rising[0] else (j, i, listed.T)
    others = np.delete(rows, slow[-1], axis=0)
    in_last, before = fast[slow == slow[-1]], fast[slow != slow[-1]]
    last_two = in_last if in_last.size > 1 or before.size < 2 else before
    rises = last_two.size < 2 or last_two[1] > last_two[0]
    end = rows.shape[1] - 1 if rises else 0
    if in_last[-1] != end and others.size and others[:, end].all():
        raise InputError(
            f"{name} ends within a row of its grid of {listed.shape[0]} x {listed.shape[1]} "
            "points, as a file that was cut short: export it again, or list missing points as NaN"
        )
