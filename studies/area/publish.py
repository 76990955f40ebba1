"""Draw the page on the contact area and its figure.

    python -m studies.area.publish

reads ``data.nc`` and ``plan.toml`` beside it, and writes ``docs/area.md`` and
``docs/figures/area``.
"""

from studies.area.figures import kappa_figure
from studies.area.page import page
from studies.publishing import publish


def main() -> None:
    """Draw everything anew."""
    publish("area", page, {"kappa": kappa_figure})


if __name__ == "__main__":
    main()
