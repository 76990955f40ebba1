"""What is said of friction, with verdicts."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from roughline.computing.arrays import Real
from roughline.statistics.verdict import Claim, around
from studies.friction.body import CYCLES, SHARES, Case
from studies.friction.measure import Data, Quantity, Sample, mean, over_lines
from studies.friction.run import HURSTS, MIDDLE, PAIRS, RUBBER, one_material
from studies.judged import Found, claim_on, confidence_of_each

SLIP, STIFFNESS, LOOP = 0.005, 0.01, 0.02
"""How near slides, k_t / k_n and loops of one material must come to closed forms."""
COUPLED = 0.05
"""The same of two materials."""
SAME = 0.02
"""How near the slides of two pairs of one mu / beta must come to be called the same."""
REDUCED = 0.1
"""How near reduced lines must come to surfaces."""
WORDS: dict[Quantity, str] = {
    "stiffness": "stiffness",
    "slide": f"slide at {SHARES[-1]:g} μF",
    "loop": "energy of a cycle",
}
"""What is compared with reduced lines, in words."""

Pair = tuple[float, float]


def rubber() -> list[Case]:
    """Return those of one that does not change its volume."""
    return [Case(hurst, MIDDLE, RUBBER) for hurst in HURSTS]


def two_materials(pair: Pair) -> list[Case]:
    """Return the cases of two materials with a beta and a coefficient of friction."""
    beta, friction = pair
    return [Case(hurst, MIDDLE, PAIRS[pair], beta, friction) for hurst in HURSTS]


def ratio(pair: Pair) -> str:
    """Return mu / beta of a pair, as it is written."""
    return f"{pair[1] / pair[0]:.2f}"


def claims(data: Data) -> list[Claim]:
    """Return all claims with their verdicts."""
    return [
        _of(
            data,
            f"k_t/k_n is Mindlin's 2(1 - ν)/(2 - ν), to {STIFFNESS:.0%}",
            "its mean over Mindlin's, less 1",
            one_material() + rubber(),
            Sample.stiffness,
            STIFFNESS,
        ),
        *(
            _of_shares(
                data,
                f"Micro-slip of one material is Jäger's, in the mean to {SLIP:.1%}: ν = {nu}",
                cases,
                SLIP,
            )
            for nu, cases in ((0.3, one_material()), (RUBBER, rubber()))
        ),
        _of_each_body(data),
        _of(
            data,
            f"A cycle of one material dissipates Jäger's loop, in the mean to {LOOP:.0%}",
            "its energy over Jäger's, less 1",
            one_material() + rubber(),
            lambda one, confidence: one.loop(0, confidence),
            LOOP,
        ),
        *(_slip_of_two(data, pair) for pair in PAIRS),
        _ratio_decides(data),
        *(_cycle_of_two(data, *each) for each in (("first", 0), ("third", CYCLES - 1))),
        *(_reduced(data, quantity) for quantity in WORDS),
        *(_as_stiffness(data, quantity) for quantity in ("slide", "loop")),
    ]


def _where(case: Case) -> str:
    of = f", ν = {case.poisson:g}" if case.poisson == RUBBER else ""
    return f"at F̄ = {case.force_bar:g}{of} and Hurst {case.hurst:g}"


def _of(
    data: Data,
    statement: str,
    what: str,
    cases: Iterable[Case],
    number: Callable[[Sample, float], Found],
    tolerance: float,
) -> Claim:
    """Judge that a number of each case is zero, to a tolerance."""
    samples = {_where(case): data.sample(case) for case in cases}
    level = confidence_of_each(len(samples))
    found = {where: number(one, level) for where, one in samples.items()}
    return claim_on(statement, what, found, around(0, tolerance), "+.1%", each=False)


def _of_shares(data: Data, statement: str, cases: list[Case], tolerance: float) -> Claim:
    """Judge that the slides of each case are Jäger's under all shear forces."""
    level = confidence_of_each(len(cases) * len(SHARES))
    found = {
        f"{_where(case)}, Q = {share:g} μF": data.sample(case).slip(i, level)
        for case in cases
        for i, share in enumerate(SHARES)
    }
    what = "slide over Jäger's, less 1"
    return claim_on(statement, what, found, around(0, tolerance), "+.1%", each=False)


