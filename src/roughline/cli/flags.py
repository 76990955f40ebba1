"""What the command line calls arguments of the library: its flags."""

from __future__ import annotations

import shlex

from roughline.errors.words import Words
from roughline.question.fields import names_by

_SPELLED = (
    *("hurst", "fractal_dimension", "length", "rms_height", "surfaces", "tolerance", "threads"),
    *("workers", "scheduler", "host", "port", "address"),
    *("radius", "prony", "times", "s_filter", "l_filter"),
)
"""Arguments of other commands whose flags are spelled like them."""

_OTHER_FLAGS = {
    "q_roll": "--roll-off",
    "q_high": "--cutoff",
    "n": "--points",
    "rng": "--seed",
    "forces": "--load",
    "force": "--load",
    "depth": "--depth",
    "force_bars": "--force-bar",
    "table": "--export-table",
    "range": "the range of --adhesion",
}

FLAGS = Words(
    {
        **{name: f"--{name.replace('_', '-')}" for name in _SPELLED},
        **_OTHER_FLAGS,
        **names_by(lambda field: field.first_flag),
    },
    shlex.quote,
)
