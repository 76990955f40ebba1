"""What stands above a matrix of heights: the same whatever separates labels and values."""

import numpy as np
import pytest

import roughline as rl
from mutated_heads import assert_read_or_refused
from random_cases import cases, seeds
from roughline.topography.files.read import measurement

ROWS = np.round(np.random.default_rng(3).normal(size=(12, 9)), 4)
WYKO = [
    ["Wyko ASCII Data File Format", "0", "0", "1"],
    ["X Size", "12"],
    ["Y Size", "9"],
    ["Block Name", "Type", "Length", "Value"],
    ["Wavelength", "7", "4", "632.8"],
    ["Aspect", "7", "4", "1.5"],
    ["Pixel_size", "7", "4", "0.00165"],
    ["Title", "5", "20", "plate"],
    ["Mult", "6", "2", "2"],
    ["RAW_DATA", "3", "432"],
]
GWYDDION = (
    ("Channel", "Width", "Height", "Value units"),
    ("Kanal", "Breite", "Höhe", "Einheiten"),
    ("Canal ", "Largeur ", "Hauteur ", "Unités "),
    ("Канал", "Ширина", "Высота", "Единицы измерения"),
    ("チャネル", "幅", "高さ", "値の単位"),
)
SPIP = (
    "# File Format = ASCII\n# Created by SPIP 6.3.2.0 2014-12-12 11:16\n# x-pixels = 9\n"
    "# y-pixels = 12\n# x-length = 2000.5\n# y-length = 1500\n# x-offset = 0\n"
)
ATTOCUBE = (
    "# Daisy frame view snapshot\n# 2009-07-14T10:12:34\n# x-pixels: 9\n# y-pixels: 12\n"
    "# x-length: 8.5\n# y-length: 6\n# x-unit: um\n# y-unit: um\n# z-unit: nm\n"
    "# display: Topography\n# Start of Data:\n"
)
NOVA = (
    "File Format = ASCII\nCreated by Nova\nNX = 9\nNY = 12\nScale X = 0.5\nScale Y = 0.25\n"
    "Unit X = um\nUnit Y = um\nUnit Data = nm\nScale Data = 3.5\nDataScaleNeeded = {}\n"
    "Start of Data :\n"
)
KOALA = (
    "h=12 w=9\npixel size=2.84871e-07 m\ndata unit=rad\n"
    "height conversion factor (-> m)=2.11994e-07\n"
)
HEADS = {  # text, unit, sides in that unit, factor of heights
    "Gwyddion": (
        "# Channel: a\n# Width: 15.5 µm\n# Height: 5 µm\n# Value units: nm\n",
        "nm",
        (15500, 5000),
        1,
    ),
    "SPIP": (SPIP + "# z-unit = um\n# Start of Data:\n", "um", (2.0005, 1.5), 1),
    "SPIP, in counts": (SPIP + "# Bit2nm = 0.5\n# Start of Data:\n", "nm", (2000.5, 1500), 0.5),
    "Attocube": (ATTOCUBE, "nm", (8500, 6000), 1),
    "Nova": (NOVA.format("no"), "nm", (4500, 3000), 1),
    "Nova, scaled": (NOVA.format("yes"), "nm", (4500, 3000), 3.5),
    "Koala": (KOALA, "m", (9 * 2.84871e-7, 12 * 2.84871e-7), 2.11994e-7),
    "mil": ("Width: 2.5 mil\nHeight: 1 mil\nz-unit: mil\n", "mil", (2.5, 1), 1),
}
DIALECTS = [(" ", "."), ("\t", "."), (";", "."), (",", "."), (" ", ","), ("\t", ","), (";", ",")]


def table(rows, separator, decimal, missing="nan"):
    cells = [
        [f"{v:.6f}".replace(".", decimal) if np.isfinite(v) else missing for v in row]
        for row in rows
    ]
    return "".join(separator.join(row) + "\n" for row in cells)


def wyko(separator="\t", decimal=".", rows=ROWS, flag="0", **changed):
    lines = [[cell.replace(".", decimal) for cell in line] for line in WYKO]
    lines[0][2] = flag
    for line in lines:
        line[-1] = changed.get(line[0].replace(" ", "_"), line[-1])
    head = "".join(separator.join(line) + "\n" for line in lines)
    return head + table(rows, separator, decimal, "Bad")


def read(folder, text, name="map.asc"):
    (folder / name).write_bytes(text.encode())
    return measurement(folder / name)


@pytest.mark.parametrize(("separator", "decimal"), DIALECTS)
@pytest.mark.parametrize("program", HEADS)
def test_a_head_states_the_same_whatever_separates_its_numbers(
    tmp_path, program, separator, decimal
):
    head, unit, sides, factor = HEADS[program]
    own = head.replace(".", decimal) if decimal == "," else head
    tabled = own.replace(": ", separator).replace(" = ", separator).replace(" µm", separator + "µm")
    for text in (own, tabled):
        found = read(tmp_path, text + table(ROWS, separator, decimal))
        assert (found.kind, found.unit, found.format, found.reader) == ("surface", unit, "Text", "")
        assert found.sizes == pytest.approx(sides)
        assert found.heights == pytest.approx(factor * ROWS.T)


