"""Campaigns that the recorder runs: a small one step by step, and the paper's quick study."""

from recorded_runs import folder_with, run
from recorded_values import contents

_PLAN = """
name = "small"
seed = 5

[[ensemble]]
name = "lines"
model = "reduced"
fractal_dimensions = { from = 2.0, to = 3.0, count = 3 }
points = 4096
realisations = LINES
force_bars = { from = 1e-4, to = 10, per_decade = 4 }

[[ensemble]]
name = "surfaces"
model = "full"
fractal_dimensions = DIMENSIONS
points = [16, 32]
realisations = 6
force_bars = { from = 1e-3, to = 10, per_decade = 3 }

[[ensemble]]
name = "rolled-off"
model = "full"
fractal_dimensions = [2.2]
points = 32
roll_off_ratios = [1, 4]
cutoff_ratio = 8
boundary = "periodic"
realisations = 4
force_bars = [0.01, 0.1, 1.0]
"""
_SMALL = _PLAN.replace("LINES", "20").replace("DIMENSIONS", "[2.0, 2.6]")
PLANS = {
    "small": _SMALL,
    "grown": _PLAN.replace("LINES", "30").replace("DIMENSIONS", "[2.0, 2.3, 2.6]"),
    "other": _SMALL.replace("4096", "1024"),
    "unknown key": _SMALL.replace("cutoff_ratio", "cut_off_ratio"),
    "wrong kind": _SMALL.replace("realisations = 20", 'realisations = "20"'),
    "no values": _SMALL.replace("[2.0, 2.6]", "[]"),
    "no plan": "seed = ",
}
_WORKERS = ("--workers", "2")
_RUN = ("campaign", "run")
_STEPS = {
    "run": (*_RUN, "small.toml", *_WORKERS),
    "status": ("campaign", "status", "small.toml"),
    "run again": (*_RUN, "small.toml", *_WORKERS, "--json"),
    "grow": (*_RUN, "grown.toml", "--store", "small.zarr", *_WORKERS, "--json"),
    "status as JSON": ("campaign", "status", "small.zarr", "--json"),
    "export": ("campaign", "export", "small.zarr", "--out", "out"),
    "export as JSON": ("campaign", "export", "small.toml", "--out", "out", "--json"),
    "export as CSV": ("campaign", "export", "small.zarr", "--out", "out", "--format", "csv"),
    "another plan": (*_RUN, "other.toml", "--store", "small.zarr", *_WORKERS),
    "unknown key": (*_RUN, "unknown key.toml"),
    "wrong kind": (*_RUN, "wrong kind.toml"),
    "no values": (*_RUN, "no values.toml"),
    "no plan": (*_RUN, "no plan.toml"),
    "no file": (*_RUN, "none.toml"),
    "no threads": (*_RUN, "small.toml", "--threads", "0"),
    "scheduler and workers": (*_RUN, "small.toml", "--scheduler", "tcp://none:1", *_WORKERS),
    "no store": ("campaign", "status", "none.zarr"),
    "foreign folder": ("campaign", "status", "foreign"),
    "store in a file": (*_RUN, "small.toml", "--store", "small.toml"),
    "export of none": ("campaign", "export", "none.toml", "--out", "out"),
    "export to a file": ("campaign", "export", "small.zarr", "--out", "small.toml"),
    "paper of another seed": ("paper", "--out", "foreign", "--seed", "-1"),
}
_LEFT = ("run", "run again", "grow", "another plan")  # after which the store is recorded


def _fill(folder):
    for name, text in PLANS.items():
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    (folder / "foreign").mkdir()
    (folder / "foreign" / "notes.txt").write_text("no store", encoding="utf-8")


def store():
    """Give the steps of a campaign, as (name, function)."""
    with folder_with(_fill) as folder:
        for name, arguments in _STEPS.items():
            yield name, lambda arguments=arguments: run(arguments)
            if name in _LEFT:
                yield f"store after {name}", lambda: contents(folder)


def paper():
    """Give the paper's study and its files, as (name, function)."""
    arguments = ("paper", "--scale", "quick", "--out", "paper", *_WORKERS)
    with folder_with(_fill) as folder:
        yield "run", lambda: run(arguments)
        yield "files", lambda: contents(folder / "paper")
