"""Campaigns: the same bytes however they were run, and stores that grow without changing."""

import json
import shutil
import time
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray

import roughline as rl
from roughline import campaign
from roughline.campaign import batch as batches
from roughline.campaign.cost import chunk_shape, estimated_cost, workers_that_fit
from roughline.campaign.export import export
from roughline.campaign.run import log_path
from roughline.campaign.writer import writing
from roughline.computing.cores import available_cores
from small_campaign import tree


@pytest.fixture(scope="module")
def plan(plan_file):
    return campaign.read_plan(plan_file)


@pytest.fixture(scope="module")
def few_plan(few_plan_file):
    return campaign.read_plan(few_plan_file)


def smaller(plan, dimensions=None, realisations=None):
    """Cut a plan down in one direction or both."""
    return replace(
        plan,
        ensembles=tuple(
            replace(
                ensemble,
                fractal_dimensions=dimensions or ensemble.fractal_dimensions,
                realisations=realisations or ensemble.realisations,
            )
            for ensemble in plan.ensembles
        ),
    )


def test_a_case_is_what_the_library_gives(plan, finished):
    data = campaign.Store(finished).dataset("surfaces")
    spectrum = rl.SelfAffine(fractal_dimension=2.4, rms_height=1.0)
    lines, surfaces = plan.ensembles
    surface = spectrum.surface(surfaces.n, np.random.SeedSequence(5, spawn_key=(3,)))
    curve = rl.press(surface, E_star=1.0, forces=surfaces.force_bars)
    one = data.sel(fractal_dimension=2.4, realisation=3)
    assert (one.stiffness.values == curve.stiffness).all()
    assert (one.depth.values == curve.depth).all()
    assert (one.area_fraction_corrected.values == curve.area_fraction_corrected).all()
    assert one.rms_slope.item() == surface.rms_slope
    assert one.highest.item() == pytest.approx(surface.heights.max())
    assert (data.status == 0).all()
    assert (data.case_status == 1).all()
    last = lines.realisations - 1
    line = spectrum.line(4096, np.random.SeedSequence(5, spawn_key=(last,)))
    curve = rl.press(line, E_star=1.0, forces=lines.force_bars)
    one = campaign.Store(finished).dataset("lines").sel(fractal_dimension=2.4, realisation=last)
    assert (one.stiffness.values == curve.stiffness).all()
    assert "area_fraction" not in one


def test_xarray_reads_the_store_without_us(plan, finished):
    with xarray.open_zarr(finished, group="surfaces") as data:
        assert data.stiffness.dims == ("fractal_dimension", "realisation", "force_bar")
        assert data.stiffness.attrs["long_name"] == "raw stiffness k / (E* L)"
        assert data.stiffness.attrs["units"] == "1"
        n = plan.ensemble("surfaces").n
        assert (data.attrs["n"], data.attrs["seed"], data.attrs["boundary"]) == (n, 5, "free")
        assert data.attrs["roughline_version"] == rl.__version__
        assert list(data.fractal_dimension.values) == [2.0, 2.4, 3.0]


def test_bytes_do_not_depend_on_workers_or_threads(plan, finished, tmp_path):
    campaign.run(plan, tmp_path / "one", workers=1)
    assert tree(tmp_path / "one") == tree(finished)


def test_nothing_is_computed_twice(plan, finished, tmp_path):
    before, log = tree(finished), log_path(finished).read_text()
    cases = {each.name: each.cases for each in plan.ensembles}
    told = []
    summary = campaign.run(plan, finished, progress=lambda *args: told.append(args))
    assert (summary.done, summary.failed) == ({}, {})
    assert told == [(name, count, 0, count) for name, count in cases.items()]
    assert tree(finished) == before
    assert log_path(finished).read_text() == log
    assert json.loads(log)["done"] == cases


