"""Reduce the store of the study to what its page needs, less than a megabyte.

    python studies/correlations/reduce.py out/correlations.zarr

writes ``data.nc``: a group for each ensemble, and one with the moments of the heights.
"""

import json
import sys
from pathlib import Path

import numpy as np
import xarray

from roughline import campaign
from roughline.campaign.export import write_netcdf
from roughline.campaign.run import log_of
from roughline.computing.arrays import Real

HERE = Path(__file__).parent
DATA = HERE / "data.nc"
HEIGHTS = "heights"
KEPT = ("stiffness", "unloading_stiffness", "area_fraction", "plastic_fraction")
BEARING = (1e-1, 1e-2, 1e-3, 1e-4)  # shares of the area that lie above a height


def main(path: Path) -> None:
    """Reduce a finished store."""
    plan, store = campaign.read_plan(HERE / "plan.toml"), campaign.Store(path)
    for ensemble in plan.ensembles:
        done, failed, total = store.counts(ensemble.name)
        if done < total:
            sys.exit(f"{ensemble.name}: {total - done} of {total} cases lack, {failed} failed")
    runs = [json.loads(line) for line in log_of(path).read_text().splitlines()]
    DATA.unlink(missing_ok=True)
    for ensemble in plan.ensembles:
        data = store.dataset(ensemble.name)
        kept = data[[name for name in KEPT if name in data]].astype(np.float32, keep_attrs=True)
        kept = kept.assign(rms_slope=data.rms_slope, status=data.status, resolved=data.resolved)
        seconds = sum(run["core_seconds"].get(ensemble.name, 0) for run in runs)
        write_netcdf(kept.assign_attrs(core_seconds=round(seconds)), DATA, group=ensemble.name)
    write_netcdf(heights_of(plan.ensembles[0]), DATA, group=HEIGHTS)


def heights_of(ensemble: campaign.Ensemble) -> xarray.Dataset:
    """Return how Gaussian the heights of an ensemble are, over their rms."""
    dimensions = ensemble.fractal_dimensions
    shape = (len(dimensions), ensemble.realisations)
    moments = {name: np.empty(shape) for name in ("skewness", "excess_kurtosis")}
    bearing = np.empty((*shape, len(BEARING)))
    for i, dimension in enumerate(dimensions):
        for j in range(ensemble.realisations):
            surface = ensemble.spectrum(dimension).surface(ensemble.n, ensemble.seed_of(j))
            heights: Real = surface.heights - surface.heights.mean()
            heights /= surface.rms_height
            moments["skewness"][i, j] = np.mean(heights**3)
            moments["excess_kurtosis"][i, j] = np.mean(heights**4) - 3
            bearing[i, j] = np.quantile(heights, 1 - np.array(BEARING))
    over = ("fractal_dimension", "realisation")
    return xarray.Dataset(
        {name: (over, values) for name, values in moments.items()}
        | {"bearing_height": ((*over, "share"), bearing)},
        {"fractal_dimension": list(dimensions), "share": list(BEARING)},
    )


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
