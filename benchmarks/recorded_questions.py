"""What the recorder asks of the package from Python, besides the commands."""

import math
import tempfile
from functools import partial
from itertools import product
from pathlib import Path

import numpy as np
from recorded_problems import LOADS, PRESSED, line, press, rough, scan, shape, spectrum, strip
from recorded_values import contents

import roughline as rl

_Q = math.tau * np.array([1.0, 2.0, 5.0, 11.0])
_PRESSURES = np.geomspace(1e-3, 0.3, 5)
_MAPS = ("al3d-1.al3d", "di-1.di", "opd-1.opd")
_SCANS = ("dektak-1.csv", "mitutoyo_mock.xlsx", "xy-1.txt")
_PREPARATIONS = {
    "none": None,
    "counted": {},
    "curvature": {"trend": "curvature"},
    "mean": {"trend": "mean"},
    "without outliers": {"remove_outliers": True},
    "low-pass": {"low_pass": 0.1},
    "cropped": {"crop": (0.1, 0.7, 0.2, 0.9)},
    "coarser": {"points": 20},
    "finer": {"points": (80, 50)},
    "all": {"crop": (0, 0.5, 0, 0.5), "remove_outliers": True, "low_pass": 0.05, "points": 16},
    "too few": {"points": 1},
    "no crop": {"crop": (0.5, 0.2, 0, 1)},
    "no trend": {"trend": "cubic"},
}


_CURVES = 1 + np.random.default_rng(3).random((12, 20)) / 5
_FORCES = np.geomspace(1e-4, 1, 20)
_LAW = 0.7 * _FORCES**0.55 * _CURVES
_MATERIALS = (
    *("steel", "E=70 GPa nu=0.33", "copper hardness=1.2 GPa", "rigid", "stel", "E=70 nu=0.3"),
    *("steel colour=3", "E=1 GPa E=2 GPa", "nu=0.3"),
)


def refused_or(ask, *arguments):
    """What a function returns, or the text of its refusal."""
    try:
        return ask(*arguments)
    except rl.RoughlineError as error:
        return f"{type(error).__name__}: {error}"


def questions(topographies):
    """Give everything that is asked from Python, as (name, function)."""
    for name, problem in PRESSED.items():
        yield f"press {name}", lambda problem=problem: press(*problem)
    yield "press interrupted", _interrupted
    yield "press on one thread", _on_one_thread
    yield "press written", _written
    yield from _scans()
    yield from _spectra()
    yield from _descriptions()
    yield from _statistics()
    yield from _bodies()
    for name in (*_MAPS, *_SCANS):
        path, options = topographies / name, {"unit": "um"} if name == "xy-1.txt" else {}
        yield f"read {name}", lambda path=path, options=options: _read(path, options)
        yield f"press read {name}", lambda path=path, options=options: _pressed(path, options)
    for name in ("sur-3.sur", "xy-1.txt", "di_corrupted.di", "none.x3p"):
        yield f"refused {name}", lambda name=name: rl.read(topographies / name)
    for name in ("al3d-1.al3d", "opd-1.opd", "di-1.di"):
        path = topographies / name
        read = {"missing": rl.Missing("nearest"), "trend": "none"}
        yield f"read untouched {name}", lambda path=path, read=read: rl.read(path, **read)


def _interrupted():
    def stop(done, total):
        if done == 2:
            raise KeyboardInterrupt

    try:
        rl.press(rough(32, 81), E_star=1.0, n_loads=5, progress=stop)
    except rl.Interrupted as stopped:
        return {"message": str(stopped), "curve": stopped.curve}
    return "not interrupted"


def _on_one_thread():
    body = rough(96, 82)
    curves = {"many": rl.press(body, E_star=1.0, forces=LOADS)}
    rl.set_threads(1)
    return curves | {"one": rl.press(body, E_star=1.0, forces=LOADS)}


def _written():
    bodies = {
        "surface": rl.Surface(rough(24, 83).heights, (1e-3, 1e-3), "m"),
        "free": rough(24, 83),
        "line": rl.Line(line(256, 84).heights, 2.0, "m"),
        "profile": scan(64, 85),
    }
    curves = {
        "plain": rl.press(bodies["surface"], E_star=1e9, n_loads=4),
        "fields": rl.press(bodies["free"], E_star=1.0, n_loads=4, fields=True),
        "errors": rl.press(rough(32, 86), E_star=1.0, depths=[0.1, 1.0], grid_error=True),
        "line": rl.press(bodies["line"], E_star=1.0, n_loads=4),
    }
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for name, body in bodies.items():
            rl.write(body, folder / f"{name}.nc")
        again = {name: refused_or(rl.read, folder / f"{name}.nc") for name in bodies}
        for name, curve in curves.items():
            curve.write(folder / f"curve {name}.nc")
            curve.write(folder / f"curve {name}.csv")
        return {"files": contents(folder), "read again": again}


