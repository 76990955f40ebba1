"""The command that recomputes the paper, or a version of one's own, from the options of that."""

from __future__ import annotations

import math
import os
import re
import shlex
from collections.abc import Callable, Mapping
from operator import lt
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from roughline.cli.options import Json, Scheduler, Workers, continuation, interruptible, print_json
from roughline.errors import InputError
from roughline.errors.checks import refuse

if TYPE_CHECKING:
    from roughline.paper.study import Study
    from roughline.paper.windows import ForceWindow, Windows

_RANGE = re.compile(r"\s*(\S+)\s+to\s+(\S+)\s*,\s*(\d+)\s+per\s+decade\s*")

_NEEDED: dict[str, tuple[Callable[[Any], bool], str]] = {
    "fractal_dimensions": (
        lambda value: all(2 <= each <= 3 for each in value) and len({*value}) == len(value),
        "numbers from 2 to 3, each once, are",
    ),
    "points": (lambda value: 3 <= value <= 2**15, f"3 to {2**15} points are"),
    "line_points": (lambda value: 3 <= value <= 2**28, f"3 to {2**28} points are"),
    "realisations": (lambda value: value >= 1, "at least one is"),
    "lines": (lambda value: value >= 1, "at least one is"),
    "force_bars": (
        lambda value: value[0] > 0 and value[-1] < math.inf and all(map(lt, value, value[1:])),
        "positive, finite and rising loads F / (E* h L) are",
    ),
}
"""What the settings of a study must be, and how that is said."""


def _own(text: str, *names: str) -> Any:
    """An option of a version of one's own."""
    return typer.Option(*names, help=text, rich_help_panel="A version of your own")


def paper(
    scale: Annotated[
        Literal["quick", "full"] | None,
        typer.Option(
            help="quick: minutes on two cores; full: the paper's sizes, hours [default: quick]."
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder for results and report.")] = Path(
        "roughline-paper"
    ),
    fractal_dimensions: Annotated[
        str | None, _own('Of surfaces and lines, 2 to 3, such as "2.1, 2.5, 2.9".')
    ] = None,
    points: Annotated[
        int | None, _own("Points along a side of the surfaces.", "-n", "--points")
    ] = None,
    realisations: Annotated[int | None, _own("Surfaces for each fractal dimension.")] = None,
    line_points: Annotated[int | None, _own("Points of the lines.")] = None,
    lines: Annotated[int | None, _own("Lines for each fractal dimension.")] = None,
    force_bars: Annotated[
        str | None,
        _own(
            "Loads F / (E* h L) of the surfaces and of the lines with their waves: "
            '"0.01, 0.1, 1", or "0.001 to 10, 6 per decade".'
        ),
    ] = None,
    plan: Annotated[
        Path | None,
        _own("A plan of your own in TOML, with surfaces and lines, instead of the paper's."),
    ] = None,
    store: Annotated[
        Path | None,
        _own(
            "Folder for the results of your plan [default: that of the plan's file, ending in "
            ".zarr]; without a plan, a finished store to report on."
        ),
    ] = None,
    window: Annotated[
        str | None,
        _own('Loads in which exponents of surfaces are fitted [default: "0.01, 0.1"].'),
    ] = None,
    line_window: Annotated[
        str | None,
        _own('Loads in which exponents of lines are fitted [default: "0.0001, 0.01"].'),
    ] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="Root of all random seeds [default: 2012].")
    ] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    json: Json = False,
) -> None:
    """Recompute the paper: both models, its figures, and a report with a verdict on each claim.

    Interrupt at any time with Ctrl-C: finished results are kept, and the same command continues
    from there.
    """
    from roughline.paper.study import recompute
    from roughline.report.progress import campaign_progress
    from roughline.report.terminal import announce

    of_paper = {
        "scale": scale,
        "seed": seed,
        "fractal-dimensions": fractal_dimensions,
        "points": points,
        "realisations": realisations,
        "line-points": line_points,
        "lines": lines,
        "force-bars": force_bars,
    }
    windows = {"window": window, "line-window": line_window}
    study = described_study(of_paper, windows, plan, store, out)
    with interruptible(continuation(study.store)), campaign_progress() as progress:
        page, headline = recompute(
            study, out, workers=workers, scheduler=scheduler, progress=progress, announce=announce
        )
    if json:
        print_json({"report": page})
        return
    for each in headline.warnings:
        announce(f"warning: {each}")
    for finding in headline.figures:
        typer.echo(finding.sentence)
    typer.echo(f"report: {page}")


