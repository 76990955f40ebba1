"""Commands on campaigns of the user's own: ensembles of random bodies."""

from __future__ import annotations

import warnings
from collections import Counter
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from roughline.cli.options import Json, Scheduler, Workers, continuation, interruptible, print_json

if TYPE_CHECKING:
    from roughline.campaign.run import Summary
    from roughline.campaign.store import Store

app = typer.Typer(
    help="Ensembles of random bodies, on this machine or a Dask cluster.",
    no_args_is_help=True,
    rich_markup_mode=None,
)


class _ExportFormat(StrEnum):
    """Which files to write."""

    netcdf = "netcdf"
    csv = "csv"


_StoreArgument = Annotated[
    Path, typer.Argument(help="A store (folder of results), or the plan that lies beside it.")
]


@app.command("run")
def _run(
    plan: Annotated[Path, typer.Argument(help="A plan in TOML.")],
    store: Annotated[
        Path | None,
        typer.Option(
            help="Folder for the results [default: that of the plan's file, ending in .zarr]."
        ),
    ] = None,
    scheduler: Scheduler = None,
    workers: Workers = None,
    threads: Annotated[
        int | None,
        typer.Option(help="Threads for each case [default: cores divided by workers]."),
    ] = None,
    json: Json = False,
) -> None:
    """Compute what a plan asks for, or what is left of it.

    Interrupt at any time with Ctrl-C: finished results are kept, and the same command continues
    from there. A plan with more realisations or fractal dimensions adds to the same store. Cases
    that failed are recorded with their reasons, do not stop the others, and are tried again by the
    next run.
    """
    from roughline.campaign import read_plan, run
    from roughline.report.progress import campaign_progress
    from roughline.report.terminal import announce

    where = store or plan.with_suffix(".zarr")
    with interruptible(continuation(where)), campaign_progress() as progress:
        summary = run(
            read_plan(plan),
            where,
            scheduler=scheduler,
            workers=workers,
            threads=threads,
            progress=progress,
            announce=announce,
        )
    if json:
        print_json(_summary_json(summary, where))
    else:
        _print_summary(summary, where)
    if sum(summary.failed.values()) or summary.unconverged:
        raise typer.Exit(1)


@app.command("status")
def _status(store: _StoreArgument, json: Json = False) -> None:
    """Print how many cases of a campaign are done, why cases failed, and what was lost on disk."""
    from roughline.campaign import Store

    results = Store(_store_path(store))
    lost = _lost(results)
    if json:
        print_json(_status_json(results, lost))
    else:
        _print_status(results)
    _end_with_lost(lost)


@app.command("export")
def _export(
    store: _StoreArgument,
    out: Annotated[Path, typer.Option(help="Folder for the files.")],
    formats: Annotated[
        list[_ExportFormat] | None,
        typer.Option("--format", help="netcdf or csv; may be repeated [default: both]."),
    ] = None,
    json: Json = False,
) -> None:
    """Write every ensemble to NetCDF and CSV, with tables of means and their intervals.

    Cases that are not done are empty in the files, and so are those that were lost on disk.
    """
    from roughline.campaign import Store
    from roughline.campaign.export import export
    from roughline.errors import LostCasesWarning
    from roughline.report.terminal import print_files

    results = Store(_store_path(store))
    lost, unfinished = _lost(results), _unfinished(results)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LostCasesWarning)  # told below
        files = export(results, out, formats or list(_ExportFormat))
    if json:
        print_json({"files": files, "unfinished": unfinished, "lost": lost})
    else:
        print_files(files)
        for name, (done, cases) in unfinished.items():
            typer.echo(f"{name}: {done} of {cases} cases are done; the others are empty")
    _end_with_lost(lost)


def _store_path(path: Path) -> Path:
    return path.with_suffix(".zarr") if path.suffix == ".toml" else path


def _print_summary(summary: Summary, store: Path) -> None:
    """Print what a campaign did, equal reasons of failures together."""
    done, failed = sum(summary.done.values()), sum(summary.failed.values())
    typer.echo(f"{done} cases computed, {failed} failed; results in {store}")
    if summary.unconverged:
        typer.echo(f"{summary.unconverged} loads did not converge: they are NaN")
    _print_failures(summary.reasons)


def _print_status(store: Store) -> None:
    """Print what is done of a campaign, and why cases failed."""
    from rich.console import Console

    from roughline.report.terminal import print_table

    rows = [[name, *map(str, store.counts(name))] for name in store.names]
    print_table(Console(markup=False), ["ensemble", "done", "failed", "in all"], rows)
    _print_failures(Counter(why for name in store.names for why in store.failures(name).values()))


def _print_failures(reasons: Counter[str]) -> None:
    for reason, count in reasons.most_common():
        typer.echo(f"{count} failed: {reason}")


def _summary_json(summary: Summary, store: Path) -> dict[str, Any]:
    """What a run of a campaign did."""
    return {
        "store": store,
        "done": summary.done,
        "failed": summary.failed,
        "core_seconds": summary.core_seconds,
        "reasons": summary.reasons,
        "unconverged": summary.unconverged,
    }


def _lost(store: Store) -> dict[str, list[str]]:
    """What was lost on disk of each ensemble of which something was."""
    return {name: lost for name in store.names if (lost := store.lost(name))}


def _unfinished(store: Store) -> dict[str, tuple[int, int]]:
    """How many cases are done, and how many there are, of ensembles that are not done."""
    counts = {name: store.counts(name) for name in store.names}
    return {name: (done, cases) for name, (done, _, cases) in counts.items() if done < cases}


def _end_with_lost(lost: dict[str, list[str]]) -> None:
    """Say what was lost of each ensemble, and end with exit code 1 if anything was."""
    from roughline.campaign.store import described_loss

    for name, cases in lost.items():
        typer.echo(described_loss(name, cases), err=True)
    if lost:
        raise typer.Exit(1)


def _status_json(store: Store, lost: dict[str, list[str]]) -> dict[str, Any]:
    """What is done of a campaign."""
    names = ("done", "failed", "cases")
    return {
        "store": store.path,
        "ensembles": {
            name: dict(zip(names, store.counts(name), strict=True))
            | {"failures": store.failures(name), "lost": lost.get(name, [])}
            for name in store.names
        },
    }
