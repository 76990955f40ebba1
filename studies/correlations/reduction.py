"""From the store of the study to what its page needs, less than a megabyte.

``data.npz`` has arrays of the store by "ENSEMBLE/VARIABLE", in single precision, and how Gaussian
the heights are. What the ensembles are stands in ``plan.toml``.
"""

import time
from pathlib import Path
from statistics import NormalDist

import numpy as np

from roughline import campaign
from roughline.campaign.batch import evaluate_case
from roughline.computing import fft
from roughline.computing.arrays import Real
from studies.reduced_data import finished, version_of

HERE = Path(__file__).parent
KEPT = ("stiffness", "unloading_stiffness", "area_fraction", "plastic_fraction", "status")
BEARING = (1e-1, 1e-2, 1e-3, 1e-4)  # shares of Gaussian surfaces that lie above a height


def reduce_store(path: Path) -> None:
    """Reduce a finished store."""
    plan, store = campaign.read_plan(HERE / "plan.toml"), campaign.Store(path)
    evaluate_case(plan.ensemble("band2-hardness0.01"), 2.5, 0)  # compiles, before times are taken
    arrays = {}
    for ensemble in plan.ensembles:
        name = ensemble.name
        data = finished(store, ensemble)
        for variable in (each for each in KEPT if each in data):
            precision = data[variable].dtype if variable == "status" else np.float32
            arrays[f"{name}/{variable}"] = data[variable].values.astype(precision)
        arrays[f"{name}/rms_slope"] = data.rms_slope.values
        arrays[f"{name}/core_seconds"] = np.array(_seconds_of(ensemble))
    arrays |= {f"heights/{name}": values for name, values in heights_of(plan.ensembles[0]).items()}
    versions = version_of(store.dataset(each.name) for each in plan.ensembles)
    arrays["roughline_version"] = np.array(versions)
    np.savez_compressed(HERE / "data.npz", **arrays)  # type: ignore[arg-type]


def _seconds_of(ensemble: campaign.Ensemble) -> float:
    """Return the time of all bodies of an ensemble on one core, from that of one. [s]"""
    fft.set_threads(1)
    start = time.thread_time()
    evaluate_case(ensemble, ensemble.fractal_dimensions[0], 0)
    return round((time.thread_time() - start) * ensemble.cases, 1)


def heights_of(ensemble: campaign.Ensemble) -> dict[str, Real]:
    """Return how Gaussian the heights of an ensemble are, over dimensions and realisations.

    By skewness, excess kurtosis, and the shares of the area that lie above the heights above which
    the shares `BEARING` of Gaussian surfaces lie.
    """
    shape = (len(ensemble.fractal_dimensions), ensemble.realisations)
    found = {name: np.empty(shape) for name in ("skewness", "excess_kurtosis")}
    found["bearing"] = np.empty((*shape, len(BEARING)))
    levels = [-NormalDist().inv_cdf(share) for share in BEARING]
    for i, dimension in enumerate(ensemble.fractal_dimensions):
        for j in range(ensemble.realisations):
            surface = ensemble.spectrum(dimension).surface(ensemble.n, ensemble.body_seed(j))
            heights = (surface.heights - surface.heights.mean()) / surface.rms_height
            found["skewness"][i, j] = np.mean(heights**3)
            found["excess_kurtosis"][i, j] = np.mean(heights**4) - 3
            found["bearing"][i, j] = [np.mean(heights > level) for level in levels]
    return found
