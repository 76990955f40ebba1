"""Heights in text: what is clear is read as it was written, the rest is refused in one line."""

import numpy as np
import pytest

import roughline as rl
from roughline.topography.files.read import measurement

ROWS = np.round(np.random.default_rng(3).normal(size=(12, 9)), 4)  # lines run along x
HEIGHTS = ROWS.T
HOLED = ROWS.copy()
HOLED[3, 4] = HOLED[5, 0] = HOLED[11, 8] = np.nan
DX, DY = 0.5, 0.25
SIDES = (9 * DX, 12 * DY)
X = np.arange(50) * 0.2
SCAN = np.round(np.sin(X), 4)


def written(rows, separator=" ", decimal=".", missing="nan", end="\n", form="{:.4f}"):
    """The text of a table."""
    cells = [
        [form.format(v).replace(".", decimal) if np.isfinite(v) else missing for v in row]
        for row in rows
    ]
    return end.join(separator.join(row) for row in cells) + end


def points(fast="x", leave_out=(), twice=()):
    """Rows x y z of the map, in the order in which an instrument measures them."""
    nodes = [(i, j) for j in range(12) for i in range(9)]
    if fast == "y":
        nodes.sort()
    rows = [(i * DX, j * DY, HEIGHTS[i, j]) for i, j in nodes]
    rows = [row for k, row in enumerate(rows) if k not in leave_out and k - 108 not in leave_out]
    return np.array([*rows, *(rows[k] for k in twice)])


def read(folder, text, name="table.csv"):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return measurement(path)


def refusal(folder, text, name="table.csv"):
    with pytest.raises(rl.InputError) as caught:
        read(folder, text, name)
    message = str(caught.value)
    assert name in message
    assert "\n" not in message
    assert len(message) < 260
    return message


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", "\n\n"])
@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("separator", [" ", "   ", "\t", ";", ",", ", ", " ; "])
def test_a_matrix_is_read_whatever_stands_between_its_numbers(tmp_path, separator, decimal, end):
    if separator.strip() == decimal == ",":
        return
    found = read(tmp_path, written(ROWS, separator, decimal, end=end))
    assert (found.kind, found.unit, found.sizes) == ("surface", None, None)
    assert (found.heights == HEIGHTS).all()


@pytest.mark.parametrize(
    "missing", ["NaN", "", "***", "---", "BAD", "N/A", "#N/A", "inf", "-9999", "-32768", "1e38"]
)
@pytest.mark.parametrize("separator", [" ", "\t", ";", ","])
def test_what_stands_for_missing_points_is_missing(tmp_path, separator, missing):
    if separator == " " and not missing:
        return
    found = read(tmp_path, written(HOLED, separator, missing=missing))
    assert np.array_equal(found.heights, HOLED.T, equal_nan=True)
    first = written(HOLED[[3, *range(12)]], separator, missing=missing)
    assert read(tmp_path, first).heights.shape == (9, 13)  # the first row is no header


@pytest.mark.parametrize("coding", ["utf-8-sig", "utf-16"])
def test_marks_at_the_start_and_separators_at_the_ends_are_no_heights(tmp_path, coding):
    text = written(ROWS, ";", ",").replace("\n", ";\n")
    assert (read(tmp_path, text.encode(coding)).heights == HEIGHTS).all()
    assert (read(tmp_path, written(ROWS, ",").rstrip("\n")).heights == HEIGHTS).all()


