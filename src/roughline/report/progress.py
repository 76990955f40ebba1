"""Progress on the terminal, with time left."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

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
from rich.text import Text


class _Rate(ProgressColumn):
    """Steps a second, or a minute where they are slow."""

    def render(self, task: Task) -> Text:
        """Show the speed of the last while."""
        speed = task.speed or 0.0
        text = f"{speed:.1f}/s" if speed >= 1 else f"{60 * speed:.1f}/min"
        return Text(text if speed else "", style="progress.data.speed")


@contextmanager
def campaign_progress() -> Iterator[Callable[[str, int, int, int], None]]:
    """Show a bar for each ensemble of a campaign; gives the callback."""
    with _bars() as show:

        def progress(name: str, done: int, failed: int, total: int) -> None:
            show(name, done, total, f"{name}, {failed} failed" if failed else name)

        yield progress


@contextmanager
def load_progress() -> Iterator[Callable[[int, int], None]]:
    """Show a bar over the loads of one body; gives the callback."""
    with _bars() as show:
        yield lambda done, total: show("loads", done, total)


@contextmanager
def part_progress() -> Iterator[tuple[Callable[[int, int], None], Callable[[int, int], None]]]:
    """Show bars over the maps of a part, and over the loads of each; gives both callbacks.

    Nothing is drawn before a map is pressed, so that a refusal of all stays one line.
    """
    with _bars() as show:
        last = (0, 1)
        is_pressing = False

        def maps(done: int, total: int) -> None:
            nonlocal last
            last = done, total
            if is_pressing:
                show("maps", done, total)

        def loads(done: int, total: int) -> None:
            nonlocal is_pressing
            is_pressing = True
            maps(*last)
            show("loads of this map", done, total)

        yield maps, loads


@contextmanager
def _bars() -> Iterator[Callable[..., None]]:
    """Bars by their keys, on standard error; nothing is drawn before the first call."""
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

    def show(key: str, done: int, total: int, name: str = "") -> None:
        if not tasks:
            progress.start()
        if key not in tasks:
            # a bar that starts half full tells its time from what is added
            tasks[key] = progress.add_task(key, total=total, completed=done)
        progress.update(tasks[key], completed=done, description=name or key)

    try:
        yield show
    finally:
        if tasks:
            progress.stop()
