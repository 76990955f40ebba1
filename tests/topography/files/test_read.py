"""Files in and out: metres always, one clear line otherwise."""

import io
import json
import re
import struct
import tracemalloc
import zipfile
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
import tifffile
import xarray
import zstandard

import roughline as rl
from roughline.question.description import describe
from roughline.question.source import topographies
from roughline.topography.files.curves import curve_in
from roughline.topography.files.instrument import _refuse_long_arrays
from roughline.topography.files.read import measurement, suspicions
from roughline.topography.missing import Filler, Missing
from roughline.topography.preparation import prepared
from roughline.topography.provenance import Instrument, Provenance
from roughline.topography.trend import without_trend

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)


@pytest.mark.parametrize("name", ["map.npy", "map.sur", "map"])
def test_what_a_file_holds_decides_its_format_not_its_name(tmp_path, name):
    heights = np.random.default_rng(0).standard_normal((12, 9))
    for write, stated in ((np.save, "NPY"), (np.savez, "NPZ")):
        with (tmp_path / name).open("wb") as file:
            write(file, heights)
        found = measurement(tmp_path / name)
        assert (found.format, found.unit) == (stated, None)
        assert np.array_equal(found.heights, heights)


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


@pytest.mark.parametrize("is_cut_out", [True, False])
def test_a_piece_is_read_back_as_a_piece(tmp_path, is_cut_out):
    """Files of earlier versions say it by their settings alone."""
    recorded = {"origin": "instrument file", "detrended": "mean"} if is_cut_out else {}
    heights = SPECTRUM.surface(16, 7).heights
    rl.write(rl.Surface(heights, (1e-3, 1e-3), "m", recorded), tmp_path / "before.nc")
    as_before(tmp_path / "before.nc", "is_cut_out", "removed_trend")
    stated = rl.Surface(
        heights,
        (1e-3, 1e-3),
        "m",
        is_cut_out=is_cut_out,
        provenance=Provenance(detrended="mean" if is_cut_out else "none"),
    )
    rl.write(stated, tmp_path / "stated.nc")
    for name in ("before", "stated"):
        found = rl.read(tmp_path / f"{name}.nc")
        assert found.is_cut_out is is_cut_out
        assert found.removed_trend == ("mean" if is_cut_out else "none")


@pytest.mark.parametrize("shape", [(32, 1), (1, 32)])
def test_one_row_or_column_of_points_is_a_line_scan(tmp_path, shape):
    heights = SPECTRUM.line(32, 7).heights
    np.save(tmp_path / "row.npy", heights.reshape(shape))
    found = rl.read(tmp_path / "row.npy", unit="m", sizes="1 mm", trend="none")
    assert isinstance(found, rl.Line)
    assert (found.kind, found.length) == ("profile", 1e-3)
    assert np.array_equal(found.heights, heights)


def as_before(path, *left_out):
    """Make a file what the first version wrote: HDF5, and each setting an attribute."""
    data = xarray.load_dataset(path).drop_vars(["x", "y"], errors="ignore")
    for name, value in json.loads(data.attrs.pop("settings")).items():
        data.attrs[f"body_{name}"] = value
    data.attrs["format"] = "roughline body 1"
    for name in left_out:
        del data.attrs[name]
    data.to_netcdf(path, engine="h5netcdf")
    return path


def test_what_the_first_version_wrote_is_read(tmp_path):
    for body in (SPECTRUM.surface(16, 7), SPECTRUM.line(64, 7)):
        rl.write(replace(body, unit="m"), tmp_path / "body.nc")
        now = rl.read(tmp_path / "body.nc")
        found = rl.read(as_before(tmp_path / "body.nc"))
        assert found.heights.tobytes() == now.heights.tobytes()
        assert found.settings == now.settings
        assert (found.spacing, found.is_cut_out) == (now.spacing, now.is_cut_out)


@pytest.mark.parametrize("missing", ["harmonic", "nearest"])
def test_one_measurement_gives_the_body_with_either_filling(tmp_path, missing):
    heights = SPECTRUM.surface(32, 7).heights.copy()
    heights[5:9, 20:23] = np.nan
    path = tmp_path / "map.npy"
    np.save(path, heights)
    stated = {"unit": "m", "sizes": 1e-3}
    measured = measurement(path)
    unknown = measured.unknown
    for each in (missing, Missing(missing).other, missing):
        body = measured.body(**stated, filler=Filler(Missing(each)), trend="tilt")
        again = rl.read(path, **stated, missing=rl.Missing(each))
        assert body.heights.tobytes() == again.heights.tobytes()
        assert body.settings == again.settings
    assert (measured.unknown == unknown).all()
    assert np.array_equal(measured.heights, heights, equal_nan=True)


