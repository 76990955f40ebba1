"""Files in and out: metres always, one clear line otherwise."""

import tracemalloc
import zipfile
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.files.read import suspicions
from roughline.topography.missing import Missing, missing_pattern
from roughline.topography.preparation import prepared
from roughline.topography.trend import without_trend
from roughline.units import engineering, in_si, metres_per

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)


def write_with_the_library(path, heights, sizes, unit):
    """Write a topography through SurfaceTopography's own NetCDF writer."""
    from SurfaceTopography import Topography

    Topography(heights, sizes, unit=unit).to_netcdf(str(path))


@pytest.mark.parametrize(("unit", "metres"), [("m", 1.0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)])
def test_a_surface_is_the_same_in_every_unit(tmp_path, unit, metres):
    surface = SPECTRUM.surface(24, 7)
    path = tmp_path / "map.nc"
    write_with_the_library(path, surface.heights / metres, (1e-3 / metres, 1e-3 / metres), unit)
    found = rl.read(path, trend="none")
    assert found.unit == "m"
    assert found.sizes == pytest.approx((1e-3, 1e-3), rel=1e-7)  # the writer keeps them in float32
    assert found.heights == pytest.approx(surface.heights, rel=1e-9, abs=1e-18)


@pytest.mark.parametrize("body", ["surface", "line"])
def test_what_is_written_is_read_back(tmp_path, body):
    original = replace(getattr(SPECTRUM, body)(64, 7), unit="m")
    path = tmp_path / "body.nc"
    rl.write(original, path)
    found = rl.read(str(path))
    assert type(found) is type(original)
    assert found.heights.tobytes() == original.heights.tobytes()
    assert found.spacing == original.spacing
    assert found.settings["seed"] == original.settings["seed"]
    assert (prepared(found).heights == found.heights).all()  # a synthetic body keeps its tilt
    rl.write(found, path)  # over itself


def test_a_file_without_unit_is_refused_until_one_is_given(tmp_path):
    path = tmp_path / "body.nc"
    rl.write(SPECTRUM.surface(16, 7), path)
    with pytest.raises(rl.UnitError, match="body.nc states no unit; say which"):
        rl.read(path)
    found = rl.read(path, unit="mm")
    assert found.sizes == pytest.approx((1e-6, 1e-6))
    with pytest.raises(rl.UnitError, match='unit is "1 parsnip"'):
        rl.read(path, unit="parsnip")
    rl.write(found, path)
    with pytest.raises(rl.UnitError, match="states its unit, m; leave unit = nm out"):
        rl.read(path, unit="nm")


def test_a_text_scan_without_unit_is_refused_until_one_is_given(tmp_path):
    path = tmp_path / "scan.txt"
    x = np.linspace(0, 10, 50) ** 1.1
    np.savetxt(path, np.stack([x, np.sin(x)], axis=1))
    with pytest.raises(rl.UnitError, match="states no unit"):
        rl.read(path)
    line = rl.read(path, unit="um")
    assert (line.kind, line.unit) == ("profile", "m")
    assert line.length == pytest.approx((x[-1] - x[0]) * 1e-6, rel=0.03)


@pytest.mark.parametrize(
    ("name", "content"),
    [("notes.txt", "no numbers here"), ("empty.al3d", ""), ("noise.opd", "\x01\x02" * 500)],
)
def test_unknown_and_damaged_files_get_one_line(tmp_path, name, content):
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(rl.InputError, match=name) as caught:
        rl.read(path)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 250


def test_missing_files_and_folders_are_named(tmp_path):
    with pytest.raises(rl.InputError, match="does not exist; give a file"):
        rl.read(tmp_path / "none.sur")
    with pytest.raises(rl.InputError, match="is a folder"):
        rl.read(tmp_path)
    surface = SPECTRUM.surface(8, 1)
    with pytest.raises(rl.InputError, match='does not end in ".nc"'):
        rl.write(surface, tmp_path / "surface.txt")
    with pytest.raises(rl.StoreError, match="cannot write"):
        rl.write(surface, tmp_path / "none" / "surface.nc")


