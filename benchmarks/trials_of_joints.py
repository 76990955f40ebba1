"""How often maps tell of the part that they are of, and of a joint as large."""

import math
from functools import partial
from zlib import crc32

import numpy as np
from made_surfaces import GAUSSIAN, KINDS, Make, parent_of, piece_of
from trials import (
    COLUMNS,
    E_STAR,
    WANTED,
    Study,
    as_surface,
    hardness_of,
    make_of,
    pressures_of,
    row,
    seen,
)

import roughline as rl
from roughline.contact.pieces import cut
from roughline.margins.place import spread_of_differences
from roughline.margins.spread import Values
from roughline.margins.tiles import TiledCurves, coarsened
from roughline.question.assumptions import broken
from roughline.question.extrapolation import Extrapolation, roll_offs_along_a_side

MATERIALS = "E=200 GPa nu=0.3 resistivity=1e-7 ohm m, E=200 GPa nu=0.3 resistivity=1e-7 ohm m"
COUNTS = (2, 3, 5, 10)
DRAWS = 12
LOADS = (0.002, 0.01, 0.05, 0.2, 0.5, 0.8)  # contact area fractions of the tiled maps, about
OPEN = (0.01, 0.1, 0.2, 0.3, 0.36)  # up to near sealing
MAPS = 3  # of each parent
SEALED_FROM = (0.05, 0.15, 0.3, 0.42)  # contact from which loads are taken off, about
MOST_POINTS = 600  # along a side of a measured map


def pressed(surface, pressures, **given):
    """Press a periodic surface, whatever becomes of its loads."""
    forces = pressures * surface.area
    return rl.press(surface, E_star=E_STAR, forces=forces, periodic=True, throw=False, **given)


def asked(surface, pressures, joint, *more, **given):
    loads, ask = [f"{each:.9g} Pa" for each in pressures], [rl.Joint(joint)] if joint else []
    return rl.Question(surface, MATERIALS, ask=[*ask, *more], loads=loads, fields=False, **given)


def larger_rows(kind, option, seed):
    """Maps of a part, asked for its joint, and the whole part in the full model."""
    bar = None if option == "elastic" else 0.2
    make, rng = make_of("larger", kind, seed)
    parent = parent_of(kind, make, rng)
    pressures, given = pressures_of(parent, bar), hardness_of(parent, bar)
    truth = pressed(parent, pressures, **given)
    truths = {
        "interface_stiffness": truth.unloading_stiffness,
        "contact_area_fraction": truth.area_fraction_corrected,
    }
    for _ in range(MAPS):
        piece = seen("larger", piece_of(parent, make, rng), "pixel means", rng)
        result = rl.assess(asked(piece, pressures, parent.area, elastic=bar is None, **given))
        yield from answered(result, truths, lambda answer: answer.values)


def answered(result, truths, value_of, name="{}", loads=WANTED):
    """The intervals of some answers at all loads, and what is true."""
    said = "; ".join(result.warnings)
    for key, truth in truths.items():
        answer = result.answers[key]
        none = [math.nan] * len(loads)
        ends = [none if each is None else each for each in (answer.low, answer.high)]
        for load, *each in zip(loads, truth, value_of(answer), *ends, strict=True):
            yield row(name.format(key), load, *each, said)


def leak_rows(kind, option, seed):
    """Maps of a part and what flows through their gap, and what flows through the whole part's."""
    bar = None if option == "elastic" else 0.2
    make, rng = make_of("leak", kind, seed)
    parent = parent_of(kind, make, rng)
    pressures, given = pressures_of(parent, bar, OPEN), hardness_of(parent, bar)
    measures = [rl.hydraulic_aperture("x"), rl.hydraulic_aperture("y"), rl.MEAN_GAP]
    truth = pressed(parent, pressures, measures=measures, **given)
    truths = {name: each.values for name, each in truth.measured.items()}
    for _ in range(MAPS):
        question = asked(
            piece_of(parent, make, rng),
            pressures,
            parent.area,
            rl.Fluid("water"),
            elastic=bar is None,
            grid_error=True,
            **given,
        )
        result = rl.assess(question)
        yield from answered(result, truths, lambda answer: answer.values, loads=OPEN)


