"""The flags of the command line in messages that speak of arguments."""

from __future__ import annotations

import shlex

from roughline.report.arguments import with_arguments_called

_FLAGS = {
    "E_star": "--modulus",
    "materials": "--materials",
    "loads": "--load",
    "depths": "--depth",
    "n_loads": "--loads",
    "against": "--against",
    "hardness": "--hardness",
    "elastic": "--elastic",
    "periodic": "--periodic",
    "friction": "--friction",
    "frequency": "--frequency",
    "theories": "--theory",
    "history": "--history",
    "unload": "--unload",
    "joint_area": "--joint-area",
    "grid_error": "--grid-error",
    "unit": "--unit",
    "channel": "--channel",
    "sizes": "--size",
    "missing": "--fill",
    "most_missing": "--max-missing",
    "tilt": "--tilt",
    "pixels": "--pixels",
    "blur": "--blur",
    "tip_radius": "--tip-radius",
    "trend": "--trend",
    "crop": "--crop",
    "low_pass": "--low-pass",
    "points": "--resample",
    "remove_outliers": "--remove-outliers",
    "hurst": "--hurst",
    "fractal_dimension": "--fractal-dimension",
    "length": "--length",
    "rms_height": "--rms-height",
    "q_roll": "--roll-off",
    "q_high": "--cutoff",
    "n": "--points",
    "rng": "--seed",
    "surfaces": "--surfaces",
    "force_bars": "--force-bar",
    "tolerance": "--tolerance",
    "threads": "--threads",
    "workers": "--workers",
    "scheduler": "--scheduler",
    "host": "--host",
    "port": "--port",
    "password_file": "--password-file",
    "behind_proxy": "--behind-proxy",
    "max_upload": "--max-upload",
    "max_points": "--max-points",
    "max_seconds": "--max-seconds",
    "max_memory": "--max-memory",
    "max_disk": "--max-disk",
}


def in_flags(message: str | Exception) -> str:
    """Return a message with flags in the places of arguments."""
    return with_arguments_called(message, _FLAGS, shlex.quote)
