"""Commands that the recorder runs on files: press, info, compare and generate."""

import shlex
from dataclasses import replace

import numpy as np
from recorded_problems import line, rough, scan
from recorded_runs import folder_with, run

import roughline as rl

_WORDS = {
    # what commands have in common
    "PAIR": "--materials steel,copper",
    "FORCE": "--modulus '1 GPa' --load '1 N'",
    "LOADS": "--load '1 mN' --load '1 MPa'",
    "ARRAY": "--unit m --size '1 mm'",
    "ENSEMBLE": "-n 32 --surfaces 3 --force-bar 0.05 --force-bar 0.5",
    "LAW": "--length '1 mm' --rms-height '1 um' --out out/made.nc",
}
_HELP = ("", "press", "info", "compare", "generate", "paper", "campaign", "campaign run")
_MAPS = {
    # file: a piece, a wavelength, two depths
    "al3d-1.al3d": ("10 um, 60 um, 20 um, 90 um", "3 um", ("100 nm", "300 nm")),
    "di-1.di": ("0 nm, 250 nm, 0 nm, 200 nm", "20 nm", ("0.5 nm", "2 nm")),
    "opd-1.opd": ("0 mm, 0.06 mm, 0.01 mm, 0.07 mm", "5 um", ("50 nm", "0.1 um")),
}
_SCANS = {
    # file: a piece, a wavelength, what it leaves open
    "dektak-1.csv": ("0 um, 400 um", "20 um", ""),
    "mitutoyo_mock.xlsx": ("100 um, 300 um", "10 um", ""),
    "xy-1.txt": ("0 um, 100 um", "5 um", " --unit um"),
}
_BAD = ("sur-3.sur", "xy-1.txt", "di_corrupted.di", "README.md", "none.x3p")


def commands(topographies):
    """Give every command with its folder made, as (name, function)."""
    with folder_with(lambda folder: _fill(folder, topographies)):
        for name, command in _named():
            yield name, lambda command=command: run(words(command))


def words(command):
    """The words of a command, with those that have a name written out."""
    found = []
    for word in shlex.split(command):
        found += shlex.split(_WORDS[word]) if word in _WORDS else [word]
    return tuple(found)


def _fill(folder, topographies):
    """Write the files that are pressed, beside the measured ones."""
    (folder / "measured").symlink_to(topographies)
    law = {"hurst": 0.7, "length": 1e-3, "height": 1e-6}
    surfaces = {"rough": rough(64, 3, **law), "other": rough(64, 4, **law)}
    surfaces["small"] = rough(96, 5, **law).cropped((0, 48), (0, 96)).detrended()
    surfaces["coarse"] = rough(16, 6, **law)
    for name, body in surfaces.items():
        rl.write(replace(body, unit="m"), f"{name}.nc")
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
        yield f"help {name}", f"{name} --help"
    yield "version", "--version"
    for file, given in _MAPS.items():
        yield from _of_map(file, *given)
    for file, given in _SCANS.items():
        yield from _of_scan(file, *given)
    for file in _BAD:
        yield f"press bad {file}", f"press measured/{file} PAIR LOADS"
        yield f"info bad {file}, shown", f"info measured/{file}"
        yield f"info bad {file}", f"info measured/{file} --json"
        yield f"compare bad {file}", f"compare measured/{file} --force-bar 0.1 --json"
    most = "measured/sur-3.sur --max-missing 0.95 --resample 32"
    yield "press sur-3 filled", f"press {most} PAIR --load '1 N' --json"
    yield "info sur-3 drawn", "info measured/sur-3.sur --out out"
    for each in _OF_OURS.strip().splitlines():
        name, _, command = each.partition(": ")
        yield name, command
        if not {"out", "--json", "LAW"} & set(command.split()):
            yield f"{name}, json", f"{command} --json"
    for i, command in enumerate(_REFUSED):
        yield f"refused {i:02d}", command


