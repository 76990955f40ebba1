"""What is known of how heights were measured, and of what was done to them, goes with a body."""

import json
from dataclasses import fields, replace

import numpy as np
import pytest
import xarray

import roughline as rl
from roughline.topography.borders import Borders, decided
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.recorded import as_record, provenance_in, provenance_of_earlier
from roughline.topography.missing import Filled, Filler
from roughline.topography.provenance import (
    NOTHING_KNOWN,
    Facing,
    Instrument,
    Left,
    Masked,
    Provenance,
    Tilt,
)

HEIGHTS = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(64, rng=7).heights
EVERYTHING = Provenance(
    instrument=Instrument("means", 2e-6, 1e-5),
    tilt=Tilt((0.1, -0.2), is_of_mounting=True),
    borders=Borders(3.5, 1e-4),
    format="GWY",
    corrected="its lengths are in nm",
    doubts_of_file="it ends early",
    masked=Masked(0.1, "Gwyddion", are_used=False),
    filled=Filled(7, 0.01, "nearest"),
    filled_before_crop=3,
    filled_over_lines="median",
    filled_between_levels=2,
    cropped_share=0.25,
    lines_levelled="tilt",
    scars_removed=0,
    outliers_kept=5,
    outliers_removed=0,
    low_pass=1e-5,
    low_pass_kept="x 3:61, y 3:61",
    resampled_to="32 x 32",
    left=(Left("detrended", 0.4), Left("low_pass", 0.9, 0.5)),
    detrended="tilt",
)


def measured(**steps):
    """A map with missing points and a spike, on a tilted stage, read and prepared."""
    heights = HEIGHTS + 1e-6 * np.arange(64)[:, np.newaxis]
    heights[3:6, 40:44], heights[50, 20] = np.nan, 1e-3
    content = Measurement("map", heights, "m", (1e-3, 1e-3), "surface", format="SDF")
    content = content.with_instrument(Instrument("points", blur=3e-6), is_tilt_of_mounting=True)
    body = content.body(None, None, Filler(), "tilt")
    return rl.prepared(body, rl.Preparation(**steps)) if steps else body


STEPS = {"remove_scars": True, "remove_outliers": True, "low_pass": 6e-5, "points": 32}


def test_every_fact_is_tried():
    for each in fields(Provenance):
        if each.name != "facing":
            assert getattr(EVERYTHING, each.name) != each.default, each.name


@pytest.mark.parametrize("known", [NOTHING_KNOWN, EVERYTHING])
def test_files_hold_all_that_is_known(known):
    both = Provenance(facing=Facing(known, NOTHING_KNOWN, (True, False), is_resampled=True))
    twice = Provenance(tilt=known.tilt, facing=Facing(both, known))
    for each in (known, both, twice):
        assert provenance_in(json.loads(json.dumps(as_record(each)))) == each


def test_only_what_is_known_is_shown():
    assert repr(NOTHING_KNOWN) == "Provenance()"
    assert repr(Provenance(low_pass=1e-5, scars_removed=0)) == (
        "Provenance(scars_removed=0, low_pass=1e-05)"
    )


def test_settings_of_earlier_versions_say_the_same():
    assert provenance_of_earlier(EVERYTHING.record) == EVERYTHING
    assert provenance_of_earlier({"pixels": "round", "blur": "some", "tilt": "small"}) == (
        NOTHING_KNOWN
    )


@pytest.mark.filterwarnings("ignore::roughline.PreparationWarning")
@pytest.mark.parametrize("is_of_before", [False, True])
def test_a_measured_body_is_read_back_with_its_provenance(tmp_path, is_of_before):
    for body in (measured(), measured(**STEPS, lines="median"), measured(crop=(0, 5e-4, 0, 5e-4))):
        rl.write(body, tmp_path / "body.nc")
        if is_of_before:
            data = xarray.load_dataset(tmp_path / "body.nc")
            del data.attrs["provenance"]
            data.to_netcdf(tmp_path / "body.nc", engine="h5netcdf")
        assert rl.read(tmp_path / "body.nc").provenance == body.provenance


