"""My surface: answers are the library's, texts the command line's, refusals sentences."""

import math
import os
import re
import shlex
import shutil
import subprocess
import sys
from itertools import chain
from pathlib import Path
from types import SimpleNamespace
from zipfile import ZipFile

import numpy as np
import pytest
import xarray

import roughline as rl
from gwyddion_files import field, gwy
from lab.unpacked import HALF_A_STEP, assert_sent, unpacked
from roughline.comparison.compared import NamedBody, compare_models
from roughline.errors.words import speaking
from roughline.lab.measured.answers import assessed
from roughline.lab.measured.controls import BY_CONTROL
from roughline.lab.measured.examples import EXAMPLES, write_example
from roughline.lab.measured.state import PAGE_WORDS, control_texts, first_source, page_question
from roughline.lab.server.tasks import run_task
from roughline.lab.site import TASKS
from roughline.question.description import describe
from roughline.report.answers import answer_table, in_full
from roughline.report.comparison import comparison_table, verdict_in_words
from roughline.report.contact_tables import curve_table, formula_table
from roughline.report.description_table import description_table
from roughline.report.page import sentence
from roughline.report.part_tables import leading_table, maps_table
from roughline.report.values import up_to_three_digits

PAIR = {"first": "steel", "second": "copper", "loads": "2 MPa"}
SMALL = {"resample": "64"}
ELASTIC = {"elastic": "yes"}
NEEDING = {
    **{"joint_area": "1 cm^2", "friction": "0.3", "frequency": "5 MHz"},
    **{"fluid": "water", "sealing_pressure": "yes"},
}
"""Controls that need two materials."""
COATED = {"first": "gold 20 µm on nickel 40 µm on copper", "second": "steel", "loads": "2 MPa"}
SIDES = [1e-3, 1e-3]
RANDOM = "3f9a0c5d7e2b4a61"  # as an upload lies on the disk


def in_answers(assessment):
    """The table of the answers, written as on the page."""
    return answer_table(assessment, with_elastic=True, write=up_to_three_digits)


def table_of(header, panel):
    """Heads and rows of the table of a panel."""
    return header["panels"][panel]["columns"], header["panels"][panel]["rows"]


def heights_of(header, arrays):
    """The heights of a file, of a map or along a line."""
    panel = header["panels"].get("file-line")
    return np.array(panel["series"]["heights"]["y"], float) if panel else arrays["height"]


class Page:
    """A session with its files, which asks as a page does."""

    def __init__(self, folder, examples):
        self.folder, self._examples = folder, examples
        self.files, self.names = {}, {}
        self.steps = []

    def bring(self, file, name=None):
        """Put a file where uploads lie."""
        key = f"key{len(self.files)}"
        path = self.folder / f"{RANDOM}{len(self.files)}{file.suffix}"
        shutil.copyfile(file, path)
        self.files[key], self.names[str(path)] = str(path), name or file.name
        return {"file": key}

    def example(self, key, folder):
        """Put the file of an example into a folder; it is written once, which takes a while."""
        folder.mkdir(exist_ok=True)
        shutil.copyfile(write_example(key, self._examples), folder / EXAMPLES[key].file)

    @property
    def session(self):
        return {
            "folder": str(self.folder),
            "files": self.files,
            "names": self.names,
            "max_memory": 4e9,
        }

    def outcome(self, task, state, **others):
        if (key := state.get("example")) in EXAMPLES:
            self.example(key, self.folder / "results")
        arguments = {"state": state, "session": self.session, **others}
        return run_task(
            TASKS[f"measured.{task}"],
            arguments,
            lambda done, total: self.steps.append((done, total)),
        )

    def ask(self, task, state, **others):
        outcome = self.outcome(task, state, **others)
        assert outcome.answer is not None, outcome.error
        return unpacked(outcome.answer)

    def refusal(self, task, state, **others):
        outcome = self.outcome(task, state, **others)
        assert outcome.answer is None
        for private in (str(self.folder), RANDOM, "Traceback", "/"):
            assert private not in outcome.error.replace("W/m/K", "").replace("1/m", "")
        assert len(outcome.error.splitlines()) == 1
        return outcome.error, outcome.at

    def refused(self, task, state):
        """The sentence of what cannot be used and its control, whether or not the rest is used."""
        if self.outcome(task, state, sides=SIDES).answer is None:
            return self.refusal(task, state)
        header, _ = self.ask(task, state, sides=SIDES)
        ((at, sentence),) = header["refused"].items()
        assert sentence.endswith("is used meanwhile")
        return sentence, at


@pytest.fixture(scope="module")
def examples(tmp_path_factory):
    """Where the files of examples lie that were written."""
    return tmp_path_factory.mktemp("examples")


@pytest.fixture
def page(tmp_path, examples):
    return Page(tmp_path, examples)


@pytest.fixture(scope="module")
def measured_page(tmp_path_factory, topographies, examples):
    """A page that has brought every measured file."""
    page = Page(tmp_path_factory.mktemp("measured"), examples)
    page.keys = {file.name: page.bring(file) for file in topographies.iterdir()}
    return page


@pytest.fixture
def cells(loads_of_curve):
    """Few cells, without the error of the grid, where a curve has few loads."""
    return {"resample": "32", "grid_error": "no"} if loads_of_curve == "few loads" else SMALL


