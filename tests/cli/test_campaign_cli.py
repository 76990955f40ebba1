"""Campaigns and comparisons on the command line: output, exit codes, and one line for bad input."""

import numpy as np
import pandas as pd
import pytest
import xarray

import roughline as rl

PLAN = """
name = "another name"
seed = 3
[[ensemble]]
name = "lines"
model = "reduced"
fractal_dimensions = [2.2, 2.8]
points = 1024
realisations = 4
force_bars = [0.01, 0.1, 1.0]
"""


@pytest.fixture
def plan(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(PLAN)
    return path


def test_a_campaign_from_plan_to_files(invoke, plan, tmp_path):
    code, out, err = invoke("campaign", "run", plan)
    assert code == 0
    assert f"8 cases computed, 0 failed; results in {tmp_path / 'study.zarr'}" in out
    assert "another name: 8 cases to compute; about" in err
    assert "dashboard: http" in err
    code, out, _ = invoke("campaign", "status", plan)
    assert code == 0
    assert out.split()[-4:] == ["lines", "8", "0", "8"]
    code, out, _ = invoke("campaign", "export", tmp_path / "study.zarr", "--out", tmp_path / "out")
    assert code == 0
    assert out.count("wrote") == 3
    with xarray.open_dataset(tmp_path / "out" / "lines.nc", engine="h5netcdf") as data:
        assert data.stiffness.shape == (2, 4, 3)
        assert data.attrs["seed"] == 3
    code, out, _ = invoke("campaign", "export", plan, out=tmp_path / "csv", format="csv")
    assert (code, out.count("wrote")) == (0, 2)
    code, out, _ = invoke("campaign", "run", plan)
    assert (code, "0 cases computed, 0 failed" in out) == (0, True)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            PLAN.replace("realisations", "realizations"),
            "is not known; did you mean 'realisations'?",
        ),
        (PLAN.replace("1024", '"1024"'), 'points is "1024"; a whole number is needed'),
        (PLAN.replace("[2.2, 2.8]", "[]"), "fractal_dimensions is []; at least one"),
        (PLAN.replace("1024", "100_000_000_000"), "points; allowed are 3 to"),
        ("seed = ", "is not valid TOML"),
    ],
)
def test_bad_plans_are_one_line_and_exit_2(invoke, tmp_path, text, message):
    path = tmp_path / "plan.toml"
    path.write_text(text)
    code, out, err = invoke("campaign", "run", path)
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.splitlines()) == 1
    assert not (tmp_path / "plan.zarr").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("campaign", "run", "none.toml"), "none.toml does not exist; a plan in TOML"),
        (("campaign", "status", "none.zarr"), "none.zarr does not exist; a store"),
        (("campaign", "export", "{plan}", "--out", "x"), "study.zarr does not exist"),
        (("campaign", "run", "{plan}", "--threads", "0"), "threads is 0"),
        (("campaign", "run", "{plan}", "--store", "{plan}"), "study.toml"),
        (("compare",), "give exactly one of --hurst and --fractal-dimension; neither is given"),
        (("compare", "--hurst", "0.5", "--roll-off", "1 mm"), "without the length"),
        (("compare", "--hurst", "0.5", "--tolerance", "10"), "tolerance is 10.0; a share"),
        (("compare", "--hurst", "0.5", "--surfaces", "1"), "surfaces is 1; an interval"),
        (("compare", "none.x3p"), "none.x3p does not exist"),
        (
            ("compare", "--hurst", "0.5", "--surfaces", "2", "-n", "16", "--force-bar", "-1"),
            "force",
        ),
    ],
)
def test_bad_input_is_one_line_and_exit_2(invoke, plan, arguments, message):
    code, out, err = invoke(*(text.format(plan=plan) for text in arguments))
    assert (code, out) == (2, "")
    assert message in err
    assert "Traceback" not in err


@pytest.mark.parametrize(("n", "drawn"), [(32, []), (64, ["comparison"])], ids=["32", "64"])
def test_the_models_are_compared(invoke, only_drawn, tmp_path, n, drawn):
    only_drawn(*drawn)
    code, out, _ = invoke(
        "compare",
        hurst=0.6,
        length="1 mm",
        cutoff="62.5 um",
        n=n,
        surfaces=4,
        force_bar=[0.05, 0.5],
        out=tmp_path / "out",
    )
    assert code == 0
    assert f"4 surfaces of {n} x {n} points, D_f = 2.4, q_roll / q_0 = 1" in out
    assert "the map says" in out
    assert "agreement within 10% is confirmed" in out
    table = pd.read_csv(tmp_path / "out" / "comparison.csv")
    spectrum = rl.SelfAffine(hurst=0.6, rms_height=1.0, q_high=16 * 2 * np.pi)
    found = rl.compare(spectrum, n=n, surfaces=4, force_bars=[0.05, 0.5])
    assert table.difference.values == pytest.approx(found.difference, rel=1e-6)
    assert (tmp_path / "out" / "comparison.png").stat().st_size > (1000 if drawn else 0)


def test_a_surface_in_a_file_is_compared(invoke, tmp_path):
    path = tmp_path / "surface.nc"
    rl.write(rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, 1), path)
    code, _, err = invoke("compare", path, "--force-bar", 0.1)
    assert (code, "states no unit" in err or "unit" in err) == (2, True)
    code, out, _ = invoke("compare", path, "--force-bar", 0.1, "--unit", "m")
    assert code == 0
    assert "64 x 64 points, and lines of its spectrum" in out
    rl.write(rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).line(64, 1), path)
    code, _, err = invoke("compare", path, "--unit", "m", "--mask", "leave-out")
    assert (code, "has no mask that selects points" in err) == (2, True)
    code, _, err = invoke("compare", path, "--unit", "m")
    assert (code, "holds a line" in err) == (2, True)


def test_a_measured_surface_is_compared(topographies, invoke):
    code, out, _ = invoke("compare", topographies / "al3d-1.al3d", force_bar=[0.1, 1])
    assert code == 0
    assert "200 x 296 points, and lines of its spectrum" in out
