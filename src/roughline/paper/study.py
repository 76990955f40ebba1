"""A study of both models, run from its plan to its page."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughline.campaign.run import run
from roughline.campaign.store import Store
from roughline.errors import StoreError
from roughline.paper.page import write_page
from roughline.paper.results import results_of_store
from roughline.paper.roles import chosen_roles
from roughline.paper.windows import Windows

if TYPE_CHECKING:
    from roughline.campaign.plan import Plan
    from roughline.paper.gallery import Gallery
    from roughline.report.page import Headline


@dataclass(frozen=True)
class Study:
    """The paper's study, or another one of both models."""

    plan: Plan | None  # what is computed; None for a store that is finished
    # folder of its results. If it holds a part of the same study, only the rest is computed
    store: Path
    # which study this is, such as "at the quick scale"; the lead of the page ends with it
    name: str
    command: str  # the command that repeats it
    # where exponents are fitted, as far as the loads reach
    windows: Windows = field(default_factory=Windows)
    gallery: Gallery | None = None  # bodies for Figures 1 and 2


def recompute(study: Study, out: Path, **how: Any) -> tuple[Path, Headline]:
    """Run a study, or what is left of it, and write its report into a folder.

    Returns the page, and with what it begins.

    The other arguments are those of :func:`roughline.campaign.run`. A study without both surfaces
    and lines is refused, and so is a folder that cannot be written, or holds another study.
    """
    if study.plan is not None:
        chosen_roles({ensemble.name: ensemble.identity() for ensemble in study.plan.ensembles})
        run(study.plan, study.store, **how)
        if study.gallery is not None:
            study.gallery.draw(study.store)
    results = results_of_store(
        Store(study.store), study.name, study.command, study.windows, study.plan
    )
    try:
        return write_page(results, out)
    except OSError as error:
        raise StoreError(
            f"cannot write the report to {out} ({error}); the results are kept"
        ) from error
