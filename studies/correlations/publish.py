"""Draw the page on the handbooks' correlations and its figures.

    python -m studies.correlations.publish

reads ``data.npz`` and ``plan.toml`` beside it, and writes ``docs/correlations.md`` and
``docs/figures/correlations``.
"""

import shutil
from pathlib import Path

from roughline.report.style import save, styled
from studies.correlations.correlations_figures import conductance_figure, ratio_figure
from studies.correlations.correlations_page import page

DOCS = Path(__file__).parents[2] / "docs"
FIGURES = DOCS / "figures" / "correlations"


def main() -> None:
    """Draw everything anew."""
    shutil.rmtree(FIGURES, ignore_errors=True)
    FIGURES.mkdir(parents=True)
    with styled():
        for name, figure in (("conductance", conductance_figure()), ("ratios", ratio_figure())):
            _, pdf = save(figure, FIGURES, name)
            pdf.unlink()
    (DOCS / "correlations.md").write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