def _of_each_body(data: Data) -> Claim:
    def off(one: Sample, confidence: float) -> Found:
        return mean(np.abs(one.off(len(SHARES) - 1)).mean(axis=0), confidence)

    return _of(
        data,
        f"It is so of each body and direction (here), to {SLIP:.1%}",
        f"mean distance of single slides at {SHARES[-1]:g} μF from Jäger's",
        one_material(),
        off,
        SLIP,
    )


def _slip_of_two(data: Data, pair: Pair) -> Claim:
    return _of_pair(
        data,
        f"Micro-slip of two materials is Jäger's, to {COUPLED:.0%}: μ/β = {ratio(pair)}, "
        f"β = {pair[0]:.2g}",
        f"slide at {SHARES[-1]:g} μF over Jäger's, less 1, mean of Hurst exponents",
        pair,
        beside_jaeger,
    )


def beside_jaeger(one: Sample) -> Real:
    """Return the slide of each body at the largest shear force over Jäger's, less 1."""
    return one.values("slides_x")[:, -1] / one.values("jaeger")[:, -1] - 1


def _cycle_of_two(data: Data, name: str, cycle: int) -> Claim:
    first = next(iter(PAIRS))  # of which all cycles are solved
    return _of_pair(
        data,
        f"The {name} cycle of two materials dissipates Jäger's loop, to {COUPLED:.0%}: μ/β = "
        f"{ratio(first)}, β = {first[0]:.2g}",
        "its energy over Jäger's, less 1, mean of Hurst exponents",
        first,
        lambda one: one.values("loops_x")[:, cycle] / one.values("jaeger_loop") - 1,
    )


def _of_pair(
    data: Data, statement: str, what: str, pair: Pair, number: Callable[[Sample], Real]
) -> Claim:
    """Judge that a number of a pair of materials is zero."""
    one = mean(np.array([*data.over_hursts(two_materials(pair), number).values()]))
    return claim_on(statement, what, {"": one}, around(0, COUPLED), "+.1%", each=False)


def _ratio_decides(data: Data) -> Claim:
    """Judge that two pairs of one mu / beta slide alike, beside the same without coupling."""
    first, *_, last = PAIRS
    one, other = (
        data.over_hursts(
            two_materials(pair),
            lambda one: one.values("slides_x")[:, -1] / one.values("alone_slides_x")[:, -1],
        )
        for pair in (first, last)
    )
    found = mean(np.array([other[i] - one[i] for i in one if i in other]))
    return claim_on(
        f"μ/β alone decides by how much coupling adds to micro-slip (here), to {SAME:.0%}",
        f"what it adds at {SHARES[-1]:g} μF and β = {last[0]:.2g} less what it adds at "
        f"{first[0]:.2g}, mean of Hurst exponents",
        {f"at μ/β = {ratio(first)}": found},
        around(0, SAME),
        "+.1%",
        each=False,
    )


def _reduced(data: Data, quantity: Quantity) -> Claim:
    return _of_lines(
        data,
        f"Reduced lines have the {WORDS[quantity]} of their surfaces, to {REDUCED:.0%}",
        "surfaces over lines, less 1",
        quantity,
    )


def _as_stiffness(data: Data, quantity: Quantity) -> Claim:
    """Judge that lines have as much of it too little as their stiffness is too large."""
    return _of_lines(
        data,
        f"The {WORDS[quantity]} of lines is off by as much as 1/k (here), to {REDUCED:.0%}",
        "surfaces over lines, times that of the stiffness, less 1",
        quantity,
        "stiffness",
    )


def _of_lines(data: Data, statement: str, what: str, *quantities: Quantity) -> Claim:
    """Judge that surfaces have what their lines have."""
    level, found = confidence_of_each(len(one_material())), {}
    for case in one_material():
        found[_where(case)] = over_lines(data.pressed(case), *quantities, confidence=level)
    return claim_on(statement, what, found, around(0, REDUCED), "+.1%", each=False)