@pytest.mark.filterwarnings("ignore::roughline.PreparationWarning")
def test_settings_record_what_is_known():
    for body in (measured(), measured(**STEPS, lines="median"), measured(crop=(0, 5e-4, 0, 5e-4))):
        assert body.provenance.record.items() <= body.settings.items()
        assert body.provenance.instrument == Instrument("points", blur=3e-6)


@pytest.mark.parametrize("wrong", ["no json", "[]", '{"missing_points": "many"}'])
def test_a_damaged_provenance_is_refused(tmp_path, wrong):
    rl.write(rl.Surface(HEIGHTS, (1e-3, 1e-3), "m"), tmp_path / "body.nc")
    data = xarray.load_dataset(tmp_path / "body.nc")
    data.assign_attrs(provenance=wrong).to_netcdf(tmp_path / "body.nc", engine="h5netcdf")
    with pytest.raises(rl.InputError, match=r"damaged file of roughline \(wrong: provenance\)"):
        rl.read(tmp_path / "body.nc")


def test_a_piece_knows_nothing_of_all_points_of_the_whole():
    whole = measured()
    found = whole.cropped((0, 32), (0, 64)).provenance
    assert (found.filled, found.filled_before_crop, found.cropped_share) == (None, 12, 0.5)
    assert (found.instrument, found.tilt) == (whole.provenance.instrument, whole.provenance.tilt)
    again = whole.cropped((0, 32), (0, 64)).cropped((0, 16), (0, 16)).provenance
    assert again.filled_before_crop == 12
    told = replace(whole, provenance=EVERYTHING).cropped((0, 32), (0, 64)).provenance
    assert (told.masked, told.borders, told.outliers_kept, told.low_pass_kept) == (
        None,
        None,
        0,
        "",
    )


def test_the_slopes_of_planes_that_were_removed_add():
    x, y = np.arange(16.0)[:, np.newaxis], np.arange(24.0)
    plane = rl.Surface(0.3 * x - 0.2 * y, (16.0, 24.0), is_cut_out=True)
    level = plane.detrended("tilt")
    assert level.provenance.tilt.removed == pytest.approx((0.3, -0.2))
    again = replace(level, heights=plane.heights).detrended("curvature").scaled(-2.0)
    assert again.provenance.tilt.removed == pytest.approx((-1.2, 0.8))
    assert plane.detrended("mean").provenance.tilt == Tilt()


def test_tilts_of_bodies_that_face_each_other_add_the_second_turned_over():
    x, y = np.arange(16.0)[:, np.newaxis], np.arange(16.0)
    first, second = (
        rl.Surface(a * x + b * y, (16.0, 16.0), is_cut_out=True)
        for a, b in ((0.3, 0.1), (0.2, 0.5))
    )
    after = rl.facing(first, second).detrended("tilt")
    before = rl.facing(first.detrended(), second.detrended())
    for body in (after, before):
        assert body.provenance.tilt.removed == pytest.approx((0.1, 0.6))


def test_a_body_made_anew_of_an_array_knows_what_is_given():
    known = measured()
    plain = rl.Surface(known.heights, known.sizes, known.unit, known.settings)
    assert plain.provenance == Provenance(borders=decided(plain))
    assert plain.removed_trend == "none"
    copied = replace(known, heights=2 * known.heights)
    assert copied.provenance == known.provenance
    assert (copied.is_cut_out, copied.removed_trend) == (True, "tilt")
    given = rl.Line(HEIGHTS[0], 1e-3, is_cut_out=True, provenance=known.provenance)
    assert given.provenance == known.provenance


@pytest.mark.parametrize("wrong", [True, {}, "measured"])
def test_another_provenance_is_refused(wrong):
    with pytest.raises(rl.InputError, match="provenance is .*; a Provenance is needed"):
        rl.Surface(HEIGHTS, (1e-3, 1e-3), provenance=wrong)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"pixels": "round"}, 'pixels is "round"'),
        ({"blur": -1.0}, "blur is -1.0"),
        ({"tip_radius": 0.0}, "tip_radius is 0.0"),
    ],
)
def test_an_instrument_that_cannot_be_is_refused(wrong, said):
    with pytest.raises(rl.InputError, match=said):
        Instrument(**wrong)