@pytest.mark.parametrize("key", EXAMPLES)
def test_examples_say_all_that_is_needed_and_are_always_the_same(page, tmp_path, key):
    header, arrays = page.ask("look", {"example": key})
    assert header["asks"] == {"unit": False, "size": False, "channels": []}
    assert header["lists"]["obstacles"] == []
    first = rl.read(write_example(key, tmp_path / "one"))
    again = rl.read(write_example(key, tmp_path / "two"))
    np.testing.assert_array_equal(first.heights, again.heights)
    assert (
        heights_of(header, arrays).size == np.prod(header["body"]["points"]) == first.heights.size
    )


def test_the_ground_example_has_tilt_missing_points_and_spikes(page):
    header, arrays = page.ask("look", {"example": "ground"})
    heights = arrays["height"]
    assert np.isnan(heights).sum() > 100
    assert len(header["maps"]["height"]["rings"]) == 7
    assert np.nanmean(heights[:, -20:]) - np.nanmean(heights[:, :20]) > 1  # of the tilt [µm]
    assert any("7 spikes kept" in each for each in header["lists"]["remarks"])
    removed, _ = page.ask("prepare", {"example": "ground", "outliers": "remove"})
    assert any("7 spikes removed" in each for each in removed["lists"]["prepared-remarks"])


def test_the_film_example_follows_its_law(page):
    header, _ = page.ask("look", {"example": "film"})
    found = dict(header["tables"]["measured-roughness"][1])
    assert found["self-affine"] == "yes"
    assert found["Hurst exponent"].startswith("0.79")
    assert header["panels"]["spectrum"]["series"]["law"]["x"]


@pytest.mark.parametrize("key", EXAMPLES)
def test_answers_are_those_of_the_library(page, key):
    said = {"example": key, **PAIR, **SMALL, "friction": "0.3", "frequency": "5 MHz"}
    source = first_source(said, page.session)
    question = page_question(said, source)
    with speaking(PAGE_WORDS):
        expected = rl.assess(question)
    header, arrays = page.ask("answer", said)
    assert header["tables"]["measured-answers"][:2] == list(in_answers(expected))
    assert header["tables"]["measured-formulas"] == list(formula_table(expected))
    assert table_of(header, "stiffness") == curve_table(expected)
    with speaking(PAGE_WORDS):
        first = [sentence(each.brief) for each in expected.facts[:3] if each.is_warning]
        in_words = sorted(map(in_full, expected.facts))
    assert header["lists"]["grave"] == first
    assert sorted(chain(*header["remarks"].values())) == in_words
    assert bool(page.steps) == (expected.fields is not None)  # a line scan is solved at once
    assert page.steps == sorted(page.steps)
    assert len({total for _, total in page.steps}) <= 1
    if page.steps:
        assert page.steps[-1][0] == page.steps[-1][1]
    if expected.fields is not None:
        marks = expected.fields.contact.astype(int) + expected.fields.plastic
        np.testing.assert_array_equal(arrays["area"].T, marks)
        largest = expected.fields.pressure.max() / header["maps"]["pressure"]["high"]
        assert_sent(arrays["pressure"].T * largest, expected.fields.pressure)
    solved = header["panels"]["stiffness"]["series"]["line"]["y"]
    ratio = np.array(solved) / expected.curve.stiffness
    assert np.ptp(ratio) < 1e-9 * ratio[0]


LEAKS = {"fluid": "helium", "inlet": "6 bar", "seal": "20 mm .. 24 mm"}


@pytest.mark.parametrize("body", ["of few points", "ground"])
def test_what_leaks_is_answered_for_and_its_flux_is_that_of_the_library(page, rough, request, body):
    said = {"example": "ground", **PAIR, **SMALL, "loads": "50 MPa"}
    if body == "of few points":
        request.getfixturevalue("few_loads")
        said = {**page.bring(rough), **PAIR, "loads": "50 MPa", "grid_error": "no"}
        said["crop"] = "0 um, 500 um, 0 um, 500 um"
    header, arrays = page.ask("answer", {**said, **LEAKS})
    answers = {row[0]: row[1] for row in header["tables"]["measured-answers"][1]}
    assert "mbar l/s" in answers["leak rate q_pV"]
    assert any(figure["name"].startswith("leak rate") for figure in header["figures"]["answers"])
    question = page_question({**said, **LEAKS}, first_source({**said, **LEAKS}, page.session))
    fields = rl.assess_body(question).fields_of_gap
    path = question.sealing.free_path  # the gas slips
    flow = max(
        rl.flow(fields, along="both", mean_free_path=path),
        key=lambda each: each.hydraulic_aperture,
    )
    shown, look = arrays["flux"].T, header["maps"]["flux"]
    np.testing.assert_array_equal(np.isnan(shown), flow.gap == 0)
    width = flow.sizes[1] if flow.along == "x" else flow.sizes[0]
    flux = np.hypot(*flow.flux) * width / flow.inflow
    flows = flux > 0.01
    most = HALF_A_STEP * (look["high"] - np.nanmin(shown))  # of the logarithms, as they are sent
    np.testing.assert_allclose(shown[flows], np.log10(flux[flows]), rtol=1e-9, atol=most)
    place = [(i + 0.5) / n for i, n in zip(flow.constriction, flow.gap.shape, strict=True)]
    assert look["rings"] == [pytest.approx(place)]
    direction = "from left to right" if flow.along == "x" else "downwards"
    assert f"{direction}, the map repeated on all sides; corrected area" in look["caption"]
    without, arrays = page.ask("answer", said)
    assert "flux" not in without["maps"]
    assert "flux" not in arrays


def test_an_assessment_is_solved_once(page, cells, only_drawn, monkeypatch):
    only_drawn()
    said = {"example": "film", **PAIR, **cells}
    first, _ = page.ask("answer", said)

    def never(*_, **__):
        raise AssertionError("solved again")

    monkeypatch.setattr("roughline.lab.measured.answers.assess_body", never)
    again, _ = page.ask("answer", said)
    assert again == first
    assert page.ask("report", said)[0]["files"]


