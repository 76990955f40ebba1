"""Fit the exponents of every window and mean to the published study of the paper.

    python -m studies.averaging.reduce

writes ``data.nc``, from the surfaces and lines that come with the package.
"""

import itertools
import json

import numpy as np
import xarray

from roughline.paper.averaging import exponent_of_means
from roughline.paper.results import published_dataset
from studies.averaging.exponents import BODIES, DATA, DIMENSIONS, plan, windows
from studies.reduced_data import write_one

NAMES = ("bodies", "window", "fixed", "averaging", "fractal_dimension", "end")


def main() -> None:
    """Fit everything."""
    fixed, means = plan()["fixed"], plan()["means"]
    sizes = [len(each) for each in (BODIES, windows("surfaces"), fixed, means, DIMENSIONS)]
    found = np.empty((*sizes, 3))
    for place in itertools.product(*map(range, sizes)):
        bodies, window, what, mean, dimension = place
        one = published_dataset(BODIES[bodies]).sel(fractal_dimension=DIMENSIONS[dimension])
        estimate = exponent_of_means(one, windows(BODIES[bodies])[window], fixed[what], means[mean])
        found[place] = (estimate.value, estimate.low, estimate.high)
    counts = {name: published_dataset(name).sizes["realisation"] for name in BODIES}
    coordinates = {
        "bodies": list(BODIES),
        "fixed": fixed,
        "averaging": means,
        "fractal_dimension": list(DIMENSIONS),
        "end": ["value", "low", "high"],
    }
    data = xarray.Dataset(
        {"exponent": (NAMES, found)}, coordinates, {"realisations": json.dumps(counts)}
    )
    write_one(DATA, plan(), data)


if __name__ == "__main__":
    main()
