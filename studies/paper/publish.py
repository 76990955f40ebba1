"""Draw the page "The paper, recomputed", the page of the map and their figures.

    python studies/paper/publish.py

reads ``studies/paper/data`` and the map of the package, and writes ``docs/paper.md``,
``docs/trust.md`` and ``docs/figures/paper``.
"""

import json
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import xarray

from roughline.comparison.trust import from_rows, trust_map
from roughline.paper.comparisons import trust_map as draw_trust_map
from roughline.paper.page import compose
from roughline.paper.results import ROW_1D, ROW_3D, ROW_MATCHED, PaperResults, row_of
from roughline.paper.trust_page import trust_page
from roughline.report.page import render_markdown
from roughline.report.style import save, styled

HERE = Path(__file__).parent
DOCS = HERE.parents[1] / "docs"
FIGURES = DOCS / "figures" / "paper"
GRIDS = (128, 256, 512, 1024)


def read(name: str) -> xarray.Dataset:
    """Read an ensemble of the study."""
    with xarray.open_dataset(HERE / "data" / f"{name}.nc", engine="h5netcdf") as data:
        return data.load()


def main() -> None:
    """Draw everything anew."""
    paper_grid = read("paper_grid")
    times = json.loads((HERE / "data" / "times.json").read_text())["core_seconds"]
    results = PaperResults(
        name="from the study in studies/paper",
        command="roughline campaign run studies/paper/plan.toml",
        reduced=read("lines"),
        full=read("surfaces"),
        matched=read("matched"),
        exponents=read("exponents"),
        grids={n: read(f"grid_{n}") for n in GRIDS} | {2048: paper_grid},
        paper_grid=paper_grid,
        core_seconds={
            name: times[ensemble]
            for name, ensemble in (
                (ROW_1D, "lines"),
                (ROW_MATCHED, "lines-of-surfaces"),
                (ROW_3D, "surfaces"),
                (row_of(2048), "paper-grid"),
                *((row_of(n), f"grids-n{n}") for n in GRIDS),
            )
        },
    )
    shutil.rmtree(FIGURES, ignore_errors=True)
    FIGURES.mkdir(parents=True)
    with TemporaryDirectory() as folder:
        title, lead, sections = compose(results, Path(folder))
        text = render_markdown(title, lead, sections, "figures/paper")
        for picture in (Path(folder) / "figures").glob("*.png"):
            shutil.copy(picture, FIGURES)
    (DOCS / "paper.md").write_text(text, encoding="utf-8")
    with styled():
        save(draw_trust_map(trust_map()), FIGURES, "trust_map")
    (FIGURES / "trust_map.pdf").unlink()
    fine = from_rows(np.loadtxt(HERE / "data" / "map_fine.csv", delimiter=",", skiprows=1))
    (DOCS / "trust.md").write_text(trust_page(trust_map(), fine, "figures/paper"), encoding="utf-8")


if __name__ == "__main__":
    main()
