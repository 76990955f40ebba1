"""The paper's study with settings of one's own, and other plans of both models in its report."""

import re
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import roughline as rl
from roughline import campaign
from roughline.cli.paper import described_study
from roughline.paper.gallery import Gallery
from roughline.paper.plan import paper_plan, with_settings
from roughline.paper.results import results_of_store
from roughline.paper.roles import chosen_roles, departures
from roughline.paper.windows import Windows

OWN = """
seed = 4
[[ensemble]]
name = "springs"
model = "reduced"
fractal_dimensions = [2.25, 2.5]
points = 1024
realisations = 3
force_bars = { from = 1e-3, to = 1, per_decade = 6 }
[[ensemble]]
name = "blocks"
model = "full"
fractal_dimensions = [2.25, 2.8]
points = [16, 24]
realisations = 3
force_bars = { from = 0.01, to = 1, per_decade = 6 }
"""


def settings(**changes):
    """Settings of an ensemble, as the paper's surfaces have them."""
    plain = {"model": "full", "n": 64, "boundary": "free", "roll_off_ratio": 1.0, "seed": 1}
    return plain | {"cutoff_ratio": "grid", "force_bars": [0.01, 0.1]} | changes


LINE = {"model": "reduced", "boundary": "none", "n": 4096}


@pytest.fixture(scope="module")
def own_store(two_workers, tmp_path_factory):
    """A finished store of a plan of one's own."""
    folder = tmp_path_factory.mktemp("own")
    (folder / "own.toml").write_text(OWN)
    plan = campaign.read_plan(folder / "own.toml")
    campaign.run(plan, folder / "own.zarr", scheduler=two_workers)
    return folder / "own.zarr"


def test_settings_of_ones_own_are_in_all_ensembles_that_they_concern():
    own = with_settings(
        paper_plan("quick"),
        fractal_dimensions=(2.1, 2.5, 2.9),
        points=64,
        realisations=3,
        line_points=4096,
        lines=8,
        force_bars=(0.01, 0.1),
    )
    lines, matched, surfaces = own.ensembles
    assert {each.fractal_dimensions for each in own.ensembles} == {(2.1, 2.5, 2.9)}
    assert (surfaces.n, surfaces.realisations, surfaces.force_bars) == (64, 3, (0.01, 0.1))
    assert (lines.n, lines.realisations) == (4096, 8)
    assert lines.force_bars[0] == 1e-5  # of its own window
    assert (matched.n, matched.cutoff_ratio, matched.force_bars) == (2**14, 32, (0.01, 0.1))
    gallery = Gallery.of(own, (2.1, 2.5, 2.9))
    assert (gallery.fractal_dimensions, gallery.n) == ((2.1, 2.5, 2.9), 64)
    assert (
        chosen_roles({each.name: each.identity() for each in own.ensembles}).matched == matched.name
    )
    assert with_settings(paper_plan("full")) == paper_plan("full")
    with pytest.raises(rl.InputError, match="fractal dimension 3.5; allowed is 2 to 3"):
        with_settings(paper_plan("quick"), fractal_dimensions=(3.5,))


def test_the_paper_s_own_plan_keeps_its_roles():
    plan = campaign.read_plan("studies/paper/plan.toml")
    roles = chosen_roles({each.name: each.identity() for each in plan.ensembles})
    assert (roles.full, roles.reduced, roles.matched) == ("surfaces", "lines", "lines-of-surfaces")


def test_roles_follow_from_settings_whatever_the_names():
    ensembles = {
        "rolled": settings(n=512, roll_off_ratio=2.0),
        "coarse": settings(n=32),
        "fine": settings(),
        "long": settings(**LINE),
        "same": settings(**LINE, cutoff_ratio=32),
    }
    roles = chosen_roles(ensembles)
    assert (roles.full, roles.reduced) == ("fine", "long")
    assert (roles.matched, roles.other_grid) == ("same", "coarse")
    # lines that are the only ones are both
    alone = chosen_roles({"fine": settings(), "same": settings(**LINE, cutoff_ratio=32)})
    assert alone.reduced == alone.matched == "same"
    assert departures(ensembles["rolled"]) == ["with a roll-off at 2 q_0"]
    with pytest.raises(rl.InputError, match=re.escape("are needed; there is fine (full)")):
        chosen_roles({"fine": settings()})


def test_windows_reach_as_far_as_the_loads():
    reached = Windows().within(np.array([1e-3, 1.0]), np.array([0.02, 0.05]))
    assert (reached.reduced, reached.full) == ((1e-3, 1e-2), (0.02, 0.05))
    assert Windows().within(np.array([1e-5, 10.0]), np.array([1e-3, 10.0])) == Windows()
    assert Windows().within(np.array([1.0, 2.0]), np.array([1e-3, 10.0])) == Windows()


