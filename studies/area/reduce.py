"""Reduce the store of the study of the area to what its page needs.

    python -m studies.area.reduce out/area.zarr

writes ``data.nc``, a group for each ensemble of ``plan.toml``.
"""

from pathlib import Path

from roughline import campaign
from studies.area.kappa import DATA, PLAN
from studies.reduced_data import run, write_groups

KEPT = ("area_fraction", "area_fraction_corrected", "status", "resolved")


def main(path: Path) -> None:
    """Reduce a finished store."""
    write_groups(DATA, campaign.read_plan(PLAN), campaign.Store(path), KEPT)


if __name__ == "__main__":
    run(main, __doc__)
