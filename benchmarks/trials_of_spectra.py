"""How often fits of spectra, and pressed scans, hold the truth.

Pieces are cut out of larger self-affine surfaces and lines, whose spectrum and rms height are
known. Their lengths are in units of the piece's, wavenumbers in units of 2 pi over it.
"""

import math
from dataclasses import replace

import numpy as np
from made_surfaces import GAUSSIAN, INSTRUMENTS, KINDS, parent_of, piece_of
from trials import E_STAR, Study, make_of, row, seen

import roughline as rl
from roughline.measurement.fit import SHORTEST_RANGE

HURSTS = (0.3, 0.6, 0.9)
SCANS = 4  # of each map
ACROSS = {"turned": 0}  # axis across the lay of a kind, along which it is scanned; else 1
FORCE_BARS = (0.01, 0.1, 1.0)
HURST_WINDOWS = ((0.1, 0.4), (0.4, 0.7), (0.7, 0.95))
ROLL_OFFS = (4, 16)
CUTOFFS = (0.35, 0.8)  # of the Nyquist wavenumber
PIECES = {
    # points along a side: how many
    "map": {128: 400, 256: 400, 512: 200, 1024: 40},
    "scan": {256: 200, 1024: 200, 4096: 200},
}
LONGER = {"map": 4, "scan": 8}  # their parents
Q_LOW = math.tau
WHOLE = 128  # points along a side of whole surfaces, and of pieces that are scanned
COUNTED = 128  # waves whose heights are summed on the lattice


def scan_of(surface, kind, rng):
    """A line scan of a map, at a random place, across its lay if it has one."""
    heights = surface.heights.T if ACROSS.get(kind, 1) == 0 else surface.heights
    place = int(rng.integers(heights.shape[0]))
    return rl.Line(heights[place].copy(), surface.sizes[0], unit="m", kind="profile")


def scan_rows(kind, option, seed):
    """Line scans of a piece, and the piece in the full model."""
    make, rng = make_of("scan", kind, seed)
    parent = parent_of(kind, make, rng)
    for _ in range(2):
        piece = piece_of(parent, make, rng).detrended()
        forces = np.array(FORCE_BARS) * E_STAR * piece.rms_height * piece.sizes[0]
        truth = rl.press(piece, E_star=E_STAR, forces=forces, throw=False).stiffness
        for _ in range(SCANS):
            scan = scan_of(piece, kind, rng).detrended()
            found = rl.press_scan(scan, E_star=E_STAR, forces=forces)
            said = "; ".join(found.curve.warnings)
            told = FORCE_BARS, truth, found.curve.stiffness, found.low, found.high
            for each in zip(*told, strict=True):
                yield row("k of a scan", *each, said)


def fit_rows(kind, option, seed):
    """The exponent of a map, and of a scan of it, that an instrument saw."""
    make, rng = make_of("fit", kind, seed)
    make = replace(make, hurst=HURSTS[seed % 3])
    piece = piece_of(parent_of(kind, make, rng), make, rng)
    map_seen = seen("fit", piece, option, rng)
    scan = scan_of(map_seen, kind, rng)
    for name, body in (("H of a map", map_seen.detrended()), ("H of a scan", scan.detrended())):
        found = rl.roughness(body)
        told = (math.nan,) * 3
        if found.fit is not None:
            told = found.fit.hurst, *found.fit.hurst_interval
        yield row(name, 0.0, make.hurst, *told, "; ".join(found.remarks))


