"""Levelling line by line takes what jumps between lines, and says what it takes with it."""

import numpy as np
import pytest

import roughline as rl
from roughline.question.description import describe
from roughline.topography.effects import effects, what_was_prepared
from roughline.topography.files.read import suspicions
from roughline.topography.line_levels import LEVELLINGS, line_levels
from roughline.topography.preparation import Preparation
from roughline.topography.scan_lines import line_jump_warning, line_jumps, scars

NOISE, SHAPE = 0.01, (64, 48)
ROUGH = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=2 * np.pi * 8.001)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.fixture
def flat(rng):
    """Noise about zero."""
    return NOISE * rng.normal(size=SHAPE)


def levelled(heights, how):
    return np.ma.filled(heights - line_levels(heights, how), np.nan)


def measured(heights):
    return rl.Surface(1e-6 * heights, (1e-4, 1e-4), "m", is_cut_out=True)


# medians of 64 points scatter by 0.16 of these
AS_NOISE = 0.7 * NOISE
AS_SUMS = 2.5 * NOISE  # of the medians of 47 differences


@pytest.mark.parametrize("how", LEVELLINGS)
def test_jumps_of_lines_are_taken_and_roughness_stays(how, flat, rng):
    jumps = rng.normal(size=SHAPE[1])
    found = levelled(flat + jumps, how)
    bound = AS_SUMS if how == "differences" else AS_NOISE
    assert found - found.mean() == pytest.approx(flat - flat.mean(), abs=4 * bound)
    assert (found - flat).std() < bound


@pytest.mark.parametrize("how", LEVELLINGS)
def test_a_tilt_across_lines_and_a_step_between_two_are_lost(how, flat):
    tilt = 0.02 * np.arange(SHAPE[1])
    step = np.where(np.arange(SHAPE[1]) < 20, 0.0, 1.0)
    for lost in (tilt, step):
        assert (levelled(flat + lost, how) - flat).std() < (
            AS_SUMS if how == "differences" else AS_NOISE
        )


@pytest.mark.parametrize("how", LEVELLINGS)
def test_what_is_not_known_takes_nothing_with_it(how, flat, rng):
    heights = np.ma.MaskedArray(flat + rng.normal(size=SHAPE[1]), False)
    whole = levelled(heights, how)
    one = heights.copy()
    one[11, 30] = np.ma.masked
    found = levelled(one, how)
    assert np.isnan(found).sum() == 1
    assert found == pytest.approx(np.where(np.isnan(found), np.nan, whole), abs=NOISE, nan_ok=True)
    line = heights.copy()
    line[:, 30] = np.ma.masked
    found = levelled(line, how)
    assert np.isnan(found).sum() == SHAPE[0]
    known = ~np.isnan(found)
    # the lines beside a missing one are levelled against each other
    assert (found - whole)[known].std() < (AS_SUMS if how == "differences" else AS_NOISE)


def test_a_missing_line_and_point_are_filled_at_the_level_of_their_lines(tmp_path, rng):
    surface = 0.1 * ROUGH.surface(64, 3).heights
    heights = surface + 5 * rng.normal(size=64)
    heights[20, 40] = np.nan
    heights[:, 10] = np.nan
    np.save(tmp_path / "map.npy", heights)
    found = describe(
        tmp_path / "map.npy", rl.Reading(unit="um", sizes=(1e-4,)), Preparation(lines="median")
    )
    prepared = 1e6 * found.body.heights
    assert np.isfinite(prepared).all()
    assert prepared.std() < 2 * surface.std()
    assert np.abs(prepared[20, 40]) < 4 * surface.std()
    assert np.abs(prepared[:, 10]).max() < 4 * surface.std()
    assert not any("before lines were levelled" in note for note in found.notes)


def test_points_that_were_filled_before_levelling_are_told_of(tmp_path, rng):
    """Between lines on different levels they are on neither."""
    heights = 0.1 * ROUGH.surface(64, 3).heights + 5 * rng.normal(size=64)
    heights[20] = np.nan
    np.save(tmp_path / "map.npy", heights)
    read = rl.read(tmp_path / "map.npy", "um", sizes=1e-4)
    with pytest.warns(rl.PreparationWarning) as caught:
        level = rl.prepared(read, Preparation(lines="median"))
    assert any("64 missing points were filled before lines" in str(each.message) for each in caught)
    assert any("before lines were levelled" in note for note in map(str, what_was_prepared(level)))
    assert level.heights[20].std() > 2 * np.delete(level.heights, 20, 0).std()


@pytest.mark.parametrize(
    ("share", "island", "rest"),
    [(0.4, 1.0, 0.0), (0.6, 0.0, -1.0)],  # an island on most of a line is taken for its level
)
def test_an_island_stands_on_the_level_of_the_most_points(share, island, rest, flat):
    wide = round(share * SHAPE[0])
    there = np.zeros(SHAPE, bool)
    there[:wide, 20:30] = True
    for how in LEVELLINGS:
        found = levelled(flat + there, how)
        others = found[:, :15].mean()
        assert found[there].mean() - others == pytest.approx(island, abs=0.05)
        assert found[wide:, 20:30].mean() - others == pytest.approx(rest, abs=0.05)


