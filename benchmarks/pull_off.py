"""Pull-off of spheres beside Maugis's, and the price of a pulled load: ``make pull-off``.

The first table is of `docs/adhesion.md`. The second has times of one run: the same surface pressed
with and without a pull, under the same depths. Tamaas 2.9 takes part with an exponential pull,
where it is installed.
"""

import importlib.util
import time

import numpy as np

import roughline as rl
from roughline.exact.adhesion import MaugisSphere

E_STAR, WORK = 0.75, 1 / np.pi  # pi w R = 1, and lengths are those of JKR
SIDES = {0.2: 6.4, 0.5: 4.6, 1.0: 3.45, 2.0: 3.45}


def sphere(points, side):
    x = side / points / 2 * (2 * np.arange(points) + 1 - points)
    return rl.Surface(-(x[:, None] ** 2 + x**2) / 2, (side, side))


def spheres():
    print("lambda  points  cells per radius  zone in cells  error of the pull-off  convolutions")
    for transition, side in SIDES.items():
        exact = MaugisSphere(1.0, WORK, 2 * WORK / transition, E_STAR)
        ratio = exact.pull_off_ratio()
        for points in (36, 72, 144):
            law = rl.Dugdale(WORK, 2 * WORK / transition)
            try:
                curve = rl.press(
                    sphere(points, side), E_star=E_STAR, law=law, forces=[0.0, -3.0], throw=False
                )
            except rl.InputError as error:
                print(f"{transition:6}  {points:6}  {error}")
                continue
            cells = exact.radius(ratio) * points / side
            zone = E_STAR * WORK / (np.pi * (transition / 2) ** 2) * points / side
            off = curve.pull_off_force / exact.force(ratio) - 1
            spent = int(curve.convolutions.sum())
            print(
                f"{transition:6}  {points:6}  {cells:16.1f}  {zone:13.1f}  {off:21.1e}  {spent:12}"
            )


def prices(points=512):
    print("boundary  zone  h_0/h   plain      pulled     ratio")
    spectrum = rl.SelfAffine(
        hurst=0.8, rms_height=0.01, q_roll=8 * np.pi, q_high=2 * np.pi * points / 8
    )
    body = spectrum.surface(points, rng=3)
    mean = float((body.heights.max() - body.heights).mean())
    depths = np.array([0.3, 0.4, 0.5, 0.6]) * mean
    for periodic in (True, False):
        half_space = rl.Homogeneous(1.0, periodic=periodic)
        for zone, reach in ((4.0, 0.1), (8.0, 0.1), (8.0, 0.3)):
            h_0 = reach * body.rms_height
            law = rl.Dugdale(h_0**2 * points / (np.pi * zone), h_0)
            seconds = []
            for of_body in (None, law):
                rl.press(body, half_space=half_space, law=of_body, depths=depths[:1])
                start = time.perf_counter()
                rl.press(body, half_space=half_space, law=of_body, depths=depths)
                seconds.append((time.perf_counter() - start) / depths.size)
            plain, pulled = seconds
            boundary = "periodic" if periodic else "free"
            print(
                f"{boundary:8}  {zone:4.0f}  {reach:5}  {plain:7.3f} s  {pulled:7.3f} s  "
                f"{pulled / plain:6.1f}"
            )


def beside_tamaas(points):
    """The first load of a periodic surface that sticks by an exponential law, of both."""
    import tamaas as tm

    body = rl.SelfAffine(
        hurst=0.8, rms_height=1e-3, q_roll=8 * np.pi, q_high=2 * np.pi * points / 8
    ).surface(points, rng=3)
    law, force, seconds = rl.Exponential(2e-6, 5e-4), 3e-3, []
    for of_body in (None, law):
        start = time.perf_counter()
        curve = rl.press(body, E_star=1.0, periodic=True, law=of_body, forces=[force], fields=True)
        seconds.append(time.perf_counter() - start)
    model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [points, points])
    model.E, model.nu = 1.0, 0.0
    sides = tm.PolonskyKeerRey.gap, tm.PolonskyKeerRey.pressure
    solver = tm.PolonskyKeerRey(model, np.array(body.heights), 1e-8, *sides)
    pull = tm.ExponentialAdhesionFunctional(np.array(body.heights))
    pull.setParameters({"rho": law.range, "surface_energy": law.work_of_adhesion})
    solver.addFunctionalTerm(pull)
    solver.setMaxIterations(20000)
    solver.setDumpFrequency(10**6)
    start = time.perf_counter()
    solver.solve(force)
    seconds.append(time.perf_counter() - start)
    off = np.abs(np.array(model.traction) - curve.fields[0].pressure).max()
    plain, pulled, theirs = seconds
    print(
        f"exponential, {points}²: plain {plain:.2f}, pulled {pulled:.2f}, Tamaas {theirs:.1f} s, "
        f"pressures differ by {off / curve.fields[0].pressure.max():.0e}"
    )


if __name__ == "__main__":
    spheres()
    prices()
    if importlib.util.find_spec("tamaas"):
        for points in (128, 256, 512):
            beside_tamaas(points)
