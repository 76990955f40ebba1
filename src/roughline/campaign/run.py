"""Computing a plan: the batches that a store lacks, on all cores, each written when it is done."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool

import numpy as np
from numpy.typing import NDArray

from roughline import fft
from roughline.campaign.plan import Case, Gallery, Plan
from roughline.campaign.store import Store
from roughline.contact import press
from roughline.curve import Curve
from roughline.errors import RoughlineError
from roughline.spectra import SelfAffine

Progress = Callable[[str, int, int], None]
Results = dict[str, NDArray[np.generic]]


def run(
    plan: Plan, store: Store, workers: int | None = None, progress: Progress | None = None
) -> None:
    """Compute what the store lacks of a plan.

    Interrupting keeps every batch that was finished; a further call goes on from there. Results
    do not depend on the number of workers, nor on the order.

    Parameters
    ----------
    plan : Plan
        What to compute.
    store : Store
        Where results go.
    workers : int, optional
        Processes; default: one for each core.
    progress : callable, optional
        Called with (stage, batches done, batches in all); once at the start of each stage too.
    """
    report = progress or (lambda stage, done, total: None)
    workers = workers or fft.available_cores()
    report("gallery", int(store.has_gallery()), 1)
    if not store.has_gallery():
        store.put_gallery(_gallery(plan.gallery))
        report("gallery", 1, 1)
    for ensemble in (plan.reduced, plan.full):
        missing = store.missing(ensemble)
        total = len(ensemble.cases())
        report(ensemble.model, total - len(missing), total)
        if missing:
            _run_cases(missing, total, store, workers, report)


def evaluate(case: Case) -> Results:
    """Generate and press the bodies of one batch; arrays over (realisation, load) or (realisation).

    Everything is dimensionless: stiffness over E* L, depth over h.
    """
    ensemble = case.ensemble
    spectrum = SelfAffine(
        fractal_dimension=ensemble.fractal_dimensions[case.dimension_index], rms_height=1.0
    )
    forces = np.array(ensemble.force_bars)
    curves: list[Curve] = []
    slopes: list[float] = []
    for realisation in case.realisations:
        seed = ensemble.seed_of(realisation)
        if ensemble.model == "reduced":
            line = spectrum.line(ensemble.n, seed)
            curves.append(press(line, E_star=1.0, forces=forces))
            slopes.append(line.rms_slope)
        else:
            surface = spectrum.surface(ensemble.n, seed)
            curves.append(press(surface, E_star=1.0, forces=forces, throw=False))
            slopes.append(surface.rms_slope)
    results: Results = {
        "stiffness": np.array([curve.stiffness for curve in curves]),
        "depth": np.array([curve.depth for curve in curves]),
        "status": np.array([curve.status for curve in curves]),
        "resolved": np.array([curve.resolved for curve in curves], dtype=np.int8),
        "rms_slope": np.array(slopes),
    }
    if ensemble.model == "full":
        results["area_fraction"] = np.array([curve.area_fraction for curve in curves])
    return results


def _run_cases(cases: list[Case], total: int, store: Store, workers: int, report: Progress) -> None:
    context = multiprocessing.get_context("spawn")
    not_ours = set(multiprocessing.active_children())
    done = total - len(cases)
    pool = ProcessPoolExecutor(workers, context, initializer=_start_worker)
    try:
        pending: dict[Future[Results], Case] = {pool.submit(evaluate, case): case for case in cases}
        while pending:
            finished, _ = wait(pending, return_when=FIRST_COMPLETED)
            for future in finished:
                case = pending.pop(future)
                store.put(case, future.result())
                done += 1
                report(case.ensemble.model, done, total)
    except BaseException as error:
        pool.shutdown(wait=False, cancel_futures=True)
        # a batch may take minutes: whoever interrupts is not made to wait for it
        for process in set(multiprocessing.active_children()) - not_ours:
            process.terminate()
        if isinstance(error, BrokenProcessPool):
            raise RoughlineError(
                "a worker process died, perhaps for want of memory; what is done is kept: run "
                "again, with fewer workers"
            ) from error
        raise
    pool.shutdown()


def _start_worker() -> None:
    """One thread for each worker, and an interrupt is the parent's business."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    fft.set_threads(1)


def _gallery(gallery: Gallery) -> Results:
    """Press one surface for each fractal dimension; keep what the figures show."""
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