@pytest.mark.parametrize("order", ["C", "F"])
def test_a_measurement_stays_as_it_is(tmp_path, order):
    heights = np.array(SPECTRUM.surface(32, 7).heights, order=order)
    np.save(tmp_path / "map.npy", heights)
    stated = {"unit": "um", "sizes": 1e-3, "filler": Filler(), "trend": "tilt"}
    measured = measurement(tmp_path / "map.npy")
    first, second = (measured.body(**stated).heights for _ in range(2))
    assert (measured.heights == heights).all()
    assert first.tobytes() == second.tobytes()
    assert first.tobytes() == measured.body(**stated, in_place=True).heights.tobytes()


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


@pytest.mark.parametrize("missing", ["harmonic", "nearest"])
def test_missing_points_are_filled_and_counted(topographies, missing):
    found = rl.read(topographies / "opd-1.opd", missing=rl.Missing(missing))
    assert found.settings["missing_points"] == 116
    assert found.settings["missing_share"] == pytest.approx(116 / 307200)
    assert found.settings["filled"] == missing
    with pytest.raises(rl.InputError, match="116 missing points of 307200"):
        rl.read(topographies / "opd-1.opd", missing=rl.Missing(most=0))


def test_channels(topographies):
    file = topographies / "di-1.di"
    assert rl.read(file, channel=1).rms_height != rl.read(file).rms_height
    assert rl.read(file, channel="1").settings["channel"] == "Height"
    second = rl.read(file, channel="Height (retrace, interleave)")
    assert second.rms_height == rl.read(file, channel=1).rms_height
    assert second.settings["reader"].startswith("SurfaceTopography 1.")
    assert second.settings["format"] == "Nanoscope"
    for channel, message in (
        ("Height", "has 2 channels 'Height': choose one by its number: 0 'Height \\(trace, main"),
        ("Phase", "channel 'Phase' of di-1.di holds no heights"),
        (2, "channel '2' of di-1.di holds no heights"),
        (7, "has no channel '7'; it has 0 'Height "),
    ):
        with pytest.raises(rl.InputError, match=message):
            rl.read(file, channel=channel)


def test_suspicious_scales_are_pointed_out():
    rough = rl.Surface(SPECTRUM.surface(24, 7).heights, (1e-3, 1e-3), "m")
    assert suspicions(rough) == []
    assert "rms height is 1 m;" in str(suspicions(rough.scaled(1e6))[0])
    assert "rms slope" in str(suspicions(rough.scaled(1e6))[1])
    assert "rms height is 1 fm" in str(suspicions(rough.scaled(1e-9))[0])
    assert "flat punch" in str(suspicions(rough.scaled(0.0))[0])
    thin = rl.Surface(rough.heights, (1e-3, 1e-2), "m")
    assert "pixels are" in str(suspicions(thin)[0])


@pytest.mark.parametrize(
    ("side", "slope", "pixels", "said"),
    [
        (160.0, 1e-5, None, "the sides are 160 m x 160 m; instruments measure 10 nm to 1 m"),
        (5e-9, 0.1, None, "the sides are 5 nm x 5 nm"),
        (0.048, 1e-3, "means", "the pixels are 2 mm x 2 mm"),
        (0.048, 1e-3, None, ""),
        (0.9, 9e-7, None, "the rms slope is 9e-07"),
    ],
)
def test_a_scale_of_the_sides_that_no_instrument_has_is_pointed_out(side, slope, pixels, said):
    known, heights = Provenance(Instrument(pixels)), SPECTRUM.surface(24, 7).heights
    rough = rl.Surface(heights, (side, side), "m", provenance=known)
    found = list(map(str, suspicions(rough.scaled(slope / rough.rms_slope))))
    assert any(said in each for each in found) if said else not found


