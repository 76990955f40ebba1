"""Plans whose bodies stick: what their stores keep, and what is refused."""

import numpy as np
import pytest
import zarr

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
    "law": rl.Dugdale(work_of_adhesion=0.2, range=0.4),
}


def planned(**changes):
    table = {key: value for key, value in (TABLE | changes).items() if value is not None}
    return campaign.plan_from({"name": "soft", "seed": 3, "ensemble": [table]})


def test_a_case_is_what_a_press_gives():
    ensemble = planned().ensembles[0]
    case = batches.evaluate_case(ensemble, 2.2, 1)
    body = ensemble.spectrum(2.2).surface(32, ensemble.body_seed(1))
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
    plain = planned(law=None)
    assert "pull_off_force" not in batches.evaluate_case(plain.ensembles[0], 2.2, 0)
    assert "law" not in plain.ensembles[0].identity()
    with pytest.raises(rl.StoreError, match="other settings: its law is"):
        compute(planned(law=rl.Dugdale(0.1, 0.4)), store)


def test_a_store_of_0_3_which_kept_the_numbers_of_the_pull_goes_on(tmp_path):
    store = tmp_path / "store"
    compute(planned(), store)
    group = zarr.open_group(store / "soft")
    law = group.attrs["law"]
    earlier = {"work_bar": law["work_of_adhesion"], "range_bar": law["range"]}
    attributes = {key: each for key, each in group.attrs.items() if key != "law"}
    group.attrs.put({**attributes, **earlier, "attraction": "dugdale"})
    assert compute(planned(), store) == 0
    assert compute(planned(realisations=3), store) == 1
    assert campaign.Store(store).lost("soft") == []
    with pytest.raises(rl.StoreError, match="other settings: its law is"):
        compute(planned(law=rl.Exponential(0.2, 0.4)), store)


def test_several_laws_make_an_ensemble_each():
    laws = [rl.Dugdale(work, 0.4) for work in (0.1, 0.2)]
    assert [(each.name, each.law) for each in planned(law=laws).ensembles] == [
        ("soft-law1", laws[0]),
        ("soft-law2", laws[1]),
    ]


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"law": rl.Dugdale(0.2, 0.18)}, "cells wide, which resolves no pull-off"),
        ({"law": rl.Dugdale(0.2, 0.1)}, "range is too short for the grid"),
        ({"law": rl.JKR(0.2)}, "of a Profile; a Surface sticks by"),
        ({"hardness_bar": 1.0}, "law and hardness_bar are given"),
        ({"model": "reduced", "boundary": None}, "the springs of the reduced model only push"),
        ({"work_of_adhesion": 1.0}, "give law = "),
    ],
)
def test_what_cannot_stick_is_refused(changes, told):
    with pytest.raises(rl.InputError) as refused:
        planned(**changes)
    assert told in str(refused.value)