@pytest.mark.parametrize("separator", [" ", ";"])
def test_a_number_that_may_be_a_height_is_one(tmp_path, separator):
    deep = np.where(np.isnan(HOLED), -9999, HOLED * 2000)  # not far below the others
    message = refusal(tmp_path, written(deep, separator))
    assert "has the height -9999 3 times: write NaN" in message
    deep[0, 0] = -12000
    assert not read(tmp_path, written(deep, separator)).unknown.any()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (written(ROWS, ",", ","), "more than one way: commas separate its numbers and stand"),
        ("1,234.5;2,345.6;3,1.5;4,2.5\n" * 4, "its numbers have points and commas"),
        ("1.5;2,5;3.5;4.5\n" * 4, "its numbers have points and commas"),
        ("1,234;2,345;999;4,567\n" * 4, '"1,234" may have a decimal comma or a separator of th'),
        ("1,5\n2,5\n3,5\n", "each of its lines has one comma"),
        ("1'234.5;2.5;3.5;4.5\n" * 4, "text is read as a matrix of heights or as lines of x z"),
        ('"1,5","2,5,"3,5","4,5"\n' * 4, "text is read as a matrix"),
        ("1.5 2.5 3.5 4.5\n1.5 2.5 x 4.5\n", 'line 2: "x" is no number; text is read as'),
        ("1.5;a;3.5;4.5\n" + "1.5;2.5;3.5;4.5\n" * 3, 'line 1: "a" is no number'),
        (written(ROWS, ";") + "1;2;3\n", "3 numbers in line 13 and 9 in line 1: it was cut short"),
        ("9 12\n" + written(ROWS), "line 1 may be a header that has to go"),
        (written(ROWS[:1]), "has one row of numbers"),
        (written(ROWS[:2]), "has two rows of numbers"),
        (";" * 8 + "\n" + written(ROWS, ";"), "a row of empty cells stands above"),
        (written(ROWS, ";") + ";" * 8 + "\n", "a row of empty cells is at an end"),
        (written(ROWS, ";").replace("\n", ";;\n"), "several columns of empty cells"),
    ],
)
def test_a_table_that_is_not_clear_is_refused(tmp_path, text, message):
    assert message in refusal(tmp_path, text)


@pytest.mark.parametrize("corner", [0.0, np.nan])
def test_positions_beside_heights_are_not_taken_for_heights(tmp_path, corner):
    with_axes = np.block(
        [[np.array([[corner]]), DX * np.arange(9)[None]], [DY * np.arange(12)[:, None], ROWS]]
    )
    message = refusal(tmp_path, written(with_axes, ";", missing=""))
    assert "rise or fall evenly in its first row" in message
    counted = np.column_stack([np.arange(12), ROWS])
    assert "in its first column" in refusal(tmp_path, written(counted, ","))


@pytest.mark.parametrize(
    ("head", "separator", "decimal"),
    [
        ("# Channel: a\n# Width: 15.5 µm\n# Height: 5 µm\n# Value units: nm\n", "\t", "."),
        ("# Width: 15,5 µm\n# Height: 5,0 µm\n# Value units: nm\n", ";", ","),
        ("Width,15.5,µm\nHeight,5,µm\nValue units,nm\n", ",", "."),
        ("x-length = 15500\ny-length = 5000\nz-unit = nm\n", " ", "."),
    ],
)
def test_sizes_and_units_above_a_matrix_are_read(tmp_path, head, separator, decimal):
    found = read(tmp_path, head + written(ROWS, separator, decimal))
    assert (found.heights == HEIGHTS).all()
    assert found.unit == "nm"
    assert found.sizes == pytest.approx((15500, 5000))
    assert (read(tmp_path, "Sample 7\n" + written(ROWS, ",")).heights == HEIGHTS).all()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x-pixels = 9\ny-pixels = 14\n" + written(ROWS), 'says "y-pixels = 14" and has 12 rows'),
        ("Points: 60\n" + written(np.stack([X, SCAN], 1)), 'says "Points: 60" and has 50 rows'),
        ("Length,20 um\nx um,z um\n" + written(np.stack([X, SCAN], 1), ","), "ends at 10 um"),
        ("x;z [mm]\n" + written(np.stack([X, SCAN], 1), ";"), "units of some columns alone"),
        ("a,b,c,d\n" + written(ROWS[:, :4], ","), "has titles above its columns (a, b, c, d)"),
    ],
)
def test_what_a_file_says_must_agree_with_what_it_holds(tmp_path, text, message):
    assert message in refusal(tmp_path, text)


@pytest.mark.parametrize("fast", ["x", "y"])
@pytest.mark.parametrize("leave_out", [(), (50,), (0,), (3, 4, 50, 51), (-3,), (-108, -107)])
def test_a_list_with_gaps_is_a_map_with_missing_points(tmp_path, fast, leave_out):
    rows = points(fast, leave_out)
    shuffled = np.random.default_rng(1).permutation(rows)
    for each in (rows, shuffled, np.vstack([rows, rows[5]])):
        for text in (written(each, form="{:.6f}"), written(each, ";", ",")):
            found = read(tmp_path, text)
            assert found.kind == "surface"
            assert found.sizes == pytest.approx(SIDES)
            assert found.unknown.sum() == len(leave_out)
            known = ~found.unknown
            assert (found.heights[known] == HEIGHTS[known]).all()
    body = rl.read(tmp_path / "table.csv", "um")
    assert body.settings.get("missing_points", 0) == len(leave_out)


