"""Draw the page on averages and windows and its figure.

    python -m studies.averaging.publish

reads ``data.nc`` and ``plan.toml`` beside it, and writes ``docs/averaging.md`` and
``docs/figures/averaging``.
"""

from studies.averaging.figures import exponents_figure
from studies.averaging.page import page
from studies.publishing import publish


def main() -> None:
    """Draw everything anew."""
    publish("averaging", page, {"exponents": exponents_figure})


if __name__ == "__main__":
    main()