@pytest.mark.parametrize("resamples", ["few", "all"])
def test_any_plan_of_both_models_becomes_the_report(
    own_store, tmp_path, invoke, only_drawn, request, resamples
):
    only_drawn()
    if resamples == "few":
        request.getfixturevalue("few_resamples")
    plan = own_store.with_suffix(".toml")
    code, _, err = invoke("paper", plan=plan, out=tmp_path / "report", window="0.02, 0.2")
    assert (code, "Traceback" in err) == (0, False), err
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    assert "from the plan own.toml" in page
    assert "0.02 to 0.2 (3D)" in page
    assert "The same surfaces on two grids" in page
    assert "nan" not in re.sub(r'src="[^"]*"', "", page)
    claims = pd.read_csv(tmp_path / "report" / "data" / "claims.csv").set_index("statement")
    assert len(claims) == 23
    for statement, lacking in (
        ("The same power-law behaviour in both models (abstract)", "no lines with the waves"),
        ("1D: α from 0.5 to 0.75 as D_f goes from 2 to 3 (§6)", "no D_f = 2 or 3"),
    ):
        claim = claims.loc[statement]
        assert claim.verdict == "undecided"
        assert claim.cases.startswith("undecided: not judged, as these data have ")
        assert lacking in claim.cases
    # lines and surfaces have one fractal dimension in common
    of_lines = claims.loc["1D: α = 1 / (4 - D_f) extremely well for D_f ≤ 2.6 (eq. 14, §7)"]
    assert of_lines.found.endswith("at D_f = 2.25")
    figures = {path.name for path in (tmp_path / "report" / "figures").iterdir()}
    assert {"figure_3.png", "figure_4.png", "figure_5.png", "area_law.png"} <= figures


def test_the_command_that_repeats_a_study_is_told():
    own = {"scale": None, "seed": 3, "points": 32, "fractal-dimensions": "2.1, 2.5"}
    windows = {"window": None, "line-window": "0.001, 0.1"}
    study = described_study(own, windows, None, None, Path("out"))
    assert study.store == Path("out", "results.zarr")
    assert study.plan.ensemble("surfaces").fractal_dimensions == (2.1, 2.5)
    assert study.windows == Windows(reduced=(0.001, 0.1))
    assert shlex.split(study.command) == [
        *("roughline", "paper", "--seed=3", "--points=32", "--fractal-dimensions=2.1, 2.5"),
        "--line-window=0.001, 0.1",
    ]
    of_store = described_study({}, {}, None, Path("mine.zarr"), Path("out"))
    assert (of_store.plan, of_store.store) == (None, Path("mine.zarr"))
    assert of_store.command == "roughline paper --store=mine.zarr"


def test_a_store_that_has_more_than_the_plan_gives_the_plan_s_part(own_store):
    plan = campaign.read_plan(own_store.with_suffix(".toml"))
    part = replace(
        plan,
        ensembles=tuple(
            replace(each, fractal_dimensions=(2.25,), realisations=2)
            for each in plan.ensembles
            if each.name != "blocks-n16"
        ),
    )
    store = campaign.Store(own_store)
    some = results_of_store(store, "in part", "none", plan=part)
    every = results_of_store(store, "as a whole", "none")
    for data in (some.full, some.reduced):
        assert (data.sizes["realisation"], data.fractal_dimension.values.tolist()) == (2, [2.25])
    assert (some.other_grid, every.other_grid.attrs["n"]) == (None, 16)
    assert every.full.sizes["realisation"] == 3
    wanted = every.full.stiffness.sel(fractal_dimension=2.25)[:2]
    assert some.full.stiffness.sel(fractal_dimension=2.25).equals(wanted)


def test_a_store_that_is_not_finished_is_refused(own_store, invoke, tmp_path, monkeypatch):
    dataset = campaign.Store.dataset

    def unfinished(store, name):
        data = dataset(store, name)
        if name == "springs":
            data.case_status[0, :2] = 0
        return data

    monkeypatch.setattr(campaign.Store, "dataset", unfinished)
    code, _, err = invoke("paper", "--store", own_store, "--out", tmp_path / "out")
    assert (code, len(err.splitlines())) == (2, 1)
    assert "2 of 6 cases of 'springs' in" in err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--fractal-dimensions", "2.1; 2.5"), '--fractal-dimensions is "2.1; 2.5"; numbers with'),
        (("--fractal-dimensions", "1.9"), '"1.9"; numbers from 2 to 3, each once, are needed'),
        (("--points", "2"), "--points is 2; 3 to 32768 points are needed"),
        (("--realisations", "0"), "--realisations is 0; at least one"),
        (("--force-bars", "1 to 0.1, 4 per decade"), "two rising, positive loads and 1 to 1000"),
        (("--force-bars", "0.1, 0.01"), '--force-bars is "0.1, 0.01"; positive, finite and rising'),
        (("--window", "0.1"), '--window is "0.1"; two rising, positive loads'),
        (("--line-window", "0.1, 0.01"), "--line-window is"),
        (("--plan", "{own}", "--points", "32"), "--points is given beside --plan"),
        (("--store", "{own}", "--seed", "3"), "--seed is given beside --store"),
        (("--plan", "{one}"), "there is lines (reduced)"),
        (("--plan", "none.toml"), '--plan is "none.toml"; there is no such file'),
    ],
)
def test_what_makes_no_study_is_one_line(invoke, tmp_path, arguments, message):
    (tmp_path / "own.toml").write_text(OWN)
    (tmp_path / "one.toml").write_text(
        '[[ensemble]]\nname = "lines"\nmodel = "reduced"\nfractal_dimensions = 2\n'
        "points = 64\nrealisations = 1\nforce_bars = 1.0\n"
    )
    files = {"own": tmp_path / "own.toml", "one": tmp_path / "one.toml"}
    code, _, err = invoke(
        "paper", *(each.format(**files) for each in arguments), out=tmp_path / "out"
    )
    assert (code, len(err.splitlines())) == (2, 1), err
    assert message in err
    assert not (tmp_path / "out").exists()
