"""NetCDF that other programs write: heights, missing points and sides as CF means them."""

import h5netcdf
import numpy as np
import pytest
import xarray
from scipy.io import netcdf_file
from SurfaceTopography import NonuniformLineScan, Topography, UniformLineScan

import roughline as rl
from random_cases import cases, seeds
from roughline.topography.files.read import measurement

ROWS = 2e-7 * np.random.default_rng(0).normal(size=(12, 20))  # (y, x) [m]
X, Y = 1e-6 * np.arange(20), 2e-6 * np.arange(12)  # [m]
SIDES = (20e-6, 24e-6)
ENGINES = ("h5netcdf", "scipy")
METRES = {"units": "m"}


def stored(path, rows=ROWS, x=X, y=Y, engine="h5netcdf", encoding=None, **attrs):
    """Write rows over (y, x), by default in metres; attributes are those of the heights."""
    attrs = METRES | attrs
    data = xarray.Dataset(
        {"height": (("y", "x"), rows, attrs)}, {"x": ("x", x, METRES), "y": ("y", y, METRES)}
    )
    data.to_netcdf(path, engine=engine, encoding={"height": encoding or {}})
    return path


def assert_is(path, rows=ROWS, rtol=1e-12, **asked):
    found = rl.read(path, trend="none", **asked)
    assert found.sizes == pytest.approx(SIDES, rel=1e-12)
    np.testing.assert_allclose(found.heights, rows.T, rtol=rtol, atol=rtol * 1e-6)
    return found


@pytest.mark.parametrize("engine", ENGINES)
def test_rows_run_along_y_and_columns_along_x(tmp_path, engine):
    found = assert_is(stored(tmp_path / "map.nc", engine=engine))
    assert found.is_cut_out
    content = measurement(tmp_path / "map.nc")
    assert (content.format, content.reader, content.channel) == ("NetCDF", "", "height")


@pytest.mark.parametrize("engine", ENGINES)
def test_a_marked_point_is_missing(tmp_path, engine):
    rows = ROWS.copy()
    rows[3, 4] = np.nan
    path = stored(tmp_path / "map.nc", rows, engine=engine, encoding={"_FillValue": -9999.0})
    content = measurement(path)
    assert np.argwhere(content.unknown).tolist() == [[4, 3]]
    assert rl.read(path).settings["missing_points"] == 1


def test_counts_are_scaled_as_the_file_states(tmp_path):
    packed = {"dtype": "i2", "scale_factor": 1e-10, "add_offset": 1e-7, "_FillValue": -32768}
    for engine in ENGINES:
        path = stored(tmp_path / f"{engine}.nc", engine=engine, encoding=packed)
        found = assert_is(path, rtol=1e-3)
        assert found.rms_height == pytest.approx(np.std(ROWS), rel=1e-6)


@pytest.mark.parametrize(
    ("attrs", "missing"),
    [
        # -32767 is what the library of NetCDF writes where nothing was written
        ({}, [-32767]),
        ({"_FillValue": np.int16(8)}, [8]),
        ({"missing_value": np.int16([7, 9])}, [7, 9, -32767]),
        ({"valid_range": np.int16([8, 40])}, [7, 50, -32767]),
        ({"valid_max": np.int16(8)}, [9, 50, -32767]),
    ],
)
def test_what_cf_calls_missing_is_missing(tmp_path, attrs, missing):
    counts = np.tile(np.int16([7, 8, 9, -32767, 50]), (4, 2))
    heights = ("y", "x"), counts, {**METRES, "scale_factor": 1e-9, **attrs}
    xarray.Dataset({"z": heights}).to_netcdf(tmp_path / "map.nc", engine="scipy")
    unknown = measurement(tmp_path / "map.nc").unknown
    assert (unknown == np.isin(counts.T, missing)).all()


