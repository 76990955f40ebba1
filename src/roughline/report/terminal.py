"""What the terminal shows: progress with time left, and tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table

from roughline.quantities import engineering
from roughline.report.pressed import Pressed, curve_table
from roughline.topography import Body, Surface

_STAGES = {
    "gallery": "surfaces to look at",
    "reduced": "reduced model, lines",
    "full": "full model, surfaces",
}


@contextmanager
def study_progress() -> Iterator[Callable[[str, int, int], None]]:
    """Show a bar for each stage of a study; gives the callback."""
    with _bars() as show:
        yield lambda stage, done, total: show(_STAGES[stage], done, total)


@contextmanager
def load_progress() -> Iterator[Callable[[int, int], None]]:
    """Show a bar over the loads of one body; gives the callback."""
    with _bars() as show:
        yield lambda done, total: show("loads", done, total)


@contextmanager
def _bars() -> Iterator[Callable[[str, int, int], None]]:
    """Bars by name, on standard error; nothing is drawn before the first is told of."""
    progress = Progress(
        TextColumn("{task.description:<22}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        console=Console(stderr=True),
    )
    tasks: dict[str, TaskID] = {}

    def show(name: str, done: int, total: int) -> None:
        if not tasks:
            progress.start()
        if name not in tasks:
            tasks[name] = progress.add_task(name, total=total)
        progress.update(tasks[name], completed=done)

    try:
        yield show
    finally:
        if tasks:
            progress.stop()


def print_pressed(pressed: Pressed) -> None:
    """Print what was pressed, its curve and the files written."""
    console = Console()
    console.print(_described(pressed.body), highlight=False)
    curve = pressed.curve
    model = "reduced model, exact" if curve.area_fraction is None else "full model"
    boundary = curve.settings.get("boundary")
    where = f", {boundary} half-space, residuals below {curve.settings['rtol']}" if boundary else ""
    console.print(f"E* = {engineering(curve.E_star, 'Pa')}; {model}{where}", highlight=False)
    header, rows = curve_table(curve)
    table = Table(box=None, header_style="bold")
    for name in header:
        table.add_column(name, justify="right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    console.print(table)
    if not curve.resolved[curve.converged].all():
        console.print("* fewer than ten points in contact: the grid decides, not the surface")
    for warning in curve.warnings:
        console.print(f"warning: {warning}", highlight=False, soft_wrap=True)
    for file in pressed.files:
        console.print(f"wrote {file}", highlight=False, soft_wrap=True)


def announce(text: str) -> None:
    """Print a line on standard error."""
    Console(stderr=True).print(text, highlight=False, soft_wrap=True)


def print_generated(body: Body, file: Path) -> None:
    """Print what was generated and where it is."""
    console = Console()
    console.print(_described(body), highlight=False)
    console.print(f"wrote {file}", highlight=False, soft_wrap=True)


def _described(body: Body) -> str:
    if isinstance(body, Surface):
        points = f"surface of {body.shape[0]} x {body.shape[1]} points"
        size = " x ".join(engineering(size, "m") for size in body.sizes)
    else:
        points = f"line of {body.heights.size} points"
        size = engineering(body.length, "m")
    tilt = ", tilt removed" if "detrended" in body.settings else ""
    slope = f"rms slope {body.rms_slope:.3g}"
    return f"{points}, {size}; rms height {engineering(body.rms_height, 'm')}, {slope}{tilt}"
