"""Ensembles: the same bytes whatever happens on the way, and nothing lost."""

import json
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline import fft
from roughline.campaign.plan import Ensemble, Gallery, Plan, paper_plan
from roughline.campaign.run import evaluate, run
from roughline.campaign.store import Store

DIMENSIONS = (2.0, 2.4, 3.0)


def small_plan():
    """Build the paper's plan on small grids, with its loads."""
    quick = paper_plan("quick")
    full = Ensemble("full", DIMENSIONS, 24, 4, quick.full.force_bars, seed=5, batch=1)
    reduced = Ensemble("reduced", DIMENSIONS, 2**14, 5, quick.reduced.force_bars, seed=5, batch=2)
    return Plan("small", full, reduced, Gallery((2.0, 3.0), 24, 128, 0.3, seed=5))


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    plan = small_plan()
    store = Store(tmp_path_factory.mktemp("finished") / "store", plan)
    run(plan, store, workers=2)
    return plan, store


def everything(store):
    datasets = (store.dataset(store.plan.reduced), store.dataset(store.plan.full), store.gallery())
    return [
        (name, data[name].values.tobytes()) for data in datasets for name in sorted(data.variables)
    ]


def test_a_case_is_what_the_library_gives(finished):
    plan, store = finished
    data = store.dataset(plan.full)
    spectrum = rl.SelfAffine(fractal_dimension=2.4, rms_height=1.0)
    surface = spectrum.surface(24, np.random.SeedSequence(5, spawn_key=(3,)))
    curve = rl.press(surface, E_star=1.0, forces=plan.full.force_bars)
    one = data.sel(fractal_dimension=2.4, realisation=3)
    assert one.stiffness.values == pytest.approx(curve.stiffness, rel=1e-12)
    assert one.area_fraction.values == pytest.approx(curve.area_fraction)
    assert one.rms_slope.item() == surface.rms_slope
    assert (data.status == 0).all()


def test_results_do_not_depend_on_the_number_of_workers(finished, tmp_path):
    plan, store = finished
    alone = Store(tmp_path / "store", plan)
    run(plan, alone, workers=1)
    assert everything(alone) == everything(store)


def test_a_run_that_was_broken_off_goes_on_to_the_same_bytes(finished, tmp_path):
    plan, store = finished
    broken = Store(tmp_path / "store", plan)
    cores = fft.available_cores()
    fft.set_threads(1)  # as in a worker: the last bits of a transform depend on it
    for case in plan.full.cases()[::2] + plan.reduced.cases()[1:3]:
        broken.put(case, evaluate(case))
    fft.set_threads(cores)
    assert len(broken.missing(plan.full)) == len(plan.full.cases()) // 2
    told = []
    again = Store(tmp_path / "store", plan)
    run(plan, again, workers=2, progress=lambda *args: told.append(args))
    assert told[0] == ("gallery", 0, 1)
    assert ("full", 6, 12) in told
    assert told[-1] == ("full", 12, 12)
    assert everything(again) == everything(store)
    assert again.missing(plan.full) == again.missing(plan.reduced) == []


def test_nothing_is_computed_twice(finished):
    plan, store = finished
    before = everything(store)
    told = []
    run(plan, store, progress=lambda *args: told.append(args))
    assert told == [("gallery", 1, 1), ("reduced", 9, 9), ("full", 12, 12)]
    assert everything(store) == before


def test_a_half_written_batch_does_not_count(finished, tmp_path):
    plan, _ = finished
    store = Store(tmp_path / "store", plan)
    case = plan.full.cases()[0]
    results = evaluate(case)
    store._root["full"]["stiffness"][case.dimension_index, 0:1] = results["stiffness"]
    assert case in store.missing(plan.full)
    store.put(case, results)
    assert case not in store.missing(plan.full)


def test_an_interrupt_keeps_what_is_done(tmp_path):
    """Ctrl-C in the middle: exit code 130, no traceback, and the next call ends the work."""
    command = [sys.executable, "-c", INTERRUPTED, str(tmp_path / "out")]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True)
    store = tmp_path / "out" / "results.zarr" / "full" / "done" / "c"
    deadline = time.monotonic() + 60
    while not (store.exists() and any(store.rglob("*"))) and time.monotonic() < deadline:
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "what is done is kept" in errors
    assert "Traceback" not in errors
    kept = sum(1 for path in store.rglob("*") if path.is_file())
    assert kept >= 1
    done = subprocess.run(command, capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "report.html").exists()


INTERRUPTED = """
import sys
from dataclasses import replace
import roughline.report.paper as paper
original = paper.paper_plan
def slow_but_small(scale, seed):
    plan = original(scale, seed)
    full = replace(plan.full, n=128, realisations=12)
    reduced = replace(plan.reduced, n=2**14, realisations=20)
    return replace(plan, full=full, reduced=reduced, gallery=replace(plan.gallery, n=48))
if __name__ == "__main__":
    paper.paper_plan = slow_but_small
    sys.argv = ["roughline", "paper", "--out", sys.argv[1]]
    from roughline.cli import main
    main()
"""


