"""Draw the page "The paper, recomputed", the page of the map and their figures.

    python -m studies.paper.publish

reads the data and the map of the package, and writes ``docs/paper.md``,
``docs/trust.md`` and ``docs/figures/paper``.
"""

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import roughline as rl
from roughline import campaign
from roughline.contact.comparison.trust import TrustMap
from roughline.paper.added_figures import trust_map_figure
from roughline.paper.page import compose
from roughline.paper.results import published_dataset, published_folder, published_results
from roughline.paper.trust_page import trust_page
from roughline.plot.style import save, styled
from roughline.report.page import render_markdown
from studies.reduced_data import errors_in_one_line, refuse_other_settings

HERE = Path(__file__).parent
PLAN = HERE / "plan.toml"
ENSEMBLES = {
    "lines": "lines",
    "matched": "lines-of-surfaces",
    "surfaces": "surfaces",
    "coarse": "coarse-surfaces",
    **{f"grid_{n}": f"grids-n{n}" for n in (128, 256, 512, 1024)},
}
"""Ensembles of the plan by the files that are theirs."""
DOCS = HERE.parents[1] / "docs"
FIGURES = DOCS / "figures" / "paper"
FOLDER_IN_PAGES = "figures/paper"


def main() -> None:
    """Draw everything again."""
    refuse_another_plan()
    shutil.rmtree(FIGURES, ignore_errors=True)
    FIGURES.mkdir(parents=True)
    publish_paper()
    publish_map()


def refuse_another_plan() -> None:
    """Refuse data of the package that are not those of the plan.

    Raises
    ------
    StoreError
        With the first difference.
    """
    plan = campaign.read_plan(PLAN)
    for file_name, ensemble in ENSEMBLES.items():
        path = published_folder() / f"{file_name}.nc"
        attributes = published_dataset(file_name).attrs
        refuse_other_settings(attributes, plan.ensemble(ensemble), path.name)


def publish_paper() -> None:
    """Draw the page "The paper, recomputed"."""
    results = published_results()
    with TemporaryDirectory() as folder:
        text = render_markdown(*compose(results, Path(folder)), FOLDER_IN_PAGES)
        for picture in (Path(folder) / "figures").glob("*.png"):
            shutil.copy(picture, FIGURES)
    (DOCS / "paper.md").write_text(text, encoding="utf-8")


def publish_map() -> None:
    """Draw the page of the map."""
    trust = rl.trust_map()
    with styled():
        save(trust_map_figure(trust), FIGURES, "trust_map")
    (FIGURES / "trust_map.pdf").unlink()
    rows = np.loadtxt(published_folder() / "map_fine.csv", delimiter=",", skiprows=1)
    fine = TrustMap.from_rows(rows)
    (DOCS / "trust.md").write_text(trust_page(trust, fine, FOLDER_IN_PAGES), encoding="utf-8")


if __name__ == "__main__":
    with errors_in_one_line():
        main()
