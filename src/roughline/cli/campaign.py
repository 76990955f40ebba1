"""Commands on ensembles: the paper's study, and the user's own campaigns."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from roughline.cli.options import Json, Scheduler, Workers, interruptible, print_json
from roughline.cli.study import study_of

app = typer.Typer(
    help="Ensembles of random bodies, on this machine or a Dask cluster.",
    no_args_is_help=True,
    rich_markup_mode=None,
)


class ExportFormat(StrEnum):
    """Which files to write."""

    netcdf = "netcdf"
    csv = "csv"


class ScaleChoice(StrEnum):
    """Size of the paper's study."""

    quick = "quick"
    full = "full"


OWN = "A version of your own"

StoreArgument = Annotated[
    Path, typer.Argument(help="A store (folder of results), or the plan that lies beside it.")
]


def paper(
    scale: Annotated[
        ScaleChoice | None,
        typer.Option(
            help="quick: minutes on two cores; full: the paper's sizes, hours [default: quick]."
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="Folder for results and report.")] = Path(
        "roughline-paper"
    ),
    fractal_dimensions: Annotated[
        str | None,
        typer.Option(
            help='Of surfaces and lines, 2 to 3, such as "2.1, 2.5, 2.9".', rich_help_panel=OWN
        ),
    ] = None,
    points: Annotated[
        int | None,
        typer.Option(
            "-n", "--points", help="Points along a side of the surfaces.", rich_help_panel=OWN
        ),
    ] = None,
    realisations: Annotated[
        int | None,
        typer.Option(help="Surfaces for each fractal dimension.", rich_help_panel=OWN),
    ] = None,
    line_points: Annotated[
        int | None, typer.Option(help="Points of the lines.", rich_help_panel=OWN)
    ] = None,
    lines: Annotated[
        int | None, typer.Option(help="Lines for each fractal dimension.", rich_help_panel=OWN)
    ] = None,
    force_bars: Annotated[
        str | None,
        typer.Option(
            help="Loads F / (E* h L) of the surfaces and of the lines with their waves: "
            '"0.01, 0.1, 1", or "0.001 to 10, 6 per decade".',
            rich_help_panel=OWN,
        ),
    ] = None,
    plan: Annotated[
        Path | None,
        typer.Option(
            help="A plan of your own in TOML, with surfaces and lines, instead of the paper's.",
            rich_help_panel=OWN,
        ),
    ] = None,
    store: Annotated[
        Path | None,
        typer.Option(
            help="Folder for the results of your plan [default: that of the plan's file, ending in "
            ".zarr]; without a plan, a finished store to report on.",
            rich_help_panel=OWN,
        ),
    ] = None,
    window: Annotated[
        str | None,
        typer.Option(
            help='Loads in which exponents of surfaces are fitted [default: "0.01, 0.1"].',
            rich_help_panel=OWN,
        ),
    ] = None,
    line_window: Annotated[
        str | None,
        typer.Option(
            help='Loads in which exponents of lines are fitted [default: "0.0001, 0.01"].',
            rich_help_panel=OWN,
        ),
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
        "scale": scale.value if scale else None,
        "seed": seed,
        "fractal-dimensions": fractal_dimensions,
        "points": points,
        "realisations": realisations,
        "line-points": line_points,
        "lines": lines,
        "force-bars": force_bars,
    }
    windows = {"window": window, "line-window": line_window}
    study = study_of(of_paper, windows, plan, store, out)
    with interruptible(_kept(study.store)), campaign_progress() as progress:
        page = recompute(
            study, out, workers=workers, scheduler=scheduler, progress=progress, announce=announce
        )
    if json:
        print_json({"report": page})
    else:
        typer.echo(f"report: {page}")


@app.command("run")
def run_campaign(
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
    from roughline.report.campaign_output import of_summary, print_summary
    from roughline.report.progress import campaign_progress
    from roughline.report.terminal import announce

    where = store or plan.with_suffix(".zarr")
    with interruptible(_kept(where)), campaign_progress() as progress:
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
        print_json(of_summary(summary, where))
    else:
        print_summary(summary, where)
    if sum(summary.failed.values()) or summary.unconverged:
        raise typer.Exit(1)


@app.command("status")
def status_of_campaign(store: StoreArgument, json: Json = False) -> None:
    """Print how many cases of a campaign are done, and why cases failed."""
    from roughline.campaign import Store
    from roughline.report.campaign_output import of_status, print_status

    results = Store(_store_of(store))
    if json:
        print_json(of_status(results))
    else:
        print_status(results)


@app.command("export")
def export_campaign(
    store: StoreArgument,
    out: Annotated[Path, typer.Option(help="Folder for the files.")],
    formats: Annotated[
        list[ExportFormat] | None,
        typer.Option("--format", help="netcdf or csv; may be repeated [default: both]."),
    ] = None,
    json: Json = False,
) -> None:
    """Write every ensemble to NetCDF and CSV, with tables of means and their intervals."""
    from roughline.campaign import Store
    from roughline.campaign.export import export
    from roughline.report.terminal import print_files

    chosen = [item.value for item in formats or ExportFormat]
    files = export(Store(_store_of(store)), out, chosen)
    if json:
        print_json({"files": files})
    else:
        print_files(files)


def _store_of(path: Path) -> Path:
    return path.with_suffix(".zarr") if path.suffix == ".toml" else path


def _kept(place: Path) -> str:
    return f"what is done is kept in {place}: run again to go on"
