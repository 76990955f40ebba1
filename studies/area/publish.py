"""Draw the page on the contact area and its figure.

    python -m studies.area.publish

reads ``data.nc`` and ``plan.toml`` beside it, and writes ``docs/area.md`` and
``docs/figures/area``, and what the lab shows of the study.
"""

from studies.area.figures import kappa_figure
from studies.area.page import page
from studies.area.summary import summary
from studies.publishing import publish
from studies.reduced_data import errors_in_one_line


def main() -> None:
    """Draw everything again."""
    publish("area", page, {"kappa": kappa_figure}, summary)


if __name__ == "__main__":
    with errors_in_one_line():
        main()