def part_rows(kind, option, seed):
    """Some maps of a part: of the joint the whole part, of maps alone the mean over all places."""
    make, rng = make_of("part", kind, seed)
    parent = parent_of(kind, make, rng)
    pressures, one = pressures_of(parent), piece_of(parent, make, rng)
    pieces = pieces_of(parent, make)
    given = {"E_star": E_STAR, "forces": pressures * one.area, "throw": False}
    alone = [np.log(rl.press(each, **given).stiffness) for each in pieces]
    whole = pressed(parent, pressures)
    maps = [seen("part", each, "pixel means", rng) for each in pieces]
    truths = {"interface_stiffness": whole.unloading_stiffness}
    yield from drawn(maps, pressures, parent.area, truths, rng)
    yield from drawn(maps, pressures, None, {"contact_stiffness": np.exp(np.mean(alone, 0))}, rng)


def mine_rows(kind, option, seed):
    """Some maps of a part as it is made, for a joint as large, and the whole part."""
    make, rng = make_of("mine", kind, seed)
    part = parent_of(kind, make, rng)
    whole = pressed(part, pressures_of(part))
    truths = {
        "interface_stiffness": whole.stiffness,
        "contact_area_fraction": whole.area_fraction_corrected,
    }
    return drawn(pieces_of(part, make), pressures_of(part), part.area, truths, rng)


def pieces_of(parent, make):
    side, count = make.points, make.maps
    places = [(i * side, j * side) for i in range(count) for j in range(count)]
    one = parent.cropped((0, side), (0, side))
    return [as_surface(parent.heights[i : i + side, j : j + side], one) for i, j in places]


def drawn(maps, pressures, joint, truths, rng):
    """What some maps at a time say together, drawn again and again."""
    questions = [asked(each, pressures, joint, elastic=True, grid_error=True) for each in maps]
    stored = {id(question): rl.assess(question) for question in questions}
    for count in COUNTS:
        for _ in range(DRAWS):
            some = [questions[i] for i in rng.permutation(len(questions))[:count]]
            part = rl.assess_part(some, answer=lambda question: stored[id(question)])
            name = f"{{}} of {count} maps"
            yield from answered(part, truths, lambda answer: answer.mean, name)


def seal_rows(kind, option, seed):
    """Where maps of a part seal, and leak again under one of some loads, and where the part does.

    What never leaks ten times as much, neither the map nor the part, is left out.
    """
    make, rng = make_of("seal", kind, seed)
    parent = parent_of(kind, make, rng)
    bar = None if option == "elastic" else 0.2
    given = {"E_star": E_STAR, "periodic": True, **hardness_of(parent, bar)}
    load = float(rng.choice(SEALED_FROM))
    (pressure,) = pressures_of(parent, bar, np.array([load]))

    def found(surface, **more):
        pressed = rl.press(surface, forces=[pressure * surface.area], **given)
        leaks = rl.reopening(pressed, rtol=0.02, **more)
        asked = {"half_space": pressed.half_space, "law": pressed.law, "rtol": 0.02, **more}
        return rl.sealing_pressure(surface, **asked), leaks

    truths = found(parent, interval=False)
    for _ in range(MAPS):
        piece = piece_of(parent, make, rng).detrended()
        for name, truth, of_map in zip(
            ("p_s", "F_10/F"), truths, found(piece, interval=True), strict=True
        ):
            if truth.value or of_map.value:
                yield row(name, load, truth.value, of_map.value, *of_map.interval)