@pytest.mark.parametrize("labels", GWYDDION)
def test_labels_that_gwyddion_translates_are_known(tmp_path, labels):
    values = ("Topo", "15.5 µm", "5 µm", "nm")
    head = "".join(f"# {label}: {value}\n" for label, value in zip(labels, values, strict=True))
    found = read(tmp_path, head + table(ROWS, "\t", "."))
    assert (found.unit, found.channel, found.sizes) == ("nm", "Topo", (15500, 5000))


@pytest.mark.parametrize(("separator", "decimal"), DIALECTS)
@pytest.mark.parametrize("flag", ["0", "1"])
def test_a_wyko_text_is_in_waves_or_in_nm_and_its_lines_are_columns(
    tmp_path, separator, decimal, flag
):
    """Each line is a column of the picture, from its bottom to its top, as in its binary files."""
    holed = ROWS.copy()
    holed[0] = holed[3, 2] = np.nan  # the first column has no point
    found = read(tmp_path, wyko(separator, decimal, holed, flag))
    factor = 1 if flag == "1" else 632.8 / 2
    assert (found.unit, found.format, found.kind) == ("nm", "Wyko ASCII", "surface")
    assert found.heights == pytest.approx(factor * holed[:, ::-1], nan_ok=True)
    assert found.sizes == pytest.approx((12 * 1650, 9 * 1.5 * 1650))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (wyko(X_Size="14"), "states 14 x 9 points and has 12 x 9: it was cut short"),
        (wyko(Mult="0"), 'states Mult = "0"'),
        (wyko(Pixel_size="-0.001"), 'states Pixel_size = "-0.001"'),
        (wyko(Wavelength="x"), 'states Wavelength = "x"'),
        (wyko().replace("RAW_DATA", "Intensity"), "a Wyko text has a block of heights there"),
        (wyko().replace("Wyko ASCII", "Wyko"), "a Wyko text begins with"),
        ("# Width: 5 µm\n# Width: 6 µm\n# Height: 5 µm\n", "delete one of them"),
        ("# Width: 5 µm\n# Value units: nm\n", "both sides are needed, or none"),
        ("# Width: 0 µm\n# Height: 5 µm\n", "a number above 0 is needed"),
        ("# Width: 5 V\n# Height: 5 µm\n", '"V" is no unit of length'),
        ("# Width: 1e308 m\n# Height: 5 µm\n# Value units: nm\n", "states sides of inf x"),
        ("# Width: 5 µm\n# Height: 5 µm\n# Value units: V\n", '"V" is no unit of length: export'),
        (KOALA.replace("h=12", "h=13"), "states 9 x 13 columns and rows and has 9 x 12"),
        (KOALA.replace("=rad", "=m"), "which is right is not said"),
        (KOALA.replace("factor", "factors"), '"rad" is no unit of length'),
        ("\x01Width: 5 µm\n# Height: 5 µm\n", "damaged or of a type that is not known"),
    ],
)
def test_a_head_that_agrees_with_no_map_is_refused(tmp_path, text, message):
    if "Wyko" not in text:
        text += table(ROWS, " ", ".")
    with pytest.raises(rl.InputError) as caught:
        read(tmp_path, text)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_width_above_one_column_is_the_length_of_a_line_scan(tmp_path):
    found = read(tmp_path, "# Width: 6.0 µm\n# Value units: nm\n" + table(ROWS[:, :1], " ", "."))
    assert (found.kind, found.unit) == ("profile", "nm")
    assert found.sizes == pytest.approx((6000,))
    assert (found.heights == ROWS[:, 0]).all()


def test_a_matrix_of_few_columns_is_one_if_its_head_states_two_sides(tmp_path):
    head = HEADS["Gwyddion"][0]
    for columns in (2, 3):
        found = read(tmp_path, head + table(ROWS[:, :columns], " ", "."))
        assert (found.heights == ROWS[:, :columns].T).all()
        assert found.sizes == (15500, 5000)
    line = read(tmp_path, head + table(ROWS[:, :1], " ", "."))
    assert (line.kind, line.sizes) == ("profile", (5000,))
    head = "# Width: 5 mm\n# Height: 4 mm\n"
    listed = np.column_stack([0.5 * np.arange(12), ROWS[:, 0]])
    assert read(tmp_path, head + table(listed, " ", ".")).sizes == (6,)


@pytest.mark.parametrize("program", ["Wyko", *HEADS])
@seeds(8, cases(2000, 16))
def test_a_changed_head_gives_the_same_heights_or_one_line(tmp_path, program, seeds):
    head = "" if program == "Wyko" else HEADS[program][0]
    text = wyko() if program == "Wyko" else head + table(ROWS, " ", ".")
    size = len(text.encode()) - len(table(ROWS, " ", "."))
    is_counted = any(key in text for key in ("x-pixels", "NX", "h=", "X Size"))
    assert_read_or_refused(tmp_path, "map.txt", text.encode(), size, seeds, cuts=is_counted)
