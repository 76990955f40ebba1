"""Departures of topographies from Gaussian, isotropic and stationary surfaces with a roll-off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_surfaces import GAUSSIAN, SIDE, Make, parent_of, piece_of
from roughline.measurement.coarser_selves import coarser_selves
from roughline.measurement.departures import departures
from roughline.topography.provenance import Provenance, Tilt


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


def tilted(surface: rl.Surface, slope: float) -> rl.Surface:
    x = np.arange(surface.shape[0])[:, np.newaxis] * surface.spacing[0]
    return rl.Surface(surface.heights + slope * x, surface.sizes, "m", is_cut_out=True)


def test_a_tilt_that_own_waves_do_not_explain_is_told_however_it_was_removed():
    stage = tilted(piece("sharp roll-off", 1), 3e-3)
    for body in (stage, stage.detrended(), stage.detrended().scaled(2.0)):
        assert "longer waves" in broken(body)
    known = replace(stage, provenance=Provenance(tilt=Tilt(is_of_mounting=True)))
    assert broken(known) == set()


def test_heights_that_were_levelled_before_do_not_tell_of_longer_waves():
    level = piece("sharp roll-off", 1).detrended()
    found = departures(rl.Surface(level.heights, level.sizes, "m", is_cut_out=True))
    assert [each.assumption for each in found] == ["longer waves"]
    assert "levelled before" in found[0].text


def test_a_map_that_was_levelled_line_by_line_does_not_tell_of_longer_waves():
    body = rl.Preparation(lines="median").applied(piece("sharp roll-off", 1))
    other = piece("sharp roll-off", 2)
    for each in (body, rl.facing(body, other), rl.facing(other, body)):
        found = {departure.assumption: departure.text for departure in departures(each)}
        assert "was levelled line by line" in found["longer waves"]
    assert "longer waves" not in broken(rl.facing(other, other))


def test_flat_summits_and_steps_of_the_heights_are_told():
    heights = piece("sharp roll-off", 1).heights
    clipped = rl.Surface(np.minimum(heights, np.quantile(heights, 0.9)), (SIDE, SIDE), "m")
    assert "gaussian" in broken(clipped)
    rounded = rl.Surface(np.round(heights / 4e-7) * 4e-7, (SIDE, SIDE), "m")
    assert "resolution" in broken(rounded)
    assert broken(rl.Surface(np.zeros((64, 64)), (SIDE, SIDE), "m", is_cut_out=True)) == set()


def test_a_map_of_four_times_the_area_shows_four_times_the_independent_values():
    """Also beyond the 512 points along a side from which correlations are taken."""
    heights = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_roll=100.0).surface(1024, 3).heights
    small, large = (
        next(coarser_selves(rl.Surface(h, (1.0, 1.0)))) for h in (heights[:512, :512], heights)
    )
    for of_small, of_large in (
        (small.heights_chance, large.heights_chance),
        (small.detail_chance, large.detail_chance),
    ):
        assert of_large.independent(3) == pytest.approx(4 * of_small.independent(3), rel=0.3)


def test_a_reduced_line_departs_from_nothing():
    assert departures(rl.Line(np.arange(64.0) ** 2, SIDE)) == ()


@pytest.mark.parametrize("kind", ["lognormal pits", "ground, 9", "uneven roughness", "no roll-off"])
def test_departures_from_some_assumptions_are_among_all_in_their_order(kind):
    body = piece(kind, 2)
    for some in ({"measured"}, {"isotropic", "roll-off"}, {"stationary", "longer waves"}):
        own = replace(body, heights=body.heights.copy())  # of which nothing is known yet
        assert departures(own, some) == tuple(
            each for each in departures(body) if each.assumption in some
        )
