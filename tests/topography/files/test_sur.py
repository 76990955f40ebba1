"""SUR of Digital Surf: units in any coding, packed, inverted, profiles, and what is no height."""

import itertools
import struct
import zlib

import numpy as np
import pytest

import roughline as rl
from mutated_heads import assert_each_is_read_or_refused_in_one_line
from random_cases import seeds
from roughline.topography.files.read import measurement

NX, NY, DX, DY, DZ = 24, 20, 0.5, 0.25, 2.0**-10
COUNTS = np.random.default_rng(7).integers(-9000, 9000, (NX, NY))
MISSING = -9002  # two below the least height
HOLES = np.zeros((NX, NY), bool)
HOLES[4:6, 7] = True
MICRO = "µm".encode("latin-1")


def sur(
    counts=COUNTS,
    *,
    type_=2,
    objects=1,
    bits=32,
    units=(MICRO, MICRO, MICRO),
    steps=(DX, DY, DZ),
    special=0,
    inversion=0,
    packed=0,
    points=None,
    comment=b"a comment",
):
    """The bytes of a file, packed in a number of pieces."""
    head = bytearray(512)
    head[:12] = b"DSCOMPRESSED" if packed else b"DIGITAL SURF"
    nx, ny = points or counts.shape
    struct.pack_into("<3H", head, 14, objects, 1, type_)
    struct.pack_into("<H", head, 86, special)
    struct.pack_into("<H2i2iI3f", head, 98, bits, -9000, 9000, nx, ny, nx * ny & 0xFFFFFFFF, *steps)
    for i, unit in enumerate(units):
        for place in (180, 228):
            struct.pack_into("<16s", head, place + 16 * i, unit)
    struct.pack_into("<H", head, 290, inversion)
    struct.pack_into("<2H", head, 334, len(comment), 0)
    data = counts.T.astype(f"<i{bits // 8}").tobytes()
    if packed:
        cut = np.linspace(0, len(data), packed + 1).astype(int)
        pieces = [data[a:b] for a, b in itertools.pairwise(cut)]
        streams = [zlib.compress(piece) for piece in pieces]
        sizes = [(len(a), len(b)) for a, b in zip(pieces, streams, strict=True)]
        table = b"".join(struct.pack("<2I", *each) for each in sizes)
        data = struct.pack("<I", packed) + table + b"".join(streams)
        struct.pack_into("<I", head, 324, len(data))
    return bytes(head) + comment + data


@pytest.fixture
def read(tmp_path):
    def read_bytes(content):
        (tmp_path / "map.sur").write_bytes(content)
        return measurement(tmp_path / "map.sur")

    return read_bytes


@pytest.mark.parametrize("packed", [0, 1, 3])
@pytest.mark.parametrize("bits", [16, 32])
def test_heights_and_missing_points_are_those_of_the_file(read, bits, packed):
    counts = np.where(HOLES, MISSING, COUNTS)
    found = read(sur(counts, bits=bits, special=1, packed=packed))
    assert (found.kind, found.unit, found.format) == ("surface", "µm", "SUR")
    assert found.sizes == (NX * DX, NY * DY)
    assert (found.unknown == HOLES).all()
    assert np.array_equal(found.heights[~HOLES], DZ * COUNTS[~HOLES])


@pytest.mark.parametrize(
    "unit", ["µm".encode(), "Âµm".encode(), b"\xb5m", b"\xe6m", b"um", "μm".encode()]
)
def test_a_micro_sign_in_any_coding_is_one(tmp_path, unit):
    (tmp_path / "map.sur").write_bytes(sur(units=(unit,) * 3))
    assert rl.read(tmp_path / "map.sur").sizes == pytest.approx((NX * DX * 1e-6, NY * DY * 1e-6))


@pytest.mark.parametrize("unit", [b"in", b"inches", b'"'])
def test_inches_and_units_that_differ_are_metres_in_the_end(tmp_path, unit):
    (tmp_path / "map.sur").write_bytes(sur(units=(unit, b"mm", b"nm")))
    found = rl.read(tmp_path / "map.sur", trend="none")
    assert found.sizes == pytest.approx((NX * DX * 25.4e-3, NY * DY * 1e-3))
    assert np.allclose(found.heights, 1e-9 * DZ * COUNTS, rtol=1e-14, atol=0)