@pytest.mark.parametrize("dimensions", [None, (2.4,), (3.0, 2.0)])
def test_an_extended_store_holds_what_a_large_one_holds(
    size, plan, finished, two_workers, tmp_path, dimensions
):
    """One that had fewer realisations before, or fewer fractal dimensions."""
    first = smaller(plan, dimensions, None if dimensions else {"few": 3, "many": 7}[size])
    path = tmp_path / "store"
    campaign.run(first, path, scheduler=two_workers)
    early = {name: campaign.Store(path).dataset(name) for name in ("lines", "surfaces")}
    summary = campaign.run(plan, path, scheduler=two_workers)
    assert sum(summary.done.values()) == plan.cases - first.cases
    for name, before in early.items():
        data = campaign.Store(path).dataset(name)
        whole = campaign.Store(finished).dataset(name)
        known = {key: before[key] for key in ("fractal_dimension", "realisation")}
        for key in data.variables:
            assert data[key].values.tobytes() == whole[key].values.tobytes()
        for key in before.data_vars:
            assert data[key].sel(known, drop=True).values.tobytes() == before[key].values.tobytes()
    # a plan that asks for less than is there is done
    assert sum(campaign.run(first, path).done.values()) == 0


def test_a_store_of_other_settings_is_refused_and_not_touched(plan, finished):
    before = tree(finished)
    lines, surfaces = plan.ensembles
    for changes, key in (
        ({"n": 48}, f"n is {surfaces.n}, the plan's is 48"),
        ({"seed": 6}, "seed is 5, the plan's is 6"),
        ({"roll_off_ratio": 2.0}, "roll_off_ratio is 1.0"),
        ({"force_bars": surfaces.force_bars[:-1]}, "force_bars is"),
        ({"boundary": "periodic"}, "boundary is 'free'"),
    ):
        more = replace(lines, realisations=100)
        other = replace(plan, ensembles=(more, replace(surfaces, **changes)))
        with pytest.raises(rl.StoreError, match="'surfaces' with other settings") as caught:
            campaign.run(other, finished)
        assert key in str(caught.value)
    assert tree(finished) == before


def test_a_store_of_another_version_is_refused(plan, finished, tmp_path):
    shutil.copytree(finished, tmp_path / "old")
    marks = tmp_path / "old" / "zarr.json"
    marks.write_text(marks.read_text().replace(f'"{rl.__version__}"', '"0.0.9"'))
    with pytest.raises(rl.StoreError, match="was made by roughline 0.0.9"):
        campaign.run(plan, tmp_path / "old")
    with pytest.raises(rl.StoreError, match="use that version, or another folder"):
        campaign.Store(tmp_path / "old")


def test_folders_that_are_no_store(plan, finished, tmp_path):
    import zarr

    with pytest.raises(rl.StoreError, match="does not exist; a store made by a campaign"):
        campaign.Store(tmp_path / "none")
    thesis = tmp_path / "thesis"
    thesis.mkdir()
    (thesis / "chapter_1.txt").write_text("")
    with pytest.raises(rl.StoreError, match="is not a store of roughline"):
        campaign.run(plan, thesis)
    assert [path.name for path in thesis.iterdir()] == ["chapter_1.txt"]
    zarr.create_group(tmp_path / "foreign")
    with pytest.raises(rl.StoreError, match="is not a store of roughline"):
        campaign.run(plan, tmp_path / "foreign")
    (tmp_path / "file").write_text("")
    with pytest.raises(rl.StoreError):
        campaign.run(plan, tmp_path / "file")
    with pytest.raises(rl.StoreError):
        campaign.run(plan, tmp_path / "file" / "store")
    shutil.copytree(finished, tmp_path / "damaged")
    (tmp_path / "damaged" / "zarr.json").write_text('{"zarr_fo')
    with pytest.raises(rl.StoreError, match=r"is damaged \(its zarr.json cannot be read\)"):
        campaign.run(plan, tmp_path / "damaged")
    with pytest.raises(rl.StoreError, match="has no ensemble 'waves'"):
        campaign.Store(finished).dataset("waves")


