"""The measured files as a new user meets them, and what comes out of them."""

import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.margins import variant as variants

PRESS = ("--materials", "steel,copper", "--load", "10 uN")  # more than copper bears at 90 µN


@pytest.mark.parametrize(
    ("name", "points", "told"),
    [
        ("al3d-1.al3d", [200, 296], "within 5% of the border"),
        ("di-1.di", [128, 128], "21 spikes kept"),
        ("opd-1.opd", [128, 96], "116 missing points (0.04%) filled: harmonic"),
        ("dektak-1.csv", [9600], "a line scan shows one line"),
        ("mitutoyo_mock.xlsx", [960], "a line scan shows one line"),
    ],
)
def test_files_that_can_be_pressed(topographies, invoke, name, points, told):
    steps = ("--resample", 128) if max(points) == 128 else ()  # the large ones on fewer points
    code, out, errors = invoke("press", topographies / name, *PRESS, *steps, "--json")
    assert code == 0, errors
    found = json.loads(out)
    assert found["body"]["points"] == points
    assert any(told in note for note in found["notes"])
    answers = {symbol: each["values"][0] for symbol, each in found["answers"].items()}
    assert answers["F"] == pytest.approx(1e-5)
    assert answers["p"] == pytest.approx(1e-5 / found["nominal_area"])
    assert answers["k"] == found["curve"]["stiffness"][0]
    # Barber's identity, by hand; metals spring back, and the model of a line scan has no yield
    stiffness = answers.get("k_u", answers["k"])
    assert ("k_u" in answers) == (len(points) == 2)
    steel, copper = rl.material("steel"), rl.material("copper")
    whole = found["E_star"] * (steel.resistivity + copper.resistivity)
    assert answers["R"] == pytest.approx(whole / (2 * stiffness), rel=1e-12)


def test_rows_of_a_probe_that_jump_are_told_of_and_levelled(topographies, invoke):
    file, options = topographies / "di-1.di", ("--level-lines", "median", "--remove-scars")
    _, as_measured, _ = invoke("info", file)
    assert "rows jump: medians of neighbouring lines along x differ by 630 pm" in as_measured
    assert "(--level-lines median)" in as_measured
    _, levelled, _ = invoke("info", file, *options)
    assert "rows jump" not in levelled
    assert "levelling line by line (median), which takes steps between lines and tilt" in levelled
    assert "the removal of scars (" in levelled


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("sur-3.sur", "233009 missing points of 262144 (89%)"),
        ("xy-1.txt", "states no unit"),
        ("di_corrupted.di", "is damaged or of a type that is not known"),
    ],
)
def test_files_that_cannot_be_used_say_why(topographies, invoke, name, told):
    code, out, errors = invoke("press", topographies / name, *PRESS)
    assert code == 2
    assert out == ""
    assert told in errors
    assert len(errors.splitlines()) == 1


@pytest.mark.parametrize(
    "name", ["al3d-1.al3d", "di-1.di", "opd-1.opd", "dektak-1.csv", "mitutoyo_mock.xlsx"]
)
def test_each_warning_of_info_says_what_to_do(topographies, invoke, name):
    told = invoke("info", topographies / name)[1].splitlines()
    warnings = [line for line in told if line.startswith("warning: ")]
    assert len(warnings) > 2
    does = r"[:;] (unless grooves|several maps|a longer|fit|map|measure|press|scan) [^:;]+$"
    assert [line for line in warnings if not re.search(does, line)] == []


def test_info_describes_a_file_of_which_most_is_missing(topographies, invoke, tmp_path):
    """By SurfaceTopography itself: 233009 of 512 x 512, all but a band at 68 to 84 mm along y."""
    code, out, errors = invoke("info", topographies / "sur-3.sur", "--out", tmp_path)
    assert code == 0, errors
    for text in (
        "512 x 512",
        "151.3 mm x 151.3 mm",
        "233009 (88.89%), mostly one region, at the border",
        "it cannot be pressed as it is: sur-3.sur has 233009 missing points of 262144 (89%)",
    ):
        assert text in out, text
    rows = [line.strip() for line in out.splitlines() if set(line.strip()) <= set(".+#") and line]
    assert len(rows) == 16
    assert [set(row) == {"#"} for row in rows] == [True] * 7 + [False] * 2 + [True] * 7
    assert (tmp_path / "file.png").stat().st_size > 10_000
    shown = out
    code, out, _ = invoke("info", topographies / "sur-3.sur", "--json")
    found = json.loads(out)
    assert (code, found["body"], found["rms_height"]) == (0, None, None)
    assert found["in_file"]["points"] == [512, 512]
    assert found["in_file"]["format"] == "SUR"
    assert found["in_file"]["reader"] == f"roughline {rl.__version__}"
    assert re.search(rf"read by +roughline {rl.__version__}, as SUR", shown)
    assert found["missing"]["points"] == 233009
    assert np.mean(found["missing"]["cells"]) == pytest.approx(233009 / 512**2)
    assert len(found["obstacles"]) == 1


