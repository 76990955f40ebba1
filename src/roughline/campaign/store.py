"""Results on disk, a Zarr group for each ensemble; the only writer of data.

A batch is one chunk of every variable. Its mark in ``done`` is written last, so a batch counts
only when all of it is on disk.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roughline.campaign.plan import Case, Ensemble, Plan
from roughline.errors import StoreError

if TYPE_CHECKING:
    import xarray

_VARIABLES: dict[str, tuple[str, float, str]] = {
    # name: (dtype, fill value, meaning)
    "stiffness": ("f8", np.nan, "k / (E* L)"),
    "depth": ("f8", np.nan, "depth since touch / h"),
    "area_fraction": ("f8", np.nan, "real / nominal contact area"),
    "status": ("i1", -1, "0 converged, 1 stalled, 2 max_iterations, 3 no tangent, -1 not done"),
    "resolved": ("i1", 0, "at least 10 springs or cells in contact"),
    "rms_slope": ("f8", np.nan, "rms slope L / h of the grid, forward differences"),
}
_GALLERY_DIMENSIONS = {
    "heights": ("fractal_dimension", "x", "y"),
    "contact": ("fractal_dimension", "x", "y"),
    "displacement": ("fractal_dimension", "x", "y"),
    "line_heights": ("fractal_dimension", "s"),
    "line_depth": ("fractal_dimension",),
}


class Store:
    """The results of one plan in one folder.

    Parameters
    ----------
    path : Path
        The folder; made if it does not exist.
    plan : Plan
        What it holds; a store made by another plan or version is refused.

    Raises
    ------
    StoreError
        If the folder cannot be made or written, or belongs to something else.
    """

    def __init__(self, path: Path, plan: Plan) -> None:
        import zarr  # here because it loads slowly

        self.plan = plan
        settings = json.loads(json.dumps(plan.settings()))
        try:
            path.mkdir(parents=True, exist_ok=True)
            existed = any(path.iterdir())
            self._root: Any = zarr.open_group(path, mode="a")
        except (OSError, ValueError) as error:
            raise StoreError(
                f"cannot keep results in {path} ({error}): choose another folder"
            ) from error
        if existed and self._root.attrs.get("settings") != settings:
            raise StoreError(
                f"{path} holds results of other settings or of another version of roughline; "
                "remove it or choose another folder"
            )
        self._root.attrs["settings"] = settings
        for ensemble in (plan.reduced, plan.full):
            if ensemble.model not in self._root:
                self._create(ensemble)

    def _create(self, ensemble: Ensemble) -> None:
        group = self._root.create_group(ensemble.model)
        loads = len(ensemble.force_bars)
        shape = (len(ensemble.fractal_dimensions), ensemble.realisations, loads)
        dims = ("fractal_dimension", "realisation", "force_bar")
        for name, (dtype, fill, _) in (_VARIABLES | {"done": ("i1", 0, "")}).items():
            if name == "area_fraction" and ensemble.model == "reduced":
                continue
            rank = 2 if name in ("rms_slope", "done") else 3
            group.create_array(
                name,
                shape=shape[:rank],
                chunks=(1, min(ensemble.batch, ensemble.realisations), loads)[:rank],
                dtype=dtype,
                fill_value=fill,
                dimension_names=dims[:rank],
            )

    def missing(self, ensemble: Ensemble) -> list[Case]:
        """List the batches that are not on disk."""
        done = self._root[f"{ensemble.model}/done"][:]
        return [
            case for case in ensemble.cases() if not done[case.dimension_index, _slice(case)].all()
        ]

    def put(self, case: Case, results: dict[str, NDArray[np.generic]]) -> None:
        """Write one batch."""
        group = self._root[case.ensemble.model]
        for name, values in results.items():
            group[name][case.dimension_index, _slice(case)] = values
        group["done"][case.dimension_index, _slice(case)] = 1

    def has_gallery(self) -> bool:
        """Return whether the gallery is on disk."""
        return bool(self._root.attrs.get("gallery_done", False))

    def put_gallery(self, results: dict[str, NDArray[np.generic]]) -> None:
        """Write the gallery."""
        group = self._root.require_group("gallery")
        for name, values in results.items():
            group.create_array(
                name, data=values, dimension_names=_GALLERY_DIMENSIONS[name], overwrite=True
            )
        self._root.attrs["gallery_done"] = True

    def gallery(self) -> xarray.Dataset:
        """Return the gallery over (fractal_dimension, x, y) and (fractal_dimension, s)."""
        gallery = self.plan.gallery
        data = self._open("gallery")
        data = data.assign_coords(fractal_dimension=np.array(gallery.fractal_dimensions))
        return data.assign_attrs(self._attrs(force_bar=gallery.force_bar, seed=gallery.seed))

    def dataset(self, ensemble: Ensemble) -> xarray.Dataset:
        """Return an ensemble over (fractal_dimension, realisation, force_bar)."""
        data = self._open(ensemble.model).drop_vars("done")
        for name in data:
            data[name].attrs = {"units": "1", "long_name": _VARIABLES[str(name)][2]}
        data = data.assign_coords(
            fractal_dimension=np.array(ensemble.fractal_dimensions),
            realisation=np.arange(ensemble.realisations),
            force_bar=np.array(ensemble.force_bars),
        )
        data.force_bar.attrs = {"units": "1", "long_name": "F / (E* h L)"}
        return data.assign_attrs(
            self._attrs(
                model=ensemble.model,
                boundary="free" if ensemble.model == "full" else "none",
                n=ensemble.n,
                seed=ensemble.seed,
                heights="random phases, fixed moduli, scaled to rms 1",
                spectrum="self-affine from 2 pi / L to pi / spacing",
            )
        )

    def _attrs(self, **attrs: Any) -> dict[str, Any]:
        return {"roughline_version": self._root.attrs["settings"]["roughline_version"], **attrs}

    def _open(self, group: str) -> xarray.Dataset:
        import xarray

        return xarray.open_zarr(
            self._root.store, group=group, consolidated=False, chunks=None
        ).load()


def _slice(case: Case) -> slice:
    return slice(case.realisations.start, case.realisations.stop)