def tiled_rows(kind, option, seed):
    """Maps for a joint as large as their parent, by their tiles; the error of the grid is left out.

    The maps of a measured one are its quarters.
    """
    if kind.startswith("quarters"):
        whole = rl.prepared(rl.read(kind.removeprefix("quarters of ")))
        while min(whole.shape) > MOST_POINTS:
            whole = whole.cropped(*((0, n - n % 2) for n in whole.shape)).coarsened()
        halves = [[(0, n // 2), (n // 2, n)] for n in whole.shape]
        maps = [whole.cropped(x, y) for x in halves[0] for y in halves[1]]
    else:
        rng = np.random.default_rng([crc32(kind.encode()), seed])
        points, sides = (64, 8) if seed % 5 == 4 else (96 if seed % 2 else 64, 4)
        hurst, waves = rng.uniform(0.2, 1.0), rng.uniform(3, 12)
        make = Make(points, sides, hurst, waves, rng.choice([2.0, 4.0, 6.0]))
        whole = parent_of(kind, make, rng)
        maps = [piece_of(whole, make, rng) for _ in range(MAPS)]
    bar = None if option == "elastic" else 0.15
    pressures, given = pressures_of(whole, bar, LOADS), hardness_of(whole, bar)
    truth = pressed(whole, pressures, **given)
    for piece in maps:
        for each in _of_tiles(piece, whole, truth, partial(pressed, pressures=pressures, **given)):
            yield each if kind in GAUSSIAN else each | {"size": None}


def _of_tiles(piece, whole, truth, press):
    """Intervals of one map for a joint as large as the whole; none if an assumption is broken."""
    level = piece.detrended()
    curve = press(level)
    beyond = Extrapolation.of(roll_offs_along_a_side(piece), piece.area, whole.area)
    k, area = curve.unloading_stiffness, curve.area_fraction_corrected
    coarse = coarsened(level)
    sizes = [coarse], cut(coarse, 2), cut(coarse, 4)
    (of_map,), *pressed_tiles = ([press(each, rtol=1e-4) for each in some] for some in sizes)
    tiled = TiledCurves(of_map, *pressed_tiles, coarse.heights.size)
    of_tiles = [each.extrapolated(beyond) for each in tiled.stiffness_and_contact()]
    open_to = spread_of_differences(Values.of(curve), *of_tiles, {}, {})
    told = {
        "k_i": (truth.unloading_stiffness / whole.area, k / piece.area),
        "A": (truth.area_fraction_corrected, area),
    }
    ends = {"k_i": np.array(open_to.unloading) / piece.area, "A": np.array(open_to.area)}
    said = ", ".join(each.assumption for each in broken("larger surface", piece))
    maps = round(math.sqrt(whole.area / piece.area))
    size = f"Gaussian, {maps} a side, roll-off {'seen' if beyond.roll_offs else 'not seen'}"
    for i in np.flatnonzero(curve.resolved & np.isfinite(truth.unloading_stiffness)):
        for quantity, (true, value) in told.items():
            low, high = ends[quantity][:, i] if not said else (math.nan, math.nan)
            yield row(quantity, LOADS[i], true[i], value[i], low, high, said, size=size)


LARGER = Study(
    larger_rows,
    "The larger surface behind one map",
    "A map of 128 x 128 pixels that are means, with its own tilt, is asked for a joint of 4 x 4 "
    "maps. The truth is the whole joint on 1024 x 1024 points.",
    tuple(KINDS),
    ("elastic", "yielding"),
)
LEAK = Study(
    leak_rows,
    "What flows through a part, from one map",
    "Maps of 96 x 96 pixels, each with its own tilt, are asked for a joint of 4 x 4 maps and a "
    "fluid in its gap. The truth is the whole part as it repeats, on the grid of its maps: "
    "hydraulic apertures both ways, zero where it is sealed, and the mean gap. Loads are contact "
    "area fractions, about.",
    tuple(KINDS),
    ("elastic", "yielding"),
    groups=("load", "kind"),
)
PART = Study(
    part_rows,
    "A part, from several maps",
    "Maps of 96 x 96 pixels that are means, drawn from the 25 of a part. The truth of a joint is "
    "the whole part on 960 x 960 points, that of a map's own stiffness is the mean over all 25 "
    "places, on 192 x 192 points each.",
    tuple(KINDS),
)
MINE = Study(
    mine_rows,
    "A part as it is made, from several maps",
    "Maps of 64 x 64 points that keep their tilt, drawn from the 25 of a part; the truth is the "
    "whole part. The last column says how often the maps do not agree.",
    tuple(KINDS),
    columns=(*COLUMNS, "disagree"),
)
SEAL = Study(
    seal_rows,
    "The seal behind one map",
    "A map of 64 x 64 pixels, without its tilt, is asked at which pressure it seals, and which "
    "share of a load is left when ten times as much leaks. The truth is the part, three maps a "
    "side, on the same pixels.",
    tuple(KINDS),
    ("elastic", "yielding"),
    groups=("kind", "option", "load"),
)
TILED = Study(
    tiled_rows,
    "The larger surface behind a map, by its tiles",
    "Parents are four or eight maps long, and on the grid of their maps.",
    tuple(KINDS),
    ("elastic", "yielding"),
    seeds=5,
    groups=("kind", "load", "size"),
)
