"""The paper's study: its plan, its page, and an interrupt on the way."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray

import roughline as rl
from roughline import campaign
from roughline.paper.exponents import exponents_of, summarise
from roughline.paper.page import compose, write_report
from roughline.paper.plan import LINES, MATCHED, SURFACES, paper_plan
from roughline.paper.results import PaperResults
from roughline.paper.sensitivity import WINDOWS_REDUCED
from roughline.report.page import render_markdown
from small_campaign import hear_interrupts, tree

DIMENSIONS = (2.0, 2.4, 3.0)
CLAIMS = 23  # without computing times


def small_plan():
    """Build the paper's plan on small grids, with its loads."""
    plan = paper_plan("quick", seed=5)
    sizes = {LINES: (2**14, 6), MATCHED: (2**12, 6), SURFACES: (24, 4)}
    ensembles = tuple(
        replace(
            ensemble,
            fractal_dimensions=DIMENSIONS,
            n=sizes[ensemble.name][0],
            realisations=sizes[ensemble.name][1],
            cutoff_ratio=12 if ensemble.name == MATCHED else None,
        )
        for ensemble in plan.ensembles
    )
    gallery = replace(plan.gallery, fractal_dimensions=(2.0, 3.0), n=24, n_line=128)
    return replace(plan, ensembles=ensembles, gallery=gallery)


def results_of(store):
    return PaperResults(
        name="in small",
        command="none",
        reduced=store.dataset(LINES),
        full=store.dataset(SURFACES),
        matched=store.dataset(MATCHED),
        exponents=exponents_of(store.dataset(LINES), WINDOWS_REDUCED),
        gallery=store.gallery(),
    )


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    path = tmp_path_factory.mktemp("finished") / "store"
    campaign.run(small_plan(), path)
    return path


@pytest.fixture(scope="module")
def results(finished):
    return results_of(campaign.Store(finished))


@pytest.fixture(scope="module")
def report(results, tmp_path_factory):
    return write_report(results, tmp_path_factory.mktemp("report"))


def test_the_quick_scale_takes_minutes():
    lines, matched, surfaces = paper_plan("quick").ensembles
    assert (lines.n, lines.realisations, len(lines.fractal_dimensions)) == (2**16, 100, 21)
    assert (surfaces.n, surfaces.realisations) == (256, 10)
    assert matched.cutoff_ratio == surfaces.n / 2
    assert matched.force_bars == surfaces.force_bars
    assert {2.0, 2.2, 2.4, 2.6, 2.8, 3.0} <= set(lines.fractal_dimensions)


