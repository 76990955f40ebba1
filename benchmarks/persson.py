"""Persson's stiffness against the full model, over roll-off and H: ``make persson``."""

import math

import numpy as np
from page import Page

import roughline as rl

N, WAVES = 256, 48
ROLL_OFFS, HURSTS, SURFACES = (1, 2, 4, 8), (0.2, 0.5, 0.8, 1.0), 6
PRESSURES = np.array([0.02, 0.05, 0.1, 0.17, 0.25, 0.4])  # p / (E* rms slope)


def main():
    page = Page("", "Persson's stiffness", "persson")  # printed alone
    for roll in ROLL_OFFS:
        for hurst in HURSTS:
            spectrum = rl.SelfAffine(
                hurst=hurst, rms_height=1e-3, q_roll=roll * math.tau, q_high=WAVES * math.tau
            )
            pressures = PRESSURES * spectrum.lattice(N).rms_slope
            ratios, areas = [], []
            for seed in range(SURFACES):
                surface = spectrum.surface(N, seed)
                curve = rl.press(surface, E_star=1.0, forces=pressures, periodic=True, rtol=1e-4)
                theory = rl.theory("persson", surface, 1.0, pressures)
                ratios.append(curve.stiffness / theory.stiffness)
                areas.append(curve.area_fraction_corrected)
            if roll == ROLL_OFFS[0] and hurst == HURSTS[0]:
                page.table("roll-off", "H", *(f"{area:.0%}" for area in np.mean(areas, axis=0)))
            means = np.exp(np.mean(np.log(ratios), axis=0))
            told = zip(means, np.min(ratios, axis=0), np.max(ratios, axis=0), strict=True)
            cells = (f"{mean:.2f} ({low:.2f}-{high:.2f})" for mean, low, high in told)
            page.row("none" if roll == 1 else f"{roll} q_0", f"{hurst:g}", *cells)


if __name__ == "__main__":
    main()
