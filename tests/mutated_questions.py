"""Questions to the lab of which some parts are not as a page has them, drawn at random."""

import json
from copy import deepcopy

STATES = {
    "explore": {
        **{"n": "64", "D_f": "2.2", "seed": "1", "F": "0.1", "boundary": "periodic", "L": "1 mm"},
    },
    "measured": {
        **{"file": "key", "unit": "m", "size": "1 mm", "first": "steel", "second": "copper"},
        **{"loads": "2 MPa", "grid_error": "no", "boundary": "periodic"},
    },
    "published": {"D_f": "2,2.2", "mean": "arithmetic", "low_1D": "1e-4", "map_F": "0.1"},
}
"""Texts of the controls by view, of questions that are answered; "key" is that of a file."""

SLOW = ("measured.report", "explore.download")
"""Tasks that take seconds."""

_OTHERS = ("of", "which", "name", "model", "row", "map", "presses", "sides", "refines")
_UNUSED = (
    *("hardness_bar", "H", "theories", "rms", "h", "slope", "E", "roll_off", "cutoff", "view", "v"),
    *("t", "E_l", "nu_l", "nu_b", "w", "h0", "fluid", "shown"),
    *("crop", "low_pass", "resample", "hardness", "joint_area", "friction", "frequency", "bodies"),
    *(
        "trend",
        "lines",
        "scars",
        "outliers",
        "fill",
        "most_missing",
        "channel",
        "example",
        "elastic",
    ),
)
_STRANGE = ("__proto__", "session", "crowded", "", "\ud800", "x" * 2000)
_TEXTS = (
    *("0", "-1", "1e-6", "nan", "inf", "1e999", "1e-400", "9" * 2000, "1,5", "1_0", "²", "0x10"),
    *("1 km", "1e400 m", "1e-300 m", "nan Pa", "9e" + 30 * "9" + " N", "1 m**9999", "5 %", "H=x"),
    *("", " ", "\0", "\ud800", "a\nb", "\u202e", "../../etc/passwd", "E=", "E=nan GPa", ";;", ","),
    *("1 m,1 m,1 m,1 m", "steel", "persson", "periodic", "modulus", "slope", "key,key", "python"),
)
_VALUES = (
    *(None, True, 0, -1, 1.5, 10**400, -(10**400), 5e-324, float("nan"), float("inf"), 2**53),
    *([], {}, [[]], [1, 2], [10**400, 1], [1e-320, 1e-320], ["1"], {"__proto__": {"a": []}}),
)


def mutated(chance, state):
    """Return arguments of a question, one to three parts of which are changed, as JSON has them.

    Parameters
    ----------
    chance : random.Random
        Draws.
    state : dict of str to str
        Texts of the controls as they may be.
    """
    arguments = {"state": dict(state)}
    for _ in range(chance.randint(1, 3)):
        value = deepcopy(chance.choice(_TEXTS if chance.random() < 0.6 else _VALUES))
        texts = arguments["state"]
        if chance.random() < 0.75 and isinstance(texts, dict):
            texts[chance.choice((*state, *state, *_UNUSED, *_STRANGE))] = value
        else:
            arguments[chance.choice(("state", *_OTHERS, *_STRANGE))] = value
    return json.loads(json.dumps(arguments))
