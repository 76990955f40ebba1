"""The controls of the view "My surface"."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.lab.controls import Choice

MOST_POINTS = 4096
"""Most points along a side that are resampled to."""
MOST_LOADS = 20
"""Most loads of one question."""
MOST_MAPS = 20
"""Most maps of one part; a page may have no more files."""

FILLING = Choice(
    "fill",
    "filling",
    {"harmonic": "smoothest surface", "nearest": "nearest height"},
    "harmonic",
    "How missing points are filled: by the smoothest surface through their neighbours, or by the "
    "nearest known height. The answers try both.",
)
TREND = Choice(
    "trend",
    "trend",
    {
        "default": "tilt, as measured",
        "tilt": "tilt",
        "curvature": "curvature",
        "mean": "mean",
        "none": "none",
    },
    "default",
    "What is removed from the heights by least squares. By default, the tilt of the stage is "
    "removed from files of an instrument; our own files stay as they are.",
)
TILT = Choice(
    "tilt",
    "tilt is of",
    {"unknown": "not known", "mounting": "the mounting"},
    "unknown",
    "Whose the tilt of a measured topography is: the mounting's alone, such as the stage's, or "
    "also that of waves longer than the topography, which change the answers for a larger surface.",
)
PIXELS = Choice(
    "pixels",
    "heights are",
    {"default": "as the file says", "means": "means over pixels", "points": "of points"},
    "default",
    "Whether heights are means over pixels or those of points, which tells the instrument from the "
    "surface in the spectrum's tail. By default, they are means in files of optical instruments, "
    "else it is not known.",
)
OUTLIERS = Choice(
    "outliers",
    "spikes",
    {"keep": "keep", "remove": "remove and fill"},
    "keep",
    "Points that differ from their neighbours by more than five times the scatter: dust, or errors "
    "of the instrument. The highest point determines where first touch is.",
)
BODIES = Choice(
    "bodies",
    "bodies given by",
    {"materials": "two materials", "modulus": "contact modulus"},
    "materials",
    "Two materials give all answers; a contact modulus E* alone gives the curve.",
)
ELASTIC = Choice(
    "elastic",
    "yield",
    {"no": "where a hardness is known", "yes": "elastic"},
    "no",
    "Points of the contact bear at most the hardness of the softer body; where it is reached, the "
    "surface is permanently indented. Or both bodies are elastic, however high the pressures.",
)
BOUNDARY = Choice(
    "boundary",
    "half-space",
    {"free": "free", "periodic": "periodic"},
    "free",
    "Free: the half-space continues, unloaded, around the surface. Periodic: the surface is "
    "repeated without end.",
)
GRID = Choice(
    "grid_error",
    "grid error",
    {"default": "where it is quick", "yes": "estimate", "no": "leave out"},
    "default",
    "What the distance of the points leaves open, from coarser grids; without it there are no "
    "intervals. It takes about twice as long.",
)
GRID_ERRORS = {"default": None, "yes": True, "no": False}

KEYS = (
    *(
        "unit",
        "channel",
        "size",
        "fill",
        "most_missing",
        "tilt",
        "pixels",
        "blur",
        "tip_radius",
        "trend",
        "outliers",
        "crop",
        "low_pass",
    ),
    *("resample", "bodies", "first", "second", "E", "loads", "boundary", "friction"),
    *("frequency", "theories", "grid_error", "elastic", "hardness", "joint_area"),
)
"""Keys of all controls, as in the address."""


DEFAULTS = {
    **{each.key: each.default for each in (FILLING, TILT, PIXELS, TREND, OUTLIERS)},
    **{each.key: each.default for each in (BODIES, ELASTIC, BOUNDARY, GRID)},
    "most_missing": "10 %",
}
"""Of controls that mean something without a text."""
NEEDED = {"first": "steel", "second": "copper", "E": "110 GPa"}
"""Of controls without whose text there is no answer: what is used while there is none."""


@dataclass(frozen=True)
class Example:
    """A measurement made by ourselves.

    Attributes
    ----------
    file : str
        Name of its file.
    name, meaning : str
        What the page calls it, and one sentence.
    """

    file: str
    name: str
    meaning: str


EXAMPLES = {
    "ground": Example(
        "ground-steel.x3p",
        "ground steel, optical profiler",
        "A map of 0.6 mm with a tilt, missing points and spikes of dust.",
    ),
    "film": Example(
        "sputtered-film.x3p",
        "sputtered film, AFM",
        "A map of 4 µm that follows a self-affine law with a roll-off.",
    ),
    "shaft": Example(
        "turned-shaft.txt",
        "turned shaft, stylus",
        "A line scan of 2 mm along feed marks.",
    ),
}
"""By their keys in the address."""
