"""Small cases whose answers, intervals and facts tell what a constant of the margins does."""

import hashlib
import math
import tempfile
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np
from made_surfaces import INSTRUMENTS, KINDS, SIDE, Make, parent_of, piece_of

import roughline as rl
from roughline.measurement.departures import departures

E_STAR = 110e9
YIELDS = "E=200 GPa nu=0.3 hardness=4 GPa, rigid"
ELASTIC = "E=200 GPa nu=0.3, rigid"
LOADS = ("5 N", "50 N")
JOINT = 16 * SIDE**2


@dataclass
class Found:
    """What a case gave: numbers with their ends, NaN where they are not known, and facts."""

    numbers: dict = field(default_factory=dict)  # (value, low, high) by name
    facts: list = field(default_factory=list)  # [name of the kind, digest of the words]

    def add(self, name, values, low=None, high=None):
        """Add a number, or one for each load."""
        values = np.atleast_1d(np.asarray(values, dtype=float))
        ends = [np.full(values.shape, math.nan if each is None else each) for each in (low, high)]
        for i, each in enumerate(zip(values, *ends, strict=True)):
            self.numbers[f"{name} {i}"] = tuple(map(float, each))
        return self

    def tell(self, facts):
        """Add facts by the names of their kinds, and of what they say more about."""
        for each in facts:
            words = hashlib.sha256(str(each).encode()).hexdigest()[:8]
            self.facts.append([" of ".join(_kinds(each)), words])
        return self


def _kinds(fact):
    inner = fact.numbers.get("fact")
    return [fact.kind, *(_kinds(inner) if inner is not None else [])]


def a_map(kind="smooth roll-off", points=64, seed=0, instrument=None, **made):
    """A map that was cut out of a parent twice as long, as an instrument sees it."""
    rng, times = np.random.default_rng(seed), 2 if instrument else 1
    make = Make(points * times, 2, **made)
    piece = piece_of(parent_of(kind, make, rng), make, rng)
    if instrument is None:
        return piece
    heights = INSTRUMENTS[instrument](piece.heights, times, rng)
    return rl.Surface(np.ascontiguousarray(heights), piece.sizes, unit="m", is_cut_out=True)


def asked(surface, materials=ELASTIC, *more, loads=LOADS, **given):
    """Press a body between two materials."""
    ask = list(more)
    return _answered(rl.assess(rl.Question(surface, materials, ask=ask, loads=loads, **given)))


def _answered(result):
    found = Found()
    for key, each in result.answers.items():
        found.add(key, each.values, each.low, each.high).tell(each.facts)
    curve, ends = result.curve, result.intervals
    known = (None,) * 3 if ends is None else (ends.stiffness, ends.unloading, ends.area)
    quantities = "stiffness", "unloading_stiffness", "area_fraction_corrected"
    for name, both in zip(quantities, known, strict=True):
        if hasattr(curve, name):
            found.add(name, getattr(curve, name), *(both or ()))
    return found.tell([*result.facts, *result.left_out])


def part(surfaces, *more, **given):
    """Press some maps of a part."""
    ask = list(more)
    questions = [rl.Question(each, ELASTIC, ask=ask, loads=LOADS, **given) for each in surfaces]
    result = rl.assess_part(questions, names=[f"map {i}" for i in range(len(questions))])
    found = Found().tell(result.facts)
    for key, each in result.answers.items():
        found.add(key, each.mean, each.low, each.high)
    return found


def some_maps(kind, count=3, points=64, seed=3, **made):
    """Maps at random places of one part."""
    rng, make = np.random.default_rng(seed), Make(points, 4, **made)
    parent = parent_of(kind, make, rng)
    return [piece_of(parent, make, rng) for _ in range(count)]


def a_scan(kind="sharp roll-off", points=512, seed=5, waves=40.0):
    """A line scan of a long part."""
    rng, make = np.random.default_rng(seed), Make(points, 2, waves=waves)
    heights = parent_of(kind, make, rng).heights[0].copy()
    return rl.Line(heights, 2 * SIDE, unit="m", kind="profile")


def scanned(scan, *more, **given):
    """Press a line scan as the surface that it was cut from."""
    found = rl.press_scan(scan, E_star=E_STAR, forces=[1.0, 10.0], **given)
    return Found().add("k", found.curve.stiffness, found.low, found.high).tell(found.curve.facts)