@pytest.mark.parametrize(
    ("name", "kind", "points", "size"),
    [
        ("al3d-1.al3d", "surface", 200 * 296, 87.6054e-6),
        ("di-1.di", "surface", 512 * 512, 500e-9),
        ("dektak-1.csv", "profile", 9600, 1499.8e-6),
        ("mitutoyo_mock.xlsx", "profile", 960, 480e-6),
    ],
)
def test_real_files_open_in_metres(topographies, name, kind, points, size):
    body = rl.read(topographies / name)
    assert body.unit == "m"
    assert body.heights.size == points
    assert (body.sizes[0] if kind == "surface" else body.length) == pytest.approx(size)
    assert kind == ("surface" if isinstance(body, rl.Surface) else body.kind)
    assert body.settings["detrended"] == "tilt"
    assert body.rms_height < rl.read(topographies / name, trend="none").rms_height
    assert (prepared(body).heights == body.heights).all()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("sur-3.sur", r"233009 missing points of 262144 \(89%\); up to 10% are filled: crop"),
        ("xy-1.txt", "states no unit"),
        ("di_corrupted.di", "di_corrupted.di is damaged or of a type that is not known"),
    ],
)
def test_real_files_that_cannot_be_used_say_why(topographies, name, message):
    with pytest.raises(rl.InputError, match=message):
        rl.read(topographies / name)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("110 GPa", "Pa", 110e9),
        ("110GPa", "Pa", 110e9),
        ("0.5 mm", "m", 5e-4),
        ("2 µm", "m", 2e-6),
        ("2um", "m", 2e-6),
        ("1e3 N/mm^2", "Pa", 1e9),
        ("2 kN", "N", 2000.0),
        ("-3 N", "N", -3.0),
    ],
)
def test_quantities_become_si(text, unit, value):
    assert in_si(text, unit, "it") == pytest.approx(value)


@pytest.mark.parametrize(
    "text", ["5 N", "abc", "", "GPa", "5 GPa 3", "9**9**9 Pa", "1/0 Pa", "5 GPaa", "5 Pa*" * 50]
)
def test_senseless_quantities_are_refused(text):
    with pytest.raises(rl.UnitError, match="modulus is .* such as"):
        in_si(text, "Pa", "modulus")
    with pytest.raises(rl.UnitError, match="without a unit; give one"):
        in_si("5", "Pa", "modulus")


def test_units_are_written_with_prefixes():
    assert engineering(1.2344e-6, "m") == "1.234 µm"


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (1 - 2e-16, "N", "1 N"),  # what rounds to a thousand has the next prefix
        (999.96, "N", "1 kN"),
        (1e-9, "m", "1 nm"),
        (1e-3, "m", "1 mm"),
        (0.0, "m", "0 m"),
        (-2.5e-3, "ohm", "-2.5 mΩ"),
        (4.713e-12, "m²", "4.713 µm²"),  # the prefix of an area counts twice
        (1.3e-13, "m²", "0.13 µm²"),
        (2.1e-9, "m²", "2100 µm²"),
        (1.499e5, "W/(m² K)", "149.9 kW/(m² K)"),
        (1.3e14, "N/m³", "130 TN/m³"),
    ],
)
def test_prefixes(value, unit, text):
    assert engineering(value, unit) == text


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("200 W/(m K)", "W/m/K", 200),
        ("200 W m-1 K-1", "W/m/K", 200),
        ("200 W/(m·K)", "W/m/K", 200),
        ("2 N/mm2", "Pa", 2e6),
        ("2 N/mm²", "Pa", 2e6),
        ("2 N/mm^2", "Pa", 2e6),
        ("7860 kg/m3", "kg/m**3", 7860),
        ("2e6 m^-1", "1/m", 2e6),
        ("0.3 mN", "N", 0.0003),  # and not 0.00029999999999999997
        ("10000 mN", "N", 10.0),
        ("0.7 um", "m", 0.7e-6),
    ],
)
def test_units_are_read_as_engineers_write_them(text, unit, value):
    assert in_si(text, unit, "it") == value


@pytest.mark.parametrize("text", ["0,33 GPa", "1,000 GPa"])
def test_a_comma_in_a_number_is_blamed(text):
    number = text.split()[0]
    with pytest.raises(rl.UnitError, match=f'comma in "{number}"; numbers take a decimal point'):
        in_si(text, "Pa", "modulus")
    assert metres_per("um") == metres_per("µm") == pytest.approx(1e-6)


@pytest.mark.parametrize("missing", ["harmonic", "nearest"])
def test_missing_points_are_filled_and_counted(topographies, missing):
    found = rl.read(topographies / "opd-1.opd", missing=missing)
    assert found.settings["missing_points"] == 116
    assert found.settings["missing_share"] == pytest.approx(116 / 307200)
    assert found.settings["filled"] == missing
    with pytest.raises(rl.InputError, match="116 missing points of 307200"):
        rl.read(topographies / "opd-1.opd", most_missing=0)


