"""Time one cold load in roughline and in the other programs that are installed.

``python benchmarks/peers.py 512``. All solve the free square, fractal down to the grid, H = 0.8, to
1e-6, at about 2 % contact. The others return no stiffness; roughline's time includes it.
"""

import sys
import time
import warnings

import numpy as np

import roughline as rl

FORCE_BAR = 0.38


def timed(name, press):
    """Print a row: program, seconds, contact area."""
    start = time.perf_counter()
    area = press()
    wall = time.perf_counter() - start
    print(f"| {name} | {wall:.2f} s | {area:.3%} |", flush=True)
    return wall


def press_roughline(surface):
    """Press with roughline; stiffness included."""
    curve = rl.press(surface, E_star=1.0, forces=[FORCE_BAR])
    return curve.area_fraction[0]


def press_tamaas(surface):
    """Press with Tamaas and its non-periodic operator."""
    import tamaas as tm

    n = surface.shape[0]
    model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tm.PolonskyKeerRey(model, np.array(surface.heights), 1e-6)
    solver.setIntegralOperator("dcfft")
    solver.setMaxIterations(100000)
    solver.solve(FORCE_BAR)
    return np.count_nonzero(np.array(model.traction) > 0) / n**2


def press_contact_mechanics(surface):
    """Press with ContactMechanics and its free half-space."""
    from ContactMechanics import FreeFFTElasticHalfSpace
    from ContactMechanics.Factory import make_system
    from SurfaceTopography import Topography

    n = surface.shape[0]
    system = make_system(
        substrate=FreeFFTElasticHalfSpace((n, n), 1.0, (1.0, 1.0)),
        surface=Topography(np.array(surface.heights), (1.0, 1.0)),
    )
    # rms height 1, so pentol is the same bound on gaps
    result = system.minimize_proxy(external_force=FORCE_BAR, pentol=1e-6, maxiter=100000)
    return np.count_nonzero(np.asarray(result.jac)[:n, :n] > 0) / n**2


def main():
    """Print a table for one size."""
    warnings.simplefilter("ignore")
    n = int(sys.argv[1])
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    press_roughline(spectrum.surface(512, 7))  # compiles
    surface = spectrum.surface(n, 7)
    print(f"| {n}² | one load | contact |\n|---|---|---|")
    ours = timed("roughline, with stiffness", lambda: press_roughline(surface))
    for name, press in (
        ("ContactMechanics", press_contact_mechanics),
        ("Tamaas, dcfft", press_tamaas),
    ):
        try:
            wall = timed(name, lambda press=press: press(surface))
        except ImportError:
            print(f"| {name} | not installed | |")
        else:
            print(f"| ... over roughline | {wall / ours:.0f} | |", flush=True)


if __name__ == "__main__":
    main()