def test_info_describes_a_file_without_a_unit(topographies, invoke):
    code, out, errors = invoke("info", topographies / "xy-1.txt")
    assert code == 0, errors
    said = " ".join(out.split())
    assert "points 132 unit in the file none stated length 187.2, unit not stated" in said
    assert "it cannot be pressed as it is: xy-1.txt states no unit" in said
    code, out, errors = invoke("info", topographies / "xy-1.txt", "--unit", "parsnip")
    assert (code, out) == (2, "")
    assert '--unit is "parsnip"; a unit of length is needed' in errors


def test_info_on_a_damaged_file_is_one_line(topographies, invoke):
    code, out, errors = invoke("info", topographies / "di_corrupted.di")
    assert (code, out) == (2, "")
    assert "is damaged or of a type that is not known" in errors
    assert len(errors.splitlines()) == 1


@pytest.mark.parametrize("drawn", [(), ("file",)], ids=["blank", "drawn"])
def test_info_describes_arrays_and_reduced_lines(tmp_path, invoke, only_drawn, drawn):
    only_drawn(*drawn)
    heights = np.arange(24.0).reshape(4, 6)
    heights[:, 0] = np.nan
    np.save(tmp_path / "map.npy", heights)
    code, out, errors = invoke("info", tmp_path / "map.npy", "--out", tmp_path / "out")
    assert code == 0, errors
    assert out.count("it cannot be pressed as it is") == 3  # unit, sizes, missing points
    assert (tmp_path / "out" / "file.png").exists()
    line = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).line(256, 1)
    rl.write(rl.Line(line.heights, line.length, "m"), tmp_path / "line.nc")
    code, out, errors = invoke("info", tmp_path / "line.nc")
    assert code == 0, errors
    assert "note: this is a reduced line" in out
    assert "Rq, rms height" in out


def test_a_unit_that_a_file_does_not_state_can_be_given(topographies, invoke):
    code, out, _ = invoke("press", topographies / "xy-1.txt", *PRESS, "--unit", "um", "--json")
    assert code == 0
    assert json.loads(out)["body"]["sizes"][0] == pytest.approx(187.19e-6, rel=1e-3)


@pytest.mark.parametrize("file", ["of few points", "sur-3.sur"])
def test_more_missing_points_can_be_allowed(request, tmp_path, invoke, file):
    if file == "of few points":
        heights = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3).heights
        np.save(tmp_path / "few.npy", np.where(np.arange(64) < 57, np.nan, heights))
        asked, told = (tmp_path / "few.npy", "--unit", "m", "--size", "1 mm"), "3648"
    else:
        asked, told = (request.getfixturevalue("topographies") / file,), "233009"
    code, out, _ = invoke("info", *asked, "--max-missing", "0.95", "--json")
    assert code == 0
    (note,) = (note for note in json.loads(out)["notes"] if "missing points" in note)
    share = "89.06" if file == "of few points" else "88.89"
    assert f"{told} missing points ({share}%) filled" in note


@pytest.mark.parametrize(
    ("name", "drawn"),
    [
        ("dektak-1.csv", []),
        *((name, ["roughness"]) for name in ("opd-1.opd", "dektak-1.csv", "mitutoyo_mock.xlsx")),
    ],
)
def test_info_fits_a_screen_and_json(topographies, invoke, only_drawn, tmp_path, name, drawn):
    only_drawn(*drawn)
    code, out, _ = invoke("info", topographies / name, "--out", tmp_path / "out")
    assert code == 0
    assert len(out.splitlines()) < 40
    assert ("Hurst exponent" in out) != bool(re.search(r"self-affine +no: ", out))
    assert "missing points" in out
    text = " ".join(out.split())
    assert (tmp_path / "out" / "file.png").exists() == (name == "opd-1.opd")
    assert (tmp_path / "out" / "roughness.png").stat().st_size > (10_000 if drawn else 0)
    again = rl.read(tmp_path / "out" / "prepared.nc")
    code, out, _ = invoke("info", topographies / name, "--json")
    found = json.loads(out)
    assert again.rms_height == pytest.approx(found["rms_height"], rel=1e-9)
    low, high = found["self_affine"]["hurst_interval"]
    refused = bool(found["self_affine"]["objections"])
    assert refused or "roughness is not alike everywhere" in text
    assert (low, high) == (None, None)
    assert (found["self_affine"]["hurst"] is None) == refused


