"""How much of a campaign's time is not the work itself, for the cheapest case: a line of 2^12.

    python benchmarks/campaign.py

Overhead is what the workers' cores are not used for between the first batch and the last: sending,
receiving, writing, and the client's own share of the cores. Starting the cluster is told apart.
"""

import json
import tempfile
import time
from pathlib import Path

from roughline import campaign
from roughline.campaign.run import log_path

PLAN = {
    "name": "cheap",
    "ensemble": [
        {
            "name": "lines",
            "model": "reduced",
            "fractal_dimensions": {"from": 2, "to": 3, "count": 11},
            "points": 2**12,
            "realisations": 20_000,
            "force_bars": {"from": 1e-4, "to": 10, "per_decade": 6},
        }
    ],
}


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "store"
        started = time.perf_counter()
        campaign.run(campaign.plan_from(PLAN), store)
        whole = time.perf_counter() - started
        entry = json.loads(log_path(store).read_text())
    cases, work = entry["done"]["lines"], entry["core_seconds"]["lines"]
    used = entry["seconds"] * entry["cores"]
    print(f"{cases} lines of 2^12 points, {1e3 * work / cases:.3f} ms each on one core")
    print(f"{entry['seconds']} s on {entry['cores']} cores; overhead {1 - work / used:.1%}")
    print(f"before the first batch and after the last: {whole - entry['seconds']:.1f} s")


if __name__ == "__main__":
    main()
