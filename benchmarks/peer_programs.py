"""Loads in roughline and in other programs, each solved in a process of its own.

All press the free square, fractal down to the grid, of rms height 1 and E* = 1. Forces are then
mean pressures. A function that presses takes a surface and returns what it found as a dictionary.
"""

import importlib.metadata
import multiprocessing
import time
import warnings
from contextlib import suppress
from functools import partial

import numpy as np
import psutil

import roughline as rl
from roughline.computing.cores import available_cores

TOLERANCE = 1e-6
SEED = 7
# Points along a side of the grid that is pressed before; no timed grid has as few. ASPHER takes
# powers of two only; neither it nor the others compile anything at run time.
WARM_UP = {"roughline": 480, "others": 256}
# Points along a side, up to which loads take milliseconds and who presses, presses many surfaces.
SMALL = 256
BRIEF = (
    0.3  # as many presses of a small grid as fit into this make one run, the shortest counts [s]
)
MOST_ITERATIONS = 100_000
SPAWN = multiprocessing.get_context("spawn")

# The interpolation of order 6 is the default of its H² product. Order 5 is faster, but the contact
# area is off by more than 1e-4.
_FFT = {"backend": "fft", "precond_engine": "fft"}
ENGINES_OF_ASPHER = {
    "H²": {"active_set": True},
    "H², Fourier": {"active_set": True, "precond_engine": "fft"},
    "FFT": _FFT,
    "FFT, single first": _FFT | {"precision": "float_then_double"},
}
PACKAGES = {"ASPHER": "aspher", "Tamaas": "tamaas", "ContactMechanics": "ContactMechanics"}


def found(area, force, converged):
    """What a program tells of one load."""
    return {"area": float(area), "force": float(force), "converged": bool(converged)}


def press_roughline(surface, force):
    curve = rl.press(surface, E_star=1.0, forces=[force], rtol=TOLERANCE)
    return found(curve.area_fraction[0], curve.force[0], True)  # it raises otherwise


def path_of_roughline(surface, n_loads):
    """Press from first touch to saturation with roughline; every stiffness is included."""
    curve = rl.press(surface, E_star=1.0, n_loads=n_loads, rtol=TOLERANCE)
    return {
        "areas": curve.area_fraction.tolist(),
        "forces": curve.force.tolist(),
        "convolutions": curve.convolutions.tolist(),
        "converged": True,
    }


