"""GWY of Gwyddion: units as stated or given, masks as selections, channels by name."""

import numpy as np
import pytest
from SurfaceTopography import Topography

import gwyddion_files
import roughline as rl
from gwyddion_files import gwy
from mutated_heads import assert_each_is_read_or_refused_in_one_line
from random_cases import seeds
from roughline.question.description import describe
from roughline.question.reading import Reading
from roughline.topography.files.read import measurement

NX, NY, SIDES = 24, 20, (2.4e-6, 4e-6)
HEIGHTS = 1e-9 * np.random.default_rng(7).standard_normal((NX, NY))
GRAINS = np.zeros((NX, NY))
GRAINS[3:9, 5:11] = 1.0  # 7.5 %


def field(heights=HEIGHTS, **others):
    return gwyddion_files.field(heights, sides=others.pop("sides", SIDES), **others)


@pytest.fixture
def file(tmp_path):
    def write(content):
        (tmp_path / "map.gwy").write_bytes(content)
        return tmp_path / "map.gwy"

    return write


def test_heights_and_sides_are_those_of_the_file(file):
    found = measurement(file(gwy(**{"0_data": field(), "0_data_title": "Topo"})))
    assert np.array_equal(found.heights, HEIGHTS)
    assert (found.unit, found.sizes, found.channel) == ("m", SIDES, "Topo")
    mixed = rl.read(file(gwy(**{"0_data": field(xy="µm", z="nm")})), trend="none")
    assert np.allclose(mixed.heights, 1e-9 * HEIGHTS, rtol=1e-14)
    assert mixed.sizes == pytest.approx((2.4e-12, 4e-12))


@pytest.mark.parametrize(("xy", "z"), [("", ""), (None, None)])
def test_units_that_are_not_stated_are_asked_for(file, xy, z):
    path = file(gwy(**{"0_data": field(xy=xy, z=z)}))
    with pytest.raises(rl.UnitError, match="states no unit"):
        rl.read(path)
    assert rl.read(path, unit="um").sizes == pytest.approx((2.4e-12, 4e-12))


def test_the_unit_of_one_direction_serves_no_other(file):
    path = file(gwy(**{"0_data": field(z="")}))
    with pytest.raises(rl.UnitError, match="its sizes in m and no unit of its heights"):
        rl.read(path)
    assert rl.read(path, unit="nm").sizes == SIDES
    with pytest.raises(rl.InputError, match="states no sizes"):
        rl.read(file(gwy(**{"0_data": field(xy="")})))


def test_channels_that_are_no_heights_are_named_and_not_taken(file):
    content = {"0_data": field(z="V"), "1_data": field(2 * HEIGHTS), "1_data_title": "Topo"}
    found = measurement(file(gwy(**content)))
    assert np.array_equal(found.heights, 2 * HEIGHTS)
    assert found.channels == ("0 one without a name (no heights)", "1 Topo")
    with pytest.raises(rl.InputError, match=r"holds no heights .in V.; it has"):
        rl.read(file(gwy(**content)), channel=0)
    with pytest.raises(rl.InputError, match=r"holds no heights; it has Phase \(in deg\)"):
        rl.read(file(gwy(**{"0_data": field(z="deg"), "0_data_title": "Phase"})))


def test_a_mask_is_a_selection_and_its_heights_are_used_or_left_out(file):
    path = file(gwy(**{"0_data": field(), "0_mask": field(GRAINS, z="")}))
    used = rl.read(path, trend="none")
    assert np.array_equal(used.heights, HEIGHTS)
    assert used.settings["masked_share"] == pytest.approx(0.075)
    leave_out = rl.Missing(mask="leave-out")
    left = rl.read(path, missing=leave_out)
    assert left.settings["missing_points"] == 36
    (note,) = [each for each in describe(path).notes if "masked" in each]
    assert note.startswith("masked in Gwyddion: 7.5% of the points; their heights are used")
    notes = describe(path, Reading(missing=leave_out)).notes
    (note,) = [each for each in notes if "masked" in each]
    assert note.endswith("they are left out, and filled like missing points")
    piece = rl.read(path, crop=(0, SIDES[0], 0, SIDES[1] / 2))
    assert piece.settings["masked_share"] == pytest.approx(6 * 5 / 240)
    bare = file(gwy(**{"0_data": field()}))
    with pytest.raises(rl.InputError, match="has no mask that selects points"):
        rl.read(bare, missing=leave_out)


@pytest.mark.parametrize("value", [0.0, 3e-9])
def test_masked_points_that_all_have_one_height_are_missing(file, value):
    """As SurfaceTopography and Gwyddion write missing points, with 0 or the mean for a height."""
    heights = np.where(GRAINS > 0, value, HEIGHTS)
    found = measurement(file(gwy(**{"0_data": field(heights), "0_mask": field(GRAINS, z="")})))
    assert (found.unknown == (GRAINS > 0)).all()
    assert found.masked is None
    assert "all have one height" in found.doubts[0]


def test_missing_points_of_surface_topography_come_back(tmp_path):
    heights = np.ma.array(HEIGHTS, mask=GRAINS > 0)
    Topography(heights, SIDES, unit="m").to_gwy(str(tmp_path / "a.gwy"))
    assert (measurement(tmp_path / "a.gwy").unknown == (GRAINS > 0)).all()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"0_data": field(xres=0)}, "states 0 x 20 points"),
        ({"0_data": field(xres=25)}, "does not hold 25 x 20 numbers"),
        ({"0_data": field(sides=(0.0, 1.0))}, "states sides of 0.0 x 1.0"),
        ({"0_data": field(sides=(float("nan"), 1.0))}, "states sides of nan"),
        ({"0_data": field(), "0_mask": field(GRAINS[1:])}, "has other points than its channel"),
        ({"0_title": "x"}, "holds no heights; it has no channel"),
        ({"0_data": field(z="V\nV")}, r"it has one without a name \(in V V\)"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(file, content, message):
    with pytest.raises(rl.InputError, match=f"map.gwy.*{message}") as caught:
        rl.read(file(gwy(**content)))
    assert "\n" not in str(caught.value)


def test_components_without_end_are_refused(file):
    deep = ("A", {})
    for _ in range(60):
        deep = ("A", {"a": deep})
    with pytest.raises(rl.InputError, match="nests without end"):
        rl.read(file(gwy(**{"0_data": deep})))


def test_a_file_that_is_cut_is_refused(file):
    whole = gwy(**{"0_data": field()})
    for place in np.random.default_rng(7).integers(4, len(whole), 20):
        with pytest.raises(rl.InputError, match="cut short"):
            rl.read(file(whole[:place]))


def test_another_program_reads_the_same(file):
    gwyfile = pytest.importorskip("gwyfile")
    path = file(gwy(**{"0_data": field()}))
    judge = gwyfile.load(str(path))["/0/data"]
    assert np.array_equal(measurement(path).heights.T, judge.data)


@seeds(10, 2000)
def test_a_changed_head_gives_a_body_or_one_line(tmp_path, seeds):
    content = gwy(**{"0_data": field(), "0_mask": field(GRAINS, z="")})
    assert_each_is_read_or_refused_in_one_line(tmp_path / "map.gwy", content, 330, seeds)