@pytest.mark.parametrize("points", [88, 160])
def test_a_report_a_client_could_receive(
    topographies, invoke, request, only_drawn, tmp_path, points
):
    folder = tmp_path / "report"
    if points == 88:
        request.getfixturevalue("few_loads")
        only_drawn()
    code, out, errors = invoke(
        "press",
        topographies / "opd-1.opd",
        materials="steel,copper",
        load="10 mN",
        theory="persson",
        friction="0.3",
        report=folder,
        resample=points,
    )
    assert code == 0, errors
    page = (folder / "report.html").read_text(encoding="utf-8")
    for text in (
        "10 mN in all, 841.1 kPa over the nominal area",
        "constriction resistance",
        "harmonic",
        "Assumptions",
        "Barber 2003",
        "steel (E = 211.9 GPa",
        "roughline_version",
        "persson",
    ):
        assert text in page, text
    pdf = (folder / "report.pdf").read_bytes()
    assert pdf.startswith(b"%PDF")
    assert pdf.count(b"/Type /Page\n") > 1
    # the grid's error, as a report estimates it
    bare = " ".join(re.sub("<[^>]*>", " ", re.sub("<sub>(.*?)</sub>", r"_\1", page)).split())
    interval = r"(± \S+%|\(\S+ to \S+\))"
    assert re.search(rf"contact stiffness k \S+ MN/m {interval} unloading stiffness", bare)
    assert "contact stiffness k dF/dd at frozen contact on further loading, exact" in bare
    assert "unloading stiffness k_u dF/dd at frozen contact on unloading, exact" in bare
    assert "red: filled points" in bare
    assert "wrote" in out


@pytest.mark.parametrize(("points", "unit"), [(16, "um"), (64, "nm"), (64, "um"), (64, "mm")])
def test_answers_do_not_depend_on_the_unit(tmp_path, invoke, points, unit):
    """The same heights and sides in another unit give the same answers."""
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(points, 3)
    per_metre = {"nm": 1e9, "um": 1e6, "mm": 1e3, "m": 1.0}
    answers = {}
    for each in ("m", unit):
        np.save(tmp_path / f"{each}.npy", surface.heights * per_metre[each])
        code, out, errors = invoke(
            "press",
            tmp_path / f"{each}.npy",
            unit=each,
            size="1 mm, 1 mm",
            materials="steel,copper",
            load="2 MPa",
            frequency="5 MHz",
            json=True,
        )
        assert code == 0, errors
        found = json.loads(out)["answers"]
        answers[each] = np.array([item["values"][0] for item in found.values()])
    assert answers[unit] == pytest.approx(answers["m"], rel=1e-12)


@pytest.mark.parametrize(("points", "roll_off"), [(32, 160e-6), (64, 125e-6)])
def test_the_interface_of_a_map_is_that_of_the_periodic_half_space(
    tmp_path, invoke, points, roll_off
):
    """With its tilt removed, whatever was asked for; the surface behind it lies in the interval."""
    spectrum = rl.SelfAffine(hurst=0.7, length=4e-3, rms_height=1e-6, q_roll=math.tau / roll_off)
    piece = spectrum.surface(4 * points, 3).cropped((0, points), (0, points))
    tilt = 1e-3 * np.arange(points)[:, np.newaxis] * piece.spacing[0]
    np.save(tmp_path / "map.npy", piece.heights + tilt)
    rl.write(replace(spectrum.surface(points, 3), unit="m"), tmp_path / "generated.nc")
    question = ("--materials", "steel,copper", "--load", "2 MPa", "--load", "20 MPa")
    question += ("--frequency", "5 MHz", "--grid-error", "--json")
    sizes = ("--unit", "m", "--size", "1 mm", "--tilt", "mounting")

    def answered(*arguments):
        code, out, errors = invoke("press", *arguments, *question)
        assert code == 0, errors
        return json.loads(out)

    found = answered(tmp_path / "map.npy", *sizes)
    level = rl.Surface(piece.detrended().heights, (1e-3, 1e-3))
    forces, hardness = [2.0, 20.0], rl.material("copper").hardness
    curve = rl.press(level, E_star=found["E_star"], hardness=hardness, forces=forces, periodic=True)
    k_u = curve.unloading_stiffness
    given = {name: each for name, each in found["answers"].items() if each["values"] is not None}
    assert given["k_i"]["values"] == pytest.approx(k_u, rel=1e-4)
    assert given["k"]["values"] == found["curve"]["stiffness"]  # of the piece, free
    for symbol in ("k_i", "h_c", "|r|"):
        low, high = (np.array(given[symbol][end]) for end in ("low", "high"))
        assert (low < given[symbol]["values"]).all()
        assert (given[symbol]["values"] < high).all()
        assert "of the larger surface" in given[symbol]["validity"]
    assert any("k_i is of the larger surface" in note for note in found["notes"])

    tilted = answered(tmp_path / "map.npy", *sizes, "--trend", "none")["answers"]["k_i"]
    assert tilted["values"] == pytest.approx(k_u, rel=1e-4)
    periodic = answered(tmp_path / "map.npy", *sizes, "--periodic")["answers"]
    assert periodic["k_i"]["values"] == periodic["k_u"]["values"]
    assert periodic["k_i"]["values"] == pytest.approx(k_u, rel=1e-4)
    alone = answered(tmp_path / "generated.nc")["answers"]
    assert "of this piece alone" in alone["h_c"]["validity"]


