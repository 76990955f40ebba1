"""The command line as a new user meets it: real files, plain messages, exit codes."""

import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

import roughline as rl
from roughline import cli
from roughline.assessment.assessment import Assessment
from roughline.engineering.materials import materials
from roughline.margins import variant as variants
from roughline.report.contact_figures import write_contact


@pytest.fixture
def surface_file(tmp_path, invoke):
    path = tmp_path / "surface.nc"
    code, out, _ = invoke(
        "generate", hurst=0.8, length="1 mm", rms_height="1 um", n=32, seed=7, out=path
    )
    assert code == 0
    assert "surface of 32 x 32 points, 1 mm x 1 mm; rms height 1 µm" in out
    return path


def test_help_and_version(invoke):
    command = [sys.executable, "-c", "from roughline.cli import main; main()", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    for command in ("paper", "press", "ball", "creep", "generate"):
        assert command in done.stdout
        assert invoke(command, "--help")[0] == 0
    assert invoke("--version")[:2] == (0, f"roughline {rl.__version__}\n")


def test_the_help_of_press_names_every_material(invoke):
    page = " ".join(invoke("press", "--help")[1].replace("│", " ").split())
    for name in materials():
        assert f"{name}," in page or f"{name}." in page, name


def test_the_help_of_press_begins_with_bodies_and_loads(invoke):
    page = invoke("press", "--help")[1]
    panels = ("Arguments", "Bodies", "Loads", "Answers", "A file", "Preparation", "Other options")
    places = [page.index(f"─ {panel} ─") for panel in panels]
    assert places == sorted(places)
    assert "╭─ Options" not in page
    assert places[-1] < page.index("Materials by name") < page.index("Examples")


@pytest.mark.parametrize("many", [100, 1000])
def test_many_loads_are_estimated_before_and_told_in_one_line(tmp_path, invoke, monkeypatch, many):
    monkeypatch.setattr("roughline.assessment.cost._ANNOUNCED_LOADS", many)
    monkeypatch.setattr("roughline.report.terminal.MOST_PRINTED", many)
    loads = many + 1
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)
    rl.write(replace(spectrum.surface(8, 1), unit="m"), tmp_path / "small.nc")
    code, out, errors = invoke(
        "press", tmp_path / "small.nc", "--modulus", "1 GPa", "--loads", loads
    )
    assert code == 0, errors
    told = re.search(rf"8 x 8 points, {loads} loads: about (\S+) GB and \S+ ", errors)
    assert 0.2 < float(told[1]) < 0.3  # of the whole process
    lines = [line for line in out.splitlines() if "stiffness" in line]
    assert len(lines) == 1
    assert lines[0].startswith(f"{loads} loads from ")
    assert len(out.splitlines()) < 6


@pytest.mark.parametrize(
    ("loads", "figures"), [(3, ["contact"]), (8, ["curve", "contact"])], ids=["few", "all"]
)
def test_a_generated_surface_is_pressed(surface_file, invoke, only_drawn, tmp_path, loads, figures):
    only_drawn(*figures)
    out_folder = tmp_path / "pressed"
    code, out, _ = invoke(
        "press", surface_file, "--modulus", "110 GPa", "--loads", loads, "--out", out_folder
    )
    assert code == 0
    assert "E* = 110 GPa; full model, free half-space" in out
    assert "tilt removed" not in out
    for name in ("curve.nc", *(f"{each}.{kind}" for each in figures for kind in ("png", "pdf"))):
        assert (out_folder / name).stat().st_size > 1000
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)
    curve = rl.press(spectrum.surface(32, 7), E_star=110e9, n_loads=loads)
    with xarray.open_dataset(out_folder / "curve.nc", engine="h5netcdf") as data:
        assert data.stiffness.values == pytest.approx(curve.stiffness)
        assert data.stiffness.attrs["units"] == "N/m"
        assert data.attrs["body_file"] == "surface.nc"