def _scans():
    pressed = partial(rl.press_scan, E_star=1.0, forces=LOADS)
    yield "scan", lambda: pressed(scan(128, 91))
    yield "scan rolled off", lambda: pressed(scan(256, 92, roll=8), E_star=2.0)
    yield "scan, seed", lambda: pressed(scan(128, 91), rng=5)
    yield "scan against scan", lambda: pressed(scan(128, 93), against=scan(96, 94))
    yield "scan of a line", lambda: pressed(line(128, 95))
    yield "compare spectrum", lambda: _compared(spectrum(roll=2), n=32, surfaces=3)
    yield "compare surface", lambda: _compared(rough(64, 96), rng=3)
    yield "compare piece", lambda: _compared(rough(64, 97).cropped((0, 40), (0, 48)))
    yield "compare once", lambda: _compared(spectrum(), surfaces=1)


def _compared(body, **options):
    found = rl.compare(body, force_bars=np.geomspace(0.01, 1, 5), **options)
    return {"found": found, "differences": found.differences(), "trusted": found.trusted(0.2)}


def _statistics():
    law = partial(rl.fit_power_law, _FORCES)
    yield "average", lambda: rl.average(_LAW)
    yield "average geometric", lambda: rl.average(_LAW, "geometric", 0.8, rng=4)
    yield "power law", lambda: law(_LAW, (1e-3, 0.1))
    yield "power law of one", lambda: law(_LAW[0], (1e-3, 0.1))
    yield "power law geometric", lambda: law(_LAW, (1e-3, 0.1), averaging="geometric")
    yield "power law, no window", lambda: law(_LAW, (0.5, 0.6))
    yield "window", lambda: rl.find_window(_FORCES, _LAW)
    yield "trust map", rl.trust_map
    places = [(2.2, 0.1, 1.0), (2.75, 0.03, 3.0), (2.0, 1.0, 2.5)]
    yield "trust map read", lambda: [_trusted(rl.trust_map().at(*each)) for each in places]
    yield "trust map, outside", lambda: rl.trust_map().at(2.2, 1e-9)
    yield "punches", lambda: [rl.PAPER_PUNCH, rl.EXACT_PUNCH]
    yield "public names", lambda: sorted(rl.__all__)
    yield "status", lambda: {each.name: [int(each), each.reason] for each in rl.Status}
    for name in _MATERIALS:
        yield f"material {name}", lambda name=name: rl.material(name)
    yield "contact modulus", lambda: rl.contact_modulus(rl.material("steel"), rl.material("pmma"))


def _trusted(found):
    return {"found": found, "text": str(found), "verdict": found.verdict(0.1)}


def _spectra():
    laws = {
        "plain": {},
        "rolled off": {"roll": 4, "hurst": 0.6},
        "cut": {"cut": 20, "hurst": 0.3},
        "both": {"roll": 3, "cut": 16, "hurst": 1.0, "length": 2e-3, "height": 1e-6},
    }
    for name, law in laws.items():
        yield f"spectrum {name}", lambda law=law: _of_spectrum(spectrum(**law))
        yield f"theories {name}", lambda law=law: _theories(spectrum(**law))
    yield "spectrum by C_0", lambda: _of_spectrum(rl.SelfAffine(fractal_dimension=2.3, C_0=1e-3))
    yield "spectrum, none", lambda: rl.SelfAffine(rms_height=1.0)
    asked = [*product((64, 1024), (False, True), (False, True))]
    yield "estimate", lambda: [_memory(*each) for each in asked]


def _memory(n, periodic, fields):
    return rl.estimate((n, 2 * n), 10, periodic=periodic, fields=fields).memory


def _of_spectrum(law):
    kinds = {"itself": law, "continuum": law.continuum, "lattice": law.lattice(64)}
    kinds["line's lattice"] = law.lattice(256, "line")
    spectra = {
        name: {each: getattr(kind, each)(_Q) for each in ("C_2d", "C_reduced", "C_profile")}
        for name, kind in kinds.items()
    }
    moments = {name: kind.moment(0) for name, kind in kinds.items()}
    return {"law": law, "spectra": spectra, "moments": moments}