@pytest.mark.parametrize(
    ("flag", "turned"),
    [(1, -COUNTS), (2, -COUNTS[::-1]), (3, -COUNTS[:, ::-1])],
)
def test_inverted_heights_are_turned_back(read, flag, turned):
    assert np.array_equal(read(sur(inversion=flag)).heights, DZ * turned)


@pytest.mark.parametrize("along", [0, 1])
def test_one_row_is_a_line_scan_whatever_is_stated_across_it(read, along):
    counts = COUNTS[:, :1] if along == 0 else COUNTS[:1]
    units = (MICRO, b"s", MICRO) if along == 0 else (b"", MICRO, MICRO)
    steps = (DX, 0.0, DZ) if along == 0 else (0.0, DX, DZ)
    found = read(sur(counts, type_=1, units=units, steps=steps))
    assert (found.kind, found.unit, found.sizes) == ("profile", "µm", (counts.size * DX,))
    assert np.array_equal(found.heights, DZ * counts.ravel())
    assert read(sur(type_=1)).kind == "surface"  # as Gwyddion writes maps


def test_of_several_layers_the_first_is_read_and_this_is_said(read):
    found = read(sur(type_=8, objects=2) + sur(2 * COUNTS))
    assert np.array_equal(found.heights, DZ * COUNTS)
    assert found.doubts == ("it holds 2 layers, of which the first is read",)


def test_units_that_are_not_stated_are_asked_for(tmp_path):
    (tmp_path / "map.sur").write_bytes(sur(units=(b"mm", b"mm", b"")))
    with pytest.raises(rl.UnitError, match="its sizes in mm and no unit of its heights"):
        rl.read(tmp_path / "map.sur")
    assert rl.read(tmp_path / "map.sur", unit="nm").sizes == (0.012, 0.005)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"units": (MICRO, MICRO, b"%")}, 'z axis is in "%": no heights in it'),
        ({"units": (MICRO, MICRO, b"a.u.")}, 'z axis is in "a.u.": no heights in it'),
        ({"units": (b"s", MICRO, MICRO)}, 'x axis is in "s": no map'),
        ({"units": (b"", MICRO, MICRO)}, "the unit of one side alone"),
        ({"type_": 10}, "an image of intensity, and no map"),
        ({"type_": 4}, "a series of profiles"),
        ({"type_": 20}, "a spectrum, and no map"),
        ({"type_": 21}, "a map of spectra, and no map"),
        ({"type_": 99}, "an object of type 99, and no map"),
        ({"points": (0, NY)}, "states 0 x 20 points"),
        ({"points": (-3, NY)}, "states -3 x 20 points"),
        ({"points": (10**6, 10**6)}, "declares 1000000 x 1000000 points"),
        ({"points": (NX, NY + 1)}, "holds 1920 bytes of heights, and its head states 2016"),
        ({"points": (NX, NY - 1), "packed": 2}, "more than 1824 bytes of heights, and its head"),
        ({"steps": (-DX, DY, DZ)}, "points are -0.5 apart"),
        ({"steps": (DX, float("inf"), DZ)}, "points are inf apart"),
        ({"steps": (DX, DY, 0.0)}, "step of heights is 0"),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_line(read, wrong, message):
    with pytest.raises(rl.InputError, match=f"map.sur.*{message}") as caught:
        read(sur(**wrong))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("packed", [0, 2])
def test_a_file_that_is_cut_or_changed_is_read_or_refused(read, packed):
    whole = sur(packed=packed)
    rng = np.random.default_rng(7)
    for place in rng.integers(12, len(whole), 60):
        with pytest.raises(rl.InputError, match="map.sur"):
            read(whole[:place])
    for place in rng.integers(12, len(whole), 60):
        assert_read_or_refused(read, whole[:place] + b"\xff" + whole[place + 1 :])


def assert_read_or_refused(read, content):
    try:
        read(content)
    except (rl.InputError, rl.UnitError) as error:
        assert "\n" not in str(error)  # noqa: PT017 - it may be read as well


@pytest.mark.parametrize("packed", [0, 3])
@seeds(10, 2000)
def test_a_changed_head_gives_a_body_or_one_line(tmp_path, packed, seeds):
    content = sur(packed=packed)
    assert_each_is_read_or_refused_in_one_line(tmp_path / "map.sur", content, 570, seeds)
