"""Commands that the recorder runs on files: press, info, compare and generate."""

import numpy as np
from recorded_problems import line, rough, scan
from recorded_refusals import ARRAY, LAW, PAIR, REFUSED
from recorded_runs import folder_with, run

import roughline as rl

LOADS = ("--load", "1 mN", "--load", "1 MPa")
JSON = ("--json",)
_HELP = ("", "press", "info", "compare", "generate", "paper", "campaign", "campaign run")
_SHORT = ("--resample", "64")

_MAPS = {
    # file: a piece, a wavelength, two depths
    "al3d-1.al3d": ("10 um, 60 um, 20 um, 90 um", "3 um", ("100 nm", "300 nm")),
    "di-1.di": ("0 nm, 250 nm, 0 nm, 200 nm", "20 nm", ("0.5 nm", "2 nm")),
    "opd-1.opd": ("0 mm, 0.06 mm, 0.01 mm, 0.07 mm", "5 um", ("50 nm", "0.1 um")),
}
_SCANS = {
    "dektak-1.csv": ("0 um, 400 um", "20 um", ()),
    "mitutoyo_mock.xlsx": ("100 um, 300 um", "10 um", ()),
    "xy-1.txt": ("0 um, 100 um", "5 um", ("--unit", "um")),
}
_BAD = ("sur-3.sur", "xy-1.txt", "di_corrupted.di", "README.md", "none.x3p")


def commands(topographies):
    """Give every command with its folder made, as (name, function)."""
    with folder_with(lambda folder: _fill(folder, topographies)):
        for name, arguments in _named():
            yield name, lambda arguments=arguments: run(arguments)


def _fill(folder, topographies):
    """Write the files that are pressed, beside the measured ones."""
    (folder / "measured").symlink_to(topographies)
    law = {"hurst": 0.7, "length": 1e-3, "height": 1e-6}
    surfaces = {"rough": rough(64, 3, **law), "other": rough(64, 4, **law)}
    surfaces["small"] = rough(96, 5, **law).cropped((0, 48), (0, 96)).detrended()
    surfaces["coarse"] = rough(16, 6, **law)
    for name, body in surfaces.items():
        rl.write(rl.Surface(body.heights, body.sizes, "m", body.settings), f"{name}.nc")
    rl.write(rl.Line(line(256, 7, **law).heights, 1e-3, "m"), "line.nc")
    heights = surfaces["rough"].heights.copy()
    np.save("map.npy", heights)
    np.savetxt("map.txt", heights)
    heights[10:13, 20:25] = np.nan
    np.save("holed.npy", heights)
    heights[::3] = np.nan
    np.save("torn.npy", heights)
    np.save("flat.npy", np.ones((16, 16)))
    np.save("scan.npy", scan(256, 8, **law).heights)
    np.save("complex.npy", np.ones((4, 4), complex))
    (folder / "notes.txt").write_text("no topography")
    (folder / "empty.sur").touch()


def _named():
    for name in _HELP:
        yield f"help {name}", (*name.split(), "--help")
    yield "version", ("--version",)
    for file, (piece, wave, depths) in _MAPS.items():
        yield from _of_map(file, piece, wave, depths)
    for file, (piece, wave, unit) in _SCANS.items():
        yield from _of_scan(file, piece, wave, unit)
    for file in _BAD:
        yield f"press bad {file}", ("press", f"measured/{file}", *PAIR, *LOADS)
        yield f"info bad {file}, shown", ("info", f"measured/{file}")
        yield f"info bad {file}", ("info", f"measured/{file}", *JSON)
        yield f"compare bad {file}", ("compare", f"measured/{file}", "--force-bar", "0.1", *JSON)
    most = ("measured/sur-3.sur", "--max-missing", "0.95", "--resample", "32")
    yield "press sur-3 filled", ("press", *most, *PAIR, "--load", "1 N", *JSON)
    yield "info sur-3 drawn", ("info", "measured/sur-3.sur", "--out", "out")
    for name, arguments in _OF_OURS.items():
        yield name, arguments
        if name in _AS_JSON:
            yield f"{name}, json", (*arguments, *JSON)
    for i, text in enumerate(REFUSED):
        yield f"refused {i:02d}", text