def _of_map(file, piece, wave, depths):
    path, cropped = f"measured/{file}", f"--crop '{piece}'"
    short, modulus = f"{path} --resample 64", "--modulus '100 GPa'"
    theories = "--theory persson --theory bush-gibson-thomas --theory greenwood-williamson"
    ways = {
        "plain": f"{modulus} --loads 5",
        "pair": "PAIR LOADS --frequency '5 MHz'",
        "theories": f"PAIR LOADS {theories} --no-grid-error",
        "depths": f"{modulus} --depth '{depths[0]}' --depth '{depths[1]}' --grid-error",
        "periodic": "PAIR LOADS --periodic",
        "nearest": "PAIR LOADS --fill nearest",
        "cropped": f"PAIR LOADS {cropped} --trend curvature",
        "filtered": f"{modulus} LOADS --low-pass '{wave}' --remove-outliers --trend mean",
        "untrended": "PAIR LOADS --trend none",
        "itself": f"PAIR LOADS --against {path}",
        "another": "PAIR LOADS --against measured/al3d-1.al3d",
    }
    for name, options in ways.items():
        yield f"press {file} {name}", f"press {short} {options} --json"
    for name in ("plain", "pair", "theories", "cropped"):
        yield f"press {file} {name}, shown", f"press {short} {ways[name]}"
    yield f"press {file} pair, all shown", f"press {short} {ways['pair']} --all"
    yield f"info {file}", f"info {path} --json"
    yield f"info {file}, shown", f"info {path}"
    yield f"info {file} nearest", f"info {path} --fill nearest --trend none --json"
    yield f"info {file} prepared", f"info {short} {cropped} --low-pass '{wave}' --out out"
    yield f"compare {file}", f"compare {path} --force-bar 0.05 --force-bar 0.5 --json"


def _of_scan(file, piece, wave, unit):
    path, low_pass = f"measured/{file}{unit}", f"--low-pass '{wave}'"
    ways = {
        "plain": "--modulus '100 GPa' --loads 6",
        "pair": "PAIR LOADS --frequency '5 MHz'",
        "cropped": f"PAIR LOADS --crop '{piece}' --trend curvature {low_pass}",
        "against": f"PAIR LOADS --against measured/{file} --resample 128",
    }
    for name, options in ways.items():
        yield f"press {file} {name}", f"press {path} {options} --json"
    yield f"press {file} pair, shown", f"press {path} {ways['pair']} --resample 100"
    yield f"press {file} depth", f"press {path} PAIR --depth '1 um'"
    yield f"press {file} periodic", f"press {path} PAIR LOADS --periodic"
    yield f"press {file} theory", f"press {path} PAIR LOADS --theory persson"
    yield f"info {file}", f"info {path} --json"
    yield f"info {file}, shown", f"info {path} --out out"
    yield f"info {file} cropped", f"info {path} --crop '{piece}' {low_pass} --json"
    yield f"compare {file}", f"compare {path} --force-bar 0.1 --json"


_OF_OURS = """
ours by modulus: press rough.nc --modulus "110 GPa"
ours in pascals: press rough.nc PAIR --load "2 MPa"
ours, many loads: press rough.nc PAIR --loads 5
ours, order of loads: press rough.nc PAIR --load "10 N" --load "1 mN"
ours, same load twice: press rough.nc PAIR --load "1 N" --load "1000 mN"
ours, periodic: press rough.nc PAIR --load "10 N" --periodic
ours, one thread: press rough.nc PAIR --load "10 N" --threads 1
ours against other: press rough.nc --against other.nc PAIR LOADS
ours against small: press rough.nc --against small.nc PAIR LOADS
ours, rigid: press rough.nc --materials steel,rigid --load "1 N" --frequency "5 MHz"
ours, unknown hardness: press rough.nc --materials "E=70 GPa nu=0.33, glass" --load "1 N"
ours, soft: press rough.nc --materials tin,steel --load "1 kN"
few points: press coarse.nc PAIR --load "10 N"
few points, grid error: press coarse.nc PAIR --load "10 N" --grid-error
a thousand loads: press coarse.nc --modulus "1 GPa" --loads 1000
reduced line: press line.nc PAIR --load "1 N" --load "10 N"
array: press map.npy ARRAY PAIR --load "10 N"
text: press map.txt ARRAY PAIR --load "10 N"
array in micrometres: press map.npy --unit um --size "1 um, 2 um" --modulus "1 GPa" --loads 4
holed: press holed.npy ARRAY PAIR --load "10 N"
holed, nearest: press holed.npy ARRAY PAIR --load "9 N" --fill nearest
holed by modulus: press holed.npy ARRAY --modulus "100 GPa" --loads 4
whole against holed: press map.npy --against holed.npy ARRAY PAIR LOADS
torn: press torn.npy ARRAY PAIR --load "10 N"
torn, filled: press torn.npy ARRAY PAIR LOADS --max-missing 0.9
flat: press flat.npy ARRAY PAIR --load "10 N"
scan: press scan.npy ARRAY PAIR --load "1 N"
report of a map: press holed.npy ARRAY PAIR --load "10 N" --load "1 N" --theory persson \
--friction 0.3 --frequency "5 MHz" --report out --json
report of two bodies: press rough.nc --against small.nc PAIR --load "10 N" --report out
report of two maps: press map.npy --against holed.npy ARRAY PAIR --load "10 N" --report out
report of a scan: press scan.npy ARRAY PAIR --load "1 N" --report out --json
report, measured: press measured/opd-1.opd --resample 64 PAIR --load "10 mN" --report out \
--theory greenwood-williamson
curve and figures: press rough.nc --modulus "1 GPa" --loads 4 --out out --theory persson --json
curve of a line: press line.nc PAIR --load "1 N" --out out
describe ours: info rough.nc --out out
describe line: info line.nc
describe holed: info holed.npy ARRAY
describe torn: info torn.npy --out out --json
describe array: info map.npy
describe flat: info flat.npy ARRAY
generate surface: generate LAW --hurst 0.8 -n 64 --seed 3
generate line: generate LAW --fractal-dimension 2.3 --line --roll-off "0.2 mm" \
--cutoff "10 um" --json
generate Gaussian: generate LAW --hurst 0.8 -n 32 --gaussian
compare law: compare --hurst 0.6 ENSEMBLE --out out --json
compare rolled off: compare --fractal-dimension 2.3 --length "1 mm" --roll-off "0.4 mm" \
--cutoff "0.1 mm" ENSEMBLE --tolerance 0.2 --seed 4
compare ours: compare rough.nc --force-bar 0.05 --force-bar 0.5
compare small: compare small.nc --force-bar 0.1 --out out
compare array: compare map.npy ARRAY --force-bar 0.1
channel: info measured/di-1.di --channel 1
"""


