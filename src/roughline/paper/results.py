"""The results of the paper's study, from a store or from files."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughline.campaign.layout import CASE_STATUS, PENDING
from roughline.errors import StoreError
from roughline.paper.gallery import gallery_in
from roughline.paper.laws import DimensionLaws, at_dimension, dimension_laws, exponent_table
from roughline.paper.roles import chosen_roles, departures
from roughline.paper.windows import Windows

if TYPE_CHECKING:
    import xarray

    from roughline.campaign.plan import Ensemble, Plan
    from roughline.campaign.store import Store


@dataclass(frozen=True)
class Computing:
    """What a study took, on which machine."""

    processor: str  # name of the processor
    cores: int  # how many of its cores computed
    hours: float  # all ensembles of the study together, with the map, on these cores [h]
    # one body with all its loads on one core, on the average, by its ensemble [s]
    core_seconds: dict[str, float]


@dataclass(frozen=True, eq=False)
class PaperResults:
    """Ensembles of the paper's study."""

    # which study this is, such as "at the quick scale"; the lead of the page ends with it
    name: str
    command: str  # the command that repeats the study
    # lines and surfaces, over the fractal dimensions of the surfaces at least
    reduced: xarray.Dataset
    full: xarray.Dataset
    # lines with the waves of the surfaces and no shorter ones, at the loads of the surfaces
    matched: xarray.Dataset | None
    exponents: xarray.Dataset  # of the reduced model over all fractal dimensions (exponent_table)
    gallery: xarray.Dataset | None = None  # single bodies for Figures 1 and 2
    # one of the surfaces of `full` on other grids, by points along a side
    grids: dict[int, xarray.Dataset] = field(default_factory=dict)
    # the surfaces of `full` on another grid, with the waves that it carries
    other_grid: xarray.Dataset | None = None
    computing: Computing | None = None  # what the study took; None if it is not known
    windows: Windows = field(default_factory=Windows)  # where exponents are fitted

    @property
    def version(self) -> str:
        """Version of roughline that computed the bodies; "a and b" if they were several."""
        ensembles = (self.reduced, self.full, self.matched)
        versions = {each.attrs["roughline_version"] for each in ensembles if each is not None}
        return " and ".join(sorted(versions))

    @cached_property
    def laws(self) -> list[DimensionLaws]:
        """Laws of stiffness and contact area, for each fractal dimension of the surfaces."""
        return [
            dimension_laws(
                at_dimension(self.reduced, dimension),
                self.full.sel(fractal_dimension=dimension),
                at_dimension(self.matched, dimension),
                self.windows,
            )
            for dimension in self.full.fractal_dimension.values
        ]


def results_of_store(
    store: Store,
    name: str,
    command: str,
    windows: Windows | None = None,
    plan: Plan | None = None,
) -> PaperResults:
    """Read the results of a finished store, of the paper's plan or of another one.

    Of the store that is used which a plan has, or all; exponents are fitted in the windows, as far
    as the loads reach. A store without both surfaces and lines is refused, and so is one in which
    cases are not done.
    """
    for each in store.names if plan is None else [each.name for each in plan.ensembles]:
        store.refuse_lost(each)
    if plan is None:
        every = {each: store.dataset(each) for each in store.names}
    else:
        every = {each.name: _part(store, each) for each in plan.ensembles}
    roles = chosen_roles({each: data.attrs for each, data in every.items()})
    for each in roles.names:
        _refuse_unfinished(store, each, every[each])
    lines, surfaces = every[roles.reduced], every[roles.full]
    reached = (windows or Windows()).within(lines.force_bar.values, surfaces.force_bar.values)
    return PaperResults(
        name=name,
        command=command,
        reduced=lines,
        full=surfaces,
        matched=every[roles.matched] if roles.matched else None,
        exponents=exponent_table(lines, reached.all_reduced),
        gallery=gallery_in(store),
        other_grid=every[roles.other_grid] if roles.other_grid else None,
        windows=reached,
    )


def _part(store: Store, ensemble: Ensemble) -> xarray.Dataset:
    """Read the bodies of an ensemble from a store that may have more of them."""
    data = store.dataset(ensemble.name).isel(realisation=slice(ensemble.realisations))
    return data.sel(fractal_dimension=sorted(ensemble.fractal_dimensions))


def _refuse_unfinished(store: Store, name: str, data: xarray.Dataset) -> None:
    """Refuse an ensemble in which cases are neither done nor recorded as failed."""
    status = data[CASE_STATUS.name].values
    if pending := int((status == PENDING).sum()):
        raise StoreError(
            f"{pending} of {status.size} cases of {name!r} in {store.path} are not done: run its "
            "plan to the end, then report"
        )


@cache
def published_results() -> PaperResults:
    """Return the study that comes with the package; it is read once.

    The page "The paper, recomputed" is made of it: 500 lines of 2^20 points and 60 surfaces of
    2048² for each of six fractal dimensions. What that page alone shows lies in studies/paper.
    """
    text = (published_folder() / "computing.json").read_text(encoding="utf-8")
    return PaperResults(
        name="from the study in studies/paper",
        command="roughline campaign run studies/paper/plan.toml",
        reduced=published_dataset("lines"),
        full=published_dataset("surfaces"),
        matched=published_dataset("matched"),
        exponents=published_dataset("exponents"),
        other_grid=published_dataset("coarse"),
        computing=Computing(**json.loads(text)),
    )


def larger_study(results: PaperResults) -> PaperResults | None:
    """Return the study that comes with the package, in the windows of another one of its bodies.

    None where the bodies differ in more than grid and number, or this one is not smaller.
    """
    ours, published = (results.full, results.reduced), published_results()
    theirs = (published.full, published.reduced)
    if any(departures(each.attrs) for each in ours) or all(
        one.attrs["n"] >= more.attrs["n"] and one.sizes["realisation"] >= more.sizes["realisation"]
        for one, more in zip(ours, theirs, strict=True)
    ):
        return None
    if results.windows == published.windows:
        return published
    return replace(published, windows=results.windows)


@cache
def published_dataset(name: str) -> xarray.Dataset:
    """Return one part of that study alone, by the name of its file; it is read once.

    "lines" and "surfaces" are the reduced and the full ensemble, "exponents" those of the reduced
    model over all fractal dimensions. Kept in single precision, they are computed with in double.
    """
    import xarray  # here because it loads slowly

    with xarray.open_dataset(published_folder() / f"{name}.nc", engine="h5netcdf") as data:
        kept = data.load().drop_encoding()
    return kept.map(
        lambda each: each.astype(np.float64) if each.dtype == np.float32 else each, keep_attrs=True
    )


def published_folder() -> Path:
    """Folder with the files of the study that comes with the package."""
    return Path(str(files("roughline.paper").joinpath("data")))
