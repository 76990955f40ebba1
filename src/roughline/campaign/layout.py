"""What a store holds, and where.

Each ensemble is a group with arrays over (fractal_dimension, realisation, force_bar); the root's
attributes say which version made it.
"""

from __future__ import annotations

import numpy as np

from roughline.campaign.plan import Ensemble

FORMAT = 1
"""Changes when older stores can no longer be read."""

PENDING, DONE, FAILED = 0, 1, 2

DIMENSIONS = ("fractal_dimension", "realisation", "force_bar")
COORDINATES = {
    "fractal_dimension": "D_f = 3 - H",
    "realisation": "body i has the seed SeedSequence(seed, spawn_key=(i,))",
    "force_bar": "F / (E* h L)",
}
GALLERY_DIMENSIONS = {
    "heights": ("fractal_dimension", "x", "y"),
    "contact": ("fractal_dimension", "x", "y"),
    "displacement": ("fractal_dimension", "x", "y"),
    "line_heights": ("fractal_dimension", "s"),
    "line_depth": ("fractal_dimension",),
}
GALLERY = "gallery"

VARIABLES: dict[str, tuple[str, float, str]] = {
    # name: (dtype, fill value, meaning); no fill value is one that a finished case can have
    "stiffness": ("f8", np.nan, "raw stiffness k / (E* L)"),
    "depth": ("f8", np.nan, "depth since touch / h"),
    "area_fraction": ("f8", np.nan, "real over nominal contact area, cells in contact"),
    "area_fraction_corrected": ("f8", np.nan, "the same, corrected for the outline's steps"),
    "status": ("i1", -1, "0 converged, 1 stalled, 2 max_iterations, 3 no tangent, -1 not done"),
    "resolved": ("i1", -1, "1 where at least 10 springs or cells are in contact, -1 not done"),
    "rms_slope": ("f8", np.nan, "rms slope L / h of the grid, forward differences"),
    "highest": ("f8", np.nan, "highest point above the mean / h"),
}
PER_BODY = ("rms_slope", "highest")
_OF_SURFACES = ("area_fraction", "area_fraction_corrected")


def variables_of(ensemble: Ensemble) -> list[str]:
    """Names of what is kept of an ensemble; areas of lines predict nothing."""
    return [name for name in VARIABLES if ensemble.model == "full" or name not in _OF_SURFACES]