def test_bytes_that_are_unsigned_are_read_so(tmp_path):
    counts = np.arange(240, dtype=np.uint8).reshape(12, 20)
    attrs = {**METRES, "_Unsigned": "true", "_FillValue": np.int8(-17), "scale_factor": 1e-9}
    heights = ("y", "x"), counts.view(np.int8), attrs
    data = xarray.Dataset({"z": heights}, {"x": ("x", X, METRES), "y": ("y", Y, METRES)})
    data.to_netcdf(tmp_path / "map.nc", engine="scipy")
    heights = measurement(tmp_path / "map.nc").heights
    np.testing.assert_allclose(heights.T.ravel()[:239], 1e-9 * np.arange(239))
    assert np.isnan(heights.T.ravel()[239])


def test_heights_and_sides_have_units_of_their_own(tmp_path):
    micrometres = {"units": "micrometers"}
    sides = {"x": ("x", 1e6 * X, micrometres), "y": ("y", 1e3 * Y, {"units": "mm"})}
    heights = ("y", "x"), 1e9 * ROWS, {"units": "nm"}
    xarray.Dataset({"height": heights}, sides).to_netcdf(tmp_path / "map.nc", engine="h5netcdf")
    assert_is(tmp_path / "map.nc")


def test_heights_without_a_unit_take_none_from_the_sides(tmp_path):
    sides = {"x": ("x", X, METRES), "y": ("y", Y, METRES)}
    data = xarray.Dataset({"height": (("y", "x"), 1e9 * ROWS)}, sides)
    data.to_netcdf(tmp_path / "map.nc", engine="h5netcdf")
    with pytest.raises(rl.UnitError, match="states its sizes in m and no unit of its heights"):
        rl.read(tmp_path / "map.nc")
    assert_is(tmp_path / "map.nc", unit="nm")


def test_sides_without_a_unit_take_none_from_the_heights(tmp_path):
    data = xarray.Dataset({"height": (("y", "x"), ROWS, METRES)}, {"x": 1e6 * X, "y": 1e6 * Y})
    data.to_netcdf(tmp_path / "map.nc", engine="h5netcdf")
    with pytest.raises(rl.InputError, match="states no sizes for its 20 x 12 points"):
        rl.read(tmp_path / "map.nc")
    assert_is(tmp_path / "map.nc", sizes=SIDES)


@pytest.mark.parametrize(
    ("rows", "x", "y"),
    [
        (ROWS[:, ::-1], X[::-1], Y),
        (ROWS[::-1], X, Y[::-1]),
        (ROWS[::-1, ::-1], -X, -Y - 1),
    ],
)
def test_the_order_of_points_in_the_file_does_not_matter(tmp_path, rows, x, y):
    assert_is(stored(tmp_path / "map.nc", rows, x, y))


def test_what_runs_along_x_is_said_by_names_and_by_axes(tmp_path):
    axes = {"a": ("a", Y, {**METRES, "axis": "Y"}), "b": ("b", X, {**METRES, "axis": "X"})}
    named = {"height": (("b", "a"), ROWS.T, METRES)}
    xarray.Dataset(named, axes).to_netcdf(tmp_path / "axes.nc", engine="h5netcdf")
    assert_is(tmp_path / "axes.nc")
    named = {"height": (("x", "y"), ROWS.T, METRES)}
    sides = {"x": ("x", X, METRES), "y": ("y", Y, METRES)}
    xarray.Dataset(named, sides).to_netcdf(tmp_path / "names.nc", engine="h5netcdf")
    assert_is(tmp_path / "names.nc")


@pytest.mark.parametrize(
    ("x", "message"),
    [
        (np.geomspace(1e-6, 2e-5, 20), "uneven positions along x: bring the map to an even grid"),
        (np.zeros(20), "positions along x that neither rise nor fall"),
        (np.where(X > 5e-6, np.nan, X), "positions along x that neither rise nor fall"),
    ],
)
def test_positions_that_are_no_grid_are_refused(tmp_path, x, message):
    with pytest.raises(rl.InputError, match=message):
        rl.read(stored(tmp_path / "map.nc", x=x))


