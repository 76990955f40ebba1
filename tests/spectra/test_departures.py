"""Departures of topographies from Gaussian, isotropic and stationary surfaces with a roll-off."""

from __future__ import annotations

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_surfaces import GAUSSIAN, SIDE, Make, parent_of, piece_of
from roughline.spectra.departures import departures


def piece(kind: str, seed: int, **make: float) -> rl.Surface:
    made = Make(**{"points": 128, "maps": 4, "hurst": 0.8, "waves": 6.0, **make})
    rng = np.random.default_rng(seed)
    return piece_of(parent_of(kind, made, rng), made, rng)


def broken(body: rl.Surface | rl.Line) -> set[str]:
    return {each.assumption for each in departures(body)}


@pytest.mark.parametrize("kind", GAUSSIAN)
def test_a_gaussian_surface_departs_from_nothing_but_a_roll_off(kind):
    assert broken(piece(kind, 1)) == ({"roll-off"} if kind == "no roll-off" else set())


@pytest.mark.parametrize(
    ("kind", "assumption"),
    [
        ("lognormal summits", "gaussian"),
        ("lognormal pits", "gaussian"),
        ("worn", "gaussian"),
        ("plateau-honed", "gaussian"),
        ("ground, 9", "isotropic"),
        ("uneven roughness", "stationary"),
    ],
)
def test_departures_are_named(kind, assumption):
    found = departures(piece(kind, 2))
    assert assumption in {each.assumption for each in found}
    assert list(found) == sorted(found, key=lambda each: -each.gravity)
    assert all(each.gravity > 1 for each in found)


def test_a_reduced_line_departs_from_nothing():
    assert departures(rl.Line(np.arange(64.0) ** 2, SIDE)) == ()
