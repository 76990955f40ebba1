"""What a low pass makes of the borders of a piece: a table of press_a_measured_surface.md.

Pieces are cut out of maps four times as long and filtered alone, in several ways at the borders.
Each is compared with the same place of the larger map, filtered as a whole.
"""

import math

import numpy as np
from scipy import ndimage

import roughline as rl

POINTS, CUTOFF, PIECES = 128, 16, 100  # of a side, of the cutoff wave [points], of each kind
HALF = CUTOFF // 2
SIGMA = math.sqrt(math.log(2) / math.pi) * CUTOFF / math.sqrt(2 * math.pi)
KINDS = {"roll-off at the cutoff": 4 * POINTS / CUTOFF, "no roll-off": 1.0}


def repeated(heights):
    """The outermost point goes on beyond the border."""
    return ndimage.gaussian_filter(heights, SIGMA, mode="nearest")


def mirrored(heights):
    """Heights go on as a mirror at the border shows them."""
    return ndimage.gaussian_filter(heights, SIGMA, mode="reflect")


def moments(heights, axis, power):
    """Sums along an axis, weighted by the kernel and a power of the distance, of what is there."""
    x = np.arange(heights.shape[axis])
    x = x - x[:, np.newaxis]
    kernel = x**power * np.exp(-(x**2) / 2 / SIGMA**2)
    return np.moveaxis(np.tensordot(kernel, heights, (1, axis)), 0, axis)


def renormalised(heights):
    """The kernel over the points there are has the sum one."""
    for axis in range(2):
        heights = moments(heights, axis, 0) / moments(np.ones_like(heights), axis, 0)
    return heights


def planar(heights):
    """A plane goes through the points there are, weighted by the kernel."""
    for axis in range(2):
        m = [moments(np.ones_like(heights), axis, power) for power in range(3)]
        h = [moments(heights, axis, power) for power in range(2)]
        heights = (m[2] * h[0] - m[1] * h[1]) / (m[0] * m[2] - m[1] ** 2)
    return heights


def left_out(heights):
    """As roughline does: half a cutoff is left out at each border."""
    sides = tuple(map(float, heights.shape))
    steps = rl.Preparation(low_pass=CUTOFF)
    return steps.applied(rl.Surface(heights, sides, is_cut_out=True)).heights


WAYS = {
    "the outermost point repeated": repeated,
    "mirrored": mirrored,
    "kernel over the points there are": renormalised,
    "a plane through the points there are": planar,
    "half a cutoff left out": left_out,
}


def rim(values, width):
    """The outermost points of a map."""
    inner = np.ones(values.shape, bool)
    inner[width:-width, width:-width] = False
    return values[inner]


def compared(filtered, low):
    """Errors of the outer half of a cutoff and of the outermost points, and where the highest is.

    Errors are mean squares over that of the map.
    """
    errors = ((filtered - low) / low.std()) ** 2
    on_rim = rim(filtered, 1).max() == filtered.max()
    return [rim(errors, HALF).mean(), rim(errors, 1).mean(), on_rim, rim(low, 1).max() == low.max()]


def main():
    print("| surface | at the border | rms error there | of the outermost | highest there | true |")
    print("|---" * 6 + "|")
    inner = (slice(HALF, -HALF),) * 2
    for kind, roll in KINDS.items():
        spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=2 * np.pi * roll * (1 + 1e-12))
        found = {way: [] for way in WAYS}
        for seed in range(PIECES):
            whole = spectrum.surface(4 * POINTS, seed, "gaussian").heights
            low = ndimage.gaussian_filter(whole, SIGMA, mode="wrap")[:POINTS, :POINTS]
            for way, make in WAYS.items():
                filtered = make(whole[:POINTS, :POINTS])
                expected = low if filtered.shape == low.shape else low[inner]
                found[way].append(compared(filtered, expected))
        for way, rows in found.items():
            zone, edge, on_rim, true = np.mean(rows, axis=0)
            cells = [f"{100 * math.sqrt(each):.2g} %" for each in (zone, edge)]
            print(f"| {kind} | {way} |", " | ".join(cells), f"| {on_rim:.0%} | {true:.0%} |")


if __name__ == "__main__":
    main()
