"""The paper's study: from its store to the data of the package, and from these to the pages.

"The paper, recomputed" is composed by the package, as users' own studies are.
"""

import json
import shutil
from collections import Counter
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pandas as pd

import roughline as rl
from roughline import campaign
from roughline.campaign import Store
from roughline.campaign.export import write_netcdf
from roughline.campaign.run import log_path
from roughline.comparison.trust import COLUMNS, TrustMap
from roughline.paper.laws import exponent_table
from roughline.paper.page import compose
from roughline.paper.results import (
    PaperResults,
    published_dataset,
    published_folder,
    published_results,
)
from roughline.paper.windows import Windows
from roughline.plot.style import save, styled
from roughline.report.json_output import plain
from roughline.report.page import render_markdown
from roughline.statistics.averages import relative_difference
from studies.paper.lab_figures import lab_figures
from studies.paper.trust import told_of_map, trust_map_figure, trust_page
from studies.reduced_data import finished, refuse_other_settings
from studies.study import DOCS, write_tables

PLAN = Path(__file__).parent / "plan.toml"
FIGURES = Path(str(files("roughline.lab").joinpath("static", "paper.json")))
"""Data of the lab's figures of the paper."""
_FIGURES = DOCS / "figures" / "paper"
DATA = published_folder()
MAP = DATA.parents[1] / "contact" / "comparison" / "trust_map.csv"
ENSEMBLES = {
    "lines": "lines",
    "matched": "lines-of-surfaces",
    "surfaces": "surfaces",
    "coarse": "coarse-surfaces",
    **{f"grid_{n}": f"grids-n{n}" for n in (128, 256, 512, 1024)},
}
"""Ensembles of the plan by the files that are theirs."""


def reduce(path: Path) -> None:
    """Reduce a finished store to the data and the map of the package, and what computing took."""
    store = Store(path)
    for ensemble in campaign.read_plan(PLAN).ensembles:
        finished(store, ensemble)
    DATA.mkdir(exist_ok=True)
    lines, surfaces = store.dataset("lines"), store.dataset("surfaces")
    write_netcdf(exponent_table(lines, Windows().all_reduced), DATA / "exponents.nc")
    for file_name, name in ENSEMBLES.items():
        data = store.dataset(name)
        if file_name == "lines":
            data = data.sel(fractal_dimension=surfaces.fractal_dimension)
        elif file_name == "matched":
            data = data.drop_vars(["depth", "rms_slope", "highest"])
        if "depth" in data:  # only averages at fixed level need it
            data = data.assign(depth=data.depth.astype(np.float32).assign_attrs(data.depth.attrs))
        write_netcdf(data, DATA / f"{file_name}.nc")
    _write_map(store, "map", (1, 2, 4, 8, 16), MAP)
    _write_map(store, "fine", (1, 4), DATA / "map_fine.csv")
    text = json.dumps(computing_of(path), indent=1) + "\n"
    (DATA / "computing.json").write_text(text, encoding="utf-8")


def _write_map(store: Store, name: str, roll_offs: Sequence[int], path: Path) -> None:
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
                    full.force_bar.values,
                    difference,
                    low,
                    high,
                    mean.scatter / mean.mean,
                    resolved.astype(int),
                    strict=True,
                )
            ]
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    table.to_csv(path, index=False, float_format="%.6g")


def computing_of(path: Path) -> dict[str, Any]:
    """Return what the runs of a store took, one after another, and on which machine."""
    runs = [json.loads(line) for line in log_path(path).read_text(encoding="utf-8").splitlines()]
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


def publish() -> None:
    """Draw the pages and their figures again."""
    refuse_another_plan()
    shutil.rmtree(_FIGURES, ignore_errors=True)
    _FIGURES.mkdir(parents=True)
    results = published_results()
    _publish_paper(results)
    _publish_map()
    data = json.dumps(plain(lab_figures(results)), ensure_ascii=False)
    # five digits are more than a figure shows
    rounded = json.loads(data, parse_float=lambda x: float(f"{float(x):.5g}"))
    kept = json.dumps(rounded, ensure_ascii=False, separators=(",", ":")) + "\n"
    FIGURES.write_text(kept, encoding="utf-8")


def refuse_another_plan() -> None:
    """Refuse data of the package that are not those of the plan."""
    plan = campaign.read_plan(PLAN)
    for file_name, ensemble in ENSEMBLES.items():
        path = DATA / f"{file_name}.nc"
        attributes = published_dataset(file_name).attrs
        refuse_other_settings(attributes, plan.ensemble(ensemble), path.name)


def _publish_paper(results: PaperResults) -> None:
    """Draw the page "The paper, recomputed"."""
    with TemporaryDirectory() as folder:
        page = compose(results, Path(folder))
        text = render_markdown(page.title, page.lead, page.sections, "figures/paper", page.headline)
        for picture in (Path(folder) / "figures").glob("*.png"):
            shutil.copy(picture, _FIGURES)
    (DOCS / "paper.md").write_text(text, encoding="utf-8")


def _publish_map() -> None:
    """Draw the page of the map."""
    trust = rl.trust_map()
    with styled():
        save(trust_map_figure(trust), _FIGURES, "trust_map")
    (_FIGURES / "trust_map.pdf").unlink()
    rows = np.loadtxt(DATA / "map_fine.csv", delimiter=",", skiprows=1)
    fine = TrustMap.from_rows(rows)
    told = told_of_map(trust, fine)
    (DOCS / "trust.md").write_text(trust_page(told), encoding="utf-8")
    write_tables(told, "trust")
