"""What a study keeps of its store: the same bytes from any run, and refusals in one line."""

import json
import shutil

import numpy as np
import pytest

import roughline as rl
import small_campaign
from dask_processes import cluster_here
from roughline import campaign
from studies.__main__ import main
from studies.reduced_data import finished, read_groups, write_groups

KEPT = ("stiffness", "area_fraction", "status")


def plan_of(tmp_path, text):
    path = tmp_path / "plan.toml"
    path.write_text(text, encoding="utf-8")
    return campaign.read_plan(path)


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    return plan_of(tmp_path_factory.mktemp("plan"), small_campaign.FEW)


@pytest.fixture(scope="module")
def store(plan, two_workers, tmp_path_factory):
    path = tmp_path_factory.mktemp("store") / "few.zarr"
    campaign.run(plan, path, scheduler=two_workers)
    return path


@pytest.fixture
def data(plan, store, tmp_path):
    path = tmp_path / "data.nc"
    write_groups(path, plan, campaign.Store(store), KEPT)
    return path


def test_data_are_those_of_the_store(plan, store, data):
    read = read_groups(data, plan)
    assert set(read) == {"lines", "surfaces"}
    for name, one in read.items():
        stored = campaign.Store(store).dataset(name)
        for variable in one.data_vars:
            assert one[variable].dtype != np.float32
            assert one[variable].values == pytest.approx(stored[variable].values, rel=1e-7)
    assert "area_fraction" not in read["lines"]


def test_a_second_run_on_a_part_of_the_realisations_gives_the_same_bytes(
    plan, store, data, tmp_path
):
    """Other workers, other realisations in the store; the part that both have is the same."""
    few = plan_of(tmp_path, small_campaign.FEW.replace("realisations = 4", "realisations = 3"))
    with cluster_here(n_workers=1, threads_per_worker=1) as cluster:
        campaign.run(few, tmp_path / "part.zarr", scheduler=cluster.scheduler_address)
    files = []
    for name, source in (("again", tmp_path / "part.zarr"), ("whole", store)):
        files.append(tmp_path / f"{name}.nc")
        write_groups(files[-1], few, campaign.Store(source), KEPT)
    assert files[0].read_bytes() == files[1].read_bytes()
    whole, again = read_groups(data, plan), read_groups(files[0], few)
    three = whole["surfaces"].stiffness.values[:, :3]
    assert (again["surfaces"].stiffness.values == three).all()


def test_a_store_that_is_half_there_is_refused(plan, store, tmp_path):
    text = small_campaign.FEW.replace("realisations = 4", "realisations = 9")
    more = plan_of(tmp_path, text)
    message = "15 of 27 cases of 'surfaces' are not done, 0 have failed; run the campaign again"
    with pytest.raises(rl.StoreError, match=message):
        write_groups(tmp_path / "data.nc", more, campaign.Store(store), KEPT)
    assert not list(tmp_path.glob("data.*"))  # nothing half there is left


def test_a_store_of_other_settings_is_refused_with_the_difference(store, tmp_path):
    other = plan_of(tmp_path, small_campaign.FEW.replace("points = 64", "points = 128"))
    with pytest.raises(rl.StoreError, match="'surfaces' has n = 64, the plan has 128"):
        finished(campaign.Store(store), other.ensemble("surfaces"))


def test_a_damaged_store_and_one_of_another_version_are_refused(plan, store, tmp_path):
    damaged = tmp_path / "damaged.zarr"
    shutil.copytree(store, damaged)
    chunk = next(each for each in (damaged / "surfaces" / "stiffness").rglob("c/*/*/*"))
    chunk.write_bytes(chunk.read_bytes()[:-7] + b"nothing")
    with pytest.raises(rl.StoreError, match="lost or damaged on disk: .* computes them"):
        write_groups(tmp_path / "data.nc", plan, campaign.Store(damaged), KEPT)
    older = tmp_path / "older.zarr"
    shutil.copytree(store, older)
    root = older / "zarr.json"
    content = json.loads(root.read_text())
    content["attributes"]["roughline_version"] = "0.0.9"
    root.write_text(json.dumps(content))
    with pytest.raises(rl.StoreError, match=r"made by roughline 0\.0\.9"):
        campaign.Store(older)


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("points = 64", "points = 128", "'surfaces' has n = 64, the plan has 128"),
        ("seed = 5", "seed = 6", "'lines' has seed = 5, the plan has 6"),
        ("realisations = 4", "realisations = 2", "has realisations = 4, the plan has 2"),
        ("2.0, 2.4, 3.0", "2.0, 3.0", "has fractal_dimensions ="),
        ("to = 10", "to = 1", "has force_bars ="),
        ('"surfaces"', '"others"', "has no ensemble 'others', which the plan has"),
    ],
)
def test_a_plan_that_was_changed_is_refused_with_the_difference(
    data, tmp_path, before, after, message
):
    with pytest.raises(rl.StoreError, match=message):
        read_groups(data, plan_of(tmp_path, small_campaign.FEW.replace(before, after)))


def test_data_that_are_damaged_or_missing_are_refused(plan, data):
    data.write_bytes(data.read_bytes()[:5000])
    with pytest.raises(rl.StoreError, match="is damaged"):
        read_groups(data, plan)
    data.unlink()
    with pytest.raises(rl.StoreError, match="does not exist: reduce the study again"):
        read_groups(data, plan)


def test_a_reduction_says_what_is_wrong_in_one_line(tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["reduce", "area", str(tmp_path / "none.zarr")])
    assert ended.value.code == 2
    said = capsys.readouterr().err
    assert said.startswith("error: ")
    assert "does not exist" in said
    assert said.count("\n") == 1
