"""The formats that are read: what of each, what not, and with what it was compared."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Format:
    """A format of files with topographies."""

    name: str  # as people call it
    suffixes: tuple[str, ...]  # of its files, with their dots
    written_by: str  # programs and instruments
    is_read: str  # what of it
    is_not_read: str = ""  # what of it, and what is said
    compared: str = ""  # with which public files or programs


FORMATS: tuple[Format, ...] = (
    Format(
        "Text",
        (".txt", ".csv", ".dat", ".asc", ".xyz", ".tsv", ".prn"),
        "Gwyddion, SPIP, Attocube, Nova (NT-MDT), Koala (Lyncee), Alicona, Dektak, spreadsheets",
        "matrices, line scans, lists of points; sides, units, scale and points that lines above "
        "them state; spaces, tabs, semicolons, commas; decimal commas; cells in quotation marks",
        "what can be read in more than one way, and values that are no lengths: refused",
        "SurfaceTopography 1.27.1",
    ),
    Format(
        "Wyko ASCII",
        (".asc", ".txt"),
        "Wyko and Veeco Vision",
        "heights in nm or in waves; lines are columns of the picture, from its bottom",
        "files with several blocks, and images: refused",
        "SurfaceTopography 1.27.1 (whose x and y change places)",
    ),
    Format(
        "SDF",
        (".sdf",),
        "MountainsMap, Olympus, Talysurf, Gwyddion, NPL, surfalize, sdfio",
        "ISO-1.0, ISO-2.0, BCR and relatives as text; ISO and BCR as binary; all types of numbers; "
        "one profile as a line scan",
        "compression and check sums: refused",
        "sdfio 2.0.0 (whose first profile of BCR is the last here), surfalize 0.19.2",
    ),
    Format(
        "SMD",
        (".smd",),
        "software gauges of NPL and PTB, NMM2Profile",
        "profiles at even steps, after ISO 5436-2",
        "positions in the file: refused; the check sum is not checked",
    ),
    Format(
        "GSF",
        (".gsf",),
        "Gwyddion",
        "heights, sides, units; NaN is missing",
        "values that are no lengths: refused",
        "gsffile 0.5.5",
    ),
)
