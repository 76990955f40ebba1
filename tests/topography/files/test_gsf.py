"""Gwyddion's simple field: heights, sides and units as its head states them."""

import numpy as np
import pytest

import roughline as rl
from mutated_heads import assert_read_or_refused
from random_cases import cases, seeds
from roughline.topography.files.read import measurement

ROWS = np.random.default_rng(3).normal(size=(12, 9)).astype("<f4")
STATED = {"XRes": "9", "YRes": "12", "XReal": "1.5e-05", "YReal": "8e-06", "XYUnits": "m"}
STATED |= {"ZUnits": "m", "Title": "Height"}


def gsf(rows=ROWS, **changed):
    stated = {key: value for key, value in (STATED | changed).items() if value is not None}
    head = "Gwyddion Simple Field 1.0\n" + "".join(f"{k} = {v}\n" for k, v in stated.items())
    data = head.encode()
    return data + b"\0" * (4 - len(data) % 4) + rows.tobytes()


def read(folder, data):
    (folder / "map.gsf").write_bytes(data)
    return measurement(folder / "map.gsf")


@pytest.mark.parametrize("title", ["a", "ab", "abc", "µm²"])  # of every length over four
def test_a_field_is_read_as_it_was_written(tmp_path, title):
    holed = ROWS.copy()
    holed[2, 5] = np.nan
    found = read(tmp_path, gsf(holed, Title=title))
    assert (found.kind, found.unit, found.sizes) == ("surface", "m", (1.5e-5, 8e-6))
    assert (found.format, found.reader, found.channel) == ("GSF", "", title)
    assert np.array_equal(found.heights, holed.T.astype(float), equal_nan=True)
    assert rl.read(tmp_path / "map.gsf").settings["missing_points"] == 1


def test_units_with_prefixes_count(tmp_path):
    found = read(tmp_path, gsf(XReal="15", YReal="8", XYUnits="um", ZUnits="nm"))
    assert (found.unit, found.sizes) == ("m", pytest.approx((1.5e-5, 8e-6)))
    assert found.heights == pytest.approx(1e-9 * ROWS.T)


def test_what_is_not_stated_is_asked_for(tmp_path):
    read(tmp_path, gsf(ZUnits=None))
    with pytest.raises(rl.UnitError, match="states its sizes in m and no unit of its heights"):
        rl.read(tmp_path / "map.gsf")
    assert rl.read(tmp_path / "map.gsf", "nm").sizes == (1.5e-5, 8e-6)
    for missing in ("XReal", "XYUnits"):
        read(tmp_path, gsf(**{missing: None}))
        with pytest.raises(rl.InputError, match="states no sizes"):
            rl.read(tmp_path / "map.gsf")
        assert rl.read(tmp_path / "map.gsf", sizes=(1e-5, 1e-5)).sizes == (1e-5, 1e-5)


def test_one_row_or_one_column_is_a_line(tmp_path):
    found = read(tmp_path, gsf(ROWS[:1], YRes="1"))
    assert (found.kind, found.sizes) == ("profile", (1.5e-5,))
    assert (found.heights == ROWS[0]).all()
    found = read(tmp_path, gsf(ROWS[:, :1], XRes="1", XReal=None))
    assert (found.kind, found.sizes) == ("profile", (8e-6,))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (gsf(ZUnits="V"), 'holds values in "V", which is no unit of length'),
        (gsf(XYUnits="deg"), 'holds sides in "deg", which is no unit of length'),
        (gsf(XRes="8"), "states 8 x 12 heights and has 108"),
        (gsf(YRes=None), "lacks YRes; a GSF file has a whole number above 0 there"),
        (gsf(XReal="-1"), 'states XReal = "-1"; a GSF file has a length above 0'),
        (gsf(XRes="1000000", YRes="1000000"), "declares 1000000 x 1000000 points"),
        (gsf()[:-3], "states 9 x 12 heights and has 107.25: it was cut short"),
        (gsf()[:80], "without an end of its head"),
        (gsf(XReal="1e308", XYUnits="km"), "states sides of inf x"),
    ],
)
def test_a_field_that_contradicts_itself_is_refused(tmp_path, data, message):
    with pytest.raises(rl.InputError) as caught:
        read(tmp_path, data)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@seeds(20, cases(2000, 16))
def test_a_changed_head_gives_what_it_states_or_one_line(tmp_path, seeds):
    def is_right(found, changed):
        lines = [line.split("=") for line in changed.split(b"\0")[0].decode("latin-1").split("\n")]
        stated = {line[0].strip(): line[1].strip() for line in lines if len(line) > 1}
        same = np.array_equal(found.heights, ROWS.T.astype(float))
        if found.unit and found.sizes and stated.get("XYUnits") == stated.get("ZUnits") == "m":
            return same and found.sizes == (float(stated["XReal"]), float(stated["YReal"]))
        return same or stated.get("ZUnits") != "m"

    assert_read_or_refused(tmp_path, "m.gsf", gsf(), gsf().index(b"Title"), seeds, is_right)