def test_arrays_that_their_names_tell_from_heights_are_not_taken(tmp_path):
    path, heights = tmp_path / "map.h5", SPECTRUM.surface(16, 7).heights
    with h5py.File(path, "w") as file:
        file["Error"], file["height"], file["thumbnail"] = 2 * heights, heights, heights[::4, ::4]
    found = measurement(path)
    assert np.array_equal(found.heights, heights)
    assert found.channels == ("0 Error (no heights)", "1 height", "2 thumbnail (no heights)")
    assert found.doubts == ()
    with h5py.File(path, "a") as file:
        file["second"] = heights
    (doubt,) = measurement(path).doubts
    assert "2 arrays that may be heights (height, second), of which 'height' is read" in doubt
    assert measurement(path, channel="second").doubts == ()
    assert np.array_equal(measurement(path, channel="Error").heights, 2 * heights)
    with h5py.File(path, "a") as file:
        del file["second"], file["height"]
    with pytest.raises(rl.InputError, match="holds no heights; it has Error .by its name; channel"):
        rl.read(path)


@pytest.mark.parametrize("name", ["curve.nc", "zygo.datx", "sheet.xlsx"])
def test_what_is_declared_and_not_there_is_refused_before_it_is_read(tmp_path, name):
    """A curve, texts and a table would take 10 GB, for ever, and 8 s."""
    path = tmp_path / name
    if name == "sheet.xlsx":
        with zipfile.ZipFile(path, "w") as archive:
            row = '<row r="1048576"><c r="F1048576"><v>1</v></c></row>'
            archive.writestr("xl/worksheets/sheet1.xml", f"<sheetData>{row}</sheetData>")
    else:
        with h5py.File(path, "w") as file:
            texts = h5py.string_dtype("ascii")
            file.create_dataset("MetaData", (20000**2, 3), texts, chunks=(1000, 3))
            file.attrs["E_star"] = 1.0
            for key in ("depth", "force", "stiffness"):
                file.create_dataset(key, (20000**2,), "f8", chunks=(10**6,))
    asked = {"curve.nc": curve_in, "zygo.datx": rl.read, "sheet.xlsx": rl.read}[name]
    tracemalloc.start()
    with pytest.raises(rl.InputError, match=f"{name} (declares 400000000|has a cell in row 10)"):
        asked(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 4e7


DECLARED = 20000  # points along each side of maps that are not there


def _sdf() -> bytes:
    stated = {"ManufacID": "x", "NumPoints": DECLARED, "NumProfiles": DECLARED, "DataType": 7}
    stated |= dict.fromkeys(("Xscale", "Yscale", "Zscale"), 1e-6)
    head = "".join(f"{key} = {value}\n" for key, value in stated.items())
    rows = "1 2 3 4 5\n" * 4
    return f"aISO-1.0\n{head}*\n{rows}*\n".encode()


def _scans_of_a_nanomeasuring_machine() -> bytes:
    line = "-" * 42
    stated = {"scans": "30000000", "lines": "2"}
    lines = [line, "Scan procedure description file", "Creation time : 2020-01-01", line]
    lines += ["1 Scan field", *(f"Number of {key} : {value}" for key, value in stated.items())]
    for key, value in (("Scan line length", 9), ("Scan field width", 1)):
        lines.append(f"{key} : {value} [um]")
    lines += [f"Distance beetween {each} : 1 [um]" for each in ("points", "lines")]
    return _archive({"s.dsc": "\n".join([*lines, line, ""])})


def _datasets_of_easyscan() -> bytes:
    info = "[DataSet-Info]\r\nDate=01-01-2020\r\nTime=10:00:00\r\n#!"
    return f"[DataSet]\r\nGroupCount=1\r\nGr0-Count=30000000\r\n{info}".encode()


def _archive(parts: dict[str, str | bytes]) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, part in parts.items():
            archive.writestr(name, part)
    return content.getvalue()


def _zon() -> bytes:
    packed = zstandard.ZstdCompressor().compress(struct.pack("<4i", 400, 400, 4, 0) + bytes(2**27))
    return b"KPK1" + bytes(4) + _archive({"4cdb0c75-5706-48cc-a9a1-adf395d609ae": packed})


def _tiff(image: np.ndarray, **tags: int) -> bytes:
    """An image, packed, some of whose tags are changed."""
    content = io.BytesIO()
    tifffile.imwrite(content, image, compression="zlib", rowsperstrip=len(image))
    content.seek(0)
    with tifffile.TiffFile(content, mode="r+b") as file:
        for name, value in tags.items():
            file.pages[0].tags[name].overwrite(value)
    return content.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("map.sdf", _sdf, "declares 20000 x 20000"),
        ("scans.zip", _scans_of_a_nanomeasuring_machine, "lists 30000000 scans and has 1 parts"),
        ("sets.ezd", _datasets_of_easyscan, "lists 30000000 datasets"),
        (
            "map.jpk",
            partial(_tiff, np.zeros((8, 8), "u2"), ImageWidth=DECLARED, ImageLength=DECLARED),
            "declares 20000 x 20000",
        ),
    ],
)
def test_what_a_header_declares_is_refused_before_a_reader_believes_it(
    tmp_path, name, content, message
):
    assert_refused_unread(tmp_path, name, content, message)


