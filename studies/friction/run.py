"""Press and shear all bodies of the study, and write each down when it is done.

    python -m studies.friction.run FILE [PROCESSES]

goes on where it stopped, as :class:`studies.lines.Run` says. All of it takes about two hours of
one core.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict
from functools import cache

from roughline._version import __version__
from roughline.errors import ConvergenceError
from studies.friction.body import Case, measured
from studies.lines import Run, in_turns, rounded

HURSTS = (0.3, 0.5, 0.8)
FORCE_BARS = (0.1, 0.3, 1.0)
MIDDLE = 0.3
"""F̄ of the bodies of two materials, and of rubber."""
RUBBER = 0.5
"""Poisson's ratio of a pair that does not change its volume."""
RIGID, COUPLED = 2 / 7, 0.3
"""Dundurs' beta of a rigid body on one of Poisson's ratio 0.3, and mu with it, all but equal."""
PAIRS = {(RIGID, COUPLED): 0.3, (RIGID, 0.1): 0.3, (RIGID, 1.0): 0.3, (0.5, 0.525): 0.0}
"""Poisson's ratios by beta and mu; the last has the mu / beta of the first."""
COUNT, FEWER = 30, 15
"""Surfaces that are sheared of each case, and of those of two materials but the first."""
PRESSED = 60
"""Surfaces of one material and of Poisson's ratio 0.3, of which the last are pressed alone."""

Body = tuple[Case, int]
"""A case, and the number of one of its bodies."""

_SECONDS = {0.1: 1.3, 0.3: 2.0, 1.0: 3.0}  # that a body of one material takes, by F̄
_COUPLED_SECONDS, _ALONE_SECONDS = 6.0, 0.15


@cache
def counts() -> dict[Case, int]:
    """How many bodies of each case are sheared."""
    found = dict.fromkeys(one_material(), COUNT)
    found |= {Case(hurst, MIDDLE, RUBBER): COUNT for hurst in HURSTS}
    for i, ((beta, friction), poisson) in enumerate(PAIRS.items()):
        for hurst in HURSTS:
            found[Case(hurst, MIDDLE, poisson, beta, friction)] = FEWER if i else COUNT
    return found


def planned() -> list[Body]:
    """Return all bodies in the order in which they are pressed: the same share of each case.

    Those that are pressed alone, and take little time, come first.
    """
    alone = [(case, COUNT + i) for i in range(PRESSED - COUNT) for case in one_material()]
    return alone + in_turns(counts())


def one_material() -> list[Case]:
    """Return the cases of one material of Poisson's ratio 0.3."""
    return [Case(hurst, force) for hurst in HURSTS for force in FORCE_BARS]


def _seconds(body: Body) -> float:
    case, number = body
    if number >= COUNT:
        return _ALONE_SECONDS
    return _COUPLED_SECONDS if case.is_coupled else _SECONDS[case.force_bar]


def _line(body: Body) -> str:
    """Measure a body, and write its line; nothing is found where it cannot even be pressed."""
    case, number = body
    try:
        found = measured(case, number, is_sheared=number < COUNT)
    except ConvergenceError:
        found = {}
    values = {name: rounded(value) for name, value in found.items()}
    return json.dumps({**asdict(case), "number": number, "version": __version__, **values}) + "\n"


def body_of(line: str) -> Body:
    """Return which body a line is of."""
    content = json.loads(line)
    names = ("hurst", "force_bar", "poisson", "beta", "friction")
    return Case(*(content[name] for name in names)), content["number"]


run = Run(_line, body_of, _seconds)

if __name__ == "__main__":
    run.main(planned(), *sys.argv[1:])