@pytest.mark.parametrize("body", ["of few points", "film"])
def test_both_models_are_compared_as_by_the_command(page, rough, body):
    said = {"example": "film"} if body == "film" else page.bring(rough)
    page.ask("look", said)
    source = first_source(said, page.session)
    expected = compare_models(NamedBody(rl.read(source.path), source.name))
    header, _ = page.ask("compare", said)
    assert table_of(header, "models") == comparison_table(expected)
    assert header["words"]["verdict"] == sentence(verdict_in_words(expected))
    error, at = page.refusal("compare", {"example": "shaft"})
    assert at == "compare"
    assert "turned-shaft.txt holds a line" in error


FILES = ("al3d-1.al3d", "di-1.di", "opd-1.opd", "dektak-1.csv", "mitutoyo_mock.xlsx")


@pytest.mark.parametrize("name", FILES)
def test_measured_files_are_described_as_by_the_command(measured_page, topographies, name):
    said = measured_page.keys[name]
    expected = describe(topographies / name)
    for _ in range(2):  # read, and kept
        header, arrays = measured_page.ask("look", said)
        table = [tuple(row) for row in header["tables"]["measured-roughness"][1]]
        assert table == description_table(expected, up_to_three_digits)
        assert header["lists"]["obstacles"] == list(expected.obstacles)
        assert header["body"]["points"] == list(expected.body.heights.shape)
        assert RANDOM not in str(header)
    assert ("channels" in dict(table)) == bool(header["asks"]["channels"])
    assert np.isnan(heights_of(header, arrays)).any() == bool(expected.missing.count)


@pytest.mark.parametrize("name", FILES)
def test_measured_files_are_answered_for_as_by_the_library(measured_page, topographies, name):
    said = {**measured_page.keys[name], "first": "steel", "second": "copper", "loads": "10 uN"}
    expected = rl.assess(
        rl.Question(
            topographies / name,
            materials=("steel", "copper"),
            loads=["10 uN"],
            whole_curve=True,
            preparation=rl.Preparation(points=96),
        )
    )
    header, _ = measured_page.ask("answer", {**said, "resample": "96"})
    assert header["tables"]["measured-answers"][:2] == list(in_answers(expected))
    assert RANDOM not in str(header)


def test_what_a_file_leaves_open_is_asked(measured_page):
    said = measured_page.keys["xy-1.txt"]
    header, _ = measured_page.ask("look", said)
    assert header["asks"]["unit"]
    assert header["lists"]["obstacles"] == [
        'xy-1.txt states no unit; give the unit of its lengths, such as unit "um"'
    ]
    assert header["body"] is None
    header, _ = measured_page.ask("look", {**said, "unit": "um"})
    assert header["lists"]["obstacles"] == []
    assert header["body"]["sides"][0] == pytest.approx(187.19e-6, rel=1e-3)
    error, at = measured_page.refused("look", {**said, "unit": "parsnip"})
    assert at == "unit"
    assert "parsnip" in error


@pytest.mark.parametrize("file", ["of few points", "sur-3.sur"])
def test_a_file_of_which_most_is_missing_is_shown_and_can_be_allowed(page, rough, request, file):
    if file == "of few points":
        heights = rl.read(rough).heights.copy()
        heights[:, :57] = np.nan
        np.save(rough.with_suffix(".npy"), heights)
        said = {**page.bring(rough.with_suffix(".npy")), "unit": "m", "size": "1 mm"}
        missing, share = 57 * 64, 57 / 64
    else:
        page = request.getfixturevalue("measured_page")
        said, missing, share = page.keys[file], 233009, 0.8889
    header, arrays = page.ask("look", said)
    assert "allow more (most missing)" in header["lists"]["obstacles"][0]
    assert np.isnan(arrays["height"]).mean() == pytest.approx(share, abs=1e-4)
    header, _ = page.ask("look", {**said, "most_missing": "95 %"})
    filled = f"{missing} missing points ({share:.2%}) filled"
    assert any(filled in each for each in header["lists"]["remarks"])


def test_masked_points_are_used_or_left_out(page, tmp_path):
    heights = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(24, 1).heights
    mask = np.zeros((24, 24))
    mask[3:9, 5:11] = 1.0
    named = {"0_data": field(heights, sides=(1e-3, 1e-3)), "0_mask": field(mask, z="")}
    (tmp_path / "map.gwy").write_bytes(gwy(**named))
    said = page.bring(tmp_path / "map.gwy")
    header, _ = page.ask("look", said)
    assert any("6.2% of the points; their heights" in each for each in header["lists"]["remarks"])
    said["mask"] = "leave-out"
    header, _ = page.ask("look", said)
    assert any("36 missing points" in each for each in header["lists"]["remarks"])
    assert "mask='leave-out'" in page.ask("code", {**said, **PAIR}, which="python")[0]["text"]
    assert "--mask leave-out" in page.ask("code", {**said, **PAIR}, which="command")[0]["text"]


def test_an_array_needs_unit_and_size(page, tmp_path):
    heights = rl.SelfAffine(hurst=0.8, length=1e3, rms_height=1.0).surface(32, 1).heights
    np.save(tmp_path / "map.npy", heights)
    said = page.bring(tmp_path / "map.npy", "my <b>map</b>.npy")
    header, arrays = page.ask("look", said)
    assert header["asks"] == {"unit": True, "size": True, "channels": []}
    assert len(header["lists"]["obstacles"]) == 2
    assert header["maps"]["height"]["along"] == "points"
    assert_sent(arrays["height"].T, heights)
    header, _ = page.ask("look", {**said, "unit": "um", "size": "1 mm"})
    assert header["body"]["sides"] == [1e-3, 1e-3]


