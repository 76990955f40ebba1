"""Measures: one number of the fields of each load, taken whether these are kept or not."""

import numpy as np
import pytest
import xarray

import roughline as rl
from roughline.contact.grid_error import grid_steepening

DEEPEST = rl.Measure("deepest_gap", "u_0", "length", "largest gap", lambda fields: fields.gap.max())
AREA = rl.Measure("touching", "A", "1", "share in contact", lambda fields: fields.contact.mean())
LEFT = rl.Measure(
    "force_on_the_left",
    "F_l",
    "force",
    "force on the left half",
    lambda fields: (
        fields.pressure[: fields.pressure.shape[0] // 2].sum()
        * np.prod(fields.sizes)
        / fields.pressure.size
    ),
)
ALL = [rl.MEAN_GAP, DEEPEST, AREA, LEFT]
FORCES = [1e-4, 1e-3, 1e-2]


@pytest.fixture(scope="module")
def surface():
    return rl.SelfAffine(hurst=0.8, rms_height=0.01).surface(64, rng=7)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("hardness", [None, 0.05])
def test_a_measure_is_that_of_the_fields_that_are_kept(surface, periodic, hardness):
    """Loads that rise and fall among them, for yielding bodies leave dents."""
    forces = [*FORCES, 1e-3, 1e-2]
    given = {"E_star": 1.0, "forces": forces, "periodic": periodic, "hardness": hardness}
    kept = rl.press(surface, fields=True, measures=ALL, **given)
    bare = rl.press(surface, measures=ALL, **given)
    assert bare.fields == ()
    for each in ALL:
        values = kept.measured[each.name].values
        assert values.tolist() == [each.value(fields) for fields in kept.fields]
        assert values.tolist() == bare.measured[each.name].values.tolist()
        assert kept.measured[each.name].low is None
    assert kept.measured["touching"].values == pytest.approx(kept.area_fraction, rel=1e-12)
    assert {fields.is_periodic for fields in kept.fields} == {periodic}
    assert {fields.sizes for fields in kept.fields} == {surface.sizes}


@pytest.mark.parametrize("periodic", [False, True])
def test_the_mean_gap_is_the_volume_between_the_bodies(surface, periodic):
    """Mean height of the highest point, less the approach, plus the mean displacement."""
    curve = rl.press(
        surface, E_star=1.0, forces=FORCES, periodic=periodic, fields=True, measures=[rl.MEAN_GAP]
    )
    displaced = np.array([fields.displacement.mean() for fields in curve.fields])
    apart = surface.heights.max() - surface.heights.mean()
    assert curve.measured["mean_gap"].values == pytest.approx(
        apart - curve.depth + displaced, rel=1e-4
    )


@pytest.mark.parametrize("length", [1e-9, 1e6])
def test_its_dimension_follows_the_unit_of_lengths(surface, length):
    """Lengths in other units, and pressures as they were: forces go with the square."""
    forces = np.array(FORCES)
    given = {"E_star": 1.0, "measures": ALL, "grid_error": True}
    scaled = rl.Surface(surface.heights * length, (length, length))
    other = rl.press(scaled, forces=forces * length**2, **given).measured
    for name, each in rl.press(surface, forces=forces, **given).measured.items():
        times = {"length": length, "1": 1.0, "force": length**2}[each.quantity.dimension]
        assert other[name].rows == pytest.approx(each.rows * times, rel=1e-5), name


def test_a_load_that_was_not_solved_has_none(surface):
    curve = rl.press(
        surface,
        E_star=1.0,
        forces=FORCES,
        measures=ALL,
        solver=rl.Solver(max_iterations=1),
        throw=False,
    )
    assert not curve.converged.all()
    for each in curve.measured.values():
        assert (np.isnan(each.values) == ~curve.converged).all()


def test_ctrl_c_keeps_the_loads_before(surface):
    def stop(done, _of):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(rl.Interrupted) as stopped:
        rl.press(surface, E_star=1.0, forces=FORCES, measures=ALL, progress=stop)
    known = ~np.isnan(stopped.value.curve.measured["mean_gap"].values)
    assert known.tolist() == [True, True, False]


def test_files_have_it_with_unit_and_meaning(surface, tmp_path):
    given = {"E_star": 1.0, "forces": FORCES, "measures": ALL}
    metres = rl.Surface(surface.heights, surface.sizes, unit="m")
    curve = rl.press(metres, grid_error=True, **given)
    curve.write(tmp_path / "curve.nc")
    with xarray.open_dataset(tmp_path / "curve.nc") as data:
        assert data.mean_gap.values == pytest.approx(curve.measured["mean_gap"].values)
        assert data.mean_gap_low.values == pytest.approx(curve.measured["mean_gap"].low)
        assert data.force_on_the_left.attrs == {
            "units": "N",
            "long_name": "force on the left half",
        }
    curve.write(tmp_path / "curve.csv")
    header = (tmp_path / "curve.csv").read_text("utf-8").splitlines()[0].split(",")
    assert header[-3:] == [f"force_on_the_left{end} [N]" for end in ("", "_low", "_high")]
    assert "mean_gap [m]" in header
    without = rl.press(metres, grid_error=True, **(given | {"measures": []}))
    assert not without.measured
    assert (without.stiffness_error == curve.stiffness_error).all()


@pytest.mark.parametrize("n", [32, 64])
@pytest.mark.parametrize("hardness_bar", [None, 0.4])
def test_the_interval_of_a_mean_gap_holds_what_a_grid_four_times_finer_gives(n, hardness_bar):
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=0.01)
    coarse, fine = spectrum.surface(n, 3000), spectrum.surface(4 * n, 3000)
    slope = fine.rms_slope
    given = {"E_star": 1.0, "periodic": True, "measures": [rl.MEAN_GAP]}
    given |= {"forces": slope * np.array([0.02, 0.06, 0.12])}
    given |= {"hardness": hardness_bar and hardness_bar * slope}
    found = rl.press(coarse, grid_error=True, **given).measured["mean_gap"]
    truth = rl.press(fine, **given).measured["mean_gap"].values
    assert (found.low < truth).all()
    assert (truth < found.high).all()
    # its logarithm differs between grids, and finer ones steepen the surface, by so much
    grids = [rl.Surface(coarse.heights[::2, ::2], coarse.sizes), coarse.coarsened()]
    grids.append(grids[1].coarsened())
    thinned, half, quarter = (
        np.log(rl.press(each, **given).measured["mean_gap"].values) for each in grids
    )
    log = np.log(found.values)
    between = np.hypot(np.hypot(thinned - log, half - log), (quarter - half) / 4)
    width = np.sqrt(grid_steepening(coarse)) * between
    assert np.log(found.high) - log == pytest.approx(width, rel=1e-4)
    assert log - np.log(found.low) == pytest.approx(width, rel=1e-4)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("mean_gap", "give a list of measures"),
        (["mean_gap"], "give a list of measures"),
        (rl.MEAN_GAP, "give a list of measures"),
        ([DEEPEST, rl.Measure("deepest_gap", "u", "1", "other", float)], "two have the name"),
    ],
)
def test_what_is_no_measure_is_refused(surface, given, said):
    with pytest.raises(rl.InputError, match=said):
        rl.press(surface, E_star=1.0, forces=FORCES, measures=given)


def test_a_line_has_no_fields_to_measure():
    line = rl.SelfAffine(hurst=0.8, rms_height=0.01).line(256, rng=7)
    with pytest.raises(rl.InputError, match="reduced model of a Line has no fields"):
        rl.press(line, E_star=1.0, forces=FORCES, measures=[rl.MEAN_GAP])


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"name": "mean gap"}, "a word of letters"),
        ({"name": "stiffness"}, "that of another quantity"),
        ({"dimension": "metre"}, "dimension"),
        ({"value": 1.0}, "a function of the fields"),
    ],
)
def test_a_measure_that_cannot_be_used_is_refused(changed, said):
    given = {"name": "mine", "symbol": "m", "dimension": "1", "meaning": "", "value": float}
    with pytest.raises(rl.InputError, match=said):
        rl.Measure(**(given | changed))


def test_a_measure_that_gives_no_number_is_named(surface):
    shape = rl.Measure("shape", "n", "1", "points", lambda fields: fields.gap.shape)
    with pytest.raises(rl.InputError, match="the measure shape gives no number"):
        rl.press(surface, E_star=1.0, forces=FORCES, measures=[shape])
