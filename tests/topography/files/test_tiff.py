"""TIFF: heights are numbers of 16 bits or more; pictures are refused, and so is what is unclear."""

import numpy as np
import pytest
import tifffile

import roughline as rl
from random_cases import cases, seeds
from roughline.topography.files.read import measurement

ROWS = np.random.default_rng(0).normal(size=(12, 20)).astype("f4")  # (y, x) [nm]
COUNTS = (1000 * ROWS + 30000).astype("u2")
ASKED = {"unit": "nm", "sizes": "20 um, 12 um"}


def read(path, **asked):
    return rl.read(path, trend="none", **asked)


@pytest.mark.parametrize("dtype", ["f4", "f8", "u2", "i2", "u4", "i4"])
@pytest.mark.parametrize(
    "options", [{}, {"compression": "zlib"}, {"byteorder": ">"}, {"tile": (16, 16)}]
)
def test_numbers_are_heights_without_a_unit(tmp_path, dtype, options):
    rows = (ROWS if dtype[0] == "f" else COUNTS // 2).astype(dtype)
    tifffile.imwrite(tmp_path / "map.tif", rows, photometric="minisblack", **options)
    content = measurement(tmp_path / "map.tif")
    assert (content.unit, content.sizes, content.format) == (None, None, "TIFF")
    found = read(tmp_path / "map.tif", **ASKED)
    np.testing.assert_allclose(found.heights, 1e-9 * rows.T.astype("f8"), rtol=1e-14)
    with pytest.raises(rl.UnitError, match=r"map.tif states no unit; give the unit"):
        read(tmp_path / "map.tif", sizes=1.0)


def test_the_size_of_a_pixel_of_imagej_is_known(tmp_path):
    for unit in ("um", "micron", "\\u00B5m"):
        pixels = {"imagej": True, "resolution": (4.0, 2.0), "metadata": {"unit": unit}}
        tifffile.imwrite(tmp_path / "map.tif", ROWS, **pixels)
        with pytest.raises(rl.UnitError, match="states its sizes in .* and no unit of its heights"):
            read(tmp_path / "map.tif")
        found = read(tmp_path / "map.tif", unit="nm")
        assert found.sizes == pytest.approx((5e-6, 6e-6), rel=1e-12)


def test_the_straight_line_of_imagej_gives_heights_with_their_unit(tmp_path):
    line = {"unit": "um", "cf": 0, "c0": -15.0, "c1": 5e-4, "vunit": "nm"}
    tifffile.imwrite(
        tmp_path / "map.tif", COUNTS, imagej=True, resolution=(4.0, 2.0), metadata=line
    )
    found = read(tmp_path / "map.tif")
    assert found.sizes == pytest.approx((5e-6, 6e-6), rel=1e-12)
    np.testing.assert_allclose(found.heights, 1e-9 * (5e-4 * COUNTS.T - 15.0), atol=1e-22)
    for vunit in ("Gray Value", "V"):
        tifffile.imwrite(
            tmp_path / "map.tif", COUNTS, imagej=True, metadata=line | {"vunit": vunit}
        )
        assert measurement(tmp_path / "map.tif").unit is None


def test_a_curve_of_imagej_is_refused(tmp_path):
    curve = {"cf": 3, "c0": 0.0, "c1": 1.0, "c2": 2.0}
    tifffile.imwrite(tmp_path / "map.tif", COUNTS, imagej=True, metadata=curve)
    with pytest.raises(rl.InputError, match="calibrates by a curve: apply it there"):
        read(tmp_path / "map.tif", **ASKED)


@pytest.mark.parametrize(
    ("per_unit", "unit", "pixel"),
    [
        (4e4, 3, 0.25e-6),  # a centimetre
        (25.4e3, 2, 1e-6),  # an inch
        (72.0, 2, None),  # of a screen
        (600.0, 2, None),  # of a printer
        (4e4, 1, None),  # of no unit
    ],
)
def test_a_resolution_counts_unless_it_is_that_of_a_printer(tmp_path, per_unit, unit, pixel):
    resolution = {"resolution": (per_unit, per_unit), "resolutionunit": unit}
    tifffile.imwrite(tmp_path / "map.tif", ROWS, **resolution)
    if pixel is None:
        assert measurement(tmp_path / "map.tif").sizes is None
    else:
        sizes = read(tmp_path / "map.tif", unit="nm").sizes
        assert sizes == pytest.approx((20 * pixel, 12 * pixel), rel=1e-9)


@pytest.mark.parametrize(
    ("image", "options", "message"),
    [
        (np.zeros((8, 8, 3), "u1"), {"photometric": "rgb"}, "8 bits for each point"),
        (np.zeros((8, 8, 3), "u2"), {"photometric": "rgb"}, "a picture in colours"),
        (np.zeros((8, 8), "u1"), {}, "8 bits for each point"),
        (np.zeros((8, 8), "u2"), {"photometric": "miniswhite"}, "from white to black"),
        (np.zeros((8, 8), "c8"), {}, "no heights"),
    ],
)
def test_a_picture_holds_no_heights(tmp_path, image, options, message):
    tifffile.imwrite(tmp_path / "map.tif", image, **options)
    for asked in ({}, {"channel": 0}):
        with pytest.raises(rl.InputError, match=message):
            read(tmp_path / "map.tif", **ASKED, **asked)


def test_of_several_images_one_is_chosen(tmp_path):
    with tifffile.TiffWriter(tmp_path / "map.tif") as file:
        for image in (ROWS + 1, ROWS):
            file.write(image, contiguous=False)
    with pytest.raises(
        rl.InputError, match=r"has 2 images that may be heights: choose one .*=\"0\""
    ):
        read(tmp_path / "map.tif", **ASKED)
    found = read(tmp_path / "map.tif", **ASKED, channel=1)
    np.testing.assert_allclose(found.heights, 1e-9 * ROWS.T.astype("f8"), rtol=1e-14)
    with pytest.raises(rl.InputError, match="has no channel '2'"):
        read(tmp_path / "map.tif", **ASKED, channel=2)


def test_a_preview_is_passed_over(tmp_path):
    with tifffile.TiffWriter(tmp_path / "map.tif") as file:
        file.write(np.zeros((8, 8, 3), "u1"), photometric="rgb")
        file.write(ROWS)
        file.write(ROWS[:6, :10], subfiletype=1)
    assert read(tmp_path / "map.tif", **ASKED).shape == (20, 12)
    assert measurement(tmp_path / "map.tif").channels[1] == "1 image"


def test_a_stack_is_refused(tmp_path):
    tifffile.imwrite(tmp_path / "map.tif", ROWS, imagej=True)
    content = (tmp_path / "map.tif").read_bytes()
    (tmp_path / "map.tif").write_bytes(content.replace(b"images=1", b"images=9"))
    with pytest.raises(rl.InputError, match="is a stack of 9 images"):
        read(tmp_path / "map.tif", **ASKED)


@pytest.mark.parametrize(
    ("orientation", "turned"),
    [
        (1, lambda rows: rows),
        (2, lambda rows: rows[:, ::-1]),
        (3, lambda rows: rows[::-1, ::-1]),
        (4, lambda rows: rows[::-1]),
        (5, lambda rows: rows.T),
        (6, lambda rows: np.rot90(rows, -1)),
        (7, lambda rows: rows[::-1, ::-1].T),
        (8, lambda rows: np.rot90(rows)),
    ],
)
def test_the_tag_of_orientation_is_followed(tmp_path, orientation, turned):
    """6 is shown turned clockwise by a quarter, 8 the other way."""
    tifffile.imwrite(tmp_path / "map.tif", ROWS, extratags=[(274, "H", 1, orientation, True)])
    found = measurement(tmp_path / "map.tif")
    np.testing.assert_array_equal(found.heights.T, turned(ROWS))


def test_the_mark_of_missing_points_is_followed(tmp_path):
    rows = ROWS.copy()
    rows[3, 4] = -9999
    tifffile.imwrite(tmp_path / "map.tif", rows, extratags=[(42113, "s", 0, "-9999", True)])
    assert np.argwhere(measurement(tmp_path / "map.tif").unknown).tolist() == [[4, 3]]


@pytest.mark.parametrize(
    ("tag", "program"),
    [
        ((34118, "s", 0, "\r\nDP_X\r\nA = 1\r\n", True), "Zeiss SEM"),
        ((50434, "I", 4, (1, 2, 3, 4), True), "Park Systems"),
    ],
)
def test_programs_with_a_layout_of_their_own_are_named(tmp_path, tag, program):
    tifffile.imwrite(tmp_path / "map.tif", COUNTS, extratags=[tag])
    with pytest.raises(rl.InputError, match=f"TIFF of {program}, whose layout is not read"):
        read(tmp_path / "map.tif", **ASKED)


@seeds(10, cases(2000, share=20))
def test_a_damaged_file_is_refused_in_one_line(tmp_path, capfd, seeds):
    path = tmp_path / "map.tif"
    tifffile.imwrite(path, ROWS, imagej=True, resolution=(4.0, 2.0), metadata={"unit": "um"})
    content = path.read_bytes()
    for seed in seeds:
        random = np.random.default_rng(seed)
        damaged, is_cut = bytearray(content), seed % 3 == 0
        if is_cut:
            damaged = damaged[: random.integers(1, len(damaged))]
        else:
            for place in random.integers(400, size=3):
                damaged[place] = random.choice([0, 1, 127, 255, random.integers(256)])
        path.write_bytes(damaged)
        said = refusal(path)
        assert said is None or (len(said.splitlines()) == 1 and len(said) < 300)
        assert said or not is_cut
    assert capfd.readouterr() == ("", "")


def refusal(path):
    try:
        measurement(path)
    except rl.InputError as error:
        return str(error)
    return None
