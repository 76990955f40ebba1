"""Draw the page on averages and windows and its figure.

    python -m studies.averaging.publish

reads ``data.nc`` and ``plan.toml`` beside it, and writes ``docs/averaging.md`` and
``docs/figures/averaging``, and what the lab shows of the study.
"""

from studies.averaging.figures import exponents_figure
from studies.averaging.page import page
from studies.averaging.summary import summary
from studies.publishing import publish
from studies.reduced_data import errors_in_one_line


def main() -> None:
    """Draw everything again."""
    publish("averaging", page, {"exponents": exponents_figure}, summary)


if __name__ == "__main__":
    with errors_in_one_line():
        main()