def test_a_generated_line_is_pressed(invoke, tmp_path):
    path = tmp_path / "line.nc"
    code, out, _ = invoke(
        "generate",
        fractal_dimension=2.2,
        length="1 mm",
        rms_height="1 um",
        n=4096,
        line=True,
        out=path,
        roll_off="0.2 mm",
        cutoff="2 um",
    )
    assert (code, "line of 4096 points, 1 mm" in out) == (0, True)
    code, out, _ = invoke("press", path, "--modulus", "2 MPa", "--force", "1 uN", "--force", "1 mN")
    assert code == 0
    assert "reduced model, exact" in out
    assert "contact area" not in out


def test_the_table_is_in_si_units(surface_file, invoke):
    code, out, _ = invoke("press", surface_file, "--modulus", "1 MPa", "--depth", "0.5 um")
    assert code == 0
    surface = rl.read(surface_file)
    curve = rl.press(surface, E_star=1e6, depths=[0.5e-6])
    row = next(line for line in out.splitlines() if line.strip().startswith("0.5 um"))
    assert "500 nm" in row
    assert f"{curve.stiffness[0]:.4g} N/m" in row
    assert f"{curve.area_fraction[0]:.3%}" in row


@pytest.mark.parametrize(
    ("loads", "more"), [(2, ["--no-grid-error"]), (20, [])], ids=["few loads", "many loads"]
)
def test_the_first_real_surface(topographies, invoke, only_drawn, tmp_path, loads, more):
    only_drawn()
    code, out, _ = invoke(
        "press",
        topographies / "al3d-1.al3d",
        *more,
        modulus="110 GPa",
        loads=loads,
        out=tmp_path / "al3d",
    )
    assert code == 0
    assert "200 x 296 points, 87.61 µm x 129.7 µm" in out
    assert "tilt removed" in out.replace("\n", " ")
    assert len([line for line in out.splitlines() if "N/m" in line]) == loads
    assert (tmp_path / "al3d" / "curve.nc").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("press", "none.sur", "--modulus", "1 GPa"), "none.sur does not exist"),
        (("press", "{file}", "--modulus", "110"), '--modulus is "110", without a unit'),
        (("press", "{file}", "--modulus", "-1 GPa"), '--modulus is "-1 GPa"; a positive'),
        (("press", "{file}", "--modulus", "nan GPa"), '--modulus is "nan GPa"; a positive'),
        (("press", "{file}", "--modulus", "5 m"), "no quantity in Pa"),
        (("press", "{file}", "--modulus", "1 GPa", "--loads", "1"), "--loads is 1; a whole number"),
        (("press", "{file}", "--modulus", "1 GPa", "--force", "-1 N"), "give positive ones"),
        (("press", "{file}", "--modulus", "1 GPa", "--force", "0 N"), "give positive ones"),
        (
            ("press", "{file}", "--modulus", "1 GPa", "--load", "2 N", "--load", "1 m"),
            '--load is "1 m"; give a total force such as "10 N", or a mean pressure',
        ),
        (
            ("press", "{file}", "--modulus", "1 GPa", "--force", "2 N", "--depth", "1 um"),
            "give one of --load, --depth and --loads",
        ),
        (
            ("press", "{file}", "--modulus", "1 GPa", "--periodic", "--depth", "1 mm"),
            "beyond reach",
        ),
        (("press", "{file}", "--modulus", "1 GPa", "--unit", "um"), "leave --unit um out"),
        (("press", "{file}", "--modulus", "1 GPa", "--out", "{file}/sub"), "cannot write to"),
        (("press", "{text}", "--modulus", "1 GPa"), "of a type that is not known"),
        (
            ("generate", "--length", "1 mm", "--rms-height", "1 um", "--out", "x.nc"),
            "give exactly one of --hurst and --fractal-dimension; neither is given",
        ),
        (
            (
                "generate",
                "--hurst",
                "2",
                "--length",
                "1 mm",
                "--rms-height",
                "1 um",
                "--out",
                "x.nc",
            ),
            "--hurst is 2.0; allowed is 0 to 1",
        ),
        (
            ("generate", "--hurst", "1", "--length", "1", "--rms-height", "1 um", "--out", "x.nc"),
            "without a unit",
        ),
        (
            (
                "generate",
                "--hurst",
                "1",
                "--length",
                "1 m",
                "--rms-height",
                "1 m",
                "--out",
                "x.txt",
            ),
            'does not end in ".nc"',
        ),
        (("paper", "--out", "{file}"), "cannot write to"),
    ],
)
def test_bad_input_is_one_line_and_exit_2(surface_file, tmp_path, invoke, arguments, message):
    text = tmp_path / "notes.txt"
    text.write_text("no topography")
    filled = [argument.format(file=surface_file, text=text) for argument in arguments]
    code, _, errors = invoke(*filled)
    assert code == 2
    assert message in errors
    lines = [line for line in errors.splitlines() if line.startswith("roughline:")]
    assert len(lines) == 1
    assert "Traceback" not in errors


