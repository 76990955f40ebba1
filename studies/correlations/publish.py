"""Draw the page on the handbooks' correlations and its figures.

    python -m studies.correlations.publish

reads ``data.npz`` and ``plan.toml`` beside it, and writes ``docs/correlations.md`` and
``docs/figures/correlations``.
"""

from studies.correlations.correlations_figures import conductance_figure, ratio_figure
from studies.correlations.correlations_page import page
from studies.publishing import publish
from studies.reduced_data import errors_in_one_line


def main() -> None:
    """Draw everything again."""
    publish("correlations", page, {"conductance": conductance_figure, "ratios": ratio_figure})


if __name__ == "__main__":
    with errors_in_one_line():
        main()
