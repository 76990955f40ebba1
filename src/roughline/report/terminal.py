"""What the terminal shows: progress with time left, and tables."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TaskID,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table
from rich.text import Text

from roughline.assessment.compared import Compared, compared_table, verdict
from roughline.assessment.described import Described, described_table, missing_map
from roughline.contact.curve import Status
from roughline.report.contact_tables import (
    UNRESOLVED,
    answer_table,
    curve_table,
    star_is_shown,
)
from roughline.report.page import value_and_interval
from roughline.topography.body import Body, Surface
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.pressed import Pressed
    from roughline.campaign.run import Summary
    from roughline.campaign.store import Store
    from roughline.theories.theory import TheoryCurve

_MOST_SHOWN = 200  # loads that anybody reads as a table
_MOST_ANSWERED = 3  # loads whose answers fit on a screen
_SHORTEST_NAME = 20  # columns that the name of an answer needs at least


class _Rate(ProgressColumn):
    """Steps a second, or a minute where they are slow."""

    def render(self, task: Task) -> Text:
        """Show the speed of the last while."""
        speed = task.speed or 0.0
        shown = f"{speed:.1f}/s" if speed >= 1 else f"{60 * speed:.1f}/min"
        return Text(shown if speed else "", style="progress.data.speed")


@contextmanager
def campaign_progress() -> Iterator[Callable[[str, int, int, int], None]]:
    """Show a bar for each ensemble of a campaign; gives the callback."""
    with _bars() as show:

        def progress(name: str, done: int, failed: int, total: int) -> None:
            show(f"{name}, {failed} failed" if failed else name, done, total, key=name)

        yield progress


@contextmanager
def load_progress() -> Iterator[Callable[[int, int], None]]:
    """Show a bar over the loads of one body; gives the callback."""
    with _bars() as show:
        yield lambda done, total: show("loads", done, total, key="loads")


class _Show(Protocol):
    def __call__(self, name: str, done: int, total: int, *, key: str) -> None: ...


@contextmanager
def _bars() -> Iterator[_Show]:
    """Bars by name, on standard error; nothing is drawn before the first is told of."""
    progress = Progress(
        TextColumn("{task.description:<22}"),
        BarColumn(),
        MofNCompleteColumn(),
        _Rate(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        console=Console(stderr=True),
    )
    tasks: dict[str, TaskID] = {}

    def show(name: str, done: int, total: int, *, key: str) -> None:
        if not tasks:
            progress.start()
        if key not in tasks:
            # a bar that starts half full tells its time from what is added
            tasks[key] = progress.add_task(name, total=total, completed=done)
        progress.update(tasks[key], completed=done, description=name)

    try:
        yield show
    finally:
        if tasks:
            progress.stop()


def print_pressed(pressed: Pressed) -> None:
    """Print what was pressed, its curve or its answers, and the files written."""
    console = Console()
    console.print(_described(pressed.body), highlight=False, soft_wrap=True)
    curve, pair = pressed.curve, pressed.pair
    model = "reduced model, exact" if curve.area_fraction is None else "full model"
    boundary = curve.settings.get("boundary")
    where = f", {boundary} half-space, residuals below {curve.settings['rtol']}" if boundary else ""
    of = f" of {pair.first.name} and {pair.second.name}" if pair else ""
    console.print(f"E*{of} = {engineering(curve.E_star, 'Pa')}; {model}{where}", highlight=False)
    many = pressed.asked.size > _MOST_SHOWN
    answered = pair is not None and pressed.asked.size <= _MOST_ANSWERED
    if many:
        console.print(_in_one_line(pressed), highlight=False, soft_wrap=True)
    elif answered:
        _print_table(console, *answer_table(pressed, slice(None)))  # formulas are for the report
    else:
        _print_table(console, *curve_table(pressed))
    if star_is_shown(pressed) and not many:
        console.print(f"* {UNRESOLVED}", highlight=False)
    if pair is not None and not answered:
        console.print(f"answers at more than {_MOST_ANSWERED} loads are for --json and --report")
    for failure in _failures(pressed) if not many else ():
        console.print(failure, highlight=False)
    for theory in pressed.theories:
        console.print(_theory_line(theory, pressed), highlight=False, soft_wrap=True)
    for note in pressed.notes:
        console.print(f"note: {note}", highlight=False, soft_wrap=not console.is_terminal)
    print_files(pressed.files)


def _in_one_line(pressed: Pressed) -> str:
    """Both ends of a curve that is too long for a screen."""
    curve, solved = pressed.curve, pressed.curve.converged
    text = f"{solved.size} loads"
    if solved.any():
        ends = (
            " to ".join(engineering(values[solved][end], unit) for end in (0, -1))
            for values, unit in ((curve.force, "N"), (curve.depth, "m"), (curve.stiffness, "N/m"))
        )
        text += " from {}: depth {}, stiffness {}".format(*ends)
    for status, count in Counter(curve.status[~solved].tolist()).items():
        text += f"; {count} not solved ({Status(status).reason})"
    return f"{text}; each of them: --out DIR or --json"


def _failures(pressed: Pressed) -> list[str]:
    """Say which loads were not solved, and why."""
    curve = pressed.curve
    asked = dict(zip(pressed.asked.tolist(), pressed.headings, strict=True))
    told = (
        f"load {asked.get(int(i), 'of the curve')}: {Status(curve.status[i]).reason}"
        for i in np.flatnonzero(~curve.converged)
    )
    return list(dict.fromkeys(told))  # loads of the curve alone share a line


def _theory_line(theory: TheoryCurve, pressed: Pressed) -> str:
    """A theory at the largest load."""
    text = f"{theory.name} at the largest load: area {theory.area_fraction[-1]:.3%}"
    if theory.stiffness is not None:
        stiffness = theory.stiffness[-1] * pressed.area
        text += f", interface stiffness {engineering(stiffness, 'N/m')}"
    return f"{text} ({theory.validity})"


def print_described(described: Described) -> None:
    """Print what a topography is like."""
    console = Console()
    table = Table(box=None, show_header=False)
    for row in described_table(described):
        table.add_row(*row)
    console.print(table, highlight=False)
    for line in missing_map(described):
        console.print(line, highlight=False, soft_wrap=True)
    for obstacle in described.obstacles:
        console.print(f"it cannot be pressed as it is: {obstacle}", highlight=False, soft_wrap=True)
    remarks = described.roughness.remarks if described.roughness else []
    for note in (*described.notes, *remarks):
        console.print(f"note: {note}", highlight=False, soft_wrap=True)
    print_files(described.files)


def print_compared(compared: Compared) -> None:
    """Print both curves, their difference, and where the reduced model may be trusted."""
    console = Console()
    console.print(compared.what, highlight=False, soft_wrap=True)
    console.print(_table(*compared_table(compared)))
    if not compared.comparison.resolved.all():
        console.print("* fewer than ten cells in contact: the grid decides, not the surface")
    console.print(verdict(compared), highlight=False, soft_wrap=True)
    for warning in compared.comparison.warnings:
        console.print(f"note: {warning}", highlight=False, soft_wrap=True)
    print_files(compared.files)


def print_summary(summary: Summary, store: Path) -> None:
    """Print what a campaign did, equal reasons of failures together."""
    console = Console()
    done, failed = sum(summary.done.values()), sum(summary.failed.values())
    console.print(f"{done} cases computed, {failed} failed; results in {store}", soft_wrap=True)
    if summary.unconverged:
        console.print(f"{summary.unconverged} loads did not converge: they are NaN")
    for reason, count in summary.reasons.most_common():
        console.print(f"{count} failed: {reason}", highlight=False, soft_wrap=True)


def print_status(store: Store) -> None:
    """Print what is done of a campaign, and why cases failed."""
    console = Console()
    rows = [[name, *map(str, store.counts(name))] for name in store.names]
    console.print(_table(["ensemble", "done", "failed", "in all"], rows))
    reasons = Counter(why for name in store.names for why in store.failures(name).values())
    for reason, count in reasons.most_common():
        console.print(f"{count} failed: {reason}", highlight=False, soft_wrap=True)


def _print_table(console: Console, header: list[str], rows: list[list[str]]) -> None:
    """Print a table of names and values; where it is too wide, intervals stand below values."""
    if _width(header, rows) > console.width:
        rows = [[_stacked(cell) for cell in row] for row in rows]
    table = _table(header, rows)
    table.columns[0].justify = "left"
    if _width(header, [["", *row[1:]] for row in rows]) + _SHORTEST_NAME <= console.width:
        for column in table.columns[1:]:
            column.no_wrap = True  # the names are broken in lines instead
    console.print(table)


def _stacked(cell: str) -> str:
    """A value, and its interval without brackets below it."""
    value, *interval = value_and_interval(cell)
    return "\n".join([value, *(each.strip("()") for each in interval)])


def _width(header: list[str], rows: list[list[str]]) -> int:
    """Columns of the screen that a table takes, with two between its own."""
    columns = zip(header, *rows, strict=True)
    return sum(
        2 + max(len(line) for cell in cells for line in cell.split("\n")) for cells in columns
    )


def _table(header: list[str], rows: list[list[str]]) -> Table:
    table = Table(box=None, header_style="bold", pad_edge=False, padding=(0, 2, 0, 0))
    for name in header:
        table.add_column(name, justify="right", overflow="fold")
    for row in rows:
        table.add_row(*row)
    return table


def print_files(files: Iterable[Path]) -> None:
    """Print which files were written."""
    console = Console()
    for file in files:
        console.print(f"wrote {file}", highlight=False, soft_wrap=True)


def announce(text: str) -> None:
    """Print a line on standard error."""
    Console(stderr=True).print(text, highlight=False, soft_wrap=True)


def print_generated(body: Body, file: Path) -> None:
    """Print what was generated and where it is."""
    console = Console()
    console.print(_described(body), highlight=False)
    print_files([file])


def _described(body: Body) -> str:
    if isinstance(body, Surface):
        points = f"surface of {body.shape[0]} x {body.shape[1]} points"
        size = " x ".join(engineering(size, "m") for size in body.sizes)
    else:
        points = f"line of {body.heights.size} points"
        size = engineering(body.length, "m")
    removed = body.settings.get("detrended")
    trend = f", {removed} removed" if removed else ""
    slope = f"rms slope {body.rms_slope:.3g}"
    return f"{points}, {size}; rms height {engineering(body.rms_height, 'm')}, {slope}{trend}"
