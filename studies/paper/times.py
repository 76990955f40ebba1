"""Time one body of each fractal dimension and ensemble of the study, on an idle machine.

    python -m studies.paper.times

writes ``times.json`` into the data of the package: seconds on one core for a body with all its
loads, by ensemble.
"""

import json
import tempfile
from dataclasses import replace
from pathlib import Path

from roughline import campaign
from roughline.campaign.run import log_of

HERE = Path(__file__).parent
DATA = HERE.parents[1] / "src" / "roughline" / "paper" / "data"
SIX = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)


def main() -> None:
    """Run the plan with one surface, or twenty lines, for each of six fractal dimensions."""
    plan = campaign.read_plan(HERE / "plan.toml")
    few = tuple(
        replace(
            ensemble,
            fractal_dimensions=tuple(d for d in SIX if d in ensemble.fractal_dimensions),
            realisations=20 if ensemble.model == "reduced" else 1,
        )
        for ensemble in plan.ensembles
        if not ensemble.name.startswith("map")
    )
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "store"
        campaign.run(replace(plan, ensembles=few), store, workers=1, threads=1)
        entry = json.loads(log_of(store).read_text())
    each = {name: entry["core_seconds"][name] / count for name, count in entry["done"].items()}
    text = json.dumps({"cores": 1, "core_seconds": each}, indent=1)
    (DATA / "times.json").write_text(text + "\n")


if __name__ == "__main__":
    main()