def _of_map(file, piece, wave, depths):
    """A measured map, pressed and described in several ways."""
    path, short = f"measured/{file}", (f"measured/{file}", *_SHORT)
    modulus = ("--modulus", "100 GPa")
    twice = ("--depth", depths[0], "--depth", depths[1])
    cropped = ("--crop", piece)
    ways = {
        "plain": (*modulus, "--loads", "5"),
        "pair": (*PAIR, *LOADS, "--frequency", "5 MHz"),
        "theories": (
            *(*PAIR, *LOADS, "--theory", "persson", "--theory", "bush-gibson-thomas"),
            *("--theory", "greenwood-williamson", "--no-grid-error"),
        ),
        "depths": (*modulus, *twice, "--grid-error"),
        "periodic": (*PAIR, *LOADS, "--periodic"),
        "nearest": (*PAIR, *LOADS, "--fill", "nearest"),
        "cropped": (*PAIR, *LOADS, *cropped, "--trend", "curvature"),
        "filtered": (*modulus, *LOADS, "--low-pass", wave, "--remove-outliers", "--trend", "mean"),
        "untrended": (*PAIR, *LOADS, "--trend", "none"),
        "itself": (*PAIR, *LOADS, "--against", path),
        "another": (*PAIR, *LOADS, "--against", "measured/al3d-1.al3d"),
    }
    for name, options in ways.items():
        yield f"press {file} {name}", ("press", *short, *options, *JSON)
    for name in ("plain", "pair", "theories", "cropped"):
        yield f"press {file} {name}, shown", ("press", *short, *ways[name])
    yield f"press {file} pair, all shown", ("press", *short, *ways["pair"], "--all")
    yield f"info {file}", ("info", path, *JSON)
    yield f"info {file}, shown", ("info", path)
    yield f"info {file} nearest", ("info", path, "--fill", "nearest", "--trend", "none", *JSON)
    yield f"info {file} prepared", ("info", *short, *cropped, "--low-pass", wave, "--out", "out")
    yield f"compare {file}", ("compare", path, "--force-bar", "0.05", "--force-bar", "0.5", *JSON)


def _of_scan(file, piece, wave, unit):
    """A measured line scan, pressed and described in several ways."""
    path = (f"measured/{file}", *unit)
    ways = {
        "plain": ("--modulus", "100 GPa", "--loads", "6"),
        "pair": (*PAIR, *LOADS, "--frequency", "5 MHz"),
        "cropped": (*PAIR, *LOADS, "--crop", piece, "--trend", "curvature", "--low-pass", wave),
        "against": (*PAIR, *LOADS, "--against", f"measured/{file}", "--resample", "128"),
    }
    for name, options in ways.items():
        yield f"press {file} {name}", ("press", *path, *options, *JSON)
    yield f"press {file} pair, shown", ("press", *path, *ways["pair"], "--resample", "100")
    yield f"press {file} depth", ("press", *path, *PAIR, "--depth", "1 um")
    yield f"press {file} periodic", ("press", *path, *PAIR, *LOADS, "--periodic")
    yield f"press {file} theory", ("press", *path, *PAIR, *LOADS, "--theory", "persson")
    yield f"info {file}", ("info", *path, *JSON)
    yield f"info {file}, shown", ("info", *path, "--out", "out")
    yield f"info {file} cropped", ("info", *path, "--crop", piece, "--low-pass", wave, *JSON)
    yield f"compare {file}", ("compare", *path, "--force-bar", "0.1", *JSON)