def described_study(
    of_paper: Mapping[str, Any],
    windows: Mapping[str, str | None],
    plan: Path | None,
    store: Path | None,
    out: Path,
) -> Study:
    """The study that the options describe.

    `of_paper` and `windows` are what was given for the paper's own study and for its windows, by
    names of options, None where nothing was. `plan` and `store` are one's own.

    Raises
    ------
    InputError
        If a value cannot be read, or options contradict each other.
    """
    from roughline.campaign import read_plan
    from roughline.paper.gallery import Gallery
    from roughline.paper.plan import paper_plan, with_settings
    from roughline.paper.study import Study

    options = {name: value for name, value in of_paper.items() if value is not None}
    files = {"plan": plan, "store": store}
    all_options = {**options, **files, **windows}
    arguments = [f"--{name}={value}" for name, value in all_options.items() if value is not None]
    command = shlex.join(["roughline", "paper", *arguments])
    fitted = _windows(windows)
    if plan is None and store is None:
        settings = _settings(options)
        plan_of_paper = paper_plan(options.get("scale", "quick"), options.get("seed", 2012))
        own = with_settings(plan_of_paper, **settings)
        changed = ", with settings of its own" if settings else ""
        return Study(
            own,
            out / "results.zarr",
            f"at the {options.get('scale', 'quick')} scale{changed}",
            command,
            fitted,
            Gallery.of(own, settings.get("fractal_dimensions")),
        )
    if options:
        raise InputError(
            f"--{next(iter(options))} is given beside --{'store' if plan is None else 'plan'}, "
            "which says what is computed: leave one of the two out"
        )
    if plan is not None:
        if not os.path.isfile(plan):  # noqa: PTH113 - of a name that no file can have, Path raises
            refuse("--plan", str(plan), "there is no such file: give a plan in TOML")
        where = store or plan.with_suffix(".zarr")
        return Study(read_plan(plan), where, f"from the plan {plan.name}", command, fitted)
    assert store is not None
    return Study(None, store, f"from the results in {store.name}", command, fitted)


def _settings(options: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments of the paper's plan, from options."""
    settings = {
        name.replace("-", "_"): value
        for name, value in options.items()
        if name not in ("scale", "seed")
    }
    for name, read in (("fractal_dimensions", _numbers), ("force_bars", _forces)):
        if name in settings:
            settings[name] = read(settings[name], f"--{name.replace('_', '-')}")
    for name, value in settings.items():
        holds, needed = _NEEDED[name]
        if not holds(value):
            option = name.replace("_", "-")
            refuse(f"--{option}", options[option], f"{needed} needed")
    return settings


def _windows(options: Mapping[str, str | None]) -> Windows:
    from roughline.paper.windows import Windows

    names = {"window": "full", "line-window": "reduced"}
    return Windows(
        **{names[each]: _window(text, f"--{each}") for each, text in options.items() if text}
    )


def _numbers(text: str, flag: str, example: str = "2.1, 2.5, 2.9") -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        refuse(flag, text, f'numbers with commas between them are needed, such as "{example}"')


def _forces(text: str, flag: str) -> tuple[float, ...]:
    """Loads one by one, or evenly spaced logarithms of them."""
    from roughline.campaign.plan import decades

    example = '0.01, 0.1, 1" or "0.001 to 10, 6 per decade'
    found = _RANGE.fullmatch(text)
    if found is None:
        return _numbers(text, flag, example)
    low, high = _numbers(f"{found[1]}, {found[2]}", flag, example)
    count = int(found[3])
    if not (0 < low < high < float("inf") and 1 <= count <= 1000):
        needed = (
            f'two rising, positive loads and 1 to 1000 per decade are needed, such as "{example}"'
        )
        refuse(flag, text, needed)
    return decades(low, high, count)


def _window(text: str, flag: str) -> ForceWindow:
    numbers = _numbers(text, flag, "0.01, 0.1")
    if len(numbers) != 2 or not 0 < numbers[0] < numbers[1] < float("inf"):
        needed = 'two rising, positive loads F / (E* h L) are needed, such as "0.01, 0.1"'
        refuse(flag, text, needed)
    return numbers[0], numbers[1]