def test_positions_in_degrees_are_refused(tmp_path):
    sides = {"lon": ("lon", X, {"units": "degrees_east"}), "lat": ("lat", Y, {"units": "degrees"})}
    data = xarray.Dataset({"z": (("lat", "lon"), ROWS, METRES)}, sides)
    data.to_netcdf(tmp_path / "map.nc", engine="scipy")
    with pytest.raises(rl.InputError, match="along x in degrees_east, no unit of length"):
        rl.read(tmp_path / "map.nc")


def several(path, **heights):
    """Write data sets by their names, each with its attributes."""
    sides = {"x": ("x", X, METRES), "y": ("y", Y, METRES)}
    named = {name: (("y", "x"), rows, attrs) for name, (rows, attrs) in heights.items()}
    xarray.Dataset(named, sides).to_netcdf(path, engine="h5netcdf")
    return path


@pytest.mark.parametrize(
    "heights",
    [
        {"current": (ROWS + 1, {"units": "A"}), "data": (ROWS, METRES)},
        {"sigma": (ROWS + 1, METRES), "z": (ROWS, METRES)},
        {"z_error": (ROWS + 1, METRES), "a": (ROWS, {**METRES, "standard_name": "height"})},
        {"error": (ROWS + 1, METRES), "b": (ROWS, {**METRES, "long_name": "Topography"})},
    ],
)
def test_of_two_data_sets_the_one_that_is_of_heights_is_read(tmp_path, heights):
    assert_is(several(tmp_path / "map.nc", **heights))


def test_where_nothing_decides_the_file_is_refused_until_a_channel_is_chosen(tmp_path):
    path = several(tmp_path / "map.nc", first=(ROWS + 1, {}), second=(ROWS, {}))
    with pytest.raises(rl.InputError, match="NetCDF with 0 'first', 1 'second', and nothing says"):
        rl.read(path)
    assert_is(path, channel="second", unit="m")
    assert_is(path, channel=1, unit="m")
    path = several(tmp_path / "two.nc", trace=(ROWS + 1, METRES), retrace=(ROWS, METRES))
    with pytest.raises(rl.InputError, match="several of them may be heights: choose one"):
        rl.read(path)
    assert_is(path, channel="retrace")


def test_a_channel_of_another_quantity_is_refused(tmp_path):
    path = several(tmp_path / "map.nc", phase=(ROWS, {"units": "degree"}), z=(ROWS, METRES))
    assert measurement(path).channels == ("0 phase (no heights)", "1 z")
    with pytest.raises(rl.InputError, match=r"channel 'phase' of map.nc holds no heights"):
        rl.read(path, channel="phase")
    with pytest.raises(rl.InputError, match="has no channel '7'; it has 0 'phase', 1 'z'"):
        rl.read(path, channel=7)


def test_numbers_that_are_no_lengths_are_not_offered_as_heights(tmp_path):
    stored(tmp_path / "map.nc", units="arbitrary\nunits")
    with pytest.raises(
        rl.InputError, match=r"no heights; it has height \(its unit is arbitrary units\)"
    ):
        rl.read(tmp_path / "map.nc")
    with pytest.raises(
        rl.InputError, match="holds no heights .its unit is arbitrary units.; it has"
    ):
        rl.read(tmp_path / "map.nc", channel="height")


def test_a_single_row_is_a_line_scan(tmp_path):
    found = rl.read(stored(tmp_path / "map.nc", ROWS[:1], y=Y[:1]), trend="none")
    assert isinstance(found, rl.Line)
    assert found.length == pytest.approx(SIDES[0])
    np.testing.assert_allclose(found.heights, ROWS[0])


def test_points_in_a_list_are_refused(tmp_path):
    columns = {name: ("n", np.arange(9.0), METRES) for name in ("x", "y", "z")}
    xarray.Dataset(columns).to_netcdf(tmp_path / "list.nc", engine="scipy")
    with pytest.raises(rl.InputError, match="lists points with an x and a y each"):
        rl.read(tmp_path / "list.nc")