def test_the_full_scale_is_the_papers():
    lines, _, surfaces = paper_plan("full").ensembles
    assert (surfaces.n, surfaces.realisations) == (2048, 60)
    assert (lines.n, lines.realisations, len(lines.fractal_dimensions)) == (2**20, 500, 101)
    assert surfaces.fractal_dimensions == (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
    assert {2.0, 2.2, 2.4, 2.6, 2.8, 3.0} <= set(lines.fractal_dimensions)


def test_the_gallery_is_kept_and_drawn_once(finished, tmp_path):
    plan = small_plan()
    gallery = campaign.Store(finished).gallery()
    assert gallery.heights.shape == (2, 24, 24)
    assert gallery.fractal_dimension.values == pytest.approx([2.0, 3.0])
    spectrum = rl.SelfAffine(fractal_dimension=3.0, rms_height=1.0)
    assert (gallery.heights.values[1] == spectrum.surface(24, plan.gallery.seed).heights).all()
    before = tree(finished)
    campaign.run(plan, finished)
    assert tree(finished) == before
    other = replace(plan, gallery=replace(plan.gallery, force_bar=0.1))
    with pytest.raises(rl.StoreError, match="a gallery of other settings"):
        campaign.run(other, finished)
    # a damaged one is drawn again
    (tmp_path / "hurt").mkdir()
    chunk = next(path for path in (finished / "gallery" / "contact").rglob("c/**/*"))
    content = {path: path.read_bytes() for path in chunk.parent.rglob("*") if path.is_file()}
    for path in content:
        path.write_bytes(b"")
    campaign.run(plan, finished)
    assert tree(finished) == before


def test_an_interrupt_keeps_what_is_done(tmp_path):
    """Ctrl-C in the middle: exit code 130, no traceback, and the next call ends the work."""
    command = [sys.executable, "-c", INTERRUPTED, str(tmp_path / "out")]
    process = subprocess.Popen(
        command,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=hear_interrupts,
    )
    store = tmp_path / "out" / "results.zarr" / SURFACES / "case_status" / "c"
    deadline = time.monotonic() + 60
    while not any(store.rglob("*")) and time.monotonic() < deadline:
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "what is done is kept" in errors
    assert "Traceback" not in errors
    assert sum(1 for path in store.rglob("*") if path.is_file()) >= 1
    done = subprocess.run(command, capture_output=True, text=True, timeout=240, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "report.html").exists()


INTERRUPTED = """
import sys
from dataclasses import replace
import roughline.paper.page as paper
original = paper.paper_plan
def slow_but_small(scale, seed):
    plan = original(scale, seed)
    sizes = {"lines": (2**14, 20), "lines-of-surfaces": (2**13, 20), "surfaces": (128, 12)}
    ensembles = tuple(
        replace(e, n=sizes[e.name][0], realisations=sizes[e.name][1], cutoff_ratio=None)
        for e in plan.ensembles
    )
    return replace(plan, ensembles=ensembles, gallery=replace(plan.gallery, n=48))
paper.paper_plan = slow_but_small
sys.argv = ["roughline", "paper", "--out", sys.argv[1]]
from roughline.cli import main
main()
"""


def test_a_load_that_fails_is_missing_counted_and_said(results, tmp_path):
    full = results.full.copy(deep=True)
    full.stiffness[1, 0, 9] = np.nan
    full.status[1, 0, 9] = rl.Status.STALLED
    hurt = replace(results, full=full)
    assert [summary.left_out for summary in summarise(hurt)] == [0, 1, 0]
    page = write_report(hurt, tmp_path).read_text(encoding="utf-8")
    assert "1 loads did not converge" in page


def test_the_report_is_one_file_that_needs_no_other(report):
    page = report.read_text(encoding="utf-8")
    assert "Every load of every realisation converged" in page
    assert "<script" not in page
    assert "http:" not in page
    assert "https:" not in page
    assert page.count('src="data:image/png;base64,') == page.count("<img") == 7
    assert page.count("<tr>") >= 1 + CLAIMS + 2 * (1 + len(DIMENSIONS)) + 3
    for text in (
        *("1.1523", "SeedSequence(5, spawn_key=(i,))", "0.2567", "Verdict", "95 % interval"),
        *("automatic window", "fixed level", "geometric"),
    ):
        assert text in page


def test_every_figure_comes_as_png_and_pdf(report):
    names = {path.name for path in (report.parent / "figures").iterdir()}
    for stem in (*(f"figure_{i}" for i in range(1, 6)), "area_law", "models_compared"):
        assert {f"{stem}.png", f"{stem}.pdf"} <= names


def test_the_data_behind_the_figures_are_there(report, results):
    folder = report.parent / "data"
    with xarray.open_dataset(folder / "full.nc", engine="h5netcdf") as data:
        assert data.identical(results.full)
        assert data.attrs["seed"] == 5
    table = pd.read_csv(folder / "full.csv")
    assert len(table) == len(DIMENSIONS) * results.full.sizes["force_bar"]
    mean = results.full.stiffness.mean("realisation").values.ravel()
    assert table.stiffness_mean.values == pytest.approx(mean)
    assert len(pd.read_csv(folder / "claims.csv")) == CLAIMS


def test_equal_results_give_equal_reports(report, results, tmp_path):
    again = write_report(results, tmp_path)
    for name in ("report.html", "figures/figure_3.pdf", "figures/figure_1.png", "data/full.csv"):
        assert (tmp_path / name).read_bytes() == (report.parent / name).read_bytes()
    assert again.name == "report.html"


def test_the_published_page_has_grids_and_times(results, tmp_path):
    more = replace(
        results,
        gallery=None,
        grids={24: results.full, 48: results.full},
        paper_grid=results.full,
        core_seconds={"reduced": 0.02, "full, 2048²": 100.0},
    )
    import roughline.paper.comparisons as comparisons

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(comparisons, "CONVERGENCE_DIMENSIONS", DIMENSIONS)
        text = render_markdown(*compose(more, tmp_path), "figures/paper")
    assert text.startswith("# The paper, recomputed")
    assert "today 10 hours for the 60 surfaces of six D_f, on one core: 100 s a surface" in text
    assert "1D: samples of 2^20 points within minutes (§8) | 0.02 s a line" in text
    assert "![The influence of the grid](figures/paper/grid_convergence.png)" in text
    assert "1.000 (1.000-1.000)" in text
    assert "figure_1" not in text
