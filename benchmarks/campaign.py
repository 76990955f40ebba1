"""How fast campaigns are, and how much of their time is not the work itself.

    python benchmarks/campaign.py            # both
    python benchmarks/campaign.py surfaces

Lines of 2^12 points are the cheapest cases; surfaces of 128 x 128 points under ten loads are many
small presses. Overhead is what the workers' cores are not used for between the first batch and the
last: sending, receiving, writing, and the client's own share of the cores. Starting the cluster is
told apart.
"""

import json
import sys
import tempfile
import time
from pathlib import Path

from roughline import campaign
from roughline.campaign.run import log_path

ENSEMBLES = {
    "lines": {
        "model": "reduced",
        "fractal_dimensions": {"from": 2, "to": 3, "count": 11},
        "points": 2**12,
        "realisations": 20_000,
        "force_bars": {"from": 1e-4, "to": 10, "per_decade": 6},
    },
    "surfaces": {
        "model": "full",
        "fractal_dimensions": [2.2],
        "points": 128,
        "realisations": 10_000,
        "force_bars": {"from": 1e-3, "to": 1, "per_decade": 3},
    },
}


def timed(name: str) -> None:
    ensemble = ENSEMBLES[name]
    plan = campaign.plan_from({"name": name, "ensemble": [{"name": name, **ensemble}]})
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "store"
        started = time.perf_counter()
        campaign.run(plan, store)
        whole = time.perf_counter() - started
        entry = json.loads(log_path(store).read_text())
    cases, work = entry["done"][name], entry["core_seconds"][name]
    used = entry["seconds"] * entry["cores"]
    print(
        f"{cases} {name}, {ensemble['points']} points: {1e3 * work / cases:.3f} ms each on a core"
    )
    print(f"{entry['seconds']} s on {entry['cores']} cores; overhead {1 - work / used:.1%}")
    print(f"before the first batch and after the last: {whole - entry['seconds']:.1f} s")


if __name__ == "__main__":
    for each in sys.argv[1:] or ENSEMBLES:
        timed(each)