@pytest.mark.parametrize("half", ["free", "periodic"])
def test_without_the_periodic_half_space_the_interface_is_not_known(
    tmp_path, invoke, monkeypatch, half
):
    """Ctrl-C in either half keeps what was solved, and no free stiffness stands for the other."""
    original = variants.press

    def press(*arguments, progress, **named):
        def stop(done, total):
            progress(done, total)
            if named["half_space"].periodic == (half == "periodic"):
                raise KeyboardInterrupt

        return original(*arguments, progress=stop, **named)

    monkeypatch.setattr(variants, "press", press)
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(32, 1)
    np.save(tmp_path / "map.npy", surface.heights)
    code, out, _ = invoke(
        "press",
        tmp_path / "map.npy",
        unit="m",
        size="1 mm",
        load=["2 MPa", "20 MPa"],
        materials="steel,copper",
        json=True,
    )
    assert code == 130
    found = json.loads(out)["answers"]
    solved = {symbol: [k is not None for k in found[symbol]["values"]] for symbol in ("k", "h_c")}
    first = [True, False]
    expected = (first, [False] * 2) if half == "free" else ([True] * 2, first)
    assert (solved["k"], solved["h_c"]) == expected


def test_two_rough_bodies(tmp_path, invoke):
    spectrum = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6)
    for i in (1, 2):
        surface = spectrum.surface(64, i)
        rl.write(rl.Surface(surface.heights, surface.sizes, "m"), tmp_path / f"{i}.nc")
    code, out, errors = invoke(
        "press", tmp_path / "1.nc", *PRESS, against=tmp_path / "2.nc", json=True
    )
    assert code == 0, errors
    rms = json.loads(out)["body"]["rms_height"]
    assert rms == pytest.approx(np.sqrt(2) * 1e-6, rel=0.25)


def test_what_laying_two_bodies_together_crops_and_resamples_is_said(tmp_path, invoke):
    spectrum = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6)
    rl.write(replace(spectrum.surface(64, 1), unit="m"), tmp_path / "whole.nc")
    small = spectrum.surface(96, 2).cropped((0, 48), (0, 96)).detrended()
    rl.write(replace(small, unit="m"), tmp_path / "small.nc")
    code, out, errors = invoke(
        "press", tmp_path / "whole.nc", *PRESS, "--all", against=tmp_path / "small.nc"
    )
    assert code == 0, errors
    said = " ".join(out.split())
    assert "first body: cropped to what both have in common, 500 µm x 1 mm" in said
    assert "second body: resampled by cubic splines to pixels of 15.62 µm x 15.62 µm" in said
    assert "second body: cropped" not in said


