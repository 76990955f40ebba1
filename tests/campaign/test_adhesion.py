"""Plans whose bodies stick: what their stores keep, and what is refused."""

import numpy as np
import pytest

import roughline as rl
from campaign.test_hardness import compute
from roughline import campaign
from roughline.campaign import batch as batches

TABLE = {
    "name": "soft",
    "model": "full",
    "fractal_dimensions": [2.2],
    "points": 32,
    "realisations": 2,
    "roll_off_ratios": 2,
    "cutoff_ratio": 8,
    "force_bars": [0.05, 0.5],
    "boundary": "periodic",
    "work_bar": 0.2,
    "range_bar": 0.4,
}


def planned(**changes):
    table = {key: value for key, value in (TABLE | changes).items() if value is not None}
    return campaign.plan_from({"name": "soft", "seed": 3, "ensemble": [table]})


def test_a_case_is_what_a_press_gives():
    ensemble = planned().ensembles[0]
    case = batches.evaluate_case(ensemble, 2.2, 1)
    body = ensemble.spectrum(2.2).surface(32, ensemble.seed_of(1))
    law = rl.Dugdale(work_of_adhesion=0.2, range=0.4)
    curve = rl.press(
        body, E_star=1.0, periodic=True, law=law, forces=[0.05, 0.5, -1.0], throw=False
    )
    np.testing.assert_array_equal(case["stiffness"], curve.stiffness[:2])
    np.testing.assert_array_equal(case["pulling_fraction"], curve.pulling_fraction[:2])
    assert float(case["pull_off_force"]) == pytest.approx(curve.pull_off_force, rel=1e-4)
    assert curve.pull_off_force < 0


def test_a_store_keeps_the_pull_of_bodies_that_stick_alone(tmp_path):
    store = tmp_path / "store"
    compute(planned(), store)
    found = campaign.Store(store).dataset("soft")
    assert (found.pull_off_force < 0).all()
    assert (found.pulling_fraction > 0).all()
    assert "plastic_fraction" not in found
    plain = planned(work_bar=None, range_bar=None)
    assert "pull_off_force" not in batches.evaluate_case(plain.ensembles[0], 2.2, 0)
    assert "work_bar" not in plain.ensembles[0].identity()
    with pytest.raises(rl.StoreError, match="work_bar"):
        compute(planned(work_bar=0.1), store)


def test_several_works_make_an_ensemble_each():
    names = [each.name for each in planned(work_bar=[0.1, 0.2]).ensembles]
    assert names == ["soft-work0.1", "soft-work0.2"]


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"work_bar": 0.0}, "work_bar is 0.0; bodies that stick need a positive"),
        ({"work_bar": float("nan")}, "work_bar is nan"),
        ({"range_bar": None}, "range_bar is None"),
        ({"work_bar": None}, "work_bar is None"),
        ({"range_bar": -1.0}, "range_bar is -1.0"),
        ({"range_bar": 0.1}, "cells wide, which resolves no pull-off"),
        ({"hardness_bar": 1.0}, "bodies that yield cannot stick"),
        ({"model": "reduced", "boundary": None}, "the reduced model cannot stick"),
        ({"attraction": "jkr"}, "attraction"),
        ({"work_of_adhesion": 1.0}, "give work_bar"),
    ],
)
def test_what_cannot_stick_is_refused(changes, told):
    with pytest.raises(rl.InputError) as refused:
        planned(**changes)
    assert told in str(refused.value)