def piece_rows(kind, option, number):
    """What a fit of one tilted map or line scan of some points says of its parent."""
    points = int(option)
    rng = np.random.default_rng([kind == "map", points, number])
    hurst = rng.uniform(*HURST_WINDOWS[number % 3])
    roll = rng.choice([0.0, rng.uniform(*ROLL_OFFS)])
    cut = points / 2 * rng.choice([1.0, rng.uniform(*CUTOFFS)])
    longer = LONGER[kind]
    law = {"hurst": hurst, "C_0": 1.0, "q_high": Q_LOW * cut}
    parent = rl.SelfAffine(length=longer, q_roll=Q_LOW * max(roll, 1 / longer), **law)
    if kind == "map":
        surface = parent.surface(points * longer, rng, ("fixed", "gaussian")[number // 3 % 2])
        x, y = (int(i) for i in rng.integers(0, points * (longer - 1) + 1, 2))
        piece = surface.cropped((x, x + points), (y, y + points))
        spectrum = rl.isotropic_spectrum(replace(piece, heights=tilted(piece.heights, rng)))
    else:
        heights = tilted(cut_out(parent, points, rng), rng)
        spectrum = rl.profile_spectrum(rl.Line(heights, 1.0, kind="profile"))
    fit = rl.fit_self_affine(spectrum)
    q_high = Q_LOW * min(cut, fit.q_last / Q_LOW)  # no fit sees beyond
    found = fit.q_high or fit.q_last
    is_cut = cut < points / 2 and q_high < fit.q_last
    if q_high < SHORTEST_RANGE * Q_LOW * max(roll, 1):
        return
    size = f"{kind}, {points} x {points}" if kind == "map" else f"{kind}, {points} points"
    low, high = HURST_WINDOWS[number % 3]
    for name, truth, value, ends in (
        ("H of a piece", hurst, fit.hurst, fit.hurst_interval),
        ("roll-off" if roll else "no roll-off", parent.q_roll, fit.q_roll, fit.q_roll_interval),
        ("cutoff" if is_cut else "no cutoff", q_high, found, fit.q_high_interval),
        ("rms height", rms_of_piece(parent), fit.rms_height, fit.rms_interval),
    ):
        ends = ends[0] * (1 - 1e-9), ends[1] * (1 + 1e-9)
        yield row(name, 0.0, truth, value, *ends, size=size, window=f"{kind}, H {low} to {high}")


def known_piece_rows(kind, option, number):
    """Tilted pieces of maps and scans; their power laws, too, span a factor of three or more."""
    for each in piece_rows(kind, option, number):
        each["quantity"] = each["quantity"].removeprefix("no ")
        yield each | {"piece": each["window" if kind == "map" else "size"]}


def whole_rows(kind, option, seed):
    """Periodic surfaces of 128 x 128 points whose power laws span a factor of three or more."""
    rng = np.random.default_rng([seed, *option.encode()])
    hurst, roll = rng.uniform(0.1, 0.95), rng.choice([1.0, rng.uniform(*ROLL_OFFS)])
    cut = WHOLE / 2 * rng.choice([1.0, rng.uniform(*CUTOFFS)])
    if cut < SHORTEST_RANGE * roll:
        return
    q_high = None if cut == WHOLE / 2 else Q_LOW * cut
    law = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=Q_LOW * roll, q_high=q_high)
    fit = rl.fit_self_affine(rl.isotropic_spectrum(law.surface(WHOLE, rng, option)))
    said = "; ".join(fit.objections)
    ring = 1 + 1 / (WHOLE / 2 - 1)  # a ring holds all waves up to the next
    for name, truth, value, (low, high) in (
        ("H of a surface", hurst, fit.hurst, fit.hurst_interval),
        ("roll-off", Q_LOW * roll, fit.q_roll, fit.q_roll_interval),
        ("cutoff", Q_LOW * cut, fit.q_high or fit.q_last, fit.q_high_interval),
        ("rms height", 1.0, fit.rms_height, fit.rms_interval),
    ):
        low, high = low * (1 - 1e-9), high * (ring if name == "cutoff" else 1 + 1e-9)
        yield row(name, 0.0, truth, value, low, high, said)


def gaussian_scan_rows(kind, option, seed):
    """A row of two tilted pieces of 128 x 128 points of a Gaussian surface, and the pieces."""
    hurst, roll = (float(each) for each in option.split(", roll-off "))
    law = {"hurst": hurst, "length": LONGER["map"], "C_0": 1.0, "q_roll": Q_LOW * roll}
    parent = rl.SelfAffine(**law).surface(WHOLE * LONGER["map"], seed, "gaussian")
    for first in (0, 2 * WHOLE):
        piece = parent.cropped((first, first + WHOLE), (0, WHOLE))
        heights = piece.heights[0] + 5 * np.linspace(-1, 1, WHOLE)
        piece = piece.detrended()
        given = {"E_star": 1.0, "forces": np.array(FORCE_BARS) * piece.rms_height}
        truth = rl.press(piece, rtol=1e-3, **given).stiffness
        scan = rl.Line(heights, 1.0, kind="profile")
        found = rl.press_scan(scan, gaussian=True, rng=seed, **given)
        told = FORCE_BARS, truth, found.curve.stiffness, found.low, found.high
        for each in zip(*told, strict=True):
            yield row("k of a scan", *each)


def rms_of_piece(parent):
    """Rms height of the waves that fit: on the lattice, and in the continuum beyond some waves."""
    q_roll = max(parent.q_roll, Q_LOW)
    C_0 = float(parent.continuum.C_2d([q_roll])[0])
    law = {"hurst": parent.hurst, "length": 1.0, "C_0": C_0, "q_roll": q_roll}
    whole = rl.SelfAffine(q_high=parent.q_high, **law)
    square = whole.lattice(2 * COUNTED).moment(0)
    if parent.q_high > COUNTED * Q_LOW:
        less = rl.SelfAffine(q_high=COUNTED * Q_LOW, **law)
        square += whole.continuum.moment(0) - less.continuum.moment(0)
    return math.sqrt(square)


def cut_out(parent, points, rng):
    """Heights of a piece of a straight Gaussian cut, without its surface."""
    n = points * round(parent.length)
    power = parent.continuum.C_profile(parent.q_low * np.arange(1, n // 2)) * parent.q_low
    modes = np.sqrt(power / 2) * (rng.normal(size=power.size) + 1j * rng.normal(size=power.size))
    first = rng.integers(0, n - points + 1)
    return np.fft.irfft([0, *modes, 0], n)[first : first + points] * n


def tilted(heights, rng):
    """Heights with a random tilt, about as high as they are."""
    height = heights.std()
    for axis, points in enumerate(heights.shape):
        rise = rng.normal() * height * np.linspace(-1, 1, points)
        heights = heights + np.expand_dims(rise, [i for i in range(heights.ndim) if i != axis])
    return heights


SCAN = Study(
    scan_rows,
    "A line scan",
    "Line scans of maps of 256 x 256 points, across the lay where there is one, with 20 to 60 "
    "roll-off wavelengths a side, are pressed; the truth is the map in the full model.",
    tuple(KINDS),
    seeds=6,
)
FIT = Study(
    fit_rows,
    "The Hurst exponent",
    "Maps of 128 x 128 pixels, and scans of 128, seen by an instrument on surfaces of four times "
    "as many points. Half widths are those of H itself.",
    (*GAUSSIAN, "lognormal summits", "ground, 3", "ground, 9", "ground, 30"),
    tuple(each for each in INSTRUMENTS if each != "missing points"),
    6,
    ("kind", "option"),
)
PIECE = Study(
    piece_rows,
    "Self-affine fits of tilted pieces",
    "Maps of n x n points are cut out of surfaces of 4n x 4n points, scans of straight Gaussian "
    "cuts that are eight times longer. Half widths are those of H itself, else factors.",
    ("map", "scan"),
    seeds={(kind, f"{n}"): many for kind, sizes in PIECES.items() for n, many in sizes.items()},
    groups=("size", "window"),
    columns=("held", "silent", "half width", "mean error"),
)
WHOLES = Study(
    whole_rows,
    "Whole surfaces",
    whole_rows.__doc__,
    ("surface",),
    ("fixed", "gaussian"),
    200,
    ("option",),
)
KNOWN_PIECES = replace(
    PIECE,
    rows_of=known_piece_rows,
    asked=known_piece_rows.__doc__,
    seeds={("map", "128"): 200, ("scan", "256"): 100, ("scan", "1024"): 100},
    groups=("piece",),
)
GAUSSIAN_SCANS = Study(
    gaussian_scan_rows,
    "Scans of Gaussian surfaces",
    gaussian_scan_rows.__doc__,
    ("surface",),
    ("0.8, roll-off 4", "0.8, roll-off 0.25", "0.3, roll-off 4"),
    12,
    ("option",),
)