@pytest.mark.parametrize(
    ("points", "extent"), [(32, "its page"), (64, "all of it")], indirect=["extent"]
)
def test_of_two_rough_bodies_each_is_described_and_filled_twice(
    tmp_path, points, extent, invoke, only_drawn
):
    only_drawn()
    spectrum = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6)
    for name, seed, hole in (("whole", 1, False), ("holed", 2, True)):
        heights = spectrum.surface(points, seed).heights.copy()
        if hole:
            heights[::5, ::5] = np.nan
        np.save(tmp_path / f"{name}.npy", heights)
    code, out, errors = invoke(
        "press",
        tmp_path / "whole.npy",
        "--all",
        against=tmp_path / "holed.npy",
        unit="m",
        size="1 mm",
        materials="steel,copper",
        load="30 N",
        report=tmp_path / "report",
    )
    assert code == 0, errors
    said = " ".join(out.split())
    told = {32: "49 missing points (4.79%)", 64: "169 missing points (4.13%)"}[points]
    assert f"second body: {told} filled: harmonic" in said
    assert f"first body: {told}" not in said
    moved = re.search(r"filled by nearest instead, stiffness changes by up to (\S+)%", said)
    assert moved
    assert float(moved[1]) > 0
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    assert "Preparation of the first body: detrended: tilt; of the second: detrended: tilt" in page


@pytest.mark.parametrize("points", [32, 64])
def test_points_filled_before_are_not_said_to_matter_nothing(
    topographies, invoke, only_drawn, tmp_path, points
):
    only_drawn()
    code, _, errors = invoke(
        "info", topographies / "opd-1.opd", "--resample", 2 * points, "--out", tmp_path
    )
    assert code == 0, errors
    code, out, errors = invoke(
        "press", tmp_path / "prepared.nc", *PRESS, "--resample", points, "--all"
    )
    assert code == 0, errors
    said = " ".join(out.split())
    assert "116 missing points (0.04%) filled: harmonic" in said
    assert "filled before the file was written" in said


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--materials", "steel"), "give two with a comma between"),
        (("--materials", "steel,rigit"), 'did you mean "rigid"'),
        (("--materials", "rigid,rigid"), "both materials are rigid"),
        (("--materials", "steel,rigid", "--modulus", "1 GPa"), "either a contact modulus"),
        ((), "either a contact modulus"),
        (("--modulus", "1 GPa", "--report", "r"), "need two --materials"),
        (("--materials", "steel,rigid", "--report", "r"), "a report needs a --load"),
        (("--modulus", "1 GPa", "--theory", "hertz"), '--theory is "hertz"; allowed are'),
        (
            ("--materials", "steel,rigid", "--load", "1 N", "--frequency=-5 MHz"),
            '--frequency is "-5 MHz"; a positive',
        ),
        (
            ("--materials", "steel,rigid", "--load", "1 N", "--friction", "0", "--report", "r"),
            "--friction is 0.0; a number above 0",
        ),
        (("--modulus", "1 GPa", "--crop", "0 um, 1 um"), "--crop has 2 lengths; give 4"),
        (("--modulus", "1 GPa", "--low-pass", "5"), "without a unit"),
        (("--modulus", "1 GPa", "--against", "none.nc"), '--against is "none.nc"; no such file'),
        (("--modulus", "1 GPa", "--channel", "1"), "has one channel only; leave --channel out"),
        (("--modulus", "1 GPa", "--max-missing", "2"), "--max-missing is 2.0"),
    ],
)
def test_questions_that_do_not_fit_together(tmp_path, invoke, arguments, message):
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(32, 1)
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), tmp_path / "map.nc")
    code, _, errors = invoke("press", tmp_path / "map.nc", *arguments)
    assert code == 2
    assert message in errors
    assert "Traceback" not in errors


@pytest.mark.parametrize(
    "arguments",
    [
        ("--theory", "hertz"),
        ("--frequency=-5 MHz",),
        ("--friction", "0", "--report", "r"),
        ("--trend", "none", "--crop", "0 um, 100 um, 0 um, 100 um", "--theory", "persson"),
    ],
)
def test_nothing_is_refused_after_the_work(tmp_path, invoke, monkeypatch, arguments):
    def not_yet(*_, **__):
        raise AssertionError("pressed before the question was understood")

    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(32, 1)
    rl.write(rl.Surface(surface.heights, surface.sizes, "m"), tmp_path / "map.nc")
    monkeypatch.setattr("roughline.margins.variant.press", not_yet)
    code, _, _ = invoke(
        "press", tmp_path / "map.nc", "--materials", "steel,rigid", "--load", "1 N", *arguments
    )
    assert code == 2


def test_a_surface_and_a_line_scan_do_not_go_together(topographies, invoke):
    code, _, errors = invoke(
        "press", topographies / "al3d-1.al3d", *PRESS, against=topographies / "dektak-1.csv"
    )
    assert code == 2
    assert "must both be surfaces, or both line scans" in errors