def masked_wave(n=48, share=0.05):
    x = np.linspace(-1, 1, n)
    heights = x[:, np.newaxis] ** 2 - x**2  # harmonic, so one of the methods is exact
    mask = np.random.default_rng(1).random((n, n)) < share
    mask[0] = mask[-1] = mask[:, 0] = mask[:, -1] = False
    return heights, np.ma.MaskedArray(heights, mask)


def test_harmonic_filling_is_exact_for_a_harmonic_surface_and_nearest_is_near():
    heights, masked = masked_wave()
    assert Missing().filled(masked, "a map") == pytest.approx(heights, abs=1e-12)
    near = Missing("nearest").filled(masked, "a map")
    assert np.abs(near - heights).max() < 0.2
    assert (near[~masked.mask] == heights[~masked.mask]).all()
    line = np.ma.MaskedArray(np.arange(9.0), np.arange(9) % 4 == 2)
    assert Missing(most=0.5).filled(line, "a line") == pytest.approx(np.arange(9.0))


def test_too_many_missing_points_are_refused_with_numbers():
    _, masked = masked_wave(share=0.3)
    with pytest.raises(
        rl.InputError, match=r"a map has \d+ missing points of 2304 \(\d\d%\); up to"
    ):
        Missing().filled(masked, "a map")
    everything = np.ma.MaskedArray(np.ones((3, 3)), True)
    with pytest.raises(rl.InputError, match="9 missing points of 9"):
        Missing(most=0.99).filled(everything, "a map")
    with pytest.raises(rl.InputError, match="missing is 'spline'"):
        Missing("spline")
    with pytest.raises(rl.InputError, match="most_missing is 1"):
        Missing(most=1.0)


def missing_at(*pieces, shape=(40, 60)):
    unknown = np.zeros(shape, dtype=bool)
    for piece in pieces:
        unknown[piece] = True
    return missing_pattern(unknown)


@pytest.mark.parametrize(
    ("pieces", "said"),
    [
        ([], "none"),
        ([np.s_[10:20, 5:9]], "one region, inside"),
        ([np.s_[:, :7]], "one region, at the border"),
        ([np.s_[:30, :40], np.s_[35, 50]], "mostly one region, at the border"),
        ([np.s_[10:20, 5:9], np.s_[10:20, 20:24]], "2 regions, inside"),
        ([np.s_[0:10, 5:9], np.s_[10:20, 20:24]], "2 regions, at the border and inside"),
        ([np.s_[2:-2:4, 2:-2:4]], "scattered in 126 places, inside"),
    ],
)
def test_where_points_are_missing_is_said_in_words(pieces, said):
    assert str(missing_at(*pieces)) == said


