"""Draw the page on finite size and its figure.

    python -m studies.finite_size.publish

reads ``data.nc`` and ``plan.toml`` beside it, and writes ``docs/finite_size.md``,
``docs/figures/finite_size``, and what the lab shows of the study.
"""

from studies.finite_size.figures import crossover_figure
from studies.finite_size.page import page
from studies.finite_size.summary import summary
from studies.publishing import publish
from studies.reduced_data import errors_in_one_line


def main() -> None:
    """Draw everything again."""
    publish("finite_size", page, {"crossover": crossover_figure}, summary)


if __name__ == "__main__":
    with errors_in_one_line():
        main()
