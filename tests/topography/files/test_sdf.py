"""SDF and SMD files: the same heights of every dialect, each point that is missing is missing."""

import struct

import numpy as np
import pytest

import roughline as rl
from mutated_heads import assert_read_or_refused
from random_cases import cases, seeds
from roughline.topography.files.read import measurement

ROWS = np.random.default_rng(5).integers(-90, 90, size=(12, 9)).astype(float)
DX, DY, DZ = 2.5e-7, 1e-6, 1e-8
TYPES = ("u1", "<u2", "<u4", "<f4", "i1", "<i2", "<i4", "<f8")
SIGNED = range(3, 8)
MAGICS = ("aISO-1.0", "aISO-2.0", "aBCR-1.0", "aBCR - 1.0", "aBCR-0.0", "aBC-1.0", "aNPL-V1.0")
PROFILE = np.round(np.random.default_rng(6).normal(size=400), 5)


def fields_of(rows, code, **changed):
    stated = {
        "ManufacID": "x",
        "CreateDate": "210520051200",
        "ModDate": "210520051200",
        "NumPoints": rows.shape[1],
        "NumProfiles": rows.shape[0],
        "Xscale": f"{DX:.5E}",
        "Yscale": f"{DY:.5E}",
        "Zscale": f"{DZ:.5E}",
        "Zresolution": -1,
        "Compression": 0,
        "DataType": code,
        "CheckType": 0,
    }
    return {key: value for key, value in (stated | changed).items() if value is not None}


def text(rows=ROWS, magic="aISO-1.0", code=7, end="*\n*\n", bad="BAD", newline="\n", **changed):
    lines = [f"{key} = {value}" for key, value in fields_of(rows, code, **changed).items()]
    values = [" ".join(bad if np.isnan(v) else f"{v:g}" for v in row) for row in rows]
    return newline.join([magic, *lines, "*", *values, end.replace("\n", newline)]).encode()


def binary(rows=ROWS, version="ISO-1.0", code=7, mark=None, extra=b"", trailer=b"", **changed):
    stated = fields_of(rows, code, **changed)
    head = struct.pack(
        f"<8s10s12s12s{'II' if version == 'ISO-2.0' else 'HH'}4d3B",
        f"b{version}".encode(),
        b"x".ljust(10),
        b"210520051200",
        b"210520051200",
        stated["NumPoints"],
        stated["NumProfiles"],
        *(float(stated[key]) for key in ("Xscale", "Yscale", "Zscale", "Zresolution")),
        *(int(stated[key]) for key in ("Compression", "DataType", "CheckType")),
    )
    raw = np.nan_to_num(rows).astype(TYPES[code])
    if mark is not None:
        raw[np.isnan(rows)] = mark
    return head + extra + raw.tobytes() + trailer


def smd(heights=PROFILE, between="\0 ", step="2.50000e-004", unit="um"):
    def line(*words):
        return between.join(words) + between.rstrip() + "\r\n"

    n = str(len(heights))
    content = line("ISO 5436-2:2012", "gauge.smd") + line("PRF", "1", "ISO5436")
    content += line("CX", "I", n, "mm", "1.0e0", "D", step)
    content += line("CZ", "A", n, unit, "1.0e0", "D") + "\x03\r\n"
    content += line("DATE: 1-May-2020") + "\x03\r\n"
    content += "".join(f"{z:.5f}\r\n" for z in heights) + "\x03\r\n"
    return f"{content}{sum(content.encode()) % 65535}\r\n\x03\r\n\x1a".encode()


def read(folder, data, name="map.sdf"):
    (folder / name).write_bytes(data)
    return measurement(folder / name)


def holed(signed=True):
    rows = ROWS.copy() if signed else np.abs(ROWS)
    rows[0, 0] = rows[7, 3] = np.nan
    return rows


def assert_is(found, rows):
    assert (found.kind, found.unit, found.format, found.reader) == ("surface", "m", "SDF", "")
    assert found.sizes == pytest.approx((9 * DX, 12 * DY))
    assert np.ma.filled(found.heights, np.nan) == pytest.approx(DZ * rows.T, nan_ok=True)


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
@pytest.mark.parametrize("end", ["*\n*\n", "*\n*", "*\nNote = a * b\n*\n", "*\n", ""])
@pytest.mark.parametrize("magic", MAGICS)
def test_texts_of_every_dialect_hold_one_map(tmp_path, magic, end, newline):
    assert_is(read(tmp_path, text(holed(), magic, end=end, newline=newline)), holed())
    commented = text(holed(), f"{magic} ; a version", code="Double", Compression="NULL")
    assert_is(read(tmp_path, commented.replace(b"\n*\n", b"\nNumDataSet = 1\n*\n", 1)), holed())


@pytest.mark.parametrize("version", ["ISO-1.0", "ISO-2.0", "BCR-1.0"])
@pytest.mark.parametrize("code", SIGNED)
def test_the_least_number_of_a_type_is_a_missing_point(tmp_path, code, version):
    kind = np.dtype(TYPES[code])
    least = (np.finfo if kind.kind == "f" else np.iinfo)(kind).min
    assert_is(read(tmp_path, binary(holed(), version, code, least)), holed())
    in_text = text(
        holed(), f"a{version}", code, bad=repr(least.item() if kind.kind == "f" else least)
    )
    assert_is(read(tmp_path, in_text), holed())
    if kind.kind == "f":
        assert_is(read(tmp_path, binary(holed(), version, code, np.nan)), holed())


