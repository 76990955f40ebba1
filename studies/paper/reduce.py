"""Reduce the store of the paper's study to what figures and tables need, a few megabytes.

    python -m studies.paper.reduce out/study.zarr

writes the data and the map of the package.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray

import roughline as rl
from roughline import campaign
from roughline.campaign import Store
from roughline.campaign.export import write_netcdf
from roughline.comparison.trust import COLUMNS
from roughline.paper.exponents import exponents_of
from roughline.paper.windows import WINDOWS_REDUCED
from roughline.statistics.averages import relative_difference
from studies.reduced_data import finished, run

HERE = Path(__file__).parent
PLAN = HERE / "plan.toml"
PACKAGE = HERE.parents[1] / "src" / "roughline"
DATA = PACKAGE / "paper" / "data"
MAP = PACKAGE / "comparison" / "trust_map.csv"


def main(path: Path) -> None:
    """Reduce a finished store."""
    store = Store(path)
    for ensemble in campaign.read_plan(PLAN).ensembles:
        finished(store, ensemble)
    DATA.mkdir(exist_ok=True)
    lines, surfaces = store.dataset("lines"), store.dataset("surfaces")
    write_netcdf(exponents_of(lines, WINDOWS_REDUCED), DATA / "exponents.nc")
    shown = lines.sel(fractal_dimension=surfaces.fractal_dimension)
    write(shown, "lines")
    write(
        store.dataset("lines-of-surfaces").drop_vars(["depth", "rms_slope", "highest"]), "matched"
    )
    write(surfaces, "surfaces")
    write(store.dataset("paper-grid"), "paper_grid")
    for n in (128, 256, 512, 1024):
        write(store.dataset(f"grids-n{n}"), f"grid_{n}")
    write_map(store, "map", (1, 2, 4, 8, 16), MAP)
    write_map(store, "fine", (1, 4), DATA / "map_fine.csv")


def write(data: xarray.Dataset, name: str) -> None:
    """Write an ensemble; depths, which only averages at fixed level need, in single precision."""
    if "depth" in data:
        data = data.assign(depth=data.depth.astype(np.float32).assign_attrs(data.depth.attrs))
    write_netcdf(data, DATA / f"{name}.nc")


def write_map(store: Store, name: str, roll_offs: Sequence[int], path: Path) -> None:
    """Write the difference of the two models over roll-off, fractal dimension and load."""
    rows = []
    for roll_off in roll_offs:
        full, reduced = (
            store.dataset(f"{name}-{body}-roll{roll_off}") for body in ("surfaces", "lines")
        )
        for dimension in full.fractal_dimension.values:
            one_3d, one_1d = (data.sel(fractal_dimension=dimension) for data in (full, reduced))
            difference, low, high = relative_difference(
                one_3d.stiffness.values, one_1d.stiffness.values, paired=False
            )
            mean = rl.average(one_3d.stiffness.values)
            resolved = (one_3d.resolved.values == 1).all(axis=0)
            rows += [
                (roll_off, dimension, *row)
                for row in zip(
                    *(full.force_bar.values, difference, low, high, mean.scatter / mean.mean),
                    resolved.astype(int),
                    strict=True,
                )
            ]
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    table.to_csv(path, index=False, float_format="%.6g")


if __name__ == "__main__":
    run(main, __doc__)
