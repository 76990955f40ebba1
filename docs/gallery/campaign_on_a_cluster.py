"""
How are hundreds of surfaces pressed?
=====================================

A campaign presses ensembles on all cores, or on a Dask cluster. Its store survives kills, and can
be enlarged without changing what is in it. This one has two workers; with a scheduler's address
instead of ``workers`` it runs on a cluster. Workers are processes, so a script needs the guard.
Single surfaces (grey) scatter by factors; the interval of the exponent of their mean holds that.
"""

import tempfile
from pathlib import Path

import roughline as rl
from roughline import campaign

plan = campaign.plan_from(
    {
        "name": "gallery",
        "seed": 1,
        "ensemble": [
            {
                "name": "surfaces",
                "model": "full",
                "fractal_dimensions": [2.2],
                "points": 64,
                "realisations": 40,
                "force_bars": {"from": 1e-3, "to": 1.0, "per_decade": 4},
            }
        ],
    }
)
if __name__ == "__main__":
    store = Path(tempfile.mkdtemp()) / "store.zarr"
    print(campaign.run(plan, store, workers=2).done)
    data = campaign.Store(store).dataset("surfaces").isel(fractal_dimension=0)
    law = rl.fit_power_law(data.force_bar, data.stiffness, window=(1e-2, 1e-1))
    rl.plot.power_law(data.force_bar, data.stiffness, law)