def test_a_coarse_map_shows_the_share_that_is_missing_in_each_piece():
    found = missing_at(np.s_[:, :15], np.s_[0, 59])
    assert (found.count, found.regions, found.largest, found.at_border) == (601, 2, 600, 601)
    columns, rows = found.cells.shape
    assert (columns, rows) == (21, 16)  # about twice as many as square characters would need
    assert (found.cells[:, : rows // 4] == 1).all()
    assert (found.cells[:, rows // 4 : -1] == 0).all()
    assert found.cells[0, -1] > 0
    line = missing_at(np.s_[30:], shape=(60,))
    assert line.cells.shape == (48,)
    assert line.cells[:24].sum() == 0
    assert (line.cells[24:] == 1).all()


def test_channels(topographies):
    file = topographies / "di-1.di"
    assert rl.read(file, channel=1).rms_height != rl.read(file).rms_height
    assert rl.read(file, channel="1").settings["channel"] == "Height"
    for channel, message in (
        ("Height", "has 2 channels 'Height': choose by number, of 0 'Height'"),
        ("Phase", "channel 'Phase' of di-1.di holds no heights"),
        (2, "channel '2' of di-1.di holds no heights"),
        (7, "has no channel '7'; it has 0 'Height', 1"),
    ):
        with pytest.raises(rl.InputError, match=message):
            rl.read(file, channel=channel)


def test_plain_arrays_need_sizes_and_a_unit(tmp_path):
    surface = SPECTRUM.surface(24, 7)
    path = tmp_path / "map.npy"
    np.save(path, surface.heights * 1e6)
    with pytest.raises(rl.UnitError, match="states no unit"):
        rl.read(path, sizes=1e-3)
    with pytest.raises(rl.InputError, match="states no sizes for its 24 x 24 points"):
        rl.read(path, unit="um")
    found = rl.read(path, unit="um", sizes=1000, trend="none")
    assert found.heights == pytest.approx(surface.heights, rel=1e-12)
    text = tmp_path / "map.txt"
    np.savetxt(text, surface.heights * 1e6)
    found = rl.read(text, unit="um", sizes=(1000, 2000), trend="none")
    assert found.sizes == pytest.approx((1e-3, 2e-3))
    assert sorted(found.heights.ravel()) == pytest.approx(sorted(surface.heights.ravel()))


@pytest.mark.parametrize(
    ("sizes", "unit", "metres"),
    [
        (1000, "um", (1e-3, 1e-3)),
        ((1000, 500.0), "um", (1e-3, 0.5e-3)),
        (np.array([1.0, 2.0]), "mm", (1e-3, 2e-3)),
        ("1 mm, 0.5 mm", "um", (1e-3, 0.5e-3)),
        ("1 mm", "nm", (1e-3, 1e-3)),
        (("1 mm", 500), "um", (1e-3, 0.5e-3)),
    ],
)
def test_sizes_are_in_the_unit_of_the_file_or_in_their_own(tmp_path, sizes, unit, metres):
    path = tmp_path / "map.npy"
    np.save(path, np.random.default_rng(0).normal(size=(24, 24)))
    assert rl.read(path, unit=unit, sizes=sizes).sizes == pytest.approx(metres)


def test_sizes_without_a_unit_given_are_in_metres(tmp_path):
    """A file that states its unit but no sizes: the caller has named no unit to count in."""
    path = tmp_path / "map.asc"
    path.write_text("# Value units: nm\n" + "1 2 4 3\n" * 4)
    found = rl.read(path, sizes=1e-3, trend="none")
    assert found.sizes == pytest.approx((1e-3, 1e-3))
    assert found.heights.max() == pytest.approx(4e-9)


@pytest.mark.parametrize(
    ("sizes", "message"),
    [
        ((1e-3,) * 3, 'give 2 positive lengths, such as "1 mm, 0.5 mm"; numbers without a unit'),
        (-1.0, "give 2 positive lengths"),
        (float("nan"), "give 2 positive lengths"),
        (1e-4, "give 2 positive lengths"),
        (None, "states no sizes for its 24 x 36 points"),
        ([[1, 2], [3, 4]], "give 2 positive lengths"),
        (("1 mm", None), "give 2 positive lengths"),
        ("1, 2", 'sizes is "1", without a unit'),
        ("0,5 mm, 1 mm", 'with a comma in "0,5"'),
        ("1 mm, 2 parsnip", "is no quantity in m"),
    ],
)
def test_sizes_that_cannot_be_get_one_line(tmp_path, sizes, message):
    path = tmp_path / "map.npy"
    np.save(path, np.random.default_rng(0).normal(size=(24, 36)))
    with pytest.raises(rl.InputError, match=message):
        rl.read(path, unit="um", sizes=sizes)


def tilted_file(folder):
    """An array file of a rough surface on a tilted stage, and the least-squares plane within."""
    surface = SPECTRUM.surface(48, 7)
    x, y = np.meshgrid(np.arange(48.0), np.arange(48.0), indexing="ij")
    heights = surface.heights + 2e-7 * x - 1e-7 * y
    terms = np.stack([np.ones(x.size), x.ravel(), y.ravel()], axis=1)
    plane = terms @ np.linalg.lstsq(terms, heights.ravel(), rcond=None)[0]
    np.save(folder / "stage.npy", heights)
    return folder / "stage.npy", heights, plane.reshape(x.shape)


def test_reading_removes_the_tilt_of_an_instrument_unless_told_not_to(tmp_path):
    path, heights, plane = tilted_file(tmp_path)
    as_given = {"unit": "m", "sizes": 1e-3}
    found = rl.read(path, **as_given)
    assert found.heights == pytest.approx(heights - plane, abs=1e-18)
    assert found.settings["detrended"] == "tilt"
    kept = rl.read(path, **as_given, trend="none")
    assert (kept.heights == heights).all()
    assert "detrended" not in kept.settings
    level = rl.read(path, **as_given, trend="mean")
    assert level.heights == pytest.approx(heights - heights.mean(), abs=1e-18)
    with pytest.raises(rl.InputError, match="trend is 'cubic'; one of none, mean, tilt"):
        rl.read(path, **as_given, trend="cubic")


def test_our_own_files_are_read_as_they_were_written(tmp_path):
    path, heights, _ = tilted_file(tmp_path)
    kept = rl.read(path, unit="m", sizes=1e-3, trend="none")
    rl.write(kept, tmp_path / "kept.nc")
    found = rl.read(tmp_path / "kept.nc")
    assert (found.heights == heights).all()
    assert (prepared(found).heights == heights).all()


def test_a_surface_pressed_with_its_tilt_says_so(tmp_path):
    path, heights, plane = tilted_file(tmp_path)
    as_given = {"unit": "m", "sizes": 1e-3}
    force = {"E_star": 1e11, "forces": [1.0]}
    kept = rl.read(path, **as_given, trend="none")
    lower = 1 - np.std(heights - plane) / np.std(heights)
    (said,) = (w for w in rl.press(kept, **force).warnings if "tilted" in w)
    assert f"would be {lower:.0%} lower" in said
    assert "tilted" in rl.press(kept, **force, periodic=True).warnings[0]
    assert "tilted" in rl.press(kept, **force).to_dataset().attrs["warnings"]
    level = rl.press(rl.read(path, **as_given), **force)
    assert not any("tilted" in w for w in level.warnings)
    meant = rl.Surface(heights, (1e-3, 1e-3), "m")  # made, not measured: its tilt is its shape
    assert rl.press(meant, **force).warnings == ()
    assert any("tilted" in w for w in rl.press(meant.cropped((0, 40), (0, 48)), **force).warnings)


def test_a_comparison_with_a_tilted_body_says_so(tmp_path):
    path, _, _ = tilted_file(tmp_path)
    as_given = {"unit": "m", "sizes": 1e-3}
    tilted = rl.compare(rl.read(path, **as_given, trend="none"), force_bars=[0.3])
    assert "tilted" in tilted.warnings[0]
    level = rl.compare(rl.read(path, **as_given), force_bars=[0.3])
    assert level.warnings == ()


def test_suspicious_scales_are_pointed_out():
    rough = rl.Surface(SPECTRUM.surface(24, 7).heights, (1e-3, 1e-3), "m")
    assert suspicions(rough) == []
    assert "rms height is 1 m;" in suspicions(rough.scaled(1e6))[0]
    assert "rms slope" in suspicions(rough.scaled(1e6))[1]
    assert "rms height is 1 fm" in suspicions(rough.scaled(1e-9))[0]
    assert "flat punch" in suspicions(rough.scaled(0.0))[0]
    thin = rl.Surface(rough.heights, (1e-3, 1e-2), "m")
    assert "pixels are" in suspicions(thin)[0]


def test_an_archive_that_unpacks_to_too_much_is_refused(tmp_path):
    path = tmp_path / "bomb.x3p"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", b"0" * 2**28)
    with pytest.raises(rl.InputError, match="would unpack to 268"):
        rl.read(path)


@pytest.mark.parametrize(
    ("kind", "trend", "copies"),
    [
        ("nc", "tilt", 1),
        ("npy", "tilt", 1),
        ("x3p", "none", 1),
        ("x3p", "tilt", 2),  # the reader hands on the bytes of the file, which nobody may change
    ],
)
def test_large_maps_open_without_further_copies(tmp_path, kind, trend, copies):
    from SurfaceTopography import Topography
    from SurfaceTopography.IO.X3P import write_x3p

    path = tmp_path / f"map.{kind}"
    heights = np.random.default_rng(0).normal(size=(1200, 900)) * 1e-6
    if kind == "nc":
        rl.write(rl.Surface(heights, (1e-3, 1e-3), "m"), path)
        asked = {}
    elif kind == "npy":
        np.save(path, heights)
        asked = {"unit": "m", "sizes": (1e-3, 1e-3)}
    else:
        write_x3p(Topography(heights, (1e-3, 1e-3), unit="m"), path)
        asked = {}
    rl.read(path, **asked, trend=trend)  # loads what loads slowly
    tracemalloc.start()
    surface = rl.read(path, **asked, trend=trend)
    held, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    plain = heights if kind == "nc" else without_trend(heights, trend)
    assert surface.heights == pytest.approx(plain, abs=1e-18)
    assert held < 1.1 * heights.nbytes
    assert peak < (copies + 0.5) * heights.nbytes
