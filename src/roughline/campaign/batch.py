"""The unit of work: bodies that one worker generates and presses, and that are stored together."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.layout import stored_variables
from roughline.campaign.plan import Ensemble
from roughline.computing import fft
from roughline.computing.cores import available_cores
from roughline.contact.loads import unbearable_pull
from roughline.contact.press import press
from roughline.errors import RoughlineError

_BatchResults = dict[str, NDArray[Any]]


@dataclass(frozen=True, eq=False)
class Batch:
    """Cases of one ensemble that lie in one chunk of the store."""

    # arrays, not tuples: with thousands of tuples, garbage collection slows Dask's event loops
    ensemble: Ensemble
    # shape (n, 2): index of the fractal dimension in the store, and realisation, of each case
    cells: NDArray[np.intp]
    fractal_dimensions: NDArray[np.float64]  # shape (n,): that of each case

    def split(self) -> list[Batch]:
        """Return batches of one case each."""
        return [
            Batch(self.ensemble, self.cells[i : i + 1], self.fractal_dimensions[i : i + 1])
            for i in range(len(self.cells))
        ]


@dataclass(frozen=True)
class BatchResult:
    """Results of a batch."""

    # every variable over (case, load) or (case); cases that failed hold fill values
    results: _BatchResults
    failures: dict[int, str]  # why cases failed, by the index of the case in the batch
    core_seconds: float = 0.0  # computing time of the batch, summed over its cores [s]


class VersionError(RoughlineError):
    """A worker has another version of roughline."""


def check_version(wanted: str) -> None:
    """Raise if this process does not have the wanted version of roughline."""
    if wanted != __version__:
        raise VersionError(f"a worker has roughline {__version__}, and the campaign has {wanted}")


def evaluate(batch: Batch, threads: int, version: str) -> BatchResult:
    """Generate and press the bodies of a batch one by one; one that fails does not stop the others.

    Everything is dimensionless: stiffness over E* L, depth over h.
    """
    check_version(version)
    fft.set_threads(min(threads, available_cores()))
    clock = time.thread_time if threads == 1 else time.process_time
    start = clock()
    ensemble = batch.ensemble
    loads = len(ensemble.force_bars)
    results: _BatchResults = {}
    for variable in stored_variables(ensemble):
        shape = (len(batch.cells),) if variable.per_body else (len(batch.cells), loads)
        results[variable.name] = np.full(shape, variable.fill, dtype=variable.dtype)
    failures: dict[int, str] = {}
    realisations = batch.cells[:, 1].tolist()
    for i, dimension in enumerate(batch.fractal_dimensions.tolist()):
        try:
            case = evaluate_case(ensemble, dimension, realisations[i])
        except Exception as error:  # the other cases go on, and the store keeps the reason
            failures[i] = f"{type(error).__name__}: {error}".splitlines()[0]
            continue
        for name, values in case.items():
            results[name][i] = values
    return BatchResult(results, failures, clock() - start)


def evaluate_case(ensemble: Ensemble, fractal_dimension: float, realisation: int) -> _BatchResults:
    """Generate and press one body; return every variable of it, over the loads or as one value."""
    spectrum = ensemble.spectrum(fractal_dimension)
    seed = ensemble.body_seed(realisation)
    make = spectrum.line if ensemble.model == "reduced" else spectrum.surface
    body = make(ensemble.n, seed)
    forces, rms_slope = np.array(ensemble.force_bars), body.rms_slope
    law = ensemble.contact_law(rms_slope)
    if not law.only_pushes:
        forces = np.append(forces, unbearable_pull(law, 1.0))
    curve = press(
        body,
        half_space=ensemble.pressed_into,
        law=None if ensemble.model == "reduced" else law,
        forces=forces,
        friction=ensemble.friction,
        shear_forces=ensemble.shear_bars,
        throw=False,
    )
    of_body = {
        "rms_slope": rms_slope,
        "highest": body.heights.max() - body.heights.mean(),
        "pull_off_force": curve.pull_off_force,
    }
    loads = len(ensemble.force_bars)
    return {
        each.name: np.asarray(
            of_body[each.name] if each.per_body else each.along_x(getattr(curve, each.name)[:loads])
        )
        for each in stored_variables(ensemble)
    }
