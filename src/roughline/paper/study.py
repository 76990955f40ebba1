"""The paper's study, run from its plan to its page."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from roughline.campaign.run import run
from roughline.campaign.store import Store
from roughline.errors import StoreError
from roughline.paper.page import write_page
from roughline.paper.plan import StudyScale, paper_plan
from roughline.paper.results import results_of_store

if TYPE_CHECKING:
    from roughline.campaign.progress import EnsembleProgress


def recompute(
    scale: StudyScale,
    out: Path,
    seed: int,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: EnsembleProgress | None = None,
    announce: Callable[[str], None] | None = None,
) -> Path:
    """Run the paper's study, or what is left of it, and write its report.

    Parameters
    ----------
    scale : {"quick", "full"}
        Minutes, or the paper's sizes.
    out : Path
        Folder for results and report. If it holds a part of the same study, only the rest is
        computed.
    seed : int
        Root of all seeds.
    workers, scheduler, progress, announce
        As for :func:`roughline.campaign.run`.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    StoreError
        If the folder cannot be written, or holds another study.
    ClusterError
        If the cluster cannot be used.
    """
    path = out / "results.zarr"
    run(
        paper_plan(scale, seed),
        path,
        workers=workers,
        scheduler=scheduler,
        progress=progress,
        announce=announce,
    )
    results = results_of_store(
        Store(path),
        name=f"at the {scale} scale",
        command=f"roughline paper --scale {scale} --seed {seed}",
    )
    try:
        return write_page(results, out)
    except OSError as error:
        raise StoreError(
            f"cannot write the report to {out} ({error}); the results are kept"
        ) from error