def test_differences_keep_a_plateau_on_most_of_its_lines_that_comes_little_by_little(flat):
    i, j = np.indices(SHAPE)
    there = i < 60 * np.sin(np.pi * j / SHAPE[1])
    for how, height in (("differences", 1.0), ("median", 0.4)):
        found = levelled(flat + there, how)
        assert found[there].mean() - found[~there].mean() == pytest.approx(height, abs=0.15)


def test_tilts_of_single_lines_are_taken_by_their_slopes(flat, rng):
    x = np.arange(SHAPE[0])[:, np.newaxis]
    leaning = flat + rng.normal(size=SHAPE[1]) + 0.02 * rng.normal(size=SHAPE[1]) * x
    assert levelled(leaning, "tilt").std() < 1.2 * NOISE
    assert levelled(leaning, "median").std() > 10 * NOISE


def test_a_step_along_lines_stays(flat):
    there = np.zeros(SHAPE)
    there[40:] = 1.0
    for how in LEVELLINGS:
        found = levelled(flat + there, how)
        assert found[40:].mean() - found[:40].mean() == pytest.approx(1.0, abs=0.03)


def test_rows_that_jump_are_told_of_with_what_to_do(rng):
    surface = ROUGH.surface(128, 3).heights
    jumping = measured(surface + 0.3 * rng.normal(size=128))
    (said,) = [each for each in map(str, suspicions(jumping)) if "rows jump" in each]
    assert 'level them line by line (lines="median")' in said
    assert line_jump_warning(Preparation(lines="median").applied(jumping)) is None
    across = measured((surface + 0.3 * rng.normal(size=128)).T)
    assert line_jump_warning(across) is None


@pytest.mark.parametrize("hurst", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("seed", range(3))
def test_rows_of_rough_and_of_grooved_surfaces_do_not_jump(hurst, seed):
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0)
    whole = spectrum.surface(128, seed, "gaussian").heights
    assert line_jump_warning(measured(whole[:64, :64])) is None
    assert line_jump_warning(measured(0.3 * whole + whole[:1])) is None  # the lay runs along x


def test_jumps_are_measured_by_their_medians(rng):
    found = line_jumps(1e-3 * rng.normal(size=(128, 128)) + 2.0 * rng.normal(size=128))
    assert found.rms == pytest.approx(2 * np.sqrt(2), rel=0.2)
    assert found.by_chance < 1e-3
    assert found.turning == pytest.approx(-0.5, abs=0.2)
    noise = line_jumps(rng.normal(size=(256, 256)))
    assert noise.rms == pytest.approx(noise.by_chance, rel=0.2)
    assert line_jumps(np.zeros((128, 8))) is None
    assert line_jumps(np.zeros((32, 32))).rms == 0


def test_what_levelling_took_is_said(rng):
    jumping = measured(ROUGH.surface(64, 3).heights + 3 * rng.normal(size=64))
    found = Preparation(lines="median").applied(jumping)
    (said,) = (each.fact for each in effects(found) if "line by line" in str(each.fact))
    share = found.rms_height / jumping.rms_height
    assert f"lowers the rms height by {1 - share:.0%}" in str(said)
    assert "takes steps between lines and tilt and waves across them" in str(said)
    assert not said.is_grave
    assert found.settings["lines_levelled"] == "median"


def scarred(rng, length=9, height=8.0):
    heights = ROUGH.surface(128, 3).heights.copy()
    heights[40 : 40 + length, 60] += height
    heights[100:106, 20] -= height
    return heights


def test_scars_are_found_and_filled(rng):
    heights, clean = scarred(rng), ROUGH.surface(128, 3).heights
    marks = scars(heights)
    assert marks[41:48, 60].all()
    assert marks[101:105, 20].all()
    assert marks.sum() <= 15
    found = Preparation(remove_scars=True).applied(measured(heights))
    assert found.settings["scars_removed"] == marks.sum()
    assert 1e6 * found.heights[41:48, 60] == pytest.approx(clean[41:48, 60], abs=0.5)
    assert (found.heights == 1e-6 * heights)[~marks].all()
    assert any("the removal of scars (15 points)" in str(each.fact) for each in effects(found))


@pytest.mark.parametrize("hurst", [0.1, 0.8])
def test_rough_surfaces_have_no_scars(hurst):
    heights = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(128, 2, "gaussian").heights
    assert not scars(heights).any()
    found = Preparation(remove_scars=True).applied(measured(heights))
    assert "no scars are found, so none is removed" in [str(each.fact) for each in effects(found)]


def test_a_line_that_is_off_from_end_to_end_is_no_scar():
    heights = ROUGH.surface(64, 3).heights.copy()
    heights[:, 20] += 9.0
    assert not scars(heights)[:, 20].all()


@pytest.mark.parametrize("step", [{"lines": "median"}, {"remove_scars": True}])
def test_a_line_scan_and_few_lines_are_refused(step):
    with pytest.raises(rl.InputError, match="is for maps; a line scan has one line"):
        Preparation(**step).applied(rl.Line(np.arange(64.0), 1.0, kind="profile"))
    with pytest.raises(rl.InputError, match="needs 8 lines of 8 points or more; the map has 2 of"):
        Preparation(**step).applied(rl.Surface(np.zeros((9, 2)), (1.0, 1.0)))
    with pytest.raises(rl.InputError, match='lines is "mean"; allowed are'):
        Preparation(lines="mean")
