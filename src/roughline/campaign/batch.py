"""The unit of work: bodies that one worker generates and presses, and that are stored together."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.layout import PER_BODY, VARIABLES, variables_of
from roughline.campaign.plan import Ensemble, Gallery
from roughline.computing import fft
from roughline.contact.press import press
from roughline.errors import RoughlineError
from roughline.spectra.self_affine import SelfAffine

Results = dict[str, NDArray[Any]]


@dataclass(frozen=True, eq=False)
class Batch:
    """Cases of one ensemble that lie in one chunk of the store.

    Attributes
    ----------
    ensemble : Ensemble
        What they belong to.
    cells : ndarray, shape (n, 2)
        Where they lie: index of the fractal dimension in the store, and realisation.
    fractal_dimensions : ndarray, shape (n,)
        Of each.
    """

    # arrays, not tuples: thousands of tuples would keep the collector of Dask's loops busy
    ensemble: Ensemble
    cells: NDArray[np.intp]
    fractal_dimensions: NDArray[np.float64]

    def split(self) -> list[Batch]:
        """Return batches of one case each."""
        return [
            Batch(self.ensemble, self.cells[i : i + 1], self.fractal_dimensions[i : i + 1])
            for i in range(len(self.cells))
        ]


@dataclass(frozen=True)
class Outcome:
    """What became of a batch.

    Attributes
    ----------
    results : dict of ndarray
        Every variable over (case, load) or (case); cases that failed hold fill values.
    failures : dict
        Reasons, by the index of the case in the batch.
    core_seconds : float
        Computing time that it took, on all its cores. [s]
    """

    results: Results
    failures: dict[int, str]
    core_seconds: float = 0.0


class VersionError(RoughlineError):
    """A worker has another version of roughline."""


def check_version(wanted: str) -> None:
    """Raise if this process has another version than the one that asks."""
    if wanted != __version__:
        raise VersionError(f"a worker has roughline {__version__}, this is {wanted}")


def evaluate(batch: Batch, threads: int, version: str) -> Outcome:
    """Generate and press the bodies of a batch, each for itself: one that fails stops no other.

    Everything is dimensionless: stiffness over E* L, depth over h.

    Parameters
    ----------
    batch : Batch
        The bodies.
    threads : int
        Threads for each.
    version : str
        Version of roughline of whoever asks.

    Raises
    ------
    VersionError
        If this process has another version.
    """
    check_version(version)
    fft.set_threads(min(threads, fft.available_cores()))
    clock = time.thread_time if threads == 1 else time.process_time
    start = clock()
    ensemble = batch.ensemble
    loads = len(ensemble.force_bars)
    results: Results = {}
    for name in variables_of(ensemble):
        dtype, fill, _ = VARIABLES[name]
        shape = (len(batch.cells),) if name in PER_BODY else (len(batch.cells), loads)
        results[name] = np.full(shape, fill, dtype=dtype)
    failures: dict[int, str] = {}
    realisations = batch.cells[:, 1].tolist()
    for i, dimension in enumerate(batch.fractal_dimensions.tolist()):
        try:
            case = evaluate_case(ensemble, dimension, realisations[i])
        except Exception as error:  # whatever it is, the others go on, and the store says it
            failures[i] = f"{type(error).__name__}: {error}".splitlines()[0]
            continue
        for name, values in case.items():
            results[name][i] = values
    return Outcome(results, failures, clock() - start)


def evaluate_case(ensemble: Ensemble, fractal_dimension: float, realisation: int) -> Results:
    """Generate and press one body; every variable over the loads, or alone."""
    spectrum = ensemble.spectrum(fractal_dimension)
    seed = ensemble.seed_of(realisation)
    make = spectrum.line if ensemble.model == "reduced" else spectrum.surface
    body = make(ensemble.n, seed)
    curve = press(
        body,
        E_star=1.0,
        forces=np.array(ensemble.force_bars),
        periodic=ensemble.boundary == "periodic",
        throw=False,
    )
    of_body = {"rms_slope": body.rms_slope, "highest": body.heights.max() - body.heights.mean()}
    return {
        name: np.asarray(of_body[name] if name in of_body else getattr(curve, name))
        for name in variables_of(ensemble)
    }


def evaluate_gallery(gallery: Gallery, threads: int, version: str) -> Results:
    """Press one surface for each fractal dimension; keep what the figures show."""
    check_version(version)
    fft.set_threads(min(threads, fft.available_cores()))
    fields: dict[str, list[NDArray[np.generic]]] = {
        name: [] for name in ("heights", "contact", "displacement", "line_heights")
    }
    depths: list[float] = []
    for fractal_dimension in gallery.fractal_dimensions:
        spectrum = SelfAffine(fractal_dimension=fractal_dimension, rms_height=1.0)
        surface = spectrum.surface(gallery.n, gallery.seed)
        line = spectrum.line(gallery.n_line, gallery.seed)
        curve = press(surface, E_star=1.0, forces=[gallery.force_bar], fields=True)
        found = curve.fields[0]
        assert found is not None
        fields["heights"].append(surface.heights)
        fields["contact"].append(found.contact)
        fields["displacement"].append(found.displacement)
        fields["line_heights"].append(line.heights)
        depths.append(float(press(line, E_star=1.0, forces=[gallery.force_bar]).depth[0]))
    return {**{k: np.array(v) for k, v in fields.items()}, "line_depth": np.array(depths)}
