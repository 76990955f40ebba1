"""Figures 1 and 2: a line and a surface of each fractal dimension, pressed as the paper plans."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import roughline as rl
from roughline.lab.controls import ControlError
from roughline.lab.frames import frame
from roughline.lab.published import controls as c
from roughline.lab.server.tasks import Arguments, Progress
from roughline.paper.gallery import Gallery
from roughline.paper.plan import paper_plan
from roughline.report.shading import shaded

_POINTS = 512  # along a side; the paper's own plan has 2048


def body(arguments: Arguments, progress: Progress) -> bytes:
    """One row of Figure 1; the second row is Figure 2 as well."""
    row = _row(arguments.get("row"))
    n = min(_POINTS, arguments["session"]["max_points"])
    gallery = replace(Gallery.of(paper_plan("full")), n=n)
    found = gallery.bodies(gallery.fractal_dimensions[row])
    heights, line = found["heights"], found["line_heights"]
    level = float(line.max() - found["line_depth"])
    fraction = float(found["contact"].mean())
    return frame(
        {
            "row": row,
            "D_f": c.GALLERY[row],
            "level": level,
            "heights": [float(heights.min()), float(heights.max())],
            "deepest": float(found["displacement"].max()),
            "points": f"{n}²",
            "contact": f"{fraction:.1%}",
            "springs": f"{float(np.mean(line > level)):.1%}",
            "force_bar": f"{gallery.force_bar:g}",
        },
        {
            "topography": shaded(rl.Surface(heights, (1.0, 1.0), is_cut_out=False)).T,
            "contact": found["contact"].astype(np.uint8).T,
            "deflection": found["displacement"].T,
            "line": line,
        },
    )


def _row(said: object) -> int:
    if not isinstance(said, int) or not 0 <= said < len(c.GALLERY):
        raise ControlError(f"there is no such row; there are 0 to {len(c.GALLERY) - 1}")
    return said