def test_damaged_empty_misnamed_and_large_files_are_refused_in_a_sentence(page, tmp_path):
    for name, content, told in (
        ("empty.x3p", b"", "is empty: export it again"),
        ("text.sur", b"this is no topography\n", "damaged or of a type that is not known"),
        ("no.npy", b"\x93NUMPY garbage", "holds no array of real heights"),
        ("cut.x3p", b"PK\x03\x04" + bytes(400), "export it again"),
        ("<img src=x>.nc", bytes(range(256)) * 20, "export it again"),
    ):
        (tmp_path / "came").write_bytes(content)
        file = tmp_path / f"file{name.rpartition('.')[1]}{name.rpartition('.')[2]}"
        file.write_bytes(content)
        for task in ("look", "answer"):
            error, at = page.refusal(task, {**page.bring(file, name), **PAIR})
            assert name in error
            assert told in error
            assert at in ("file", "answers")


def test_measured_files_that_are_damaged_are_refused_by_their_own_name(measured_page):
    error, at = measured_page.refusal("look", measured_page.keys["di_corrupted.di"])
    assert at == "file"
    assert error.startswith("di_corrupted.di is damaged")


@pytest.mark.parametrize(
    ("said", "task", "at", "told"),
    [
        ({"first": "steal"}, "bodies", "first", 'did you mean "steel"'),
        ({"second": ""}, "bodies", "second", 'give the smooth body, such as "copper"'),
        ({"first": "rigid", "second": "rigid"}, "bodies", "second", "must give way"),
        ({"low_pass": "1 km"}, "prepare", "low_pass", "longer than the topography"),
        ({"blur": "1 km"}, "prepare", "blur", "a shorter one is needed"),
        ({"blur": "-1 um"}, "look", "blur", "a length from 0 on is needed"),
        ({"tip_radius": "0 um"}, "look", "tip_radius", "a positive, finite length is needed"),
        ({"pixels": "nonsense"}, "look", "pixels", "allowed are"),
        ({"friction": "nan"}, "bodies", "friction", "above 0 and up to 5"),
        ({"friction": "0,3"}, "bodies", "friction", "no commas"),
        ({"friction": "abc"}, "bodies", "friction", "such as 0.3"),
        ({"bodies": "modulus"}, "bodies", "E", 'such as "110 GPa"'),
        ({"bodies": "modulus", "E": "110"}, "bodies", "E", "without a unit"),
        ({"bodies": "modulus", "E": "-1 Pa"}, "bodies", "E", "a positive, finite contact modulus"),
        ({"loads": "10"}, "bodies", "loads", "give a total force"),
        ({"loads": "-3 N"}, "bodies", "loads", "give positive ones"),
        ({"loads": "0,5 N"}, "bodies", "loads", "decimal point"),
        ({"hardness": "soft"}, "bodies", "hardness", "no quantity in Pa"),
        ({"hardness": "-2 GPa"}, "bodies", "hardness", "a positive pressure is needed"),
        ({"hardness": "2 GPa", "elastic": "yes"}, "answer", "hardness", 'and "elastic" contradict'),
        ({"elastic": "perhaps"}, "bodies", "elastic", "allowed are"),
        ({"joint_area": "2"}, "bodies", "joint_area", "without a unit"),
        ({"joint_area": "1 nm^2"}, "answer", "answers", "less than the map"),
        *(
            ({key: text, "bodies": "modulus", "E": "1 GPa"}, "bodies", key, "two materials")
            for key, text in NEEDING.items()
        ),
        ({"loads": "900 MPa"}, "answer", "answers", "hardness"),
        ({"friction": "rough"}, "answer", "friction", "such as 0.3"),
        ({"friction": "nan", "joint_area": "1 cm^2"}, "answer", "friction", "up to 5 is needed"),
        ({"frequency": "5 m"}, "answer", "frequency", "no quantity in Hz"),
        ({"theories": "hertz"}, "answer", "theories", '"hertz"; allowed are "persson"'),
        ({"fluid": "watr"}, "bodies", "fluid", 'did you mean "water"'),
        ({"inlet": "6 bar"}, "bodies", "inlet", "belongs to a fluid"),
        ({"fluid": "water", "inlet": "6 bar"}, "bodies", "inlet", "needs seal"),
        ({"fluid": "water", "seal": "24 mm .. 20 mm"}, "bodies", "seal", "inner radius"),
        ({"fluid": "water", "flow_along": "z"}, "bodies", "flow_along", "allowed are"),
        ({"crop": "1, 2"}, "prepare", "crop", "without a unit"),
        ({"crop": "0 um, 1 um"}, "prepare", "crop", "give 4"),
        ({"crop": "0 um, 1 um, 2 um"}, "prepare", "crop", "give from and to along each side"),
        ({"low_pass": "-1 um"}, "prepare", "low_pass", "a positive, finite length"),
        ({"resample": "1.5"}, "prepare", "resample", "whole numbers of at least 2"),
        ({"trend": "cubic"}, "prepare", "trend", "allowed are"),
        ({"most_missing": "120%"}, "look", "most_missing", "from 0 to below 1"),
        ({"v": "7"}, "look", "v", "reads version 1"),
        ({"parsnip": "1"}, "look", "v", "does not know"),
        ({"example": "mars"}, "look", "file", "there is no example"),
        ({"file": "another"}, "look", "file", "the file is no longer here: choose it again"),
        ({**COATED, "first": "gold on copper"}, "bodies", "first", '"gold" is no layer: write its'),
        ({**COATED, "second": "rubber 2 mm on"}, "bodies", "second", '"on" stands between a layer'),
        ({"second": "rubber -2 mm on steel"}, "bodies", "second", "a positive, finite thickness"),
        ({**COATED, "friction": "0.3"}, "bodies", "friction", "partial slip (friction) follows"),
        ({"friction": "30"}, "bodies", "friction", "above 0 and up to 5"),
        ({"joint_area": "1e300 m^2"}, "bodies", "joint_area", "up to 1 km²"),
        ({**ELASTIC, "adhesion": "50 mJ/m^2 over 1 km"}, "bodies", "adhesion", "side, 1 mm"),
        ({**ELASTIC, "adhesion": "1e300 J/m^2"}, "bodies", "adhesion", "more than the contact mod"),
        ({"resample": "100000"}, "bodies", "resample", "this lab takes up to 4096"),
        ({**ELASTIC, "loads": "1 TPa"}, "bodies", "loads", "linear elastic far below that"),
    ],
)
def test_what_cannot_be_used_is_said_at_its_control(page, rough, said, task, at, told):
    error, found = page.refused(task, {**page.bring(rough), **PAIR, **said})
    assert told in error
    assert found == at