def _each(begin, *ends):
    """The same command with one end after another."""
    return (f"{begin} {end}" for end in ends)


_REFUSED = (
    *("presss", "press", "generate", "compare", "press rough.nc", "press rough.nc --modulus"),
    *_each("press rough.nc --modulus", "110", "'1,1 GPa'", "'-1 GPa'", "'nan GPa'", "'5 m'"),
    "press rough.nc --modulus '1 GPa' PAIR",
    *_each("press rough.nc --materials", "steel", "steel,coper --load '1 N'"),
    "press rough.nc --materials rigid,rigid --load '1 N'",
    *_each("press rough.nc --modulus '1 GPa' --loads", "1", "many"),
    *_each("press rough.nc --modulus '1 GPa' --load", "'-1 N'", "'0 N'"),
    *_each("press rough.nc FORCE", "--load '1 m'", "--depth '1 um'", "--loads 5"),
    *_each("press rough.nc --modulus '1 GPa'", "--depth '1 N'", "--periodic --depth '1 mm'"),
    *_each("press rough.nc FORCE", "--unit um", "--size '1 mm'", "--channel 1"),
    *_each("press rough.nc FORCE", "--out rough.nc/sub", "--report out", "--friction 0.3"),
    *_each("press rough.nc FORCE", "--frequency '5 MHz'", "--theory hertz", "--threads 0"),
    *_each("press rough.nc FORCE", "--resample 1", "--crop '0 mm, 2 mm, 0 mm, 1 mm'"),
    *_each("press rough.nc FORCE", "--crop '0 mm, 0.5 mm'", "--low-pass '0 um'", "--trend cubic"),
    *_each("press rough.nc FORCE", "--fill zero", "--against line.nc", "--against none.nc"),
    "press rough.nc FORCE --max-missing 2",
    "press rough.nc PAIR --depth '1 um' --report out",
    *_each("press rough.nc PAIR --load '1 N'", "--friction -1 --report out", "--friction 0.3"),
    "press rough.nc PAIR --load '1 N' --frequency '5 mm'",
    *_each("press line.nc FORCE", "--periodic", "--theory persson"),
    *_each("press flat.npy ARRAY", "FORCE --theory persson", "--modulus '1 GPa'"),
    *_each("press map.npy FORCE", "", "--unit m", "--unit parsnip --size '1 mm'"),
    "press complex.npy FORCE ARRAY",
    *(f"press {file} FORCE" for file in ("notes.txt", "empty.sur", "measured")),
    *_each("press measured/di-1.di FORCE --channel", "nine", "99"),
    *("press none.sur FORCE", "info none.sur", "info measured/xy-1.txt --unit parsnip"),
    *_each("compare", "none.sur", "line.nc", "map.npy", "rough.nc --hurst 0.5"),
    *_each("compare --hurst 0.5", "--roll-off '1 mm'", "--tolerance 10", "--surfaces 1"),
    "compare --hurst 0.5 --surfaces 2 -n 16 --force-bar -1",
    *_each("generate LAW", "", "--hurst 2", "--hurst 0.5 -n 2"),
    "generate --hurst 1 --length 1 --rms-height '1 um' --out x.nc",
    "generate --hurst 1 --length '1 m' --rms-height '1 m' --out x.txt",
    *_each("paper", "--scale huge", "--out rough.nc"),
)
