"""Plans whose bodies are pressed and sheared: what their stores keep, and what is refused."""

import hashlib

import numpy as np
import pytest

import roughline as rl
from campaign.test_hardness import compute
from roughline import campaign
from roughline.campaign import batch as batches

BODY = {"name": "Homogeneous", "E_star": 1.0, "poisson": 0.3}
TABLE = {
    "name": "rubbing",
    "model": "full",
    "fractal_dimensions": [2.2],
    "points": 16,
    "realisations": 2,
    "roll_off_ratios": 2,
    "cutoff_ratio": 8,
    "force_bars": [0.1, 0.5, 0.5, 0.3],  # a path
    "half_space": BODY,
    "friction": 0.3,
    "shear_bars": [0.0, 0.1, -0.1, 0.02],
}


def planned(**changes):
    table = {key: value for key, value in (TABLE | changes).items() if value is not None}
    return campaign.plan_from({"name": "rubbing", "seed": 3, "ensemble": [table]})


@pytest.mark.parametrize("beta", [0.0, 0.2])
def test_a_case_is_what_a_press_gives(beta):
    ensemble = planned(half_space=BODY | {"beta": beta}).ensembles[0]
    case = batches.evaluate_case(ensemble, 2.2, 1)
    curve = rl.press(
        ensemble.spectrum(2.2).surface(16, ensemble.body_seed(1)),
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=beta),
        friction=rl.Friction(0.3),
        forces=TABLE["force_bars"],
        shear_forces=TABLE["shear_bars"],
    )
    for name, value in {
        "depth": curve.depth,
        "slide": curve.slide[:, 0],
        "shear_stiffness": curve.shear_stiffness[:, 0, 0],
        "shear_stiffness_back": curve.shear_stiffness_back[:, 0, 0],
        "stick_fraction": curve.stick_fraction,
        "dissipated": curve.dissipated,
    }.items():
        np.testing.assert_array_equal(case[name], value)
    assert (case["dissipated"][1:] > 0).all()


def files(store):
    """Digests of all files of a store."""
    return {
        path.relative_to(store).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(store.rglob("*"))
        if path.is_file()
    }


def test_a_store_keeps_the_slides_with_the_settings_and_goes_on_to_the_same_bytes(tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    assert compute(planned(realisations=1), first) == 1
    assert compute(planned(), first) == 1  # the other one alone
    assert compute(planned(), first) == 0
    found = campaign.Store(first).dataset("rubbing")
    assert found.slide.shape == (1, 2, 4)
    assert found.shear_bar.values.tolist() == TABLE["shear_bars"]
    assert found.shear_bar.dims == ("force_bar",)
    assert '"coefficient": 0.3' in found.attrs["friction"]
    table = campaign.export.mean_table(found)
    assert table.shear_bar.tolist() == TABLE["shear_bars"]
    assert table.slide_mean.to_numpy() == pytest.approx(found.slide.mean("realisation").values[0])
    compute(planned(), second)
    assert campaign.Store(second).dataset("rubbing").equals(found)
    with pytest.raises(rl.StoreError, match="other settings: its friction is"):
        compute(planned(friction=0.4), first)
    with pytest.raises(rl.StoreError, match="other settings: its shear_bars"):
        compute(planned(shear_bars=[0.0, 0.1, -0.1, 0.03]), first)


def test_a_store_has_the_same_bytes_whatever_the_workers(tmp_path):
    stores = [tmp_path / "one", tmp_path / "two"]
    for store, workers in zip(stores, (1, 2), strict=True):
        campaign.run(planned(realisations=4), store, workers=workers)
    assert files(stores[0]) == files(stores[1])


def test_coupled_bodies_of_a_plan_may_yield():
    body = rl.Homogeneous(1.0, True, poisson=0.3, beta=0.2)
    changes = {"hardness_bar": 1.0, "half_space": body}
    found = batches.evaluate_case(planned(**changes).ensembles[0], 2.2, 0)
    assert np.isfinite(found["slide"]).all()
    assert (found["plastic_fraction"] > 0).any()


def test_without_friction_nothing_is_said_of_it():
    plain = planned(friction=None, shear_bars=None, force_bars=[0.1, 0.5]).ensembles[0]
    assert not {"friction", "shear_bars"} & plain.identity().keys()
    assert "slide" not in batches.evaluate_case(plain, 2.2, 0)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"friction": None, "force_bars": [0.1, 0.5, 0.6, 0.7]}, "without friction"),
        ({"shear_bars": None}, "friction is given without shear_bars"),
        ({"shear_bars": [0.0, 0.1]}, "shear_bars are 2 and force_bars are 4"),
        ({"shear_bars": [0.0, 0.1, -0.1, 0.2]}, "friction bears less than mu F = 0.09"),
        ({"shear_bars": [0.0, 0.1, float("nan"), 0.0]}, "friction bears less than mu F"),
        ({"half_space": None}, "Poisson"),
        ({"model": "reduced", "half_space": None}, "a plan has it of surfaces"),
        (
            {"force_bars": [0.1, 50.0, 0.5, 0.3], "hardness_bar": 1.0},
            "force_bar 50 at fractal dimension 2.2: bodies with hardness_bar 1 bear less than",
        ),
        ({"friction": -0.3}, "above 0 and up to 5"),
        ({"friction": "much"}, "friction"),
        ({"force_bars": [0.1, 0.5, 0.0, 0.3]}, "positive, finite"),
        ({"shear": [0.0]}, "give shear_bars, Q / (E* h L)"),
        ({"mu": 0.3}, "give friction = 0.3"),
    ],
)
def test_what_cannot_be_sheared_is_refused_in_one_line(changes, told):
    with pytest.raises(rl.InputError) as refused:
        planned(**changes)
    assert told in str(refused.value)
    assert "\n" not in str(refused.value)
