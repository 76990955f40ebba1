"""Files in and out: metres always, one clear line otherwise."""

import tracemalloc
import zipfile
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.measured import suspicions
from roughline.missing import Missing
from roughline.preparation import prepared
from roughline.quantities import engineering, in_si, metres_per

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
    found = rl.read(path)
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
    assert prepared(body).rms_height < body.rms_height


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
    for sizes in (1e-3, (1e-3, 1e-3)):
        found = rl.read(path, unit="um", sizes=sizes)
        assert found.sizes == pytest.approx((1e-3, 1e-3))
        assert found.heights == pytest.approx(surface.heights, rel=1e-12)
    for sizes in ((1e-3,) * 3, -1.0, float("nan")):
        with pytest.raises(rl.InputError, match="give 2 positive lengths"):
            rl.read(path, unit="um", sizes=sizes)
    text = tmp_path / "map.txt"
    np.savetxt(text, surface.heights * 1e6)
    found = rl.read(text, unit="um", sizes=(1e-3, 2e-3))
    assert found.sizes == pytest.approx((1e-3, 2e-3))
    assert sorted(found.heights.ravel()) == pytest.approx(sorted(surface.heights.ravel()))


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


@pytest.mark.parametrize("kind", ["nc", "npy", "x3p"])
def test_large_maps_open_without_two_copies(tmp_path, kind):
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
    rl.read(path, **asked)  # loads what loads slowly
    tracemalloc.start()
    surface = rl.read(path, **asked)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert surface.heights == pytest.approx(heights, abs=1e-18)
    assert peak < 1.5 * heights.nbytes
