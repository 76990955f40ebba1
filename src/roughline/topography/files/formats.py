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
    reader: str = ""  # what SurfaceTopography calls it, where that reads it; empty: roughline


_PUBLIC = "a public file, in the tests"
_HEIGHTS = "heights, sides and units"
_CHANNELS = "channels of heights; others are named"

FORMATS: tuple[Format, ...] = (
    Format(
        name="X3P",
        suffixes=(".x3p",),
        written_by="exchange format of ISO 25178-72",
        is_read="maps, line scans, layers (as channels) and points on a grid; heights of four "
        "types, beside main.xml or in it; missing points; a folder in the archive",
        is_not_read="points on no grid are refused; pictures of marked regions and another "
        "checksum are said, and the heights read",
        compared="x3pio 2.0.0, number by number",
    ),
    Format(
        name="SUR",
        suffixes=(".sur", ".pro"),
        written_by="Mountains of Digital Surf, and instruments",
        is_read="maps and line scans, plain or packed; missing points; inverted heights; the first "
        "of several layers, which is said",
        is_not_read="intensities, colours, discs, series of profiles and curves are refused by "
        "name",
        compared="surfalize 0.19.2; SurfaceTopography 1.27.1 on a public file",
    ),
    Format(
        name="GWY",
        suffixes=(".gwy",),
        written_by="Gwyddion",
        is_read=f"{_CHANNELS}; masks, as selections; units that are not stated are asked for",
        is_not_read="curves, volumes and lists of points",
        compared="gwyfile 0.3.0, number by number",
    ),
    Format(
        name="NMS",
        suffixes=(".nms", ".orginal"),
        written_by="confocal microscopes of NanoFocus",
        is_read="heights, sides (in nm, which SurfaceTopography takes for mm), points without "
        "signal",
        is_not_read="intensities; maps of other numbers than 16 bits are refused",
        compared="SurfaceTopography 1.27.1 and surfalize 0.19.2, sides by the latter",
    ),
    Format(
        name="TMD",
        suffixes=(".tmd",),
        written_by="TrueMap, scanners of GelSight",
        is_read=f"{_HEIGHTS}, after a comment of any length",
        compared="surfalize 0.19.2, whose comments have 24 bytes",
    ),
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
    Format(
        "NetCDF",
        (".nc", ".nc4", ".cdf", ".grd"),
        "roughline, SurfaceTopography, xarray, GMT",
        "ours: all; of others, by the CF conventions: heights over one or two even sides, their "
        "units, marks and ranges of missing points, scaled counts, falling positions, (y, x) and "
        "(x, y); SurfaceTopography's `mask` and `periodic`; grids of early GMT",
        "positions in degrees, uneven maps, groups, CDF-5, scans of GXSM; of data that do not say "
        "that they are heights, `--channel` chooses",
        "xarray 2026.9, SurfaceTopography 1.27; Gwyddion reads no NetCDF but GXSM's",
    ),
    Format(
        "TIFF",
        (".tif", ".tiff"),
        "ImageJ, and programs that export images",
        "floats and counts of 16 bits and more; sides from the pixel of ImageJ, or from a "
        "resolution finer than 2400 dots an inch; units of heights from a straight line of ImageJ "
        "alone; the orientation; GDAL's mark of missing points",
        "pictures: colours, 8 bits, white to black; stacks; SEM, Park Systems; of several images "
        "`--channel` chooses",
        "tifffile 2026.3; Gwyddion takes sides of 1 x 1",
    ),
    Format(
        name="NPY",
        suffixes=(".npy",),
        written_by="NumPy",
        is_read="arrays of one or two dimensions; unit and sizes are asked for",
        is_not_read="texts, complex numbers, objects",
    ),
    Format(
        name="Nanoscope",
        suffixes=(".spm", ".001"),
        written_by="AFM of Digital Instruments, Veeco and Bruker",
        is_read=f"{_CHANNELS}, those of one name by trace and retrace",
        compared=_PUBLIC,
        reader="di",
    ),
    Format(
        name="OPD",
        suffixes=(".opd",),
        written_by="interferometers of Wyko, Veeco and Bruker",
        is_read=f"{_HEIGHTS}, missing points",
        compared=_PUBLIC,
        reader="opd",
    ),
    Format(
        name="AL3D",
        suffixes=(".al3d",),
        written_by="focus variation of Alicona",
        is_read=f"{_HEIGHTS}, missing points",
        compared=_PUBLIC,
        reader="al3d",
    ),
    Format(
        name="Mitutoyo",
        suffixes=(".xlsx",),
        written_by="SurfTest testers of Mitutoyo",
        is_read="the line scan",
        compared=_PUBLIC,
        reader="mitutoyo",
    ),
    Format(
        name="MNT",
        suffixes=(".mnt",),
        written_by="Mountains of Digital Surf",
        is_read="the measured surface; points that its mask marks as not measured are missing",
        is_not_read="layers that Mountains computes when it opens the file",
        reader="mnt",
    ),
    Format(
        name="HDF5",
        suffixes=(".h5",),
        written_by="any program",
        is_read="arrays of two dimensions; unit and sizes are asked for",
        is_not_read="arrays whose names say that they are no heights (thumbnail, error, phase); of "
        "several others, the first is read, and this is said",
        reader="h5",
    ),
    *(
        Format(name, suffixes, by, "arrays; unit and sizes are asked for", reader=reader)
        for name, suffixes, by, reader in (
            ("HGT", (".hgt",), "the Shuttle Radar Topography Mission", "hgt"),
            ("MATLAB", (".mat",), "MATLAB", "mat"),
            ("NPZ", (".npz",), "NumPy", "npz"),
        )
    ),
    *(
        Format(name, suffixes, by, _HEIGHTS, reader=reader)
        for name, suffixes, by, reader in (
            ("BCR", (".bcr", ".bcrf"), "scanning probe microscopes", "bcr"),
            ("DATX", (".datx",), "interferometers of Zygo", "datx"),
            ("easyScan", (".nid", ".ezd"), "AFM of Nanosurf", "ezd"),
            ("FRT", (".frt",), "MicroProf of FRT", "frt"),
            ("Igor", (".ibw",), "AFM of Asylum, Igor Pro", "ibw"),
            ("JPK", (".jpk",), "AFM of JPK and Bruker", "jpk"),
            ("LEXT", (".lext",), "microscopes of Olympus", "lext"),
            ("MDT", (".mdt",), "AFM of NT-MDT", "mdt"),
            ("MetroPro", (".dat",), "interferometers of Zygo", "metropro"),
            ("MI", (".mi",), "AFM of Molecular Imaging and Agilent", "mi"),
            ("NMM", (".zip",), "the nanomeasuring machine of SIOS", "nmm"),
            ("OIR", (".oir",), "microscopes of Olympus", "oir"),
            ("OmniSurf3D", (".os3d",), "Digital Metrology", "os3d"),
            ("OPDx", (".opdx",), "stylus profilometers of Bruker", "opdx"),
            ("Park", (".tiff",), "AFM of Park", "ps"),
            ("PLU", (".plu", ".apx"), "profilometers of Sensofar", "plu"),
            ("PLUX", (".plux",), "profilometers of Sensofar", "plux"),
            ("POIR", (".poir",), "microscopes of Olympus", "poir"),
            ("QEP", (".qep",), "MarWin of Mahr", "qep"),
            ("VK", (".vk4", ".vk6", ".vk7"), "microscopes of Keyence", "vk"),
            ("WSxM", (".stp", ".top"), "WSxM", "wsxm"),
            ("ZMG", (".zmg",), "profilometers of KLA Zeta", "zmg"),
            ("ZON", (".zon",), "3D microscopes of Keyence", "zon"),
        )
    ),
)