@pytest.mark.parametrize("fast", ["x", "y"])
@pytest.mark.parametrize("lost", [1, 2, 4])
def test_a_list_that_ends_within_a_row_was_cut_short(tmp_path, fast, lost):
    text = written(points(fast)[:-lost], form="{:.6f}")
    assert "ends within a row of its grid of 9 x 12 points" in refusal(tmp_path, text)
    for k in (9, 20, 24):  # within its last lines
        assert refusal(tmp_path, written(points(fast), form="{:.6f}")[:-k])


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (np.random.default_rng(2).uniform(0, 9, (200, 3)), "points that lie on no regular grid"),
        (
            points() + np.random.default_rng(2).normal(size=(108, 3)) * [0.2, 0.1, 0],
            "points that lie on no regular grid",
        ),
        (np.ones((4, 3)), "they have one position along a side"),
        (np.vstack([points(), [0, 0, 9]]), "two heights at x = 0, y = 0"),
        (np.column_stack([points(), points()[:, 2]]), "the first two are positions on a grid"),
        (np.stack([X, SCAN], 1)[[0, 2, 1, 3]], "0.4 stands before 0.2"),
        (np.stack([X, SCAN], 1).repeat(2, axis=0), "0 stands before 0"),
    ],
)
def test_a_list_of_which_no_map_and_no_line_can_be_made_is_refused(tmp_path, rows, message):
    assert message in refusal(tmp_path, written(rows, form="{:.5f}"))


def test_titles_say_which_column_is_which_and_in_which_unit(tmp_path):
    x, y, z = points().T
    for head, rows, factor, unit in (
        ("X [mm];Y [mm];Z [µm]\n", (x, y, z), 1e-3, "mm"),
        ("z;x;y\nnm;um;um\n", (z, x, y), 1e-3, "um"),
        ("i;x (um);y (um);z (um);valid\n", (y, x, y, z, x), 1, "um"),
        ("# Lateral units: µm\n# Value units: m\n", (x, y, z), 1e6, "µm"),
    ):
        found = read(tmp_path, head + written(np.stack(rows, 1), ";"))
        assert found.unit == unit
        assert found.heights == pytest.approx(factor * HEIGHTS)
        assert found.sizes == pytest.approx(SIDES)


@pytest.mark.parametrize(
    ("head", "in_full", "rows", "separator"),
    [
        ("# Width: 1 mm\n# Height: 2 mm\n", "# Value units: um\n", ROWS, " "),
        ("x [mm];y [mm];z\n", "# Value units: um\n", points(), ";"),
        ("x [mm];z\n", "# Value units: um\n", np.stack([X, SCAN], 1), ";"),
        ("x [mm];z\n", "# Value units: um\n", np.stack([X**1.5, SCAN], 1), ";"),  # uneven
    ],
)
@pytest.mark.parametrize("crop", [None, "half"])
def test_a_unit_of_heights_that_is_left_open_is_the_callers(
    tmp_path, head, in_full, rows, separator, crop
):
    """The same body as of a file that states it; sizes keep the unit that they have."""
    for name, text in (("open.txt", head), ("full.txt", in_full + head)):
        (tmp_path / name).write_text(text + written(rows, separator))
    whole = rl.read(tmp_path / "full.txt")
    sides = whole.sizes if isinstance(whole, rl.Surface) else (whole.length,)
    ends = None if crop is None else [end for side in sides for end in (0.0, side / 2)]
    stated = rl.read(tmp_path / "full.txt", crop=ends)
    given = rl.read(tmp_path / "open.txt", "um", crop=ends)
    assert given.heights == pytest.approx(stated.heights, rel=1e-12, abs=1e-20)
    assert given.spacing == pytest.approx(stated.spacing)
    with pytest.raises(rl.UnitError, match="states its sizes in mm and no unit of its heights"):
        rl.read(tmp_path / "open.txt")