def test_a_case_that_fails_is_recorded_and_stops_no_other(plan, two_workers, tmp_path, monkeypatch):
    """The reasons lie in the store; the next run tries again and leaves no trace of them."""
    small = smaller(plan, realisations=4)
    original = batches.evaluate_case

    def sometimes(ensemble, dimension, realisation):
        if (dimension, realisation) == (2.4, 2):
            raise FloatingPointError("the sky fell\non this one")
        return original(ensemble, dimension, realisation)

    path = tmp_path / "store"
    with writing(path, small) as writer:
        monkeypatch.setattr(batches, "evaluate_case", sometimes)
        for ensemble in small.ensembles:
            for batch in writer.missing(ensemble):
                writer.put(batch, batches.evaluate(batch, 1, rl.__version__))
    store = campaign.Store(path)
    assert [store.counts(name) for name in store.names] == [(11, 1, 12), (11, 1, 12)]
    why = {"D_f 2.4, realisation 2": "FloatingPointError: the sky fell"}
    assert store.failures("lines") == store.failures("surfaces") == why
    hurt = store.dataset("surfaces")
    assert hurt.case_status.sel(fractal_dimension=2.4, realisation=2) == 2
    assert np.isnan(hurt.stiffness.sel(fractal_dimension=2.4, realisation=2)).all()
    assert int(np.isnan(hurt.stiffness).any("force_bar").sum()) == 1
    monkeypatch.undo()
    summary = campaign.run(small, path, scheduler=two_workers)
    assert summary.done == {"lines": 1, "surfaces": 1}
    assert campaign.Store(path).failures("lines") == {}
    campaign.run(small, tmp_path / "undisturbed", scheduler=two_workers)
    assert tree(path) == tree(tmp_path / "undisturbed")


def test_a_load_that_does_not_converge_is_a_result(plan, tmp_path, monkeypatch):
    """Its values are NaN, its status says why, and the case is done."""
    small = smaller(plan, realisations=1, dimensions=(2.4,))
    original = batches.evaluate_case

    def stalled(*case):
        values = original(*case)
        for name in ("stiffness", "depth", "area_fraction", "area_fraction_corrected"):
            if name in values:
                values[name][3] = np.nan
        values["status"][3] = rl.Status.STALLED
        return values

    monkeypatch.setattr(batches, "evaluate_case", stalled)
    path = tmp_path / "store"
    with writing(path, small) as writer:
        for batch in writer.missing(small.ensemble("surfaces")):
            writer.put(batch, batches.evaluate(batch, 1, rl.__version__))
    with writing(path, small) as writer:
        assert writer.missing(small.ensemble("surfaces")) == []
    assert campaign.Store(path).dataset("surfaces").status.values.ravel()[3] == rl.Status.STALLED


def test_export_to_netcdf_and_csv(finished, tmp_path):
    files = export(campaign.Store(finished), tmp_path)
    assert {path.name for path in files} == {
        *("lines.nc", "lines.csv", "lines_mean.csv"),
        *("surfaces.nc", "surfaces.csv", "surfaces_mean.csv"),
    }
    data = campaign.Store(finished).dataset("surfaces")
    with xarray.open_dataset(tmp_path / "surfaces.nc", engine="h5netcdf") as written:
        assert written.identical(data)
    means = pd.read_csv(tmp_path / "surfaces_mean.csv")
    assert means.stiffness_mean.values == pytest.approx(
        data.stiffness.mean("realisation").values.ravel()
    )
    assert (means.stiffness_low <= means.stiffness_mean).all()
    assert (means.realisations_done == data.sizes["realisation"]).all()
    cases = pd.read_csv(tmp_path / "surfaces.csv")
    assert len(cases) == data.stiffness.size
    assert cases.stiffness.values == pytest.approx(data.stiffness.values.ravel())
    with pytest.raises(rl.InputError, match="format is 'xlsx'"):
        export(campaign.Store(finished), tmp_path, ["xlsx"])
    (tmp_path / "taken").write_text("")
    with pytest.raises(rl.StoreError, match="cannot write to"):
        export(campaign.Store(finished), tmp_path / "taken")