def _theories(law):
    kinds = {"surface": law.surface(64, 4), "lattice": law.lattice(64), "law": law}
    return {
        f"{name} {what}": refused_or(rl.theory, name, roughness, 2.0, _PRESSURES)
        for name in ("persson", "bush-gibson-thomas", "greenwood-williamson", "hertz")
        for what, roughness in kinds.items()
    }


def _descriptions():
    bodies = {
        "surface": lambda: rough(128, 101, hurst=0.7, roll=4, cut=32),
        "rough surface": lambda: rough(64, 102, hurst=0.2),
        "piece": lambda: rough(128, 103).cropped((0, 64), (0, 96)),
        "strip": lambda: strip((24, 96), (0.5, 3.0), 104),
        "scan": lambda: scan(256, 105, roll=6),
        "short scan": lambda: scan(48, 106),
        "wave": lambda: shape("wave", 32),
        "flat": lambda: shape("flat", 16),
        "line": lambda: line(256, 107),
    }
    for name, make in bodies.items():
        yield f"roughness {name}", lambda make=make: _described(make())
    scans = (scan(128, i) for i in range(4))
    yield "spectrum of scans", lambda: _fitted(rl.profile_spectrum([*scans]))


def _described(body):
    estimate = rl.isotropic_spectrum if isinstance(body, rl.Surface) else rl.profile_spectrum
    fitted = refused_or(lambda: _fitted(estimate(body)))
    return {"roughness": refused_or(rl.roughness, body), "fitted": fitted}


def _fitted(found):
    fit = rl.fit_self_affine(found)
    law = refused_or(fit.spectrum)
    return {"spectrum": found, "fit": fit, "values": fit.values(found.q), "law": law}


def _bodies():
    first, second = rough(64, 111), rough(96, 112, length=0.8)
    yield "facing", lambda: rl.facing(first, rough(64, 113))
    yield "facing resampled", lambda: rl.facing(first, second)
    yield "facing cropped", lambda: rl.facing(first.cropped((0, 40), (0, 64)), first)
    yield "facing, units", lambda: rl.facing(first, rl.Surface(first.heights, (1, 1), "m"))
    for name, steps in _PREPARATIONS.items():
        yield f"prepared {name}", lambda steps=steps: _prepared(first, steps)
    yield "prepared scan", lambda: _prepared(scan(256, 114), {"crop": (0.1, 0.6), "points": 50})
    yield "surface of NaN", lambda: rl.Surface(np.full((4, 4), math.nan), (1, 1))
    yield "surface without sizes", lambda: rl.Surface(np.zeros((4, 4)))
    yield "surface of a topography", _of_surface_topography
    yield "line of one", lambda: rl.Line(np.zeros(1), 1.0)
    yield (
        "surface coarser",
        lambda: [first.coarsened(), first.detrended("curvature"), first.scaled(3)],
    )


def _of_surface_topography():
    from SurfaceTopography import Topography

    heights = rough(16, 115).heights
    given = Topography(heights, (1.0, 2.0), unit="um"), Topography(heights, (1, 1), periodic=True)
    return [rl.Surface(each) for each in given]


def _prepared(body, steps):
    heights = body.heights.copy()
    heights.flat[17] += 40.0  # a spike
    spiked = type(body)(heights, *([body.sizes] if heights.ndim == 2 else [body.length]))
    return rl.prepared(spiked, None if steps is None else rl.Preparation(**steps))


def _read(path, options):
    body = rl.prepared(rl.read(path, **options))
    return {"body": body, "roughness": rl.roughness(body)}


def _pressed(path, options):
    """A small piece of a measured body, or a coarse scan, pressed."""
    body = rl.prepared(rl.read(path, **options), rl.Preparation(points=128))
    forces = 1e11 * body.rms_height * body.length * np.array(LOADS)
    if isinstance(body, rl.Line):
        return rl.press_scan(body, E_star=1e11, forces=forces)
    piece = body.cropped((0, 64), (10, 60))
    free = rl.press(piece, E_star=1e11, forces=forces, grid_error=True)
    level = piece.detrended()
    return [free, rl.press(level, E_star=1e11, forces=forces, periodic=True)]
