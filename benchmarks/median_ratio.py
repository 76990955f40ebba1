"""The stiffness of the full model over that of the reduced one, as a line scan's answer needs it.

The map of trust has means of 20 surfaces at each place, which scatter by a tenth under light loads.
Here 256 surfaces and 600 lines with the same spectrum give the ratio of geometric means, which are
the middles of a stiffness whose logarithm is symmetric:

    python benchmarks/median_ratio.py 1 2 4 8 16 32 > median_ratio.csv

Waves end at 32 times the longest, and from a roll-off of 16 on at 64 times: the shortest has eight
points, or four.
"""

import sys

import numpy as np

import roughline as rl

SURFACES, LINES, POINTS, SPRINGS = 256, 600, 256, 2**14
HURSTS = (0.3, 0.8)
FORCE_BARS = (1e-3, 3.16e-3, 1e-2, 3.16e-2, 0.1, 0.316, 1.0)
COLUMNS = ("roll_off_ratio", "fractal_dimension", "force_bar", "ratio", "standard_error")


def rows(roll, hurst):
    """The ratio of the models and the standard error of its logarithm, under each load."""
    last = 64 if roll >= 16 else 32
    spectrum = rl.SelfAffine(
        hurst=hurst, rms_height=0.01, q_roll=2 * np.pi * roll, q_high=2 * np.pi * last
    )
    logs = []
    for count, make in (
        (SURFACES, lambda seed: spectrum.surface(POINTS, seed)),
        (LINES, lambda seed: spectrum.line(SPRINGS, seed)),
    ):
        pressed = [
            rl.press(body, E_star=1.0, forces=np.array(FORCE_BARS) * body.rms_height, rtol=1e-3)
            for body in map(make, range(count))
        ]
        logs.append(np.log([each.stiffness for each in pressed]))
    ratio = np.exp(logs[0].mean(axis=0) - logs[1].mean(axis=0))
    error = np.sqrt(sum(each.var(axis=0, ddof=1) / len(each) for each in logs))
    for load, value, off in zip(FORCE_BARS, ratio, error, strict=True):
        yield f"{roll:g},{3 - hurst:g},{load:g},{value:.3f},{off:.3f}"


if __name__ == "__main__":
    print(",".join(COLUMNS))
    for roll_off in sys.argv[1:]:
        for each in HURSTS:
            print(*rows(float(roll_off), each), sep="\n", flush=True)
