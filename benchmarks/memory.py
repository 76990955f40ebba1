"""Press one large surface under three loads and print the peak memory: ``make memory``."""

import resource
import sys
import time

import roughline as rl


def peak():
    """Return the largest memory that this process has held so far. [bytes]"""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def main():
    """Print a row of the table of docs/speed.md."""
    n = int(sys.argv[1])
    rl.press(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(512, 0), E_star=1.0, forces=[0.01])
    interpreter = peak()
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7)
    generated = peak()
    start = time.perf_counter()
    curve = rl.press(surface, E_star=1.0, forces=[0.03, 0.3, 3.0])
    wall = time.perf_counter() - start
    before, after = (held - interpreter for held in (generated, peak()))
    print(
        f"| {n}² | {after / n**2:.0f} B a point ({before / n**2:.0f} by the generation) | "
        f"{peak() / 1e9:.2f} GB | {wall / 3:.1f} s a load | {curve.stiffness_bar[-1]:.3f} | "
        f"{curve.residual.max():.0e} |"
    )


if __name__ == "__main__":
    main()