_REPORT = ("--report", "out")
_ENSEMBLE = ("-n", "32", "--surfaces", "3", "--force-bar", "0.05", "--force-bar", "0.5")
_OF_OURS = {
    "ours by modulus": ("press", "rough.nc", "--modulus", "110 GPa"),
    "ours in pascals": ("press", "rough.nc", *PAIR, "--load", "2 MPa"),
    "ours, many loads": ("press", "rough.nc", *PAIR, "--loads", "5"),
    "ours, order of loads": ("press", "rough.nc", *PAIR, "--load", "10 N", "--load", "1 mN"),
    "ours, same load twice": ("press", "rough.nc", *PAIR, "--load", "1 N", "--load", "1000 mN"),
    "ours, periodic": ("press", "rough.nc", *PAIR, "--load", "10 N", "--periodic"),
    "ours, one thread": ("press", "rough.nc", *PAIR, "--load", "10 N", "--threads", "1"),
    "ours against other": ("press", "rough.nc", "--against", "other.nc", *PAIR, *LOADS),
    "ours against small": ("press", "rough.nc", "--against", "small.nc", *PAIR, *LOADS),
    "ours, rigid": (
        *("press", "rough.nc", "--materials", "steel,rigid", "--load", "1 N"),
        *("--frequency", "5 MHz"),
    ),
    "ours, unknown hardness": (
        "press",
        *("rough.nc", "--materials", "E=70 GPa nu=0.33, glass", "--load", "1 N"),
    ),
    "ours, soft": ("press", "rough.nc", "--materials", "tin,steel", "--load", "1 kN"),
    "few points": ("press", "coarse.nc", *PAIR, "--load", "10 N"),
    "few points, grid error": ("press", "coarse.nc", *PAIR, "--load", "10 N", "--grid-error"),
    "a thousand loads": ("press", "coarse.nc", "--modulus", "1 GPa", "--loads", "1000"),
    "reduced line": ("press", "line.nc", *PAIR, "--load", "1 N", "--load", "10 N"),
    "array": ("press", "map.npy", *ARRAY, *PAIR, "--load", "10 N"),
    "text": ("press", "map.txt", *ARRAY, *PAIR, "--load", "10 N"),
    "array in micrometres": (
        *("press", "map.npy", "--unit", "um", "--size", "1 um, 2 um"),
        *("--modulus", "1 GPa", "--loads", "4"),
    ),
    "holed": ("press", "holed.npy", *ARRAY, *PAIR, "--load", "10 N"),
    "holed, nearest": ("press", "holed.npy", *ARRAY, *PAIR, "--load", "9 N", "--fill", "nearest"),
    "holed by modulus": ("press", "holed.npy", *ARRAY, "--modulus", "100 GPa", "--loads", "4"),
    "whole against holed": ("press", "map.npy", "--against", "holed.npy", *ARRAY, *PAIR, *LOADS),
    "torn": ("press", "torn.npy", *ARRAY, *PAIR, "--load", "10 N"),
    "torn, filled": ("press", "torn.npy", *ARRAY, *PAIR, *LOADS, "--max-missing", "0.9"),
    "flat": ("press", "flat.npy", *ARRAY, *PAIR, "--load", "10 N"),
    "scan": ("press", "scan.npy", "--unit", "m", "--size", "1 mm", *PAIR, "--load", "1 N"),
    "report of a map": (
        *("press", "holed.npy", *ARRAY, *PAIR, "--load", "10 N", "--load", "1 N"),
        *("--theory", "persson", "--friction", "0.3", "--frequency", "5 MHz", *_REPORT, *JSON),
    ),
    "report of two bodies": (
        *("press", "rough.nc", "--against", "small.nc", *PAIR, "--load", "10 N"),
        *_REPORT,
    ),
    "report of two maps": (
        *("press", "map.npy", "--against", "holed.npy", *ARRAY, *PAIR, "--load", "10 N"),
        *_REPORT,
    ),
    "report of a scan": ("press", "scan.npy", *ARRAY, *PAIR, "--load", "1 N", *_REPORT, *JSON),
    "report, measured": (
        *("press", "measured/opd-1.opd", *_SHORT, *PAIR, "--load", "10 mN", *_REPORT),
        *("--theory", "greenwood-williamson"),
    ),
    "curve and figures": (
        *("press", "rough.nc", "--modulus", "1 GPa", "--loads", "4", "--out", "out"),
        *("--theory", "persson", *JSON),
    ),
    "curve of a line": ("press", "line.nc", *PAIR, "--load", "1 N", "--out", "out"),
    "describe ours": ("info", "rough.nc", "--out", "out"),
    "describe line": ("info", "line.nc"),
    "describe holed": ("info", "holed.npy", *ARRAY),
    "describe torn": ("info", "torn.npy", "--out", "out", *JSON),
    "describe array": ("info", "map.npy"),
    "describe flat": ("info", "flat.npy", *ARRAY),
    "generate surface": ("generate", *LAW, "--hurst", "0.8", "-n", "64", "--seed", "3"),
    "generate line": (
        *("generate", *LAW, "--fractal-dimension", "2.3", "--line", "--roll-off", "0.2 mm"),
        *("--cutoff", "10 um", *JSON),
    ),
    "generate Gaussian": ("generate", *LAW, "--hurst", "0.8", "-n", "32", "--gaussian"),
    "compare law": ("compare", "--hurst", "0.6", *_ENSEMBLE, "--out", "out", *JSON),
    "compare rolled off": (
        *("compare", "--fractal-dimension", "2.3", "--length", "1 mm", "--roll-off", "0.4 mm"),
        *("--cutoff", "0.1 mm", *_ENSEMBLE, "--tolerance", "0.2", "--seed", "4"),
    ),
    "compare ours": ("compare", "rough.nc", "--force-bar", "0.05", "--force-bar", "0.5"),
    "compare small": ("compare", "small.nc", "--force-bar", "0.1", "--out", "out"),
    "compare array": ("compare", "map.npy", *ARRAY, "--force-bar", "0.1"),
    "channel": ("info", "measured/di-1.di", "--channel", "1"),
}
_AS_JSON = {name for name in _OF_OURS if not {"out", "--json", "out/made.nc"} & set(_OF_OURS[name])}