def test_what_is_exported_twice_is_the_same_byte_for_byte(finished, tmp_path):
    first, *others = (
        [path.read_bytes() for path in export(campaign.Store(finished), tmp_path / name)]
        for name in ("one", "two", "three")
    )
    assert all(files == first for files in others)


def test_batches_take_a_second_or_one_case():
    line = campaign.Ensemble("a", "reduced", (2.0, 2.5, 3.0), 2**12, 500, (0.1, 1.0), 0, "none")
    high, wide = chunk_shape(line)
    assert (high, wide) == (3, 500)
    assert chunk_shape(replace(line, n=2**20)) == (1, 47)
    assert chunk_shape(replace(line, n=2**12, realisations=10**6))[0] == 1
    surface = replace(line, model="full", boundary="free", n=512)
    assert chunk_shape(surface) == (1, 4)
    assert chunk_shape(replace(surface, n=2048)) == (1, 1)


def test_what_does_not_fit_is_refused_with_numbers(few_plan, two_workers, tmp_path, monkeypatch):
    import psutil

    plan = few_plan
    huge = replace(plan.ensemble("surfaces"), n=2**15, realisations=1)
    with pytest.raises(rl.InputError, match="GB of memory for the largest case"):
        campaign.run(replace(plan, ensembles=(huge,)), tmp_path / "huge")
    assert not (tmp_path / "huge").exists()
    small = replace(huge, n=24)
    fits = replace(plan, ensembles=(small,))
    done = campaign.run(fits, tmp_path / "huge", scheduler=two_workers).done
    assert done["surfaces"] == 3
    with pytest.raises(rl.InputError, match="take fewer workers"):
        workers_that_fit(psutil.virtual_memory().available // 2, wanted=4)
    assert workers_that_fit(psutil.virtual_memory().available // 3, wanted=2) == 2
    many = replace(plan.ensemble("lines"), realisations=10)
    usage = shutil.disk_usage(tmp_path)
    monkeypatch.setattr(shutil, "disk_usage", lambda path: usage._replace(free=1000))
    with pytest.raises(rl.StoreError, match="GB of disk, and"):
        campaign.run(replace(plan, ensembles=(many,)), tmp_path / "many")
    countless = replace(many, realisations=10**10)
    with pytest.raises(rl.InputError, match="a campaign of 30000000000 cases needs about"):
        campaign.run(replace(plan, ensembles=(countless,)), tmp_path / "countless")
    assert not (tmp_path / "countless").exists()


def test_the_cost_is_told_before_the_work(plan, two_workers, tmp_path, monkeypatch):
    for ensemble in plan.ensembles:
        batches.evaluate_case(ensemble, 2.0, 0)  # compiles
    told = []
    campaign.run(plan, tmp_path / "store", scheduler=two_workers, announce=told.append)
    assert told[0].startswith(f"small: {plan.cases} cases to compute; about ")
    assert "GB of memory each, up to" in told[0]
    assert told[1].startswith("dashboard: http://127.0.0.1:")
    entry = json.loads(log_path(tmp_path / "store").read_text())
    assert entry["processor"]
    spent = entry["core_seconds"]
    monkeypatch.setattr(time, "perf_counter", time.thread_time)  # whatever else the core does
    cost = estimated_cost(plan, {each.name: each.cases for each in plan.ensembles})
    # good to a factor of two or three, and machines are noisy
    assert 0.2 < cost.core_seconds / sum(spent.values()) < 5


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"workers": 0}, "workers is 0; at least 1"),
        ({"threads": 0}, "threads is 0; at least 1"),
        ({"workers": 10**3, "threads": 2}, "more than the .* cores of this machine"),
        ({"workers": 2, "scheduler": "tcp://127.0.0.1:1"}, "workers and a scheduler are given"),
    ],
)
def test_workers_and_threads_fit_the_machine(few_plan, tmp_path, options, message):
    if options.get("workers") == 10**3:
        options = options | {"workers": available_cores()}
    with pytest.raises(rl.InputError, match=message):
        campaign.run(smaller(few_plan, realisations=1), tmp_path / "store", **options)