def test_numbers_over_three_sides_and_groups_are_refused(tmp_path):
    cube = {"height": (("t", "y", "x"), np.zeros((2, 3, 4)), METRES)}
    xarray.Dataset(cube).to_netcdf(tmp_path / "cube.nc", engine="h5netcdf")
    with pytest.raises(rl.InputError, match="NetCDF without numbers over one or two sides"):
        rl.read(tmp_path / "cube.nc")
    flat = {"height": (("y", "x"), ROWS, METRES)}
    xarray.Dataset(flat).to_netcdf(tmp_path / "group.nc", engine="h5netcdf", group="scan")
    with pytest.raises(rl.InputError, match="or it lies in a group"):
        rl.read(tmp_path / "group.nc")


@pytest.mark.parametrize("periodic", [True, False])
def test_what_surface_topography_writes_keeps_unit_borders_and_missing_points(tmp_path, periodic):
    heights = np.ma.masked_array(1e6 * ROWS.T, mask=np.zeros(ROWS.T.shape, dtype=bool))
    if not periodic:
        heights.mask[4, 3] = True
    Topography(heights, (20.0, 24.0), unit="um", periodic=periodic).to_netcdf(tmp_path / "st.nc")
    found = rl.read(tmp_path / "st.nc", trend="none")
    assert found.sizes == pytest.approx(SIDES, rel=1e-15)
    assert found.is_cut_out is not periodic
    unknown = measurement(tmp_path / "st.nc").unknown
    assert (unknown == np.ma.getmaskarray(heights)).all()
    np.testing.assert_allclose(found.heights[~unknown], ROWS.T[~unknown], rtol=1e-14)


def test_what_repeats_keeps_its_tilt(tmp_path):
    Topography(ROWS.T, SIDES, unit="m", periodic=True).to_netcdf(tmp_path / "st.nc")
    found = rl.read(tmp_path / "st.nc")
    assert found.removed_trend == "mean"
    np.testing.assert_allclose(found.heights, ROWS.T - ROWS.mean(), atol=1e-20)


def test_lines_of_surface_topography_are_line_scans(tmp_path):
    UniformLineScan(1e9 * ROWS[0], 20e3, unit="nm").to_netcdf(tmp_path / "even.nc")
    found = rl.read(tmp_path / "even.nc", trend="none")
    assert found.length == pytest.approx(20e-6)
    np.testing.assert_allclose(found.heights, ROWS[0], rtol=1e-14)
    x = 1e-6 * np.geomspace(1, 20, 20)
    NonuniformLineScan(x, ROWS[0], unit="m").to_netcdf(tmp_path / "uneven.nc")
    found = rl.read(tmp_path / "uneven.nc", trend="none")
    assert found.length == pytest.approx(np.ptp(x))
    np.testing.assert_allclose(
        found.heights, np.interp(np.linspace(x[0], x[-1], 20), x, ROWS[0]), atol=1e-20
    )


def test_a_length_that_differs_from_the_positions_is_refused(tmp_path):
    Topography(ROWS.T, SIDES, unit="m").to_netcdf(tmp_path / "st.nc")
    with netcdf_file(tmp_path / "st.nc", "a") as file:
        file.variables["x"].length = 4e-5
    with pytest.raises(rl.InputError, match="a length of 4e-05 along x, and its positions make 2e"):
        rl.read(tmp_path / "st.nc")


@pytest.mark.parametrize("of_pixels", [True, False])
def test_a_grid_of_gmt_is_read(tmp_path, of_pixels):
    """Heights have no unit of their own; ranges count from the borders of pixels or from nodes."""
    with netcdf_file(tmp_path / "map.grd", "w") as file:
        file.Conventions, file.GMT_version = "CF-1.7", "6.4.0"
        if of_pixels:
            file.node_offset = 1
        for name, values, step in (("x", X, 1e-6), ("y", Y, 2e-6)):
            file.createDimension(name, values.size)
            variable = file.createVariable(name, "f8", (name,))
            variable[:] = values
            border = step / 2 if of_pixels else 0.0
            variable.long_name, variable.units = name, "m"
            variable.actual_range = np.array([values[0] - border, values[-1] + border])
        heights = file.createVariable("z", "f4", ("y", "x"))
        heights[:] = 1e9 * ROWS
        heights.long_name, heights._FillValue = "z", np.float32(np.nan)
    with pytest.raises(rl.UnitError, match="states its sizes in m and no unit of its heights"):
        rl.read(tmp_path / "map.grd")
    assert_is(tmp_path / "map.grd", unit="nm", rtol=1e-6)


