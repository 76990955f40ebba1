"""Ensembles with a hardness: what a plan may say, what is kept, and that elastic stores stay."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

import roughline as rl
from roughline import campaign
from roughline.campaign import batch as batches
from roughline.campaign.export import export
from roughline.campaign.layout import VARIABLES
from roughline.campaign.writer import writing
from small_campaign import tree

TABLE = {
    "name": "metal",
    "model": "full",
    "fractal_dimensions": 2.2,
    "points": 32,
    "cutoff_ratio": 4,
    "realisations": 2,
    "boundary": "periodic",
    "force_bars": [0.1, 1.0, 1000.0],
    "hardness_bar": [float("inf"), 0.3],
}
OF_YIELDING = {name for name, each in VARIABLES.items() if "dents" in each.memories}


def plan_of(**changes):
    table = {"force_bars": [0.1, 1.0]} if "hardness_bar" not in changes else {}
    content = TABLE | table | changes
    return campaign.plan_from({"name": "hardness", "seed": 3, "ensemble": [content]})


def compute(plan, path):
    """Compute what a store lacks, in this process; the number of batches."""
    with writing(path, plan) as writer:
        lacking = [batch for ensemble in plan.ensembles for batch in writer.missing(ensemble)]
        for batch in lacking:
            writer.put(batch, batches.evaluate(batch, 1, rl.__version__))
    return len(lacking)


@pytest.fixture(scope="module")
def plan():
    return plan_of()


@pytest.fixture(scope="module")
def store(plan, tmp_path_factory):
    path = tmp_path_factory.mktemp("hardness") / "store"
    assert compute(plan, path) == 2
    return path


def test_several_hardnesses_make_several_ensembles():
    plan = plan_of(points=[32, 64], hardness_bar=[float("inf"), 1, 0.3], force_bars=0.1)
    assert [(each.name, each.hardness_bar) for each in plan.ensembles] == [
        *(
            ("metal-n32-elastic", None),
            ("metal-n32-hardness1", 1.0),
            ("metal-n32-hardness0.3", 0.3),
        ),
        *(
            ("metal-n64-elastic", None),
            ("metal-n64-hardness1", 1.0),
            ("metal-n64-hardness0.3", 0.3),
        ),
    ]
    assert plan_of(hardness_bar=0.3, force_bars=0.1).ensembles[0].name == "metal"


def test_elastic_bodies_are_known_by_the_settings_that_they_always_had():
    elastic = plan_of(hardness_bar=float("inf")).ensembles[0]
    assert set(elastic.identity()) == {
        *("model", "n", "force_bars", "seed", "boundary", "roll_off_ratio", "cutoff_ratio")
    }
    assert replace(elastic, hardness_bar=200.0).identity()["hardness_bar"] == 200.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"hardness_bar": 0}, "hardness_bar is 0.0; a positive H / (E* times the rms slope)"),
        ({"hardness_bar": -1}, "hardness_bar is -1.0; a positive"),
        ({"hardness_bar": float("-inf")}, "hardness_bar is -inf; a positive"),
        ({"hardness_bar": float("nan")}, "hardness_bar is nan; a positive"),
        ({"hardness_bar": "2 GPa"}, 'hardness_bar is "2 GPa"; a number is needed'),
        ({"hardness_bars": 0.3}, "'hardness_bars' is not known; did you mean 'hardness_bar'?"),
        (
            {"hardness_bar": 0.3, "model": "reduced", "boundary": "none"},
            "hardness_bar is 0.3, and the reduced model has no yield: leave it out, or take model",
        ),
        (
            {"hardness_bar": 0.3},
            "force_bar 1000 at fractal dimension 2.2: bodies with hardness_bar",
        ),
        (
            {"force_bars": [1.0, 2.0, 1.0], "hardness_bar": 1},
            "and 1 came after 2: sort them; a plan without friction has no loading histories",
        ),
    ],
)
def test_what_cannot_be_is_said_in_one_line(changes, message):
    with pytest.raises(rl.InputError) as caught:
        plan_of(**changes)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_load_beyond_the_hardness_is_refused_before_anything_is_computed():
    """At the refused load and a little less: differences on the grid know less slope than waves."""
    ensemble = plan_of(hardness_bar=0.3, force_bars=0.1).ensembles[0]
    surface = ensemble.spectrum(2.2).surface(32, ensemble.body_seed(0))
    bears = 0.3 * surface.rms_slope
    with pytest.raises(rl.InputError, match="bear less than H A_0"):
        replace(ensemble, force_bars=(1.1 * bears,))
    replace(ensemble, force_bars=(0.99 * bears,))


def test_a_body_that_bears_less_fails_with_its_reason(tmp_path):
    """Where only the body itself tells, its case fails, and the loads that it bears are asked."""
    ensemble = plan_of(hardness_bar=0.3, force_bars=0.1).ensembles[0]
    surface = ensemble.spectrum(2.2).surface(32, ensemble.body_seed(0))
    plan = campaign.Plan("n", (replace(ensemble, force_bars=(0.3001 * surface.rms_slope,)),))
    compute(plan, tmp_path / "store")
    failures = campaign.Store(tmp_path / "store").failures("metal")
    assert "bears less than H A_0" in failures["D_f 2.2, realisation 0"]


def test_a_case_is_what_the_library_gives(plan, store):
    data = campaign.Store(store).dataset("metal-hardness0.3").sel(fractal_dimension=2.2)
    ensemble = plan.ensemble("metal-hardness0.3")
    surface = ensemble.spectrum(2.2).surface(32, ensemble.body_seed(1))
    curve = rl.press(
        surface,
        E_star=1.0,
        forces=ensemble.force_bars,
        hardness=0.3 * surface.rms_slope,
        periodic=True,
    )
    one = data.sel(realisation=1)
    assert set(data.data_vars) > OF_YIELDING
    for name in (*OF_YIELDING, "stiffness", "area_fraction_corrected"):
        assert (one[name].values == getattr(curve, name)).all()
    assert (one.unloading_stiffness.values > one.stiffness.values).all()
    assert data.attrs["hardness_bar"] == 0.3


def test_elastic_bodies_are_stored_as_if_there_were_no_hardness(plan, store, tmp_path):
    alone = replace(plan, ensembles=(plan.ensemble("metal-elastic"),))
    content = {key: value for key, value in TABLE.items() if key != "hardness_bar"}
    content |= {"name": "metal-elastic", "force_bars": [0.1, 1.0]}
    without = campaign.plan_from({"name": "hardness", "seed": 3, "ensemble": [content]})
    assert without == alone
    compute(without, tmp_path / "store")
    elastic = {
        name: content for name, content in tree(store).items() if name.startswith("metal-elastic/")
    }
    assert elastic.items() <= tree(tmp_path / "store").items()
    assert not OF_YIELDING & set(campaign.Store(store).dataset("metal-elastic"))


def test_nothing_is_computed_twice_and_what_is_damaged_is(plan, store):
    before = tree(store)
    assert compute(plan, store) == 0
    chunk = next(path for path in (store / "metal-hardness0.3" / "work" / "c").rglob("0"))
    while chunk.is_dir():
        chunk = chunk / "0"
    chunk.write_bytes(chunk.read_bytes()[:-3])
    assert compute(plan, store) == 1
    assert tree(store) == before


def test_another_hardness_is_another_ensemble(plan, store):
    metal, elastic = plan.ensemble("metal-hardness0.3"), plan.ensemble("metal-elastic")
    for other, message in (
        (replace(metal, hardness_bar=0.2), "its hardness_bar is 0.3, the plan's is 0.2"),
        (replace(metal, hardness_bar=None), "its hardness_bar is 0.3, the plan's is None"),
        (replace(elastic, hardness_bar=0.3), "its hardness_bar is None, the plan's is 0.3"),
    ):
        with pytest.raises(rl.StoreError, match=message):
            compute(replace(plan, ensembles=(other,)), store)


def test_tables_of_means_have_what_yields(store, tmp_path):
    export(campaign.Store(store), tmp_path, ["csv"])
    elastic, metal = (
        pd.read_csv(tmp_path / f"metal-{name}_mean.csv") for name in ("elastic", "hardness0.3")
    )
    assert {f"{name}_mean" for name in OF_YIELDING} <= set(metal) - set(elastic)
    data = campaign.Store(store).dataset("metal-hardness0.3")
    mean = data.plastic_fraction.mean("realisation").values.ravel()
    assert metal.plastic_fraction_mean.values == pytest.approx(mean)
    assert set(pd.read_csv(tmp_path / "metal-hardness0.3.csv")) > OF_YIELDING


def test_full_contact_is_done_once(tmp_path):
    """A periodic surface in full contact is infinitely stiff, which is no value that is missing."""
    plan = plan_of(hardness_bar=float("inf"))
    assert compute(plan, tmp_path / "store") == 1
    data = campaign.Store(tmp_path / "store").dataset("metal")
    assert np.isinf(data.stiffness.values[..., -1]).all()
    assert compute(plan, tmp_path / "store") == 0
    export(campaign.Store(tmp_path / "store"), tmp_path, ["csv"])
    assert (pd.read_csv(tmp_path / "metal_mean.csv").realisations_converged == 2).all()