@pytest.mark.parametrize(
    ("adhesion", "mended"), [("50 mJ/m^2", ["adhesion"]), ("sticky", []), ("", [])]
)
def test_what_elastic_bodies_would_have_is_known(page, rough, adhesion, mended):
    header, _ = page.ask("bodies", {**page.bring(rough), **PAIR, "adhesion": adhesion}, sides=None)
    assert header["mended_if_elastic"] == mended


def test_bodies_and_loads_are_said_as_soon_as_they_can_be_read(page):
    said = {**PAIR, "loads": "2 MPa; 10 N", "theories": "persson,bush-gibson-thomas"}
    header, _ = page.ask("bodies", said, sides=[1e-3, 0.5e-3])
    steel, copper = map(rl.material, ("steel", "copper"))
    rows = header["tables"]["measured-bodies"][1]
    assert rows[0] == ["contact modulus E*", f"{rl.contact_modulus(steel, copper) / 1e9:#.3g} GPa"]
    assert rows[-1] == ["yield", f"at {copper.hardness / 1e6:g} MPa, known to a factor of 1.5"]
    first, second = header["lists"]["loads"]
    assert first.startswith("load 2 MPa: 1 N in all, 2 MPa over the nominal area")
    assert "20 MPa over" in second
    assert "theories Persson and Bush, Gibson, Thomas" in header["words"]["line-bodies"]
    assert page.refusal("bodies", said, sides=["a"])[1] == ""
    header, _ = page.ask("bodies", {**PAIR, "first": "E=70 GPa nu=0.33"}, sides=None)
    assert header["lists"]["loads"] == []
    note = "hardness of the first body (E=70 GPa nu=0.33)"
    assert any(note in each for each in header["lists"]["bodies-notes"])
    for yields, told in (
        ({"hardness": "2 GPa"}, "at 2.00 GPa, as given"),
        ({"elastic": "yes"}, "left out"),
    ):
        header, _ = page.ask("bodies", {**PAIR, **yields}, sides=None)
        assert ["yield", told] in header["tables"]["measured-bodies"][1]


def test_no_file_that_is_taken_away_tells_where_the_upload_lay(
    page, loads_of_curve, tmp_path, rough, only_drawn
):
    said = {**page.bring(rough, "Müller <1>.nc"), **PAIR}
    if loads_of_curve == "few loads":
        only_drawn("curve")
        said |= {"resample": "32", "grid_error": "no"}
    header, _ = page.ask("report", said)
    results = page.folder / "results"
    assert {"report.html", "report.pdf", "curve.nc"} <= header["files"].keys()
    for place in header["files"].values():
        assert re.fullmatch(r"[\w.-]+", place, re.ASCII)
        content = (results / place).read_bytes()
        assert RANDOM.encode() not in content
        assert str(tmp_path).encode() not in content
    html = (results / header["files"]["report.html"]).read_text(encoding="utf-8")
    assert "<h1>Contact of Müller &lt;1&gt;.nc</h1>" in html
    with xarray.open_dataset(results / header["files"]["curve.nc"], engine="h5netcdf") as curve:
        assert curve.attrs["body_file"] == "Müller <1>.nc"


EVERY = {
    **{"unit": "um", "size": "0.4 mm", "fill": "nearest", "most_missing": "20 %"},
    **{"tilt": "mounting", "pixels": "means", "blur": "0.3 um", "tip_radius": "2 um"},
    **{"trend": "curvature", "crop": "0 um, 300 um, 0 um, 300 um", "low_pass": "10 um"},
    **{"resample": "16", "lines": "median", "scars": "remove", "outliers": "remove"},
    **{"first": "E=70 GPa nu=0.33", "second": "copper"},
    **{"loads": "2 MPa; 0.5 N", "hardness": "2 GPa", "joint_area": "2 cm^2", "friction": "0.30"},
    **{"frequency": "5 MHz", "fluid": "oil VG 46", "inlet": "6 bar", "outlet": "2 bar"},
    **{"fluid_carries": "no", "seal": "20 mm .. 24 mm", "flow_along": "x"},
    **{"theories": "persson,greenwood-williamson"},
    **{"grid_error": "yes", "boundary": "periodic", "sealing_pressure": "yes"},
}
STICKING = {
    **{**PAIR, "unit": "um", "size": "0.4 mm", "elastic": "yes", "grid_error": "no"},
    **{"adhesion": "50 mJ/m^2 over 200 nm", "second": "gold 20 µm on copper"},
}
WITHOUT_LOADS = {
    **{**PAIR, "unit": "um", "size": "0.4 mm", "loads": "", "friction": "0.123456789"},
    **{"resample": "8", "grid_error": "no"},
}
BY_MODULUS = {"bodies": "modulus", "E": "110 GPa", "loads": "2 MPa", "unit": "um", "size": "1 mm"}


