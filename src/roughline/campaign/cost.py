"""What a campaign will cost in time, memory and disk, and how many cases make a batch."""

from __future__ import annotations

import math
import shutil
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from roughline.campaign.batch import evaluate_case
from roughline.campaign.layout import CASE_DIGEST, CASE_STATUS, stored_variables
from roughline.campaign.plan import Ensemble, Plan
from roughline.computing import fft
from roughline.computing.cores import available_cores
from roughline.computing.memory import free_memory
from roughline.contact import estimates
from roughline.errors import InputError, StoreError

_BATCH_SECONDS = 1.0  # sending, receiving and writing a batch takes some ten milliseconds
_MOST_VALUES_PER_CHUNK = 2**20  # of one variable, so that one chunk is some megabytes
_GENERATION_BYTES = 40  # per point of a surface, while it is generated
_LINE_BYTES = 60  # per point of a line, to generate and to press it
_BLOCK_BYTES = 4096  # of a file system
_METADATA_FILES = 30  # of each ensemble
_SATURATING_FORCE = 3.0  # reduced force, up to which some of a free surface is in contact
_WORKER_BYTES = 300_000_000  # of the interpreter and its libraries


@dataclass(frozen=True)
class _Cost:
    """Cost of computing some cases."""

    cases: int  # number of bodies
    core_seconds: float  # time on one core of this machine, to a factor of two or three [s]
    memory: int  # largest memory of one worker [bytes]
    disk: int  # size of the results, before compression [bytes]

    def described(self, workers: int | None) -> str:
        """Return the cost in words, shared among a number of workers, or for each if not known."""
        seconds = _duration(self.core_seconds / (workers or 1))
        if workers is None:
            shared = f"{seconds}, shared among the workers of the cluster"
        else:
            shared = f"{seconds} with {workers} worker{'s' if workers > 1 else ''}"
        return (
            f"{self.cases} cases to compute; about {shared}, {self.memory / 1e9:.2g} GB of memory "
            f"each, up to {self.disk / 1e6:.2g} MB of disk"
        )


