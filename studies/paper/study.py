"""The paper's study: from its store to the data of the package, and from these to the pages.

"The paper, recomputed" is composed by the package, as users' own studies are.
"""

import json
import shutil
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
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
from roughline.paper.results import PaperResults, published_folder
from roughline.paper.windows import Windows
from roughline.plot.style import save, styled
from roughline.report.json_output import plain
from roughline.report.page import Section, render_markdown
from roughline.statistics.averages import relative_difference
from studies.paper.data import APART, FOLDER, dataset, results, write
from studies.paper.lab_figures import lab_figures
from studies.paper.trust import told_of_map, trust_map_figure, trust_page
from studies.reduced_data import finished, refuse_other_settings
from studies.study import DOCS, write_table, write_tables

PLAN = Path(__file__).parent / "plan.toml"
FIGURES = Path(str(files("roughline.lab").joinpath("static", "paper.json")))
"""Data of the lab's figures of the paper."""
_FIGURES = DOCS / "figures" / "paper"
_TABLES = DOCS / "data" / "paper"
_MOST_COLUMNS = 9  # of a table on the page
_TABLE_NAMES = {"α 1D": "exponents-of-lines", "α 3D": "exponents-of-surfaces"}
"""Files of wider ones, by how their second column begins."""
DATA = published_folder()
MAP = DATA.parents[1] / "comparison" / "trust_map.csv"
ENSEMBLES = {
    "lines": "lines",
    "matched": "lines-of-surfaces",
    "surfaces": "surfaces",
    "coarse": "coarse-surfaces",
    **{f"grid_{n}": f"grids-n{n}" for n in (128, 256, 512, 1024)},
}
"""Ensembles of the plan by the files that are theirs."""
_UNREAD = dict.fromkeys(("matched", "coarse"), ("depth", "rms_slope", "highest"))


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
        data = data.drop_vars([*_UNREAD.get(file_name, ())])
        if apart := APART.get(file_name):
            write(data[apart], FOLDER / f"{file_name}.nc")
            data = data.drop_vars(apart)
        write(data, (FOLDER if file_name.startswith("grid") else DATA) / f"{file_name}.nc")
    _write_map(store, "map", (1, 2, 4, 8, 16), MAP)
    _write_map(store, "fine", (1, 4), FOLDER / "map_fine.csv")
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
    _TABLES.mkdir(exist_ok=True)
    _publish_paper(results())
    _publish_map()
    data = json.dumps(plain(lab_figures(results())), ensure_ascii=False)
    # five digits are more than a figure shows
    rounded = json.loads(data, parse_float=lambda x: float(f"{float(x):.5g}"))
    kept = json.dumps(rounded, ensure_ascii=False, separators=(",", ":")) + "\n"
    FIGURES.write_text(kept, encoding="utf-8")


def refuse_another_plan() -> None:
    """Refuse data of the package that are not those of the plan."""
    plan = campaign.read_plan(PLAN)
    for file_name, ensemble in ENSEMBLES.items():
        attributes = dataset(file_name).attrs
        refuse_other_settings(attributes, plan.ensemble(ensemble), f"{file_name}.nc")


def _publish_paper(results: PaperResults) -> None:
    """Draw the page "The paper, recomputed"."""
    with TemporaryDirectory() as folder:
        page = compose(results, Path(folder))
        sections = [_with_wide_tables_apart(each) for each in page.sections]
        text = render_markdown(page.title, page.lead, sections, "figures/paper", page.headline)
        for picture in (Path(folder) / "figures").glob("*.png"):
            shutil.copy(picture, _FIGURES)
        shutil.copy(Path(folder) / "data" / "claims.csv", _TABLES)
    included, rows = _with_rows_apart(text)
    (_FIGURES / "claims.html").write_text(rows, encoding="utf-8")
    (DOCS / "paper.md").write_text(included, encoding="utf-8")


def _with_wide_tables_apart(section: Section) -> Section:
    """Write tables that no page is wide enough for as data, and link them."""
    wide = [each for each in section.tables if len(each.header) > _MOST_COLUMNS]
    links = []
    for each in wide:
        exponent = each.header[1][:4]
        name = _TABLE_NAMES[exponent]
        write_table(each, _TABLES / f"{name}.csv")
        links.append(f"[{exponent}](data/paper/{name}.csv)")
    if not links:
        return section
    said = f"Every window and average, with intervals, is data: {', '.join(links)}."
    kept = [each for each in section.tables if each not in wide]
    return replace(section, paragraphs=[*section.paragraphs, said], tables=kept)


def _with_rows_apart(text: str) -> tuple[str, str]:
    """Return the page with its claims included from a file, and what is in that file."""
    before, _, rest = text.partition('<div class="claims">')
    rows, _, after = rest.partition("</div>\n")
    listed = "All claims with their numbers are [data](data/paper/claims.csv), too."
    included = "```{raw} html\n:file: figures/paper/claims.html\n```"
    return f"{before}{listed}\n\n{included}\n{after}", f'<div class="claims">{rows}</div>\n'


def _publish_map() -> None:
    """Draw the page of the map."""
    trust = rl.trust_map()
    with styled():
        save(trust_map_figure(trust), _FIGURES, "trust_map")
    (_FIGURES / "trust_map.pdf").unlink()
    rows = np.loadtxt(FOLDER / "map_fine.csv", delimiter=",", skiprows=1)
    fine = TrustMap.from_rows(rows)
    told = told_of_map(trust, fine)
    (DOCS / "trust.md").write_text(trust_page(told), encoding="utf-8")
    write_tables(told, "trust")