def test_what_is_packed_twice_is_counted_before_it_is_unpacked(tmp_path):
    assert_refused_unread(tmp_path, "map.zon", _zon, "would unpack to")


def test_an_image_that_is_larger_than_it_says_is_counted_before_it_is_unpacked(tmp_path):
    image = partial(_tiff, np.zeros((9000, 9000), "u1"), ImageWidth=80, ImageLength=80)
    assert_refused_unread(tmp_path, "packed.lext", image, "would unpack to")


def assert_refused_unread(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content())
    tracemalloc.start()
    with pytest.raises(rl.InputError, match=f"{name} .*{message}") as caught:
        rl.read(tmp_path / name)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert "\n" not in str(caught.value)
    assert peak < 4e7


@pytest.mark.parametrize("is_cut", [True, False])
@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("al3d-1.al3d", {rb"(Cols\0+)\d+": rb"\g<1>20000", rb"(Rows\0+)\d+": rb"\g<1>20000"}),
        (
            "di-1.di",
            {
                rb"(Samps/line: |Number of lines: |\\Lines: )\d+": rb"\g<1>20000",
                rb"(Data length: )\d+": rb"\g<1>800000000",
            },
        ),
        ("opd-1.opd", {re.escape(struct.pack("<2H", 640, 480)): struct.pack("<2H", 20000, 20000)}),
        (
            "sur-3.sur",
            {
                re.escape(struct.pack("<3i", 512, 512, 512**2)): struct.pack(
                    "<3i", 20000, 20000, 20000**2
                )
            },
        ),
    ],
)
def test_real_files_that_declare_more_than_they_have_are_refused(
    topographies, tmp_path, name, changes, is_cut
):
    content = (topographies / name).read_bytes()
    for pattern, replacement in changes.items():
        content, count = re.subn(pattern, replacement, content)
        assert count
    path = tmp_path / name
    path.write_bytes(content[:7000] if is_cut else content)
    tracemalloc.start()
    with pytest.raises(rl.InputError, match=name) as caught:
        rl.read(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert "\n" not in str(caught.value)
    assert peak < 4e7


@pytest.mark.parametrize("name", ["map.nc", "map.h5"])
def test_maps_that_were_never_written_are_refused_beside_data_that_were(tmp_path, name):
    with h5py.File(tmp_path / name, "w") as file:
        file.create_dataset("heights", (14000, 14000), "f8", chunks=(1000, 1000))
        file.create_dataset("noise", data=np.random.default_rng(7).integers(256, size=10**6))
        file.attrs.update(format="roughline body 1", kind="surface", unit="m")
        file.attrs.update(sizes=[1e-3, 1e-3], removed_trend="none")
    with pytest.raises(rl.InputError, match=f"{name} declares 14000 x 14000 points and has 0 kB"):
        rl.read(tmp_path / name, sizes=None if name == "map.nc" else 1e-3)


def test_arrays_of_mountains_are_no_longer_than_their_map():
    def reader(length):
        heights = {"data": {"_raw": length.to_bytes(8, "little") + bytes(100)}}
        arrays = [{"heights": heights, "mask": None}]
        return SimpleNamespace(format=lambda: "mnt", _arrays=arrays)

    channel = SimpleNamespace(index=0, nb_grid_pts=(20, 30))
    _refuse_long_arrays(reader(4 * 20 * 30), channel, "map.mnt")
    with pytest.raises(rl.InputError, match="map.mnt declares 1.6e.04 MB for 20 x 30 points"):
        _refuse_long_arrays(reader(16 * 10**9), channel, "map.mnt")


def test_memory_that_ends_while_a_file_is_read_gets_one_line(tmp_path, monkeypatch):
    def without_memory(*_):
        raise MemoryError("Unable to allocate 112 GiB")

    monkeypatch.setattr("roughline.topography.files.read.read_instrument", without_memory)
    (tmp_path / "map.jpk").write_bytes(bytes(100))
    with pytest.raises(rl.InputError, match="map.jpk declares more than memory can hold"):
        rl.read(tmp_path / "map.jpk")


@pytest.mark.parametrize(
    ("harmless", "unpacked", "told"), [(2**18, 2**20, "1.049"), (2**26, 2**28, "268")]
)
def test_an_archive_that_unpacks_to_too_much_is_refused(
    tmp_path, monkeypatch, harmless, unpacked, told
):
    monkeypatch.setattr("roughline.topography.files.archives._HARMLESS_BYTES", harmless)
    path = tmp_path / "bomb.x3p"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", b"0" * unpacked)
    with pytest.raises(rl.InputError, match=f"would unpack to {told}"):
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
    heights = np.random.default_rng(0).normal(size=(800, 600)) * 1e-6
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
    assert np.abs(surface.heights - plain).max() <= 1e-18
    assert held < 1.1 * heights.nbytes
    assert peak < (copies + 0.5) * heights.nbytes


@pytest.fixture
def half_known(tmp_path):
    """A map whose right half was not measured, with two more holes in the left one."""
    heights = SPECTRUM.surface(64, 7).heights + 1e-5 * np.linspace(0, 1, 64)
    heights[32:] = np.nan
    heights[4:6, 7] = np.nan
    path = tmp_path / "half.npy"
    np.save(path, heights)
    return path, heights


def test_missing_points_outside_a_crop_do_not_count(half_known):
    path, heights = half_known
    stated = {"unit": "m", "sizes": 1e-3}
    with pytest.raises(rl.InputError, match=r"half.npy has 2050 .* to where points .* \(crop=\)"):
        rl.read(path, **stated)
    few = rl.Missing(most=0.01)
    with pytest.raises(rl.InputError, match="the piece of half.npy has 162 missing points of 1440"):
        rl.read(path, **stated, crop=(0, 36e-3 / 64, 0, 40e-3 / 64), missing=few)
    crop = (0, 5e-4, 0, 1e-3)
    piece = rl.read(path, **stated, crop=crop)
    np.save(path.with_name("left.npy"), heights[:32])
    alone = rl.read(path.with_name("left.npy"), unit="m", sizes=(5e-4, 1e-3))
    assert (piece.heights == alone.heights).all()  # nothing outside fills the piece
    assert piece.sizes == alone.sizes
    assert piece.settings["missing_points"] == 2
    assert piece.settings["cropped"] == "x 0:32, y 0:64"
    preparation = rl.Preparation(crop=crop)
    question = rl.Question(
        path,
        E_star=1e9,
        loads=1,
        reading=rl.Reading(unit="m", sizes=1e-3),
        preparation=preparation,
    )
    (part,) = topographies(question)
    assert (part.body.heights == piece.heights).all()
    assert part.body.settings["missing_points"] == 2
    described = describe(path, question.reading, preparation)
    assert (described.missing.count, described.body.settings["missing_points"]) == (2, 2)


def test_a_piece_that_is_read_is_the_piece_of_what_is_read(tmp_path):
    """Whole maps and lines, even and uneven: cropped before or after, the heights are the same."""
    body = replace(SPECTRUM.surface(48, 7).detrended(), unit="m")
    rl.write(body, tmp_path / "map.nc")
    crop = (1e-4, 6e-4, 0, 1e-3)
    read = rl.read(tmp_path / "map.nc", crop=crop)
    assert read.heights == pytest.approx(
        prepared(body, rl.Preparation(crop=crop)).heights, abs=1e-18
    )
    assert (read.is_cut_out, read.removed_trend) == (True, "tilt")
    x = np.cumsum(np.random.default_rng(0).uniform(1, 2, 80))
    np.savetxt(tmp_path / "scan.txt", np.stack([x, np.sin(x / 9)], axis=1), fmt="%.17g")
    whole = rl.read(tmp_path / "scan.txt", "um", trend="none")
    piece = rl.read(tmp_path / "scan.txt", "um", trend="none", crop=(20e-6, 70e-6))
    assert whole.heights.size > piece.heights.size > 25
    assert piece.length == pytest.approx(50e-6, abs=4e-6)
    assert piece.heights.max() == pytest.approx(1e-6, abs=1e-8)
    for crop, message in (
        ((0, 1e-3), "lengths that rise, within"),
        ((0, 1e-6), "keeps 1 points; take more"),
    ):
        with pytest.raises(rl.InputError, match=message):
            rl.read(tmp_path / "scan.txt", "um", crop=crop)


def test_a_piece_of_a_filled_body_does_not_count_the_points_of_the_whole(half_known):
    whole = rl.read(half_known[0], unit="m", sizes=1e-3, missing=rl.Missing(most=0.9))
    piece = prepared(whole, rl.Preparation(crop=(0, 5e-4, 0, 1e-3)))
    assert "missing_points" not in piece.settings
    assert piece.settings["filled_before_crop"] == 2050


def test_arrays_that_are_no_heights_are_refused(tmp_path):
    path = tmp_path / "map.npy"
    arrays = (
        (np.zeros(0), "holds (0 points|no array)"),
        (np.zeros((5, 0)), "holds (5 x 0 points|no array)"),
        (np.zeros(1), "holds 1 points"),
        (np.zeros((1, 1)), "holds 1 x 1 points"),
        (np.array(3.0), "0 dimensions"),
        (np.zeros((3, 3, 3)), "3 dimensions"),
        (np.ones((4, 4)) * 1j, "of type complex128"),
        (np.array([["a", "b"]]), "of type <U1"),
        (np.array([[1, None]], dtype=object), "holds no array of real heights"),
    )
    for array, message in arrays:
        np.save(path, array, allow_pickle=True)
        with pytest.raises(rl.InputError, match=message):
            rl.read(path, "m", sizes=1e-3)


def test_an_array_whose_head_is_damaged_is_refused(tmp_path):
    path = tmp_path / "map.npy"
    np.save(path, np.ones((5, 4)))
    path.write_bytes(path.read_bytes().replace(b"(5, 4)", b"((5, 4"))
    with pytest.raises(rl.InputError, match="map.npy holds no array of real heights"):
        rl.read(path)


def test_an_archive_whose_list_of_parts_is_damaged_is_refused_in_one_line(tmp_path):
    path, part = tmp_path / "map.x3p", 300 * "n"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("main.xml", "<a/>")
        archive.writestr(part, "")
    path.write_bytes(path.read_bytes().replace(part.encode(), 300 * b"m", 1))
    with pytest.raises(rl.InputError, match="map.x3p is a damaged archive") as caught:
        rl.read(path)
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize("shape", [(20000, 20000), (10**12, 10**9), (2000, 3000)])
def test_points_that_are_declared_and_cannot_be_there_are_refused_before_they_are_read(
    tmp_path, shape
):
    header = io.BytesIO()
    declared = {"descr": "<f8", "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(header, declared)
    (tmp_path / "map.npy").write_bytes(header.getvalue() + bytes(7000))
    names = ["map.npy"]
    if shape[0] < 10**6:
        for name in ("map.nc", "map.h5"):
            names.append(name)
            with h5py.File(tmp_path / name, "w") as file:
                file.create_dataset("heights", shape, "f8", chunks=(1000, 1000))
                file.attrs.update(format="roughline body 1", kind="surface", unit="m")
                file.attrs.update(sizes=[1e-3, 1e-3], removed_trend="none")
    tracemalloc.start()
    for name in names:
        with pytest.raises(rl.InputError, match=name):
            rl.read(tmp_path / name)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 4e7


@pytest.mark.parametrize(
    "wrong",
    [
        {"kind": "banana"},
        {"kind": "profile"},
        {"sizes": np.array([1e-3])},
        {"sizes": np.array([np.nan, 1e-3])},
        {"sizes": "a"},
        {"sizes": None},
        {"unit": None},
        {"removed_trend": "foo"},
        {"settings": "{"},
        {"settings": "[1]"},
    ],
)
@pytest.mark.parametrize("engine", ["scipy", "h5netcdf"])
def test_a_file_of_our_own_that_is_damaged_is_read_as_nothing_else(tmp_path, wrong, engine):
    path = tmp_path / "map.nc"
    rl.write(replace(SPECTRUM.surface(16, 7), unit="m"), path)
    data = xarray.load_dataset(path)
    for name, value in wrong.items():
        del data.attrs[name]
        if value is not None:
            data.attrs[name] = value
    data.to_netcdf(path, engine=engine)
    with pytest.raises(
        rl.InputError, match=f"damaged file of roughline .wrong: {next(iter(wrong))}"
    ):
        rl.read(path)