def described(body):
    """The law of a topography, and how it departs from what predictions rest on."""
    found, body = Found(), body.detrended()
    found.facts = [
        [f"{each.assumption} {each.fact.kind}", str(each.fact)] for each in departures(body)
    ]
    rough = rl.roughness(body)
    fit = rough.fit
    if fit is None:
        return found
    found.facts += [["objection", each] for each in fit.objections]
    nothing = (math.nan, math.nan)
    found.add("H", 10.0**fit.hurst, *(10.0 ** np.array(fit.hurst_interval)))
    for name, value, ends in (
        ("q_roll", fit.q_roll, fit.q_roll_interval),
        ("q_high", fit.q_high, fit.q_high_interval),
        ("rms height", fit.rms_height, fit.rms_interval),
        ("blur", fit.blur, fit.blur_interval),
        ("q_tail", fit.q_tail, nothing),
    ):
        found.add(name, math.nan if value is None else value, *ends)
    return found


def sealed(surface, law):
    """At which pressure a map seals, and down to which share of a load it leaks no more."""
    body = rl.Homogeneous(E_STAR, periodic=True)
    found = rl.sealing_pressure(surface, half_space=body, law=law, rtol=0.05)
    return Found().add("p_s", found.value, *found.interval)


def leaks_again(surface, hardness, times=10.0):
    given = {"E_star": E_STAR, "periodic": True, "hardness": hardness}
    curve = rl.press(surface, forces=[2e8 * surface.area], **given)
    found = rl.reopening(curve, times=times, rtol=0.05, interval=True)
    return Found().add("F/F", found.value, *found.interval)


def exponent(count):
    """The exponent of the mean of some curves, from their resamples."""
    rng = np.random.default_rng(count)
    pressures = np.geomspace(1e-3, 1e-1, 8)
    stiffness = pressures**0.9 * np.exp(0.1 * rng.normal(size=(count, 1)))
    stiffness = stiffness * np.exp(0.02 * rng.normal(size=(count, 8)))
    found = rl.fit_power_law(pressures, stiffness, window=(1e-3, 1e-1))
    return Found().add("exponent", found.exponent, *found.exponent_interval)


def _with_heights(surface, heights):
    return replace(surface, heights=np.ascontiguousarray(heights))


def _times(surface, factor):
    """A map whose heights are so many times as large."""
    return _with_heights(surface, factor * surface.heights)


def _noise_like(surface):
    """A map of white noise with the rms height of another."""
    noise = np.random.default_rng(0).normal(size=surface.shape)
    return _with_heights(surface, surface.rms_height * noise)