@pytest.mark.parametrize(
    "arguments",
    [
        ["presss"],
        ["press"],
        ["press", "x", "--modulus"],
        ["paper", "--scale", "huge"],
        ["generate"],
    ],
)
def test_a_wrong_call_is_exit_2(arguments):
    assert CliRunner().invoke(cli.app, arguments).exit_code == 2


def test_a_load_that_fails_is_said_and_exit_1(surface_file, invoke, monkeypatch):
    original = variants.press
    monkeypatch.setattr(
        variants, "press", lambda *a, **k: original(*a, **k, solver=rl.Solver(max_iterations=2))
    )
    code, out, _ = invoke("press", surface_file, "--modulus", "1 GPa", "--loads", 6)
    assert code == 1
    assert "max_iterations reached" in " ".join(out.split())


@pytest.mark.parametrize("where", ["--out", "--report"])
def test_ctrl_c_keeps_the_loads_that_were_solved(
    surface_file, invoke, only_drawn, monkeypatch, tmp_path, where
):
    only_drawn()
    original = variants.press

    def press(*arguments, progress, **named):
        def stop(done, total):
            progress(done, total)
            if done == 3:
                raise KeyboardInterrupt

        return original(*arguments, progress=stop, **named)

    monkeypatch.setattr(variants, "press", press)
    folder = tmp_path / "pressed"
    code, out, err = invoke(
        "press",
        surface_file,
        where,
        folder,
        materials="steel,copper",
        load=["1 N", "2 N", "3 N", "4 N"],
        theory="persson",
    )
    assert code == 130, err
    assert "interrupted; the loads solved before are above" in err
    # one line for all loads that were not solved
    (one,) = re.findall(r"^\d+ of \d+ loads .*$", out, re.MULTILINE)
    assert re.fullmatch(r"\d+ of \d+ loads \(.*4 N\): not solved: interrupted before", one)
    assert {file.name for file in folder.iterdir()} >= {"curve.nc", "curve.png"}
    assert not (folder / "report.html").exists()
    with xarray.open_dataset(folder / "curve.nc", engine="h5netcdf") as data:
        assert (data.status.values == 0).sum() == 3
        assert np.isfinite(data.stiffness.values[:3]).all()


def test_a_report_with_loads_that_failed_says_so(
    surface_file, invoke, only_drawn, monkeypatch, tmp_path
):
    only_drawn()
    original = variants.press
    monkeypatch.setattr(
        variants, "press", lambda *a, **k: original(*a, **k, solver=rl.Solver(max_iterations=1))
    )
    code, out, err = invoke(
        "press",
        surface_file,
        materials="steel,copper",
        load=["0.1 N", "0.5 N"],
        elastic=True,
        theory="persson",
        friction=0.3,
        report=tmp_path / "r",
    )
    assert code == 1, err
    assert "max_iterations reached" in " ".join(out.split())
    assert "not solved" in (tmp_path / "r" / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("drawn", [(), ("curve", "contact")], ids=["blank", "drawn"])
def test_figures_of_a_failed_load_show_the_others(surface_file, only_drawn, tmp_path, drawn):
    only_drawn(*drawn)
    surface = rl.read(surface_file)
    curve = rl.press(
        surface,
        E_star=1e9,
        n_loads=6,
        fields=True,
        solver=rl.Solver(max_iterations=2),
        throw=False,
    )
    assert not curve.converged.all()
    question = rl.Question(surface_file, E_star=1e9, n_loads=6)
    pressed = Assessment(question, [], surface, curve, np.arange(6))
    files = write_contact(pressed, tmp_path / "figures")
    assert all(file.stat().st_size > 0 for file in files)
    assert np.isfinite(curve.stiffness).any()