def chunk_shape(ensemble: Ensemble) -> tuple[int, int]:
    """Return how many fractal dimensions and realisations make a batch, and a chunk of the store.

    A batch takes about a second on a nominal core. Its size depends on the plan alone, so that
    equal plans give equal stores on all machines.
    """
    loads = len(ensemble.force_bars)
    most = max(1, min(round(_BATCH_SECONDS / _nominal(ensemble)), _MOST_VALUES_PER_CHUNK // loads))
    realisations = min(most, ensemble.realisations)
    return min(most // realisations, len(ensemble.fractal_dimensions)), realisations


def estimated_cost(plan: Plan, missing: dict[str, int]) -> _Cost:
    """Estimate the cost of what is missing, from the time of one small problem of each kind."""
    seconds, memory = 0.0, 0
    for ensemble in plan.ensembles:
        count = missing[ensemble.name]
        if count:
            seconds += count * _timed(ensemble)
            memory = max(memory, _worker_memory(ensemble))
    return _Cost(sum(missing.values()), seconds, memory, _result_bytes(plan, missing))


def _worker_memory(ensemble: Ensemble) -> int:
    """Return the memory of a worker with one case of an ensemble. [bytes]"""
    if ensemble.model == "reduced":
        return _WORKER_BYTES + _LINE_BYTES * ensemble.n
    shape = (ensemble.n, ensemble.n)
    law, half_space, spacing = ensemble.contact_law(1.0), ensemble.pressed_into, 1 / ensemble.n
    saturates = max(ensemble.force_bars) > _SATURATING_FORCE
    share = 1.0 if saturates else estimates.most_in_contact(half_space.periodic)
    besides = estimates.bytes_of_layers(half_space, shape, (spacing, spacing))
    besides += estimates.bytes_of_pull(law, 1.0)
    if ensemble.friction is not None:
        besides += estimates.bytes_of_shear(0, share, coupled=half_space.is_coupled)
    pressing = estimates.memory_for(
        shape,
        half_space.periodic,
        0,
        yielding=law.memory == "dents",
        area_fraction=share,
        besides=besides,
    )
    heights = 8 * ensemble.n**2
    return _WORKER_BYTES + heights + max(pressing, _GENERATION_BYTES * ensemble.n**2)


def _times_longer(ensemble: Ensemble) -> int:
    """As long as so many loads without friction one of an ensemble takes."""
    if ensemble.friction is None:
        return 1
    return estimates.TIMES_WITH_FRICTION[ensemble.pressed_into.is_coupled]


def _result_bytes(plan: Plan, missing: dict[str, int]) -> int:
    """Return the size of results, before compression. [bytes]"""
    return sum(
        _bytes_on_disk(ensemble, missing[ensemble.name])
        for ensemble in plan.ensembles
        if missing[ensemble.name]
    )


def refuse_more_than_disk(plan: Plan, missing: dict[str, int], store: Path) -> None:
    """Refuse a campaign whose results the disk cannot hold."""
    folder = store.absolute()
    while not folder.exists():
        folder = folder.parent
    needed, free = _result_bytes(plan, missing), shutil.disk_usage(folder).free
    if needed > free:
        raise StoreError(
            f"{sum(missing.values())} cases need up to {needed / 1e9:.3g} GB of disk, and "
            f"{free / 1e9:.3g} GB is free in {folder}: make room, or take fewer cases or loads"
        )


def _nominal(ensemble: Ensemble) -> float:
    """Time of a case on a nominal core. [s]"""
    if ensemble.model == "reduced":
        return 2e-4 + 2e-8 * ensemble.n
    times = _times_longer(ensemble) * len(ensemble.force_bars)
    return times * (1e-3 + 5e-7 * ensemble.n**2)


def _timed(ensemble: Ensemble) -> float:
    """Time of a case on one core of this machine. [s]"""
    before = fft.threads()
    fft.set_threads(1)
    try:
        if ensemble.model == "full":
            shape = (ensemble.n, ensemble.n)
            periodic = ensemble.pressed_into.periodic
            one = estimates.estimate(shape, len(ensemble.force_bars), periodic=periodic)
            return _times_longer(ensemble) * one.seconds
        small = replace(ensemble, n=min(ensemble.n, 2**18), roll_off_ratio=1.0, cutoff_ratio=None)
        evaluate_case(small, small.fractal_dimensions[0], 0)  # compiles
        start = time.perf_counter()
        evaluate_case(small, small.fractal_dimensions[0], 0)
        return (time.perf_counter() - start) * ensemble.n / small.n
    finally:
        fft.set_threads(before)


def _bytes_on_disk(ensemble: Ensemble, cases: int) -> int:
    """Size of the results of some cases, in the whole blocks that files take. [bytes]"""
    loads = len(ensemble.force_bars)
    high, wide = chunk_shape(ensemble)
    chunks = math.ceil(cases / (high * wide))
    per_chunk = 0
    for variable in (*stored_variables(ensemble), CASE_DIGEST, CASE_STATUS):
        values = high * wide * (1 if variable.per_body else loads)
        per_chunk += _BLOCK_BYTES * math.ceil(
            values * np.dtype(variable.dtype).itemsize / _BLOCK_BYTES
        )
    return chunks * per_chunk + _BLOCK_BYTES * _METADATA_FILES


def _duration(seconds: float) -> str:
    """Return a time in words, in the unit that suits it."""
    for size, unit in ((86400, "days"), (3600, "h"), (60, "min")):
        if seconds >= 1.5 * size:
            return f"{seconds / size:.1f} {unit}"
    return f"{math.ceil(seconds)} s"


def workers_that_fit(memory: int, wanted: int | None) -> int:
    """Return how many workers this machine's cores and memory allow."""
    free = free_memory()
    fitting = int(0.95 * free // memory)
    if fitting < (wanted or 1):
        raise InputError(
            f"{wanted or 1} workers need about {(wanted or 1) * memory / 1e9:.3g} GB of memory for "
            f"the largest case, and {free / 1e9:.3g} GB is free: take "
            + ("fewer workers" if fitting else "fewer points")
        )
    return wanted or min(fitting, available_cores())
