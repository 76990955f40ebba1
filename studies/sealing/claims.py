"""What is said of sealing, with verdicts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations

from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Claim, ClaimCase, Range, around
from studies.judged import Found, claim_on, confidence_of_each, spread
from studies.sealing.body import ELASTIC, FULL, LOADS, MOSTLY, PEAKS, WEAK, Case
from studies.sealing.measure import (
    OF_GAPS,
    Data,
    Sample,
    over_theory,
    plastic_factor,
    taken_off,
    tightening,
    until_open,
)
from studies.sealing.run import HARDNESSES, HURSTS, LEAKING
from studies.sealing.scaling import (
    LARGEST,
    PERCOLATION,
    SMALLEST,
    at_sealing,
    hurst_change,
    scaling,
    size_change,
)

SEALING = 0.42
"""Contact area at sealing of elastic bodies in the literature."""
EARLIER = 0.40
"""That of roughline 0.2, of gaps between two ends."""
AREA_TOLERANCE = 0.01
EXPONENT_TOLERANCE = 0.2
FACTOR = 8.0
"""By which plastic flow lowers the leak of a metal seal in the literature."""
WITHIN = 2.0
"""Factor within which leaks agree."""
BELOW, BEYOND = PEAKS[:-1], PEAKS[-1]
"""Largest loads over the sealing pressure below which, and beyond which, bodies were unloaded."""
SAME = 0.001
"""How near the leaks on loading and on unloading must come to be called the same."""
THEORIES = {
    "the critical junction": ("critical-junction", SEALING),
    "Bruggeman's medium, d = 2": ("bruggeman", 0.5),
    f"Bruggeman's medium that seals at {SEALING:g}": ("bruggeman", SEALING),
    "Bruggeman's medium of the gaps found here, d = 2": (OF_GAPS, 0.5),
    f"Bruggeman's medium of these gaps that seals at {SEALING:g}": (OF_GAPS, SEALING),
}
"""Theories by name, with the area at which they seal; the first ones are of Persson's gaps."""
KINDS = {
    ELASTIC: "elastic",
    WEAK: "weakly plastic",
    MOSTLY: "mostly plastic",
    FULL: "fully plastic",
}

_OF_HURSTS = confidence_of_each(len(HURSTS))
_OF_LOADS = confidence_of_each(len(HURSTS) * len(LOADS))
_OF_PEAKS = confidence_of_each(len(HURSTS) * len(BELOW))
_HALF: Range = (0.5, 1.0)


def claims(data: Data) -> list[Claim]:
    """Return all claims with their verdicts."""
    return [
        *(_seals(data, hardness, SEALING) for hardness in (ELASTIC, WEAK)),
        _seals(data, ELASTIC, EARLIER),
        _seals(data, FULL, 0.5),
        *(_is_the_same(data, hardness) for hardness in HARDNESSES),
        _size(data),
        _nears_as_percolation(data),
        *(_leaks_as(data, name) for name in THEORIES),
        *(_plastic_flow_lowers(data, hardness) for hardness in (WEAK, FULL)),
        _elastic_bodies_retrace(data),
        *(_much_may_be_taken_off(data, hardness) for hardness in HARDNESSES),
        _stays_sealed(data),
    ]


_SAID_BY = {
    SEALING: "Dapp and others; Wang and Müser",
    EARLIER: "roughline 0.2, between two ends",
    0.5: "as heights cut at a level",
}


def _seals(data: Data, hardness: float, area: float) -> Claim:
    return claim_on(
        f"{KINDS[hardness].capitalize()} contacts seal at A/A_0 = {area:g} ({_SAID_BY[area]}), to "
        f"±{AREA_TOLERANCE:g}",
        "A/A_0 where endless contacts seal",
        {f"at Hurst {hurst:g}": at_sealing(data, hurst, hardness, _OF_HURSTS) for hurst in HURSTS},
        around(area, AREA_TOLERANCE),
        ".3f",
    )


def _is_the_same(data: Data, hardness: float) -> Claim:
    pairs = list(combinations(HURSTS, 2))
    level = confidence_of_each(len(pairs))
    return claim_on(
        "The area at sealing is the same whatever the Hurst exponent (Dapp and others), to "
        f"±{AREA_TOLERANCE:g}: {KINDS[hardness]}",
        "change of A/A_0 where endless contacts seal",
        {
            f"from {first:g} to {second:g}": hurst_change(data, (first, second), hardness, level)
            for first, second in pairs
        },
        around(0, AREA_TOLERANCE),
        "+.3f",
    )


