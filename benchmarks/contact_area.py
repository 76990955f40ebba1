"""Contact areas of surfaces whose top is cut flat, against finer grids: ``make contact-area``."""

import math

import numpy as np
from page import Page

import roughline as rl

FINER = 4
LOADS = np.array([0.001, 0.01, 0.1, 0.3, 1.0])  # F / (E* h L), h the rms height before the cut
SURFACES = [(0.3, 2), (0.5, 4), (0.8, 1), (0.8, 4)]  # H, roll-off over q_0
BEARINGS = (0.1, 0.3, 0.6)
SEEDS = (11, 12)  # others than those on which the factors were chosen


def errors(n):
    """Errors over the loads, in per cent: cells, all pairs as under summits, corrected."""
    for hurst, roll in SURFACES:
        spectrum = rl.SelfAffine(
            hurst=hurst, rms_height=1.0, q_roll=roll * math.tau, q_high=8 * math.tau
        )
        for seed in SEEDS:
            rough = spectrum.surface(FINER * n, seed).heights
            for bearing in BEARINGS:
                honed = np.minimum(rough, np.quantile(rough, 1 - bearing))
                curve, finer = (
                    rl.press(
                        rl.Surface(heights, (1.0, 1.0)), E_star=1.0, forces=LOADS, periodic=True
                    )
                    for heights in (honed[1::FINER, 1::FINER], honed)
                )
                as_summits = curve.area_fraction_corrected - (
                    curve.area_fraction_most - curve.area_fraction
                )
                yield [
                    100 * (area / finer.area_fraction_corrected - 1)
                    for area in (curve.area_fraction, as_summits, curve.area_fraction_corrected)
                ]


def main():
    page = Page("", "Contact areas of flat tops", "contact-area")  # printed alone
    page.table("grid", "", *(f"F̄ = {load:g}" for load in LOADS), "rms")
    for n in (64, 128):
        found = np.array(list(errors(n)))
        for i, name in enumerate(("cells", "all as under summits", "`area_fraction_corrected`")):
            ranges = zip(found[:, i].min(axis=0), found[:, i].max(axis=0), strict=True)
            cells = [f"{low:+.1f} to {high:+.1f} %" for low, high in ranges]
            rms = math.sqrt(float((found[:, i] ** 2).mean()))
            page.row(f"{n}²", name, *cells, f"{rms:.1f} %")


if __name__ == "__main__":
    main()
