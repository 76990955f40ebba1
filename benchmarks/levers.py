"""What each lever of the full model is worth: a path of loads with one of them taken away."""

import sys
import time
from contextlib import contextmanager

import roughline as rl
from roughline.halfspace.inverse import approximate_inverse as preconditioner
from roughline.halfspace.operators import convolution
from roughline.halfspace.operators.restricted import RestrictedOperators
from roughline.halfspace.search import cascade, path, tangent


@contextmanager
def without(module, name, value):
    """Replace a part for a while."""
    sound = getattr(module, name)
    setattr(module, name, value)
    try:
        yield
    finally:
        setattr(module, name, sound)


def measured(surface, n_loads, **options):
    """Return seconds and convolutions for each load of a path."""
    start = time.perf_counter()
    curve = rl.press(surface, E_star=1.0, n_loads=n_loads, **options)
    return (time.perf_counter() - start) / n_loads, curve.convolutions.mean()


def main():
    """Print the table."""
    n, n_loads = int(sys.argv[1]) if len(sys.argv) > 1 else 1024, 20
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7)
    rl.press(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(512, 7), E_star=1.0, n_loads=3)
    levers = {
        "nothing": without(path, "_LARGEST_CHANGE", path._LARGEST_CHANGE),
        "steps restricted to the contact": without(
            RestrictedOperators, "on", lambda self, nodes: None
        ),
        "sums over pairs of few nodes": without(convolution, "_PAIRS", 0.0),
        "direct solution of few nodes": without(preconditioner, "_DIRECT", 0),
        "energy of the tangent's error as its measure (1e-12 instead)": without(
            tangent, "_ENERGY_MARGIN", 1e-6
        ),
        "prediction along the tangent (coarse grids every time)": without(
            path, "_LARGEST_CHANGE", 0.0
        ),
        "coarse grids (rigid shift for the first load)": without(cascade, "_COARSEST", 10**6),
    }
    print(f"{n}², H = 0.8, {n_loads} loads\n\n| without | per load | convolutions |\n|---|---|---|")
    for name, lever in levers.items():
        with lever:
            wall, count = measured(surface, n_loads)
        print(f"| {name} | {wall:.2f} s | {count:.0f} |", flush=True)
    wall, count = measured(surface, n_loads, precision="float64")
    print(f"| single precision for the steps | {wall:.2f} s | {count:.0f} |")


if __name__ == "__main__":
    main()
