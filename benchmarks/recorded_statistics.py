"""What the recorder asks of averages, power laws, the trust map and materials."""

import numpy as np

import roughline as rl

_CURVES = 1 + np.random.default_rng(3).random((12, 20)) / 5
_FORCES = np.geomspace(1e-4, 1, 20)
_LAW = 0.7 * _FORCES**0.55 * _CURVES
_MATERIALS = (
    "steel",
    "E=70 GPa nu=0.33",
    "copper hardness=1.2 GPa",
    "rigid",
    "stel",
    "E=70 nu=0.3",
    "steel colour=3",
    "E=1 GPa E=2 GPa",
    "nu=0.3",
)


def statistics():
    """Give the questions, as (name, function)."""
    yield "average", lambda: rl.average(_LAW)
    yield "average geometric", lambda: rl.average(_LAW, "geometric", 0.8, rng=4)
    yield "power law", lambda: rl.fit_power_law(_FORCES, _LAW, (1e-3, 0.1))
    yield "power law of one", lambda: rl.fit_power_law(_FORCES, _LAW[0], (1e-3, 0.1))
    yield (
        "power law geometric",
        lambda: rl.fit_power_law(_FORCES, _LAW, (1e-3, 0.1), averaging="geometric"),
    )
    yield "power law, no window", lambda: rl.fit_power_law(_FORCES, _LAW, (0.5, 0.6))
    yield "window", lambda: rl.find_window(_FORCES, _LAW)
    yield "trust map", rl.trust_map
    places = [(2.2, 0.1, 1.0), (2.75, 0.03, 3.0), (2.0, 1.0, 2.5)]
    yield (
        "trust map read",
        lambda: [
            {"found": found, "text": str(found), "verdict": found.verdict(0.1)}
            for found in (rl.trust_map().at(*place) for place in places)
        ],
    )
    yield "trust map, outside", lambda: rl.trust_map().at(2.2, 1e-9)
    yield "punches", lambda: [rl.PAPER_PUNCH, rl.EXACT_PUNCH]
    yield "public names", lambda: sorted(rl.__all__)
    yield "status", lambda: {each.name: [int(each), each.reason] for each in rl.Status}
    for name in _MATERIALS:
        yield f"material {name}", lambda name=name: rl.material(name)
    yield "contact modulus", lambda: rl.contact_modulus(rl.material("steel"), rl.material("pmma"))