@pytest.mark.parametrize("code", range(8))
def test_the_largest_number_of_a_type_is_a_missing_point_of_bcr(tmp_path, code):
    kind = np.dtype(TYPES[code])
    rows = holed(signed=code > 2)
    most = (np.finfo if kind.kind == "f" else np.iinfo)(kind).max
    assert_is(read(tmp_path, binary(rows, "BCR-1.0", code, most)), rows)
    if kind.kind == "i":  # a height in the standard
        assert not read(tmp_path, binary(rows, "ISO-2.0", code, most)).unknown.any()


def test_one_profile_is_a_line_and_so_is_a_column(tmp_path):
    for data in (text, binary):
        found = read(tmp_path, data(ROWS[:1], Yscale=0))
        assert (found.kind, found.sizes) == ("profile", pytest.approx((9 * DX,)))
        assert found.heights == pytest.approx(DZ * ROWS[0])
        found = read(tmp_path, data(ROWS[:, :1], Xscale=0))
        assert (found.kind, found.sizes) == ("profile", pytest.approx((12 * DY,)))


def test_what_stands_before_and_after_the_heights_is_no_height(tmp_path):
    assert_is(read(tmp_path, binary(extra=struct.pack("<2I", 5, 1))), ROWS)  # of Olympus
    assert_is(read(tmp_path, binary(trailer=b"OperatorName = a\r\n*\r\n\0")), ROWS)
    with pytest.raises(rl.InputError, match="has 109 heights and states 9 x 12"):
        read(tmp_path, binary(trailer=struct.pack("<d", 1.5)))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (text(NumPoints=10), "has 108 heights and states 10 x 12 of them: it was cut short"),
        (text(NumPoints=None), "does not state NumPoints"),
        (text(NumProfiles=0), 'states NumProfiles = "0"'),
        (text(Xscale=0), 'states Xscale = "0"; an SDF file has a length above 0, in m'),
        (text(Yscale="-1e-6"), 'states Yscale = "-1e-6"'),
        (text(Zscale="1,0"), 'states Zscale = "1,0"'),
        (text(DataType=8), 'heights are of type "8"; SDF files have types 0 to 7'),
        (text(Compression=1), "has a compression of type 1; SDF files without are read"),
        (text(CheckType=1), "has a check sum of type 1"),
        (text(NumPoints=10**6, NumProfiles=10**6), "declares 1000000 x 1000000 points"),
        (text().replace(b"Xscale", b"xscale = 1\nXscale"), "states Xscale twice"),
        (text(bad="bar", rows=holed()), 'has "bar" among its heights, which is no number'),
        (text().replace(b"*\n", b""), 'has no line "*"'),
        (text(end="").rstrip(b"\n")[:-1], "ends within its heights"),
        (binary(NumPoints=10), "has 108 heights and states 10 x 12"),
        (binary(version="ISO-3.0"), "is an SDF file of version ISO-3.0; ISO-1.0, ISO-2.0"),
        (binary(Zscale="nan"), 'states Zscale = "nan"'),
        (binary()[:60], "ends within the head"),
        (binary(Compression=1), "has a compression of type 1"),
        (smd()[:-40], "ends of records (ETX) of 4: it was cut short"),
        (smd(step="0"), 'states its axis CX by "CX I 400 mm 1.0e0 D 0"'),
        (smd(unit="V"), 'states its axis CZ by "CZ A 400 V 1.0e0 D"'),
        (smd().replace(b"400", b"401", 1), "has 400 heights and states 401 along x and 400 of z"),
    ],
)
def test_a_file_that_contradicts_itself_is_refused(tmp_path, data, message):
    with pytest.raises(rl.InputError) as caught:
        read(tmp_path, data)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("between", ["\0 ", " "])
def test_the_check_sum_of_a_software_gauge_is_no_height(tmp_path, between):
    found = read(tmp_path, smd(between=between), "gauge.smd")
    assert (found.kind, found.unit, found.format) == ("profile", "m", "SMD")
    assert found.sizes == pytest.approx((400 * 2.5e-7,))
    assert found.heights == pytest.approx(1e-6 * PROFILE)


def stated_by(data):
    """What the head of a binary file states, read apart."""
    counts = "II" if data[1:8] == b"ISO-2.0" else "HH"
    _, _, _, n, m, x, y, z, _, _, code, _ = struct.unpack_from(f"<8x10s12s12s{counts}4d3B", data)
    raw = np.frombuffer(data, TYPES[code], n * m, struct.calcsize(f"<42x{counts}4d3B"))
    return raw.reshape(m, n).T, (n * x, m * y), z


@seeds(20, cases(2000, 16))
@pytest.mark.parametrize(
    "form", ["text", *(f"b{v}" for v in ("ISO-1.0", "ISO-2.0", "BCR-1.0")), "smd"]
)
def test_a_changed_head_gives_what_it_states_or_one_line(tmp_path, form, seeds):
    def is_right(found, changed):
        raw, sides, scale = stated_by(changed)
        return found.sizes == pytest.approx(sides) and found.heights[
            ~found.unknown
        ] == pytest.approx(raw[~found.unknown] * scale)

    if form[0] == "b":
        assert_read_or_refused(tmp_path, "m.sdf", binary(version=form[1:]), 81, seeds, is_right)
    elif form == "smd":
        assert_read_or_refused(tmp_path, "m.smd", smd(), smd().index(b"DATE"), seeds)
    else:
        assert_read_or_refused(tmp_path, "m.sdf", text(), text().index(b"*"), seeds)


@pytest.mark.parametrize("version", ["ISO-1.0", "ISO-2.0"])
def test_another_reader_finds_the_same(tmp_path, version):
    other = pytest.importorskip("sdfio")
    for data in (text(holed(), f"a{version}"), binary(holed(), version, 5, -(2**15))):
        found = read(tmp_path, data)
        theirs = other.read(tmp_path / "map.sdf")
        assert np.ma.filled(found.heights, np.nan) == pytest.approx(theirs.data.T, nan_ok=True)
