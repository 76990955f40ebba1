"""The results that the page about the paper is drawn from."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray

ROW_1D, ROW_MATCHED, ROW_3D = "reduced", "reduced, with the waves of the surfaces", "full"
"""Names of the ensembles in the table of what was computed."""


def row_of(n: int) -> str:
    """Return the name of the surfaces on a grid of n points along a side."""
    return f"full, {n}²"


@dataclass(frozen=True, eq=False)
class PaperResults:
    """Ensembles of the paper's study.

    Attributes
    ----------
    name : str
        Which study.
    command : str
        The command that repeats it.
    reduced, full : Dataset
        Lines and surfaces, over the fractal dimensions of the surfaces at least.
    matched : Dataset
        Lines with the waves of the surfaces and no shorter ones, at the loads of the surfaces.
    exponents : Dataset
        The reduced model's exponent over all fractal dimensions, of :func:`exponents_of`.
    gallery : Dataset or None
        Single bodies for Figures 1 and 2.
    grids : dict of Dataset
        The same surfaces on other grids, by points along a side.
    paper_grid : Dataset or None
        Surfaces of 2048².
    core_seconds : dict of float
        Computing time of one body with all its loads, on one core, by the name of its row. [s]
    """

    name: str
    command: str
    reduced: xarray.Dataset
    full: xarray.Dataset
    matched: xarray.Dataset
    exponents: xarray.Dataset
    gallery: xarray.Dataset | None = None
    grids: dict[int, xarray.Dataset] = field(default_factory=dict)
    paper_grid: xarray.Dataset | None = None
    core_seconds: dict[str, float] = field(default_factory=dict)

    @property
    def ensembles(self) -> tuple[xarray.Dataset, xarray.Dataset, xarray.Dataset]:
        """Lines, surfaces, and lines with the waves of the surfaces."""
        return self.reduced, self.full, self.matched