def run(text, which, folder, programs=Path(sys.executable).parent):
    """Run code as who takes it along does, in a folder with the files; return what it printed."""
    file = folder / f"again.{which}"
    file.write_text(text, encoding="utf-8")
    program = [sys.executable if which == "python" else "bash", str(file)]
    path = os.pathsep.join(map(str, [programs, Path(sys.executable).parent, os.environ["PATH"]]))
    environment = {**os.environ, "PATH": path, "PYTHONIOENCODING": "utf-8", "COLUMNS": "250"}
    return subprocess.run(
        program, cwd=folder, env=environment, capture_output=True, check=False, encoding="utf-8"
    )


@pytest.fixture
def run_here(few_loads, invoke, only_drawn, tmp_path_factory, monkeypatch, capsys):
    """Run code in this process, a command with the words that a shell gives it."""
    programs = tmp_path_factory.mktemp("programs")
    (programs / "roughline").write_text("#!/bin/sh\nprintf '%s\\0' \"$@\"\n")
    (programs / "roughline").chmod(0o700)
    only_drawn()
    monkeypatch.setenv("COLUMNS", "250")

    def run_in(text, which, folder):
        monkeypatch.chdir(folder)
        if which == "python":
            exec(text, {})
            return SimpleNamespace(returncode=0, stdout=capsys.readouterr().out, stderr="")
        words = run(text, which, folder, programs).stdout.split("\0")[:-1]
        code, out, errors = invoke(*words)
        return SimpleNamespace(returncode=code, stdout=out, stderr=errors)

    return run_in


@pytest.fixture(params=["here", "in processes"])
def run_code(request):
    """Run code in this process, or in processes of its own."""
    return run if request.param == "in processes" else request.getfixturevalue("run_here")


def printed(out, result):
    """Check that lines of Python printed the values of all answers, to the digits printed."""
    lines = " ".join(line for line in out.splitlines() if not line.startswith("note:"))
    for answer in result.answers.values():
        found = re.search(rf"{re.escape(f'{answer.name} {answer.symbol}')} \[([^]]*)]", lines)
        values = np.array(found[1].split(), float)
        np.testing.assert_allclose(values, answer.values, rtol=1e-7, atol=1e-8)


def is_told(figure, out):
    """Whether the numbers of a figure are printed, to the digits that are printed."""
    numbers = re.compile(r"\d+(?:\.\d+)?")
    printed = [
        (float(each), 0.501 * 10.0 ** -len(each.partition(".")[2])) for each in numbers.findall(out)
    ]
    return all(
        any(
            math.isclose(float(text), value, rel_tol=0.05)  # 300 stands for 297
            or ("." in text and half < 0.5 and abs(float(text) - value) <= half)
            for value, half in printed
        )
        for text in numbers.findall(f"{figure['value']} {figure['interval']}")
    )


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("-a #1, b & 'c' \"d\" $HOME µ.npy", EVERY),
        ("~b `x`; c.npy", STICKING),
        ("c.npy", WITHOUT_LOADS),
        ("d=e é.npy", BY_MODULUS),
    ],
)
def test_code_runs_as_it_is_and_gives_the_same(page, run_code, tmp_path, name, said):
    spectrum = rl.SelfAffine(hurst=0.7, length=400, rms_height=1, q_roll=0.06)
    heights = spectrum.surface(32, 3).heights.copy()
    heights[np.random.default_rng(1).random(heights.shape) < 0.02] = np.nan
    folder = tmp_path / "again"
    folder.mkdir()
    np.save(folder / name, heights)
    said = {**page.bring(folder / name), **said}
    answered, _ = page.ask("answer", said)
    result = assessed({"state": said, "session": page.session}, lambda done, total: None)
    done = {
        which: run_code(page.ask("code", said, which=which)[0]["text"], which, folder)
        for which in ("python", "command")
    }
    assert all(each.returncode == 0 for each in done.values()), done
    printed(done["python"].stdout, result)
    with xarray.open_dataset(folder / "curve.nc", engine="h5netcdf") as curve:
        np.testing.assert_array_equal(curve.stiffness, result.curve.stiffness)
    out = " ".join(done["command"].stdout.split())
    for figure in answered["figures"]["answers"]:
        assert figure["name"] in out
        assert is_told(figure, out)


def test_code_of_an_example_brings_its_file(page, run_code, tmp_path):
    said = {"example": "shaft", **PAIR, **({} if run_code is run else {"grid_error": "no"})}
    answered, _ = page.ask("answer", said)
    for which in ("python", "command"):
        folder = tmp_path / which
        folder.mkdir()
        done = run_code(page.ask("code", said, which=which)[0]["text"], which, folder)
        assert done.returncode == 0, done.stderr
        assert (folder / EXAMPLES["shaft"].file).exists()
    assert is_told(answered["figures"]["answers"][0], done.stdout)


