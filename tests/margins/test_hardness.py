"""What the scatter of the hardness is learnt from, and where nothing has to be pressed for it."""

import numpy as np
import pytest

import roughline as rl
from random_cases import seeds
from roughline.contact import grid_error
from roughline.margins import hardness
from roughline.margins.variant import press_all

MARGIN = 1e-12  # rounding, of the same contacts


def polished(seed):
    """A body that yields at summits or nowhere, under a load."""
    rng = np.random.default_rng(seed)
    rms, n = 10 ** rng.uniform(-8.5, -6.8), 32
    q_roll = 2 * np.pi * rng.uniform(2, 6) / 1e-3
    spectrum = rl.SelfAffine(hurst=rng.uniform(0.4, 1), rms_height=rms, length=1e-3, q_roll=q_roll)
    heights = spectrum.surface(n, rng=rng).heights
    body = rl.Surface(heights, (1e-3, 1e-3), "m", is_cut_out=bool(rng.integers(2)))
    return rl.Question(body, "steel,copper", loads=[f"{10 ** rng.uniform(-1, 1):.3g} N"])


@seeds(2, 32)
def test_what_is_not_pressed_changes_no_end(monkeypatch, seeds):
    """Without the largest pressure, each body would be pressed."""
    for seed in seeds:
        question = polished(seed)
        found = rl.assess(question)
        with monkeypatch.context() as patched:
            for room in (hardness, grid_error):
                patched.setattr(room, "is_elastic", lambda *_: False)
            pressed = rl.assess(question)
        assert found.answers.keys() == pressed.answers.keys()
        for key, answer in pressed.answers.items():
            if answer.ends is None:
                assert found.answers[key].ends is None
            else:
                ends = found.answers[key].ends
                np.testing.assert_allclose(ends, answer.ends, rtol=MARGIN, atol=0)


@pytest.mark.parametrize(("rms", "is_told"), [(1e-8, True), (1e-6, False)])
def test_that_the_softest_body_is_not_pressed_is_told(monkeypatch, rms, is_told):
    surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=rms, q_roll=2e4).surface(32, 7)
    body = rl.Surface(surface.heights, surface.sizes, "m", is_cut_out=False)
    names = []

    def listed(variants, *arguments, **named):
        curves = press_all(variants, *arguments, **named)
        nominal = curves.as_asked
        names.extend(
            name for name, each in curves.by_name.items() if each.depth is not nominal.depth
        )
        return curves

    monkeypatch.setattr("roughline.assessment.assess.press_all", listed)
    result = rl.assess(rl.Question(body, "steel,copper", loads="1 N"))
    told = [fact for fact in result.facts if fact.kind == "softest_is_elastic"]
    assert bool(told) is is_told
    assert (hardness.SOFTEST in names) is not is_told
    if told:
        most = float(result.curve.largest_pressure.max())
        assert told[0].numbers["pressure"] == pytest.approx(most)
        assert most < told[0].numbers["hardness"] < result.curve.hardness


def test_a_map_that_does_not_yield_yet_seals_later_if_it_is_harder():
    """The contact under the load is that of any hardness, and where it seals is not."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2e-7, q_roll=2.5e4, q_high=8e4)
    surface = spectrum.surface(32, 7)
    body = rl.Surface(surface.heights, surface.sizes, "m", is_cut_out=True)
    ask = rl.Fluid(closure=True, along="x")
    result = rl.assess(rl.Question(body, "steel,copper", loads="0.02 N", ask=[ask]))
    assert result.curve.plastic_fraction == [0.0]
    answer = result.answers["sealing_pressure"]
    (margin,) = (each for each in answer.margins if each.cause == "hardness")
    assert margin.low < 0.9 * answer.values < 0.95 * margin.high