def _jumping(surface, times=3.0):
    """A map whose rows stand higher from one on, as where an instrument lost its place."""
    heights = surface.heights.copy()
    heights[surface.shape[0] // 3 :] += times * surface.rms_height
    return _with_heights(surface, heights)


def _in_steps(surface, step=1.0):
    """A map whose heights are rounded to steps [rms height]."""
    step = step * surface.rms_height
    return _with_heights(surface, np.round(surface.heights / step) * step)


def _tilted(surface, times):
    """A map with a plane that rises by so many rms heights from the middle."""
    level = surface.detrended()
    x = np.linspace(-1, 1, surface.shape[0])[:, np.newaxis]
    return _with_heights(surface, level.heights + times * level.rms_height * x)


def _without_points(surface, share):
    """Heights of a map of which a share is missing, in spots."""
    drawn = surface.heights[::-1, ::-1]
    return np.where(drawn > np.quantile(drawn, 1 - share), np.nan, surface.heights)


def _without_its_tilt(surface):
    """A map that was levelled before, by nobody knows how much."""
    return _with_heights(surface, surface.detrended().heights)


def _on_a_level(surface, share=0.02):
    """A map with its highest points on one level, as where an instrument's range ends."""
    return _with_heights(
        surface, np.minimum(surface.heights, np.quantile(surface.heights, 1 - share))
    )


FEW_KINDS = ("no roll-off", "worn", "ground, 9", "waviness of 4 maps")
OTHER_KINDS = (
    *("smooth roll-off", "lognormal pits", "cross-hatched", "scratched", "plateau-honed"),
    *("ground, 3", "ground, 30", "waviness of 2 maps"),
)
"""Kinds that are not described: others of them break the same assumptions."""

MEASUREMENT = ("measurement",)
PRESSED = "margins", "contact", "question", "assessment", "fluid", "statistics"


@dataclass(frozen=True)
class Case:
    """Bodies that are asked about, by name, and for constants of which rooms."""

    rooms: tuple
    parts: dict  # functions that give what was found


def cases(maps=()):
    """All cases by name; those of measured maps where their files are told."""
    joint = rl.Joint(JOINT)
    every = (*MEASUREMENT, *PRESSED)
    of_files = {path.name: partial(_of_file, path) for path in maps}
    return {
        "maps that yield": Case(
            PRESSED,
            {
                "64": lambda: asked(a_map(), YIELDS, joint),
                "128": lambda: asked(a_map(points=128), YIELDS),
                "quantised": lambda: asked(a_map(instrument="quantised"), YIELDS),
                "noise": lambda: asked(a_map(instrument="noise"), YIELDS),
            },
        ),
        "elastic maps": Case(
            every,
            {each: partial(_of_kind, each) for each in FEW_KINDS}
            | {
                "bow": lambda: asked(a_map(instrument="bow")),
                "levelled before": lambda: asked(_without_its_tilt(a_map())),
            },
        ),
        "maps with faults": Case(
            PRESSED,
            {
                "missing points": _with_missing,
                "missing summits": partial(_with_missing, summits=True, loads=["0.1 N"]),
                "in steps": lambda: asked(_in_steps(a_map())),
                "alone": lambda: asked(replace(a_map(), is_cut_out=False)),
            },
        ),
        "coated maps": Case(
            PRESSED,
            {
                "32": lambda: asked(
                    a_map(points=32), "gold 60 µm on copper, rigid", elastic=True, grid_error=True
                )
            },
        ),
        "sticking maps": Case(
            ("margins", "contact"),
            {
                "32": lambda: asked(
                    a_map(points=32),
                    "E=10 MPa nu=0.49, rigid",
                    rl.Adhesion("50 mJ/m^2"),
                    loads=["1 mN"],
                    grid_error=True,
                )
            },
        ),
        "sheared maps": Case(
            ("margins",),
            {
                "32": lambda: asked(
                    a_map(points=32),
                    ELASTIC,
                    rl.Friction(0.3),
                    rl.Shear("40 N", cycles=2),
                    loads=["200 N"],
                    elastic=True,
                    grid_error=True,
                )
            },
        ),
        "a large map": Case(
            PRESSED, {"272": lambda: asked(a_map(points=272), ELASTIC, joint, loads=["5 N"])}
        ),
        "fluids": Case(
            PRESSED,
            {
                "160": lambda: asked(
                    a_map(points=160), ELASTIC, joint, rl.Fluid("water"), loads=["100 N"]
                ),
            },
        ),
        "seals": Case(
            PRESSED,
            {
                "elastic": lambda: sealed(a_map(waves=5.0).detrended(), None),
                "few waves": lambda: sealed(a_map("no roll-off", seed=1).detrended(), None),
                "yielding": lambda: sealed(a_map(waves=5.0).detrended(), rl.Yielding(1e9)),
                "leaks again": lambda: leaks_again(a_map(waves=5.0).detrended(), 1e9),
            },
        ),
        "joints": Case(PRESSED, {"three maps": lambda: part(some_maps("sharp roll-off"), joint)}),
        "parts": Case(
            ("assessment", "margins", "statistics"),
            {
                "three maps": lambda: part(some_maps("uneven roughness")),
                "maps of two sizes": lambda: part(_of_two_sizes()),
            },
        ),
        "wavy joints": Case(
            ("assessment", "margins", "measurement"),
            {"three maps": lambda: part(some_maps("waviness of 4 maps"), joint)},
        ),
        "line scans": Case(
            ("assessment", "margins", "measurement"),
            {"one": lambda: scanned(a_scan()), "worn": lambda: scanned(a_scan("worn"))},
        ),
        "other line scans": Case(
            ("assessment", "margins"),
            {
                "two": lambda: scanned(a_scan(), against=a_scan(seed=6)),
                "short": lambda: scanned(a_scan(points=64, waves=20.0)),
                "long summits": lambda: scanned(a_scan("lognormal summits")),
            },
        ),
        "maps at limits": Case(
            PRESSED,
            {
                "noise alone": lambda: asked(_noise_like(a_map())),
                "faint noise": lambda: asked(
                    a_map("no roll-off", seed=[2, 7], instrument="noise", hurst=0.9)
                ),
                "points of a rougher surface": lambda: asked(a_map(hurst=0.3, cells=0.0)),
                "nearly all yields": lambda: asked(a_map(), YIELDS, loads=["3.8 kN"]),
                "24 points": lambda: asked(a_map(points=24), grid_error=True),
                "soft": lambda: asked(a_map(), "E=10 MPa nu=0.3, rigid", loads=["2 N"]),
                "steep": lambda: asked(_times(a_map(), 13.0)),
                "a dome without its top": _without_its_top,
                "a far joint": lambda: asked(
                    a_map("no roll-off"), ELASTIC, rl.Joint(1024 * SIDE**2), loads=["5 kN"]
                ),
                "nearly full contact": lambda: asked(
                    a_map(), "E=10 MPa nu=0.3, rigid", loads=["0.1 N", "0.2 N", "0.5 N"]
                ),
            },
        ),
        "parts at limits": Case(
            ("assessment", "margins", "statistics"),
            {
                "rough and smooth": lambda: part(_of_three_heights(), joint),
                "sides that differ": lambda: part(_of_two_sizes(1.07, 1.0), joint),
                "24 points": lambda: part(some_maps("sharp roll-off", points=24)),
            },
        ),
        "seals at limits": Case(
            ("fluid", "margins"),
            {
                "48 points": lambda: sealed(a_map(points=48, waves=5.0).detrended(), None),
                "four waves": lambda: sealed(
                    a_map("sharp roll-off", 96, waves=4.0).detrended(), None
                ),
                "soft": lambda: sealed(a_map(waves=5.0).detrended(), rl.Yielding(1e8)),
                "leaks again, elastic": lambda: leaks_again(a_map(waves=5.0).detrended(), None),
            },
        ),
        "described maps": Case(
            MEASUREMENT,
            {
                each: partial(lambda kind: described(a_map(kind, 128)), each)
                for each in KINDS
                if each not in OTHER_KINDS
            }
            | {
                each: partial(lambda name: described(a_map(points=128, instrument=name)), each)
                for each in INSTRUMENTS
                if each != "missing points"
            }
            | {
                "jumping": lambda: described(_jumping(a_map(points=128))),
                "on a level": lambda: described(_on_a_level(a_map(points=128))),
                "in steps": lambda: described(_in_steps(a_map(points=128))),
                "few points": lambda: described(a_map(points=24)),
                "a tip": lambda: _described_as(
                    a_map(points=128, instrument="stylus tip").heights, tip_radius=5e-6
                ),
                "told pixels": lambda: _described_as(
                    a_map(points=128, instrument="blur of a pixel").heights,
                    pixels="means",
                    blur=0.0,
                ),
            },
        ),
        "faint faults": Case(
            MEASUREMENT,
            {
                "few steps": lambda: described(_in_steps(a_map(points=128), 0.4)),
                "a low level": lambda: described(_on_a_level(a_map(points=128), 0.005)),
                "a low jump": lambda: described(_jumping(a_map(points=128), 0.6)),
                "a slight tilt": lambda: described(_tilted(a_map(points=128), 0.45)),
                "a tilt of many waves": lambda: described(
                    _tilted(a_map(points=128, waves=16.0), 0.28)
                ),
                "a blunt tip": lambda: _described_as(
                    a_map(points=128, instrument="stylus tip").heights, tip_radius=50e-6
                ),
                "many filled": lambda: _described_as(
                    _without_points(a_map(), 0.14), missing=rl.Missing(most=0.3)
                ),
            },
        ),
        "described scans": Case(
            MEASUREMENT,
            {
                each: partial(lambda kind: described(a_scan(kind)), each)
                for each in ("sharp roll-off", "no roll-off", "worn", "turned")
            },
        ),
        "means of curves": Case(
            ("statistics",), {f"{count}": partial(exponent, count) for count in (4, 20)}
        ),
        **({"measured maps": Case(PRESSED, of_files)} if of_files else {}),
    }


def _of_kind(kind):
    return asked(a_map(kind), ELASTIC, rl.Joint(JOINT))


def _of_two_sizes(times=1.04, higher=4.0):
    other = _times(a_map(seed=2), higher)
    return [a_map(), replace(other, sizes=(times * SIDE,) * 2)]


def _of_three_heights():
    maps = some_maps("sharp roll-off")
    return [_times(each, factor) for each, factor in zip(maps, (0.5, 1.0, 2.0), strict=True)]


def _with_missing(*more, summits=False, loads=LOADS):
    """A map as an instrument writes it that does not see all of its points, or its summits."""
    heights = a_map().heights.copy()
    if summits:
        heights[heights > np.quantile(heights, 0.92)] = np.nan
    else:
        heights = INSTRUMENTS["missing points"](heights, 1, np.random.default_rng(0))
    return _of_heights(
        heights, lambda path, of: asked(path, YIELDS, *more, loads=loads, reading=of)
    )


def _without_its_top():
    """A map on a dome whose top was not seen, and is filled about the trend of the rest."""
    heights, x = a_map().heights, np.linspace(-1, 1, 64)
    away = x[:, np.newaxis] ** 2 + x**2
    heights = np.where(away < 0.08, np.nan, heights - 1e-5 * away)

    def ask(path, reading):
        return asked(path, YIELDS, loads=["1 N", "50 N", "200 N"], reading=reading)

    return _of_heights(heights, ask)


def _of_heights(heights, ask, **told):
    """Ask of heights that stand in a file, with what is told of the instrument."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "map.npy"
        np.save(path, heights)
        return ask(path, rl.Reading(unit="m", sizes=(SIDE, SIDE), **told))


def _described_as(heights, **told):
    """Describe a map with what is told of its instrument."""

    def ask(path, reading):
        return described(rl.assess(rl.Question(path, ELASTIC, loads=["1 N"], reading=reading)).body)

    return _of_heights(heights, ask, **told)


def _of_file(path):
    body = rl.prepared(rl.read(path))
    while min(body.shape) > 128:
        body = body.coarsened()
    return asked(body, ELASTIC, loads=["1 MPa"])
