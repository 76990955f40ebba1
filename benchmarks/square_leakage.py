"""Write how a window smears the spectrum of a square map: ``make square-leakage``."""

from dataclasses import asdict

import numpy as np

from roughline.spectra.leakage import SQUARE_MAPS, compute_map_leakage, compute_power_inside


def main():
    distances, share = compute_power_inside(1.0)
    arrays = {**asdict(compute_map_leakage(1.0)), "distances": distances, "share": share}
    np.savez_compressed(SQUARE_MAPS, **arrays)


if __name__ == "__main__":
    main()
