"""Reduce the store of the paper's study to what figures and tables need, a few megabytes.

    python -m studies.paper.reduce out/study.zarr

writes the data and the map of the package, and what computing them took.
"""

import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray

import roughline as rl
from roughline import campaign
from roughline.campaign import Store
from roughline.campaign.export import write_netcdf
from roughline.campaign.run import log_of
from roughline.contact.comparison.trust import COLUMNS
from roughline.paper.exponents import exponents_of
from roughline.paper.windows import WINDOWS_REDUCED
from roughline.statistics.averages import relative_difference
from studies.reduced_data import finished, run

HERE = Path(__file__).parent
PLAN = HERE / "plan.toml"
PACKAGE = HERE.parents[1] / "src" / "roughline"
DATA = PACKAGE / "paper" / "data"
MAP = PACKAGE / "contact" / "comparison" / "trust_map.csv"


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
    write(store.dataset("coarse-surfaces"), "coarse")
    for n in (128, 256, 512, 1024):
        write(store.dataset(f"grids-n{n}"), f"grid_{n}")
    write_map(store, "map", (1, 2, 4, 8, 16), MAP)
    write_map(store, "fine", (1, 4), DATA / "map_fine.csv")
    text = json.dumps(computing_of(path), indent=1) + "\n"
    (DATA / "computing.json").write_text(text, encoding="utf-8")


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


def computing_of(path: Path) -> dict[str, Any]:
    """Return what the runs of a store took, one after another, and on which machine."""
    runs = [json.loads(line) for line in log_of(path).read_text(encoding="utf-8").splitlines()]
    done: Counter[str] = Counter()
    core_seconds: Counter[str] = Counter()
    for each in runs:
        done.update(each["done"])
        core_seconds.update(each["core_seconds"])
    return {
        "processor": " and ".join(sorted({each["processor"] for each in runs})),
        "cores": max(each["cores"] for each in runs),
        "hours": round(sum(each["seconds"] for each in runs) / 3600, 2),
        "core_seconds": {name: float(f"{core_seconds[name] / done[name]:.3g}") for name in done},
    }


if __name__ == "__main__":
    run(main, __doc__)