@pytest.mark.parametrize(
    ("columns", "length"),
    [
        ((X, SCAN), 10),
        ((X[::-1], SCAN[::-1]), 10),
        ((np.arange(50), X, SCAN), 10),
        ((3 * X, 4 * X, SCAN), 50),
        ((X, 0 * X + 2, SCAN), 10),
        ((SCAN,), None),
    ],
)
def test_a_line_scan_is_read_along_its_positions(tmp_path, columns, length):
    found = read(tmp_path, written(np.stack(columns, 1)))
    assert found.kind == "profile"
    assert found.positions is None
    assert (found.heights == SCAN).all()
    assert found.sizes == (None if length is None else pytest.approx((length,)))


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_quotation_marks_around_cells_change_nothing(tmp_path, separator, decimal):
    """As spreadsheets write them: a comma within them is a decimal sign."""
    text = written(HOLED, separator, decimal, missing="", form='"{:.4f}"')
    assert np.array_equal(read(tmp_path, text).heights, HOLED.T, equal_nan=True)
    titles = separator.join(['"X [mm]"', '"Y [mm]"', '"Z [µm]"']) + "\n"
    found = read(tmp_path, titles + written(points(), separator, decimal, form='"{:.4f}"'))
    assert found.unit == "mm"
    assert found.sizes == pytest.approx(SIDES)
    assert found.heights == pytest.approx(1e-3 * HEIGHTS)


@pytest.mark.parametrize(
    ("before", "after"), [("{\n", "}\n"), ("", "}\n"), ("x [mm] y [mm] z [mm] {\n", "}")]
)
def test_a_list_may_stand_in_braces(tmp_path, before, after):
    text = before + written(points()) + after
    found = read(tmp_path, text)
    assert (found.heights == HEIGHTS).all()
    assert found.unit == ("mm" if "mm" in before else None)
    if before:
        assert "does not close it: it was cut short" in refusal(tmp_path, text[: -len(after)])


@pytest.mark.parametrize("unit", ["MM", "Um", "nM", "mil", "Å", "inches"])
def test_capitals_change_no_unit(tmp_path, unit):
    metres = {"MM": 1e-3, "Um": 1e-6, "nM": 1e-9, "mil": 25.4e-6, "Å": 1e-10, "inches": 0.0254}
    read(tmp_path, f"x [{unit}];y [{unit}];z [{unit}]\n" + written(points(), ";"))
    body = rl.read(tmp_path / "table.csv", trend="none")
    assert body.sizes == pytest.approx([side * metres[unit] for side in SIDES])
    assert body.heights == pytest.approx(HEIGHTS * metres[unit])


def test_positions_in_metres_are_even_only_if_they_are(tmp_path):
    x = np.cumsum(np.random.default_rng(0).uniform(1, 2, 50)) * 1e-6
    found = read(tmp_path, written(np.stack([x, SCAN * 1e-6], 1), form="{:.6e}"))
    assert found.positions == pytest.approx(x, rel=1e-5)


@pytest.mark.parametrize("form", ["{:.4f}", "{:.6e}"])
def test_a_line_scan_that_ends_within_a_number_was_cut_short(tmp_path, form):
    text = written(np.stack([X, SCAN], 1), form=form).rstrip("\n")
    assert read(tmp_path, text).heights.size == 50
    for k in range(1, 6):
        assert "cut short" in refusal(tmp_path, text[:-k])


@pytest.mark.parametrize(
    "name", ["al3d-1.al3d", "di-1.di", "mitutoyo_mock.xlsx", "opd-1.opd", "sur-3.sur"]
)
def test_a_measured_file_that_is_cut_anywhere_gives_its_points_or_none(
    topographies, tmp_path, name
):
    assert_whole_or_refused(topographies, tmp_path, name)


def test_a_measured_text_that_is_cut_anywhere_gives_its_points_or_none(topographies, tmp_path):
    assert_whole_or_refused(topographies, tmp_path, "dektak-1.csv")


def assert_whole_or_refused(topographies, tmp_path, name):
    whole = measurement(topographies / name)
    data = (topographies / name).read_bytes()
    places = {int(len(data) * share) for share in (0.004, 0.1, 0.25, 0.5, 0.75, 0.98)}
    for end in places | {8, 512, 2048, 5000, 20000, len(data) - 1, len(data) - 400}:
        (tmp_path / name).write_bytes(data[:end])
        try:
            found = measurement(tmp_path / name)
        except rl.InputError:
            continue
        if name == "dektak-1.csv":  # its last lines are nobody's loss
            assert found.sizes[0] == pytest.approx(whole.sizes[0], rel=0.01)
            continue
        assert found.sizes == whole.sizes
        assert (np.ma.filled(found.heights, 0) == np.ma.filled(whole.heights, 0)).all()