def test_a_store_of_other_settings_is_refused(finished, tmp_path):
    plan, _ = finished
    Store(tmp_path / "store", plan)
    other = replace(plan, full=replace(plan.full, seed=6))
    with pytest.raises(rl.StoreError, match="results of other settings or of another version"):
        Store(tmp_path / "store", other)


def test_a_folder_that_is_no_store_or_cannot_be_one_is_refused(finished, tmp_path):
    plan, _ = finished
    (tmp_path / "file").write_text("")
    with pytest.raises(rl.StoreError, match="cannot keep results in"):
        Store(tmp_path / "file", plan)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.txt").write_text("")
    with pytest.raises(rl.StoreError, match="holds results of other settings"):
        Store(tmp_path / "full", plan)


def test_settings_say_everything():
    settings = json.loads(json.dumps(paper_plan("quick").settings()))
    assert settings["roughline_version"] == rl.__version__
    assert settings["full"]["n"] >= 128
    assert settings["full"]["realisations"] >= 10
    assert (settings["reduced"]["n"], settings["reduced"]["realisations"]) == (2**16, 100)


def test_the_full_scale_is_the_papers():
    plan = paper_plan("full")
    assert (plan.full.n, plan.full.realisations) == (2048, 60)
    assert (plan.reduced.n, plan.reduced.realisations) == (2**20, 500)
    assert plan.full.fractal_dimensions == (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
    assert {2.0, 2.2, 2.4, 2.6, 2.8, 3.0} <= set(plan.reduced.fractal_dimensions)


def test_a_load_that_fails_is_kept_as_missing_and_counted(finished, tmp_path):
    from roughline.report.paper import write_report
    from roughline.report.summary import summarise

    plan, _ = finished
    hurt = Store(tmp_path / "store", plan)
    run(plan, hurt, workers=1)
    case = plan.full.cases()[1]
    results = evaluate(case)
    results["stiffness"][0, 9], results["status"][0, 9] = np.nan, rl.Status.STALLED
    hurt.put(case, results)
    summaries = summarise(hurt.dataset(plan.reduced), hurt.dataset(plan.full))
    assert [s.left_out for s in summaries] == [0, 1, 0]
    page = write_report(plan, hurt, tmp_path / "report").read_text(encoding="utf-8")
    assert "1 loads did not converge" in page


@pytest.fixture(scope="module")
def report(finished, tmp_path_factory):
    from roughline.report.paper import write_report

    return write_report(*finished, tmp_path_factory.mktemp("report"))


def test_the_report_is_one_file_that_needs_no_other(report):
    page = report.read_text(encoding="utf-8")
    assert "Every load of every realisation converged" in page
    assert "<script" not in page
    assert "http" not in page
    assert page.count('src="data:image/png;base64,') == page.count("<img") == 7
    assert page.count("<tr>") >= 1 + 7 + 2 * (1 + len(DIMENSIONS)) + 3
    for text in ("1.1523", "SeedSequence(5, spawn_key=(i,))", "0.2567", "Verdict", "95 % interval"):
        assert text in page


def test_every_figure_comes_as_png_and_pdf(report):
    names = {path.name for path in (report.parent / "figures").iterdir()}
    for stem in (*(f"figure_{i}" for i in range(1, 6)), "area_law", "models_compared"):
        assert {f"{stem}.png", f"{stem}.pdf"} <= names


def test_the_data_behind_the_figures_are_there(report, finished):
    import pandas as pd
    import xarray

    plan, store = finished
    folder = report.parent / "data"
    with xarray.open_dataset(folder / "full.nc", engine="h5netcdf") as data:
        assert data.identical(store.dataset(plan.full))
        assert data.attrs["seed"] == 5
    table = pd.read_csv(folder / "full.csv")
    assert len(table) == len(DIMENSIONS) * len(plan.full.force_bars)
    mean = store.dataset(plan.full).stiffness.mean("realisation").values.ravel()
    assert table.stiffness_mean.values == pytest.approx(mean)
    assert len(pd.read_csv(folder / "claims.csv")) == 7


def test_equal_results_give_equal_reports(report, finished, tmp_path):
    from roughline.report.paper import write_report

    again = write_report(*finished, tmp_path)
    for name in ("report.html", "figures/figure_3.pdf", "figures/figure_1.png", "data/full.csv"):
        assert (tmp_path / name).read_bytes() == (report.parent / name).read_bytes()
    assert again.name == "report.html"


def test_a_worker_that_dies_is_said_and_nothing_is_lost(finished, tmp_path):
    plan, store = finished
    again = Store(tmp_path / "store", plan)

    def kill_at_once(stage, done, total):
        if (stage, done) == ("full", 1):
            for process in multiprocessing.active_children():
                process.kill()

    with pytest.raises(rl.RoughlineError, match="a worker process died"):
        run(plan, again, workers=1, progress=kill_at_once)
    assert again.missing(plan.reduced) == []
    assert 0 < len(again.missing(plan.full)) < len(plan.full.cases())
    run(plan, again, workers=1)
    assert everything(again) == everything(store)
