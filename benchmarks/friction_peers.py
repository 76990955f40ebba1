"""Friction beside ASPHER: a shear force that rises in one direction, on the same surface.

Both press the surface and then shear it in two steps, ours at its tolerance of 1e-6 and with both
tangents, ASPHER at its own tolerances and without. Times are those of the processor, each the least
of two runs in turns. ASPHER takes long where Poisson's ratio is not zero, so it has one run there.

    python benchmarks/friction_peers.py --points 64 128 256
"""

import argparse
import time

import aspher
import numpy as np
from page import Page, machine

import roughline as rl

FORCE, FRICTION = 0.02, 0.3
SHARES = 0.3, 0.6  # of what friction bears


def ours(surface, poisson):
    """Shear and slide of each step along y, which ASPHER calls x, and the time of both."""
    shears = [(0.0, share * FRICTION * FORCE) for share in (0.0, *SHARES)]
    asked = {"half_space": rl.Homogeneous(1.0, poisson=poisson), "friction": rl.Friction(FRICTION)}
    found, times = [], []
    for end in (1, len(shears)):  # the second run goes through the first
        start = time.process_time()
        curve = rl.press(
            surface, forces=[FORCE] * end, shear_forces=shears[:end], fields=True, **asked
        )
        times.append(time.process_time() - start)
    for load in range(1, len(shears)):
        found.append((curve.fields[load].shear[..., 1], curve.slide[load, 1], True))
    return found, times[1] - times[0], FRICTION * curve.fields[0].pressure.max()


def theirs(surface, poisson):
    """The same of ASPHER, and whether it says that it converged."""
    law = aspher.CoulombFriction(FRICTION)
    solver = aspher.FrictionSolver(surface.shape[0], 1.0, 1.0, poisson, law)
    solver.set_gap((surface.heights.max() - surface.heights).ravel())
    solver.step(p_bar=FORCE, q_bar=(0.0, 0.0))
    found, start = [], time.process_time()
    for share in SHARES:
        step = solver.step(q_bar=(share * FRICTION * FORCE, 0.0))
        slide = solver.delta_t[0] if step.converged else np.nan
        found.append((np.reshape(step.qx, surface.shape), slide, step.converged))
    return found, time.process_time() - start


def measure(page, points, poisson):
    """Rows of one grid."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(points, rng=7)
    ours(surface, poisson)  # compiles, and makes what is kept of the grid
    runs = [(ours(surface, poisson), theirs(surface, poisson)) for _ in range(1 if poisson else 2)]
    (mine, _, largest), (its, _) = runs[0]
    ratio = min(run[1][1] for run in runs) / min(run[0][1] for run in runs)
    for share, (shear, slide, _), (other, its_slide, converged) in zip(
        SHARES, mine, its, strict=True
    ):
        page.row(
            f"{points}²",
            poisson,
            share,
            "yes" if converged else "no",
            f"{np.abs(shear - other).max() / largest:.0e}",
            f"{its_slide / slide - 1:+.0e}" if converged else "-",
            f"{ratio:.0f}",
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, nargs="+", default=[64, 128, 256])
    given = parser.parse_args()
    page = Page("friction-peers", "measured.md", "friction-peers", f"{machine()}; ASPHER 0.1.3")
    page.table(
        "grid",
        "Poisson's ratio",
        "Q over μF",
        "ASPHER says converged",
        "largest difference of shear over μ p",
        "of the slide",
        "its time over ours, both steps",
    )
    for points in given.points:
        measure(page, points, 0.0)
    measure(page, given.points[0], 0.3)
    page.save()


if __name__ == "__main__":
    main()
