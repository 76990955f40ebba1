"""The page about the paper: its figures, its data, and what it says of failures."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
import xarray

import roughline as rl
from roughline.paper import added_figures
from roughline.paper.page import compose, write_page
from roughline.paper.results import Computing
from roughline.report.page import render_markdown

DIMENSIONS = (2.0, 2.4, 3.0)  # of the study in small
CLAIMS = 23  # without computing times


@pytest.mark.parametrize("resamples", ["few", "all"])
def test_a_load_that_fails_is_missing_counted_and_said(
    results, only_drawn, request, tmp_path, resamples
):
    only_drawn()
    if resamples == "few":
        request.getfixturevalue("few_resamples")
    full = results.full.copy(deep=True)
    full.stiffness[1, 0, 9] = np.nan
    full.status[1, 0, 9] = rl.Status.STALLED
    hurt = replace(results, full=full)
    assert [laws.left_out for laws in hurt.laws] == [0, 1, 0]
    page = write_page(hurt, tmp_path)[0].read_text(encoding="utf-8")
    assert "1 loads did not converge" in page


def test_the_report_is_one_file_that_needs_no_other(report):
    page = report.read_text(encoding="utf-8")
    assert "Every load of every realisation converged" in page
    assert "<script" not in page
    assert "http:" not in page
    assert "https:" not in page
    assert page.count('src="data:image/png;base64,') == page.count("<img") == 9
    assert page.count('class="said"') == CLAIMS
    assert page.count("<tr>") >= 2 * (1 + len(DIMENSIONS)) + 3
    for text in (
        *("1.1523", "SeedSequence(5, spawn_key=(i,))", "0.2567", "Verdict", "95 % interval"),
        *("automatic window", "fixed level", "geometric"),
    ):
        assert text in page


def test_every_figure_comes_as_png_and_pdf(report):
    names = {path.name for path in (report.parent / "figures").iterdir()}
    of_paper = ("figure_1a", "figure_1b", *(f"figure_{i}" for i in range(2, 6)))
    for stem in (*of_paper, "area_law", "both_models", "difference"):
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


def test_equal_results_give_equal_reports(report, results, only_drawn, request, tmp_path):
    """The pictures in the page, too: they are the same bytes as the files of the figures."""
    drawn = "figure_3"
    if request.node.callspec.params["report"] == "one figure":
        drawn = "figure_2"
        only_drawn(drawn)
        request.getfixturevalue("few_resamples")
    again, _ = write_page(results, tmp_path)
    for name in ("report.html", f"figures/{drawn}.pdf", "figures/figure_1a.png", "data/full.csv"):
        assert (tmp_path / name).read_bytes() == (report.parent / name).read_bytes()
    assert again.name == "report.html"


@pytest.mark.parametrize(
    "drawn",
    [
        pytest.param((), id="blank"),
        # by grids and lines that others have not
        pytest.param(("grid_convergence", "both_models", "difference"), id="drawn"),
    ],
)
def test_the_published_page_has_grids_and_times(results, only_drawn, request, tmp_path, drawn):
    only_drawn(*drawn)
    if not drawn:
        request.getfixturevalue("few_resamples")
    more = replace(
        results,
        gallery=None,
        grids={48: results.full, 96: results.full},
        other_grid=results.full,
        computing=Computing(
            processor="a processor",
            cores=2,
            hours=2.5,
            core_seconds={
                **dict.fromkeys(("lines-of-surfaces", "coarse-surfaces"), 1.0),
                **{"grids-n48": 1.0, "grids-n96": 1.0, "lines": 0.02, "surfaces": 2400.0},
            },
        ),
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(added_figures, "CONVERGENCE_DIMENSIONS", DIMENSIONS)
        page = compose(more, tmp_path)
    text = render_markdown(page.title, page.lead, page.sections, "figures/paper", page.headline)
    assert text.startswith("# The paper, recomputed")
    said = "4.0 hours for the 12 surfaces of 24² with 25 loads each, on 2 cores (a processor)"
    assert said in text
    assert "2400 core seconds a surface" in text
    assert "took 2.5 hours on 2 cores of a machine with the processor a processor" in text
    assert "1D: samples of 2<sup>20</sup> points within minutes (§8)" in text
    assert "0.02 s a line" in text
    assert "![The influence of the grid](figures/paper/grid_convergence.png)" in text
    assert "1.000 (1.000-1.000)" in text
    assert "figure_1" not in text


def test_one_surface_has_no_interval_decides_nothing_and_says_so(
    results, only_drawn, few_resamples, tmp_path
):
    only_drawn()
    lone = replace(results, full=results.full.isel(realisation=[0]))
    page = compose(lone, tmp_path)
    (warning,) = page.headline.warnings
    assert "One surface of each D_f does not tell" in warning
    surfaces, lines, ratio = (each.sentence for each in page.headline.figures)
    assert "95 %" in lines
    for sentence in (surfaces, ratio):
        assert "95 %" not in sentence.partition(";")[0]
        assert "does not decide on" in sentence
    claims = pd.read_csv(tmp_path / "data" / "claims.csv")
    of_exponents = claims[claims.statement.str.startswith("3D: α")]
    assert set(of_exponents.verdict) == {"undecided"}