def test_code_of_several_maps_of_which_one_is_refused_runs(page, part, run_code, tmp_path):
    keys = dict(list(part[0].items())[: None if run_code is run else 3])
    said = {"file": ",".join(keys.values()), **PAIR, "joint_area": "2 cm^2", "grid_error": "no"}
    figures = page.ask("answer", said)[0]["figures"]["part"]
    for which in ("python", "command"):
        text = page.ask("code", said, which=which)[0]["text"]
        if which == "python":
            assert f"[{', '.join(map(repr, keys))}]" in text
        else:
            words = shlex.split(text)
            assert words[: 2 + len(keys)] == ["roughline", "press", *keys]
            assert words[words.index("--joint-area") + 1] == "2 cm^2"
        done = run_code(text, which, tmp_path)
        assert done.returncode == (0 if which == "python" else 1), done.stderr  # as it says itself
        assert "broken.x3p: this file is damaged" in " ".join((done.stdout + done.stderr).split())
    assert all(is_told(each, done.stdout) for each in figures)


def test_every_field_with_a_flag_and_a_control_is_run_above():
    of_some_files = {"channel", "mask"}  # which files of one channel and without a mask refuse
    assert set(BY_CONTROL) - of_some_files <= {*EVERY, *STICKING}


def test_a_coated_body_is_typed_into_the_control_of_its_material(page, cells):
    said = {"example": "ground", **cells, **COATED, "elastic": "yes"}
    header, _ = page.ask("bodies", said, sides=SIDES)
    assert header["refused"] == {}
    rows = dict(header["tables"]["measured-bodies"][1])
    assert rows["rough body"].startswith("gold 20 µm on nickel 40 µm on copper: gold (E = 78 GPa")
    note = "no tangential stiffness of coated bodies: its"
    assert any(note in each for each in header["lists"]["bodies-notes"])
    answered, _ = page.ask("answer", said)
    words = answered["words"]
    assert words["modulus"].startswith("E* of gold and steel, which lie at the surfaces, = ")
    assert "old 20 µm on nickel 40 µm on copper, against steel under" in words["answers-lead"]
    question = page_question(said, first_source(said, page.session))
    assert answered["tables"]["measured-answers"][:2] == list(in_answers(rl.assess(question)))
    words = shlex.split(page.ask("code", said, which="command")[0]["text"])
    assert words[words.index("--materials") + 1] == f"{COATED['first']}, steel"


def test_layers_thinner_than_half_a_cell_are_refused_where_the_grid_is_known(page):
    said = {"example": "ground", **SMALL, **COATED, "first": "gold 50 nm on copper"}
    header, _ = page.ask("bodies", said, sides=SIDES)
    assert header["refused"] == {}
    error, at = page.refusal("answer", said)
    assert "have a layer of gold, 50 nm, thinner than half a cell of" in error
    assert at == "first"


def test_what_a_crop_and_a_low_pass_keep_is_drawn_where_it_was(page, tmp_path):
    heights = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, 7).heights
    np.save(tmp_path / "map.npy", heights)
    said = {**page.bring(tmp_path / "map.npy"), "unit": "m", "size": "1 mm"}
    said |= {"crop": "250 um, 750 um, 0 um, 1 mm", "low_pass": "125 um"}
    header, arrays = page.ask("prepare", said)
    after = header["maps"]["after"]
    assert after["corner"] == pytest.approx([0.25 + 4 / 64, 4 / 64])  # mm
    assert after["sizes"] == pytest.approx([0.5 - 8 / 64, 1 - 8 / 64])
    assert arrays["after"].shape == (64 - 8, 32 - 8)


def test_a_crop_to_where_points_are_known_opens_a_file_that_is_refused_whole(page, tmp_path):
    heights = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, 7).heights.copy()
    heights[32:] = heights[3, 4] = np.nan
    np.save(tmp_path / "half.npy", heights)
    said = {**page.bring(tmp_path / "half.npy"), "unit": "m", "size": "1 mm"}
    header, _ = page.ask("look", said)
    assert "2049 missing points" in header["lists"]["obstacles"][0]
    for crop, points, missing in (
        ("0 um, 500 um, 0 um, 1 mm", (32, 64), 1),
        ("250 um, 500 um, 0 um, 1 mm", (16, 64), 0),
    ):
        header, _ = page.ask("prepare", {**said, "crop": crop})
        assert header["lists"]["obstacles"] == []
        assert tuple(header["body"]["points"]) == points
        remarks = header["lists"]["prepared-remarks"]
        filled = [remark for remark in remarks if "filled" in remark]
        assert filled == ["1 missing points (0.05%) filled: harmonic"] * missing


def test_a_contact_modulus_alone_gives_a_curve(page, only_drawn):
    only_drawn()
    said = {"example": "film", **SMALL, "bodies": "modulus", "E": "110 GPa"}
    header, _ = page.ask("answer", said)
    assert len(header["tables"]["measured-answers"][1]) == 20
    files, _ = page.ask("report", said)
    assert "report.html" not in files["files"]
    assert "curve.nc" in files["files"]


def test_names_of_arguments_are_those_of_the_controls(page):
    header, _ = page.ask("answer", {"example": "film", **PAIR, "resample": "32"})
    assert any(
        'with grid error "estimate" it is estimated nevertheless' in each
        for each in header["remarks"]["What the intervals include"]
    )


def test_state_is_text_alone():
    assert control_texts({"state": {"first": " steel ", "second": ""}}) == {"first": "steel"}