@pytest.mark.parametrize("of_pixels", [0, 1])
def test_a_grid_of_early_gmt_is_read_from_its_top_row(tmp_path, of_pixels):
    with netcdf_file(tmp_path / "map.grd", "w") as file:
        file.createDimension("side", 2)
        file.createDimension("xysize", ROWS.size)
        border = of_pixels / 2
        for name, values in (("x", X), ("y", Y)):
            step = values[1] - values[0]
            ends = np.array([values[0] - border * step, values[-1] + border * step])
            file.createVariable(f"{name}_range", "f8", ("side",))[:] = ends
            file.variables[f"{name}_range"].units = "m"
        file.createVariable("z_range", "f8", ("side",))[:] = [ROWS.min(), ROWS.max()]
        file.variables["z_range"].units = "user_z_unit"
        file.createVariable("dimension", "i4", ("side",))[:] = [20, 12]
        heights = file.createVariable("z", "f4", ("xysize",))
        heights[:] = (1e9 * ROWS[::-1] - 5).ravel() / 2
        heights.scale_factor, heights.add_offset, heights.node_offset = 2.0, 5.0, of_pixels
    assert_is(tmp_path / "map.grd", unit="nm", rtol=1e-6)


def test_what_is_not_read_is_named(tmp_path):
    (tmp_path / "map.nc").write_bytes(b"CDF\x05" + bytes(100))
    with pytest.raises(rl.InputError, match="of the kind CDF-5, which is not read: convert it"):
        rl.read(tmp_path / "map.nc")
    with netcdf_file(tmp_path / "scan.nc", "w") as file:
        file.createDimension("one", 1)
        for name in ("rangex", "rangey"):
            file.createVariable(name, "f8", ("one",))[:] = 1
    with pytest.raises(rl.InputError, match="NetCDF of GXSM, whose layout is not read"):
        rl.read(tmp_path / "scan.nc")


def test_netcdf_under_another_name_is_known_by_its_mark(tmp_path):
    with h5netcdf.File(tmp_path / "map.h5", "w") as file:
        file.dimensions = {"y": 12, "x": 20}
        for name, dims, values in (("x", ("x",), X), ("y", ("y",), Y), ("z", ("y", "x"), ROWS)):
            file.create_variable(name, dims, data=values).attrs["units"] = "m"
    assert_is(tmp_path / "map.h5")


def of_each_kind(folder):
    stored(folder / "hdf5.nc")
    stored(folder / "classic.nc", engine="scipy", encoding={"_FillValue": -9999.0})
    Topography(ROWS.T, SIDES, unit="m", periodic=True).to_netcdf(folder / "st.nc")
    rl.write(rl.Surface(ROWS.T, SIDES, "m", is_cut_out=True), folder / "own.nc")
    return [folder / f"{name}.nc" for name in ("hdf5", "classic", "st", "own")]


@seeds(10, cases(2000, share=20))
def test_a_damaged_file_is_refused_in_one_line(tmp_path, seeds):
    """Bytes of its head are changed, or it is cut: a cut one is never read.

    HDF5 is cut alone: its library goes through some damaged heaps for ever.
    """
    for path in of_each_kind(tmp_path):
        content = path.read_bytes()
        for seed in seeds:
            random = np.random.default_rng(seed)
            damaged, is_cut = bytearray(content), seed % 3 == 0 or path.stem == "hdf5"
            if is_cut:
                damaged = damaged[: random.integers(1, len(damaged))]
            else:
                for place in random.integers(min(len(damaged), 3000), size=3):
                    damaged[place] = random.choice([0, 1, 127, 255, random.integers(256)])
            path.write_bytes(damaged)
            said = refusal(path)
            assert said is None or (len(said.splitlines()) == 1 and len(said) < 300)
            assert said or not is_cut


def refusal(path):
    try:
        measurement(path)
    except rl.InputError as error:
        return str(error)
    return None
