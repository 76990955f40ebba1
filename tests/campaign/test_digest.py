"""What was computed and is lost, cut off or in another's place is seen, and computed again.

Each chunk of each array of a small store is damaged in turn: status and export name its cases, and
the next run ends in the bytes of before.
"""

import shutil
from dataclasses import replace

import numpy as np
import pytest
import xarray

import roughline as rl
from roughline import campaign
from roughline.campaign import batch as batches
from roughline.campaign import writer as writers
from roughline.campaign.export import mean_table
from small_campaign import tree

FORCES = (0.01, 0.1, 1.0)
LINES = campaign.Ensemble("lines", "reduced", (2.6, 2.2), 32, 2, FORCES, 1, "none")
SURFACES = replace(LINES, name="surfaces", model="full", boundary="free", n=8)
ONLY_SURFACES = campaign.Plan("surfaces", (SURFACES,))
PLAN = campaign.Plan("small", (LINES, SURFACES))
COORDINATES = ("fractal_dimension", "realisation", "force_bar")
OF_CASES = (
    *("case_status", "case_digest", "stiffness", "depth", "area_fraction"),
    *("area_fraction_corrected", "status", "resolved", "rms_slope", "highest"),
)


def computed(path, plan=PLAN):
    """Compute what a store lacks in this process; how many cases."""
    count = 0
    with writers.writing(path, plan) as writer:
        for ensemble in plan.ensembles:
            for batch in writer.missing(ensemble):
                writer.put(batch, batches.evaluate(batch, 1, rl.__version__))
                count += len(batch.cells)
    return count


@pytest.fixture(autouse=True)
def two_cases_per_chunk(monkeypatch):
    monkeypatch.setattr(writers, "chunk_shape", lambda ensemble: (1, 2))


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A store with everything that the plan asks for."""
    path = tmp_path_factory.mktemp("whole") / "store.zarr"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(writers, "chunk_shape", lambda ensemble: (1, 2))
        assert computed(path) == PLAN.cases
    return path


@pytest.fixture(scope="module")
def whole_surfaces(tmp_path_factory):
    """A store with its surfaces alone."""
    path = tmp_path_factory.mktemp("surfaces") / "store.zarr"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(writers, "chunk_shape", lambda ensemble: (1, 2))
        computed(path, ONLY_SURFACES)
    return path


@pytest.fixture
def store(whole, tmp_path):
    """A copy of it."""
    return shutil.copytree(whole, tmp_path / "store.zarr")


def chunks_of(store, variable):
    return sorted(path for path in (store / variable).rglob("c/**/*") if path.is_file())


def swap(one, other):
    content = one.read_bytes()
    one.write_bytes(other.read_bytes())
    other.write_bytes(content)


def damages(store, variable):
    """Damage the array's chunks one after the other, in each way: how, and which are damaged."""
    chunks = chunks_of(store, variable)
    for i, chunk in enumerate(chunks):
        content = chunk.read_bytes()
        chunk.write_bytes(content[:-3])
        yield "cut", {i}
        chunk.unlink()
        yield "deleted", {i}
    if len(chunks) == 2 and chunks[0].read_bytes() != chunks[1].read_bytes():
        swap(*chunks)
        yield "swapped", {0, 1}


@pytest.mark.parametrize("variable", OF_CASES)
def test_no_case_is_lost_unseen(whole_surfaces, tmp_path, variable):
    store, before, ways = tmp_path / "store.zarr", tree(whole_surfaces), set()
    shutil.copytree(whole_surfaces, store)
    for way, hurt in damages(store, f"surfaces/{variable}"):
        ways.add(way)
        found = campaign.Store(store)
        done = found.counts("surfaces")[0]
        # cases that are alike may lie in each other's place
        assert (done < 4) if way == "swapped" else (done == 2)
        if (variable, way) == ("case_status", "deleted"):  # as where they were never computed
            assert found.lost("surfaces") == []
            data = found.dataset("surfaces")
        else:
            named = {each.split(",")[0] for each in found.lost("surfaces")}
            assert named == {f"D_f {(2.6, 2.2)[i]}" for i in hurt}
            with pytest.warns(rl.LostCasesWarning, match="`roughline campaign run` with the same"):
                data = found.dataset("surfaces")
        means = mean_table(data)
        assert means.realisations_done.sum() == done * len(FORCES)
        assert (means.stiffness_realisations == means.realisations_done).all()
        assert computed(store, ONLY_SURFACES) == 4 - done
        assert tree(store) == before
    # chunks of marks and of states are equal where all was computed
    equal = variable in ("case_status", "status", "resolved")
    assert ways == {"cut", "deleted"} | (set() if equal else {"swapped"})