def press_aspher(surface, force, engine):
    """Press with ASPHER from coarse to fine grids."""
    import aspher

    n, heights = surface.shape[0], surface.heights
    result = aspher.solve_nested(
        grid_size=n,
        gap=(heights.max() - heights).ravel(),
        p_nominal=force,
        E_star=1.0,
        tol=TOLERANCE,
        max_iter=MOST_ITERATIONS,
        coarsest=min(64, n // 2),  # its default, where the grid is larger
        **ENGINES_OF_ASPHER[engine],
    )
    return found(result.contact_area, result.mean_pressure, result.converged)


def path_of_aspher(surface, forces):
    """Press with ASPHER's FFT, each load from the pressures of the load before."""
    import aspher

    gap = (surface.heights.max() - surface.heights).ravel()
    solver = aspher.ContactSolver(grid_size=surface.shape[0], E_star=1.0, backend="fft")
    settings = {"tol": TOLERANCE, "max_iter": MOST_ITERATIONS, "precond": "fourier-fft"}
    pressure, results = None, []
    for force in forces:
        results.append(solver.solve(gap, p_nominal=force, p_init=pressure, **settings))
        pressure = results[-1].pressure
    return {
        "areas": [result.contact_area for result in results],
        "converged": all(result.converged for result in results),
    }


def press_tamaas(surface, force):
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    n = surface.shape[0]
    model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tm.PolonskyKeerRey(model, np.array(surface.heights), TOLERANCE)
    solver.setIntegralOperator("dcfft")
    solver.setMaxIterations(MOST_ITERATIONS)
    error = solver.solve(force)
    pressure = np.array(model.traction)
    return found(np.mean(pressure > 0), pressure.mean(), error <= TOLERANCE)


def press_contact_mechanics(surface, force):
    from ContactMechanics import FreeFFTElasticHalfSpace
    from ContactMechanics.Factory import make_system
    from SurfaceTopography import Topography

    n = surface.shape[0]
    system = make_system(
        substrate=FreeFFTElasticHalfSpace((n, n), 1.0, (1.0, 1.0)),
        surface=Topography(np.array(surface.heights), (1.0, 1.0)),
    )
    # the rms height is 1, so pentol is the same bound on gaps
    result = system.minimize_proxy(external_force=force, pentol=TOLERANCE, maxiter=MOST_ITERATIONS)
    forces = np.asarray(result.jac)[:n, :n]
    return found(np.mean(forces > 0), forces.sum(), result.success)


def versions():
    installed = {"roughline": rl.__version__}
    for program, package in PACKAGES.items():
        with suppress(importlib.metadata.PackageNotFoundError):
            installed[program] = importlib.metadata.version(package)
    return installed


def entrants(programs, force):
    """Return what presses one load, for each program and each of its engines."""
    presses = {"roughline": partial(press_roughline, force=force)}
    for engine in ENGINES_OF_ASPHER:
        presses[f"ASPHER, {engine}"] = partial(press_aspher, force=force, engine=engine)
    presses["Tamaas"] = partial(press_tamaas, force=force)
    presses["ContactMechanics"] = partial(press_contact_mechanics, force=force)
    return {label: press for label, press in presses.items() if program_of(label) in programs}


def program_of(label):
    """Return the program of an entrant, whose label may name an engine after it."""
    return label.partition(", ")[0]


def timed(press, n, hurst, limit):
    """Press in a process of its own, and stop it after so many seconds.

    The process has pressed another surface before: machine code is loaded. That was on another
    grid, so that neither tables nor memory of the timed grid are there; but a small grid is pressed
    again and again, and finds there what a program keeps from one press to the next. What comes
    back has "seconds" when it ended, and "others", the part of them in which other work had the
    cores; "stopped_after" when it was stopped; and "failed" when it raised or died.
    """
    receiver, sender = SPAWN.Pipe(duplex=False)
    process = SPAWN.Process(target=answer, args=(sender, press, n, hurst))
    process.start()
    sender.close()
    try:
        receiver.recv()  # it begins
        if receiver.poll(limit):
            return receiver.recv()
        return {"stopped_after": limit}
    except EOFError:
        return {"failed": True}
    finally:
        process.kill()
        process.join()


def answer(sender, press, n, hurst):
    """Press another surface and then the timed one; tell when the latter begins and how it ends."""
    warnings.simplefilter("ignore")
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0)
    ours = press.func in (press_roughline, path_of_roughline)
    before = n if n <= SMALL else WARM_UP["roughline" if ours else "others"]
    press(spectrum.surface(before, SEED + 1))
    surface = spectrum.surface(n, SEED)
    sender.send("begins")
    start, own, all_work = time.perf_counter(), time.process_time(), busy_seconds()
    told = press(surface)
    shortest = spent = time.perf_counter() - start
    while n <= SMALL and spent < BRIEF:
        surface, again = spectrum.surface(n, SEED), time.perf_counter()  # holds nothing yet
        press(surface)
        shortest = min(shortest, time.perf_counter() - again)
        spent = time.perf_counter() - start
    others = max(0.0, busy_seconds() - all_work - (time.process_time() - own)) / available_cores()
    sender.send({"seconds": shortest, "others": shortest * others / spent, **told})


def busy_seconds():
    """Return how long the cores of this machine have worked, or were taken by its host. [s]"""
    times = psutil.cpu_times()._asdict()
    return sum(
        times.get(name, 0.0) for name in ("user", "nice", "system", "irq", "softirq", "steal")
    )
