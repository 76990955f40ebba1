"""Tables on a screen: words and numbers stay whole, and every cell is there."""

import re

import pytest

from roughline.report.columns import blocks, paragraph

HEADER = ["5 MPa", "constriction resistance R", "h_c", "contact area fraction A/A_0"]
ROWS = [
    ["al3d-1.al3d *", "7.779 mΩ (0.832 to 9.96)", "99.28 kW/(m² K)", "0.2703% (0.18 to 0.492)"],
    ["a map of a place.x3p", "2.837 Ω ± 3.2%", "11.89 MW/(m² K) (0.826 to 56)", "0.766% ± 9.1%"],
    ["b", "infinite", "-", "not solved"],
]


def words(texts):
    return sorted(word for text in texts for word in re.sub("[()]", "", text).split())


@pytest.mark.parametrize("width", [20, 30, 40, 50, 60, 80, 100, 200])
def test_no_word_is_broken_or_lost_at_any_width(width):
    laid = list(blocks(HEADER, ROWS, width))
    lines = [line for block in laid for line in (*block.header, *block.body)]
    names, *values = zip(HEADER, *ROWS, strict=True)
    # names are repeated in each block, everything else is there once
    expected = [*names * len(laid), *(cell for column in values for cell in column)]
    assert words(lines) == words(expected)
    if width >= 40:
        assert max(map(len, lines)) <= width


@pytest.mark.parametrize("width", [30, 60, 80])
def test_a_value_stands_in_one_line_with_its_unit(width):
    lines = [line for block in blocks(HEADER, ROWS, width) for line in block.body]
    for value in ("7.779 mΩ", "99.28 kW/(m² K)", "± 3.2%", "0.832 to 9.96", "not solved"):
        assert sum(value in line for line in lines) == 1, value


def test_a_map_takes_one_line_where_there_is_room():
    (block,) = blocks(HEADER, ROWS, 120)
    assert (len(block.header), len(block.body)) == (1, 3)
    (block,) = blocks(["map", "points"], [["a.x3p", "640 x 480"]], 80)
    assert list(block.body) == ["a.x3p  640 x 480"]


def test_a_long_name_stands_above_its_values():
    name = "a_file_with_a_very_long_name_that_an_instrument_gave_it.x3p"
    (block,) = blocks(["map", "points", "sides"], [[name, "640 x 480", "1 mm x 1 mm"]], 60)
    assert list(block.body) == [name, "  640 x 480  1 mm x 1 mm"]


def test_intervals_below_their_values_have_no_brackets():
    (block,) = blocks(["load", "all"], [["0.1", "+46.7% (-15.7% to +155.4%) *"]], 30)
    lines = [" ".join(line.split()) for line in block.body]
    assert lines == ["0.1 +46.7%", "-15.7% to +155.4% *"]


def test_a_paragraph_is_broken_between_words():
    text = "116 (0.04%), 3 regions, inside"
    shown = paragraph("missing", text, 9, 30)
    assert shown.splitlines() == ["missing  116 (0.04%), 3", "         regions, inside"]
