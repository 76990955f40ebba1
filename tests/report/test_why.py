"""Pages show why an answer is not known better with the numbers that it says itself."""

import re
from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console

import roughline as rl
from roughline.report.answers import groups, leading_keys
from roughline.report.document import write_document
from roughline.report.page import Section, render, render_markdown
from roughline.report.terminal import print_assessment, print_part
from roughline.report.why import TITLE, bars

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=5e4, q_high=4e5)


@pytest.fixture(scope="module")
def result():
    piece = SPECTRUM.surface(64, rng=7).cropped((0, 32), (0, 32))
    return rl.assess(rl.Question(piece, "steel,copper", loads=["3 N", "10 N"], grid_error=True))


@pytest.fixture(scope="module")
def of_stiffness(result):
    return bars(result, ["interface_stiffness"])


def told(result, capsys, **more):
    console = Console(markup=False, width=200)
    print_assessment(result, console=console, **more)
    return capsys.readouterr().out


def test_bars_are_the_reasons_the_most_first_below_the_whole_interval(result, of_stiffness):
    answer = result.answers["interface_stiffness"]
    (group,) = of_stiffness.groups
    whole, *causes = group.bars
    assert [(each.name, each.ends, each.remedy) for each in causes] == [
        (each.title, each.ends_in_words, each.remedy) for each in answer.why()
    ]
    ends = [float(each) for each in whole.ends.split(" to ")]
    at = result.largest
    assert ends == pytest.approx([each[at] / answer.values[at] for each in answer.ends], rel=5e-3)
    assert "under 10 N" in of_stiffness.about


def test_places_are_logarithms_of_multiples_of_the_value(result, of_stiffness):
    (group,) = of_stiffness.groups
    reasons = result.answers["interface_stiffness"].why()
    logs = np.log([[each.low, each.high] for each in reasons])
    places = [[each.left, each.left + each.width] for each in group.bars[1:]]
    slope, at_value = np.polyfit(logs.ravel(), np.ravel(places), 1)
    assert places == pytest.approx(at_value + slope * logs, abs=0.02)  # of rounding
    assert of_stiffness.value == pytest.approx(at_value, abs=0.02)
    low, _, high = map(float, of_stiffness.ticks)
    assert slope * np.log([low, high]) + at_value == pytest.approx([0, 100], abs=0.05)
    assert all(0 <= left < right <= 100 for left, right in places)


def test_answers_that_the_same_leaves_open_stand_together(result):
    (group,) = bars(result, ["unloading_stiffness", "tangential_stiffness"]).groups
    assert group.names == "unloading stiffness k_u and tangential stiffness k_t"


def test_nothing_is_shown_where_nothing_is_open(result):
    assert bars(result, ["normal_force", "mean_pressure"]) is None


def test_page_and_sheets_have_the_same_numbers_and_load_nothing(result, of_stiffness):
    section = Section("Mechanics", bars=of_stiffness)
    page, text = render("", "", [section]), render_markdown("", "", [section], "")
    for group in of_stiffness.groups:
        for bar in group.bars:
            row = f'<td class="ends">{bar.ends}</td><td class="remedy">{bar.remedy}</td>'
            assert f"<td>{bar.name}</td>" in page
            assert row in page
            assert f"{bar.name} | {bar.ends} | {bar.remedy}" in text
    assert not re.search(r"(?:src|href)=", page)
    (widths,) = {len(re.findall("<rect", each)) for each in page.split("<tbody>")[1:]}
    assert widths == len(of_stiffness.groups[0].bars)


def test_what_is_zero_has_its_upper_end_with_its_unit(result):
    answer = result.answers["mean_gap"]
    margin = replace(answer.margins[0], low=np.zeros(2), high=np.full(2, 3e-9))
    zero = replace(
        answer, values=np.zeros(2), low=np.zeros(2), high=np.full(2, 4e-9), margins=[margin]
    )
    (group,) = bars(replace(result, answers={"mean_gap": zero}), ["mean_gap"]).groups
    assert [each.ends for each in group.bars] == ["up to 4 nm", "up to 3 nm"]
    assert [each.width for each in group.bars] == [None, None]


def test_what_is_infinite_has_its_lower_end_with_its_unit(result):
    answer, endless = result.answers["contact_stiffness"], np.full(2, np.inf)
    margin = replace(answer.margins[0], low=np.full(2, 3e9), high=endless)
    full = replace(answer, values=endless, low=np.full(2, 2e9), high=endless, margins=[margin])
    (group,) = bars(replace(result, answers={"k": full}), ["k"]).groups
    assert [each.ends for each in group.bars] == ["2 GN/m or more", "3 GN/m or more"]
    assert [each.width for each in group.bars] == [None, None]


@pytest.mark.parametrize("low_and_high", [(0.0, 5.0), (0.5, np.inf), (np.nan, np.nan)])
def test_ends_that_have_no_logarithm_stay_on_the_axis(result, low_and_high):
    answer = result.answers["contact_stiffness"]
    low, high = (answer.values * each for each in low_and_high)
    changed = replace(answer, margins=[replace(answer.margins[0], low=low, high=high)])
    found = bars(replace(result, answers={"k": changed}), ["k"])
    bar = found.groups[0].bars[1]
    assert (bar.width is None) == bool(np.isnan(low_and_high[0]))
    assert 0 <= bar.left <= bar.left + (bar.width or 0) <= 100


def test_the_terminal_says_it_of_leading_answers_where_all_is_wanted(result, capsys):
    assert TITLE not in told(result, capsys, unfolded_by="--all")
    _, lines = told(result, capsys).split(f"{TITLE}, as multiples of the value (at the largest")
    for key in leading_keys(result):
        answer = result.answers[key]
        causes = "; ".join(f"{each.title}: {each.ends_in_words}" for each in answer.why())
        assert re.search(f"  {re.escape(answer.name)} +{re.escape(causes)}\n", lines)


def test_a_part_leaves_it_to_the_reports_of_its_maps(tmp_path, capsys):
    surface = SPECTRUM.surface(64, rng=7)
    maps = [surface.cropped((x, x + 16), (0, 16)) for x in (0, 32)]
    part = rl.assess(rl.Question(maps, "steel,copper", loads=["2 MPa"], grid_error=True))
    page, _ = write_document(part, tmp_path, "A part", [], [])
    print_part(part)
    assert TITLE not in page.read_text("utf-8")
    assert TITLE not in capsys.readouterr().out
    assert all(bars(each, groups(each)[0].keys) for each in part.assessments)