def _size(data: Data) -> Claim:
    level = confidence_of_each(len(HURSTS) * len(HARDNESSES))
    count = data.sample(LARGEST, HURSTS[0], ELASTIC).count
    return claim_on(
        "The mean area at sealing along a direction does not depend on the size (here), to "
        f"±{AREA_TOLERANCE:g}",
        f"change of A/A_0 from {SMALLEST} to {LARGEST} roll-off waves along a side",
        {
            f"{KINDS[hardness]} at Hurst {hurst:g}": Found.of(
                size_change(data, hurst, hardness, level), count
            )
            for hardness in HARDNESSES
            for hurst in HURSTS
        },
        around(0, AREA_TOLERANCE),
        "+.3f",
        each=False,
    )


def _nears_as_percolation(data: Data) -> Claim:
    level, found = confidence_of_each(len(HURSTS) * len(HARDNESSES)), {}
    for hardness in HARDNESSES:
        for hurst in HURSTS:
            fit = scaling(data, hurst, hardness, free=True)
            where = f"{KINDS[hardness]} at Hurst {hurst:g}"
            found[where] = Found.of(fit.exponent(level), fit.bodies)
    return claim_on(
        f"Finite contacts near this area as in two-dimensional percolation, 1/ν = {PERCOLATION:g}, "
        f"to ±{EXPONENT_TOLERANCE:g}",
        "exponent 1/ν that fits best",
        found,
        around(PERCOLATION, EXPONENT_TOLERANCE),
        ".2f",
        each=False,
    )


def _leaks_as(data: Data, name: str) -> Claim:
    return _of_loads(
        f"Elastic contacts leak as {name} says, to a factor of {WITHIN:g}",
        "leak over that of the theory",
        LOADS,
        lambda hurst, load: over_theory(
            data, THEORIES[name], Case(LEAKING, hurst, ELASTIC), load, _OF_LOADS
        ),
        (1 / WITHIN, WITHIN),
    )


def _plastic_flow_lowers(data: Data, hardness: float) -> Claim:
    return _of_loads(
        f"Plastic flow lowers the leak by a factor of {FACTOR:g} (Fischer and others): "
        f"{KINDS[hardness]}, to a factor of {WITHIN:g}",
        "leak of elastic bodies over that under the same pressure",
        Case(LEAKING, HURSTS[0], hardness).loads,
        lambda hurst, load: plastic_factor(data, LEAKING, hurst, hardness, load, _OF_LOADS),
        (FACTOR / WITHIN, FACTOR * WITHIN),
    )


def _of_loads(
    statement: str,
    what: str,
    loads: Sequence[float],
    found: Callable[[float, float], Found | None],
    allowed: Range,
) -> Claim:
    """Judge a ratio at every load, for all Hurst exponents together, where bodies leak."""
    cases, numbers = [], []
    for load in loads:
        known = [one for hurst in HURSTS if (one := found(hurst, load))]
        if len(known) == len(HURSTS):
            where = f"at p/(E*∇h) = {load:g}"
            cases.append(ClaimCase.together(where, [one.judged(where, allowed) for one in known]))
            numbers += known
    return Claim.of(
        statement,
        f"{what}: {spread((one.value for one in numbers), '.3g')}",
        spread((end for one in numbers for end in (one.low, one.high)), ".3g"),
        cases,
    )


def _elastic_bodies_retrace(data: Data) -> Claim:
    return _of_peaks(
        data,
        f"Unloaded elastic contacts leak as on loading, to {SAME:.1%}",
        "leak on loading over that on unloading, under half of the largest load",
        ELASTIC,
        tightening,
        around(1, SAME),
        ".4f",
    )


def _much_may_be_taken_off(data: Data, hardness: float) -> Claim:
    said_by = "here" if hardness == ELASTIC else "Pérez-Ràfols and others"
    return _of_peaks(
        data,
        "A large part of the load, more than half, may be taken off until ten times as much leaks "
        f"({said_by}): {KINDS[hardness]}",
        "share of the load",
        hardness,
        taken_off,
        _HALF,
        ".2f",
    )


def _of_peaks(
    data: Data,
    statement: str,
    what: str,
    hardness: float,
    number: Callable[[Sample, float, float], IntervalEstimate],
    allowed: Range,
    form: str,
) -> Claim:
    found = {}
    for peak in BELOW:
        for hurst in HURSTS:
            one = data.leaks(LEAKING, hurst, hardness)
            where = f"from {peak:g} of the sealing pressure at Hurst {hurst:g}"
            found[where] = Found.of(number(one, peak, _OF_PEAKS), one.count)
    return claim_on(statement, what, found, allowed, form, each=False)


def _stays_sealed(data: Data) -> Claim:
    found = {}
    for hurst in HURSTS:
        one = data.leaks(LEAKING, hurst, FULL)
        found[f"at Hurst {hurst:g}"] = Found.of(until_open(one, _OF_HURSTS), one.count)
    return claim_on(
        f"Loaded to {BEYOND:g} of the sealing pressure, fully plastic contacts stay sealed until "
        "more than half of the load is off (here)",
        "share of the load",
        found,
        _HALF,
        ".2f",
    )