def test_a_joint_is_answered_for_with_its_area(page, cells):
    said = {"example": "film", **PAIR, **cells, "loads": "1 kN", "joint_area": "1 cm^2"}
    page.ask("look", said)
    expected = rl.assess(page_question(said, first_source(said, page.session)))
    assert expected.question.joint == pytest.approx(1e-4)
    header, _ = page.ask("answer", said)
    assert header["tables"]["measured-answers"][:2] == list(in_answers(expected))
    panel = header["panels"]["stiffness"]
    assert panel["axes"][0] == "force F on the joint [kN]"
    assert max(panel["series"]["line"]["x"]) == pytest.approx(1)
    told, _ = page.ask("bodies", said, sides=list(expected.body.sizes))
    assert "1 kN on the joint of 100 mm²" in told["lists"]["loads"][0]


@pytest.fixture
def part(page, tmp_path):
    """Three maps of one part and a damaged file: their keys by name, and their paths."""
    keys, paths = {}, []
    whole = rl.SelfAffine(
        hurst=0.7, length=4e-4, rms_height=1e-6, q_roll=2 * np.pi / 25e-6
    ).surface(128, 3)
    for i in range(3):
        piece = whole.cropped((40 * i, 40 * i + 32), (0, 32)).detrended()
        paths.append(tmp_path / f"place {i}.nc")
        rl.write(rl.Surface(piece.heights, piece.sizes, "m"), paths[-1])
    paths.insert(1, tmp_path / "broken.x3p")
    paths[1].write_bytes(b"PK\x03\x04" + bytes(300))
    for path in paths:
        keys[path.name] = page.bring(path)["file"]
    return keys, paths


def test_maps_of_a_part_are_checked_one_by_one(page, part):
    keys, _ = part
    header, _ = page.ask("maps", {"file": ",".join(keys.values())})
    rows = {each["name"]: each for each in header["maps"]}
    assert list(rows) == list(keys)
    assert rows["place 0.nc"]["cells"][:2] == ["32 x 32", "100 µm x 100 µm"]
    assert "damaged" in rows["broken.x3p"]["refused"]
    assert RANDOM not in str(header)


def test_a_part_is_answered_for_as_by_the_library_and_its_maps_are_kept(
    page, part, loads_of_curve, monkeypatch
):
    keys, paths = part
    said = {"file": ",".join(keys.values()), **PAIR, "loads": "2 MPa; 20 MPa", "grid_error": "no"}
    header, arrays = page.ask("answer", said, map=2)
    assert all(done <= total for done, total in page.steps)
    expected = rl.assess(
        rl.Question(
            paths,
            materials=("steel", "copper"),
            loads=["2 MPa", "20 MPa"],
            whole_curve=True,
            grid_error=False,
        )
    )
    given = header["part"]
    assert given["names"] == expected.names == ["place 0.nc", "place 1.nc", "place 2.nc"]
    tables = header["tables"]
    assert tables["measured-part-answers"][:2] == list(
        answer_table(expected, write=up_to_three_digits)
    )
    assert tables["measured-part-leading"] == list(leading_table(expected, up_to_three_digits))
    assert tables["measured-part-maps"] == list(maps_table(expected))
    assert any("broken.x3p" in each for each in header["remarks"]["Limits"])
    drawn = header["choices"]["part"]["contact stiffness k"]["series"]
    mean = expected.answers["contact_stiffness"].mean[1]
    first = expected.assessments[0].answers["contact_stiffness"].values[1]
    assert drawn["mean"]["y"][0] / drawn["maps"]["y"][0] == pytest.approx(mean / first)
    alone = expected.assessments[2]
    assert header["tables"]["measured-answers"][:2] == list(in_answers(alone))
    marks = alone.fields.contact.astype(int) + alone.fields.plastic
    np.testing.assert_array_equal(arrays["area"].T, marks)

    def never(*_, **__):
        raise AssertionError("solved again")

    monkeypatch.setattr("roughline.lab.measured.answers.assess_body", never)
    alone = {**said, "file": keys["place 1.nc"]}
    assert page.ask("answer", alone)[0]["tables"]["measured-answers"][:2] == list(
        in_answers(expected.assessments[1])
    )


def test_the_report_of_a_part_comes_with_all_of_its_maps(page, part, loads_of_curve, monkeypatch):
    keys, _ = part

    def written(part, folder, command):
        for name in part.names:
            (folder / name).mkdir(parents=True)
            (folder / name / "report.html").write_text(command)
        (folder / "report.html").write_text(f"<h1>{len(part.names)} maps</h1>")

    monkeypatch.setattr("roughline.lab.measured.documents.write_part_report", written)
    header, _ = page.ask("report", {"file": ",".join(keys.values()), **PAIR, "grid_error": "no"})
    assert header["files"].keys() == {"report.html", "all-maps.zip"}
    results = page.folder / "results"
    assert (results / header["files"]["report.html"]).read_text() == "<h1>3 maps</h1>"
    with ZipFile(results / header["files"]["all-maps.zip"]) as packed:
        assert "report.html" in packed.namelist()
        told = packed.read("place 2.nc/report.html").decode()
    assert told.startswith("roughline press 'place 0.nc' broken.x3p")


def test_a_part_needs_materials_and_loads(page, part):
    keys, _ = part
    said = {"file": ",".join(keys.values())}
    error, at = page.refusal("answer", {**said, "bodies": "modulus", "E": "1 GPa", "loads": "1 N"})
    assert "need two materials" in error
    assert at == "answers"
    assert "under the same loads" in page.refusal("answer", {**said, **PAIR, "loads": ""})[0]
    broken = keys["broken.x3p"]
    assert "none of the 2 maps" in page.refusal("answer", {**PAIR, "file": f"{broken},{broken}"})[0]
    assert page.refusal("maps", {"file": f"{broken},gone"})[0].startswith("one of the files is no")
