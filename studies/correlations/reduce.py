"""Reduce the store of the study to what its page needs, less than a megabyte.

    python studies/correlations/reduce.py out/correlations.zarr

writes ``data.npz``: arrays of the store by "ENSEMBLE/VARIABLE", in single precision, and how
Gaussian the heights are. What the ensembles are stands in ``plan.toml``.
"""

import json
import sys
from pathlib import Path

import numpy as np

from roughline import campaign
from roughline.campaign.layout import DONE
from roughline.campaign.run import log_of
from roughline.computing.arrays import Real

HERE = Path(__file__).parent
DATA = HERE / "data.npz"
PLAN = HERE / "plan.toml"
KEPT = ("stiffness", "unloading_stiffness", "area_fraction", "plastic_fraction", "status")
BEARING = (1e-1, 1e-2, 1e-3, 1e-4)  # shares of the area that lie above a height


def main(path: Path) -> None:
    """Reduce a finished store."""
    plan, store = campaign.read_plan(PLAN), campaign.Store(path)
    runs = [json.loads(line) for line in log_of(path).read_text().splitlines()]
    arrays = {}
    for ensemble in plan.ensembles:
        name = ensemble.name
        data = store.dataset(name).isel(realisation=slice(ensemble.realisations))
        data = data.sel(fractal_dimension=list(ensemble.fractal_dimensions))
        done = int((data.case_status == DONE).sum())
        if done < ensemble.cases:
            sys.exit(f"{name}: {ensemble.cases - done} of {ensemble.cases} cases are not done")
        for variable in (each for each in KEPT if each in data):
            precision = data[variable].dtype if variable == "status" else np.float32
            arrays[f"{name}/{variable}"] = data[variable].values.astype(precision)
        arrays[f"{name}/rms_slope"] = data.rms_slope.values
        seconds = sum(run["core_seconds"].get(name, 0.0) for run in runs)
        arrays[f"{name}/core_seconds"] = np.array(seconds)
    arrays |= {f"heights/{name}": values for name, values in heights_of(plan.ensembles[0]).items()}
    np.savez_compressed(DATA, **arrays)


def heights_of(ensemble: campaign.Ensemble) -> dict[str, Real]:
    """Return how Gaussian the heights of an ensemble are, over their rms.

    Returns
    -------
    dict of ndarray, shape (dimensions, realisations) or (dimensions, realisations, shares)
        Skewness, excess kurtosis, and the heights above which the shares `BEARING` lie.
    """
    shape = (len(ensemble.fractal_dimensions), ensemble.realisations)
    found = {name: np.empty(shape) for name in ("skewness", "excess_kurtosis")}
    found["bearing_height"] = np.empty((*shape, len(BEARING)))
    for i, dimension in enumerate(ensemble.fractal_dimensions):
        for j in range(ensemble.realisations):
            surface = ensemble.spectrum(dimension).surface(ensemble.n, ensemble.seed_of(j))
            heights = (surface.heights - surface.heights.mean()) / surface.rms_height
            found["skewness"][i, j] = np.mean(heights**3)
            found["excess_kurtosis"][i, j] = np.mean(heights**4) - 3
            found["bearing_height"][i, j] = np.quantile(heights, 1 - np.array(BEARING))
    return found


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