@pytest.mark.parametrize("variable", COORDINATES)
def test_no_coordinate_is_lost_unseen(whole, store, variable):
    before = campaign.Store(whole).dataset("lines")
    for _ in damages(store, f"lines/{variable}"):
        found = campaign.Store(store)
        assert found.lost("lines") == [f"the coordinate {variable}"]
        with pytest.warns(rl.LostCasesWarning, match=f"disk: the coordinate {variable}; `rough"):
            assert found.dataset("lines").identical(before)
        assert computed(store) == 0
        assert tree(store) == tree(whole)


def test_cases_in_each_others_place_in_all_arrays_are_seen(store):
    """Each is whole then, and of another body."""
    for variable in ("case_digest", "stiffness", "depth", "rms_slope", "highest"):
        swap(*chunks_of(store, f"lines/{variable}"))
    found = campaign.Store(store).lost("lines")
    assert found == ["D_f 2.2, realisations 0 to 1", "D_f 2.6, realisations 0 to 1"]


def test_an_array_that_is_gone_is_seen(whole, store):
    shutil.rmtree(store / "lines" / "depth")
    assert campaign.Store(store).counts("lines") == (0, 0, 4)
    assert computed(store) == 4
    assert tree(store) == tree(whole)


def test_stores_of_before_there_were_digests_are_read_and_grown(whole, store, tmp_path):
    """In these, what is missing or cut off is seen, and not what lies in another's place."""
    for name in ("lines", "surfaces"):
        shutil.rmtree(store / name / "case_digest")
    found = campaign.Store(store)
    assert found.lost("lines") == found.lost("surfaces") == []
    assert found.dataset("lines").identical(campaign.Store(whole).dataset("lines"))
    more = replace(PLAN, ensembles=tuple(replace(each, realisations=3) for each in PLAN.ensembles))
    assert computed(store, more) == 4
    assert not (store / "lines" / "case_digest").exists()
    assert campaign.Store(store).counts("lines") == (6, 0, 6)
    chunks_of(store, "lines/depth")[0].unlink()
    assert campaign.Store(store).lost("lines") == ["D_f 2.6, realisations 0 to 1"]
    assert computed(store, more) == 2


def test_a_case_that_failed_is_not_lost(tmp_path, monkeypatch):
    original = batches.evaluate_case

    def sometimes(ensemble, dimension, realisation):
        if realisation == 1:
            raise FloatingPointError("the sky fell")
        return original(ensemble, dimension, realisation)

    monkeypatch.setattr(batches, "evaluate_case", sometimes)
    computed(tmp_path / "store")
    found = campaign.Store(tmp_path / "store")
    assert (found.lost("lines"), found.counts("lines")) == ([], (2, 2, 4))


def test_status_and_export_name_what_was_lost(store, invoke, tmp_path):
    chunks_of(store, "lines/depth")[0].write_bytes(b"half")
    told = (
        "lines: values that were computed are lost or damaged on disk: D_f 2.6, realisations "
        "0 to 1; `roughline campaign run` with the same plan computes them again"
    )
    code, out, err = invoke("campaign", "status", store)
    assert (code, err.strip()) == (1, told)
    assert out.split()[5:] == ["lines", "2", "0", "4", "surfaces", "4", "0", "4"]
    code, out, err = invoke("campaign", "export", store, "--out", tmp_path / "files")
    assert (code, err.strip()) == (1, told)
    assert out.splitlines()[-1] == "lines: 2 of 4 cases are done; the others are empty"
    with xarray.open_dataset(tmp_path / "files" / "lines.nc", engine="h5netcdf") as data:
        assert np.isnan(data.depth).any("force_bar").sum() == 2


def test_xarray_sees_all_of_a_store_that_grows(store, tmp_path):
    """While a campaign grows, after it was killed, and where cases have failed."""
    more = replace(PLAN, ensembles=tuple(replace(each, realisations=9) for each in PLAN.ensembles))
    with writers.writing(store, more) as writer:
        killed = shutil.copytree(store, tmp_path / "killed.zarr")
        batch = writer.missing(more.ensemble("lines"))[0]
        writer.put(batch, batches.BatchResult({}, {0: "the sky fell"}))
        with xarray.open_zarr(store, group="lines") as data:
            assert len(data.attrs["failures"]) == 1
    for path in (store, killed):
        for name in ("lines", "surfaces"):
            with xarray.open_zarr(path, group=name) as data:
                assert data.sizes == {"fractal_dimension": 2, "realisation": 9, "force_bar": 3}
                assert int(np.isfinite(data.depth).all("force_bar").sum()) == 4
