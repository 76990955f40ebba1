"""X3P as programs write it: every form of it gives the heights that it holds, or one line."""

import hashlib
import io
import tracemalloc
import zipfile

import numpy as np
import pytest

import roughline as rl
from mutated_heads import assert_each_is_read_or_refused_in_one_line
from random_cases import seeds
from roughline.topography.files.read import measurement, suspicions

NX, NY, DX, DY = 31, 20, 1e-6, 2e-6
HEIGHTS = 1e-6 * np.random.default_rng(7).standard_normal((NX, NY))
LISTED = list(map(repr, HEIGHTS.T.ravel().tolist()))  # as texts
HOLES = np.zeros((NX, NY), bool)
HOLES[4:6, 7] = True
TYPES = {"I": ("<i2", 1e-10), "L": ("<i4", 1e-13), "F": ("<f4", 1.0), "D": ("<f8", 1.0)}


def axis(name, kind, type_, step, offset=0.0):
    """An axis as ISO 25178-72 writes it."""
    return (
        f"<{name}><AxisType>{kind}</AxisType><DataType>{type_}</DataType>"
        f"<Increment>{step!r}</Increment><Offset>{offset!r}</Offset></{name}>"
    )


def md5(content):
    return hashlib.md5(content).hexdigest()


def x3p(
    points=(NX, NY, 1),
    *,
    axes=None,
    data=None,
    valid=None,
    datums=None,
    revision="ISO5436 - 2000",
    feature="SUR",
    folder="",
    checksum=None,
    head="",
    sums=True,
):
    """The bytes of a file; what is not given is that of the map HEIGHTS in doubles."""
    if axes is None:
        axes = axis("CX", "I", "D", DX) + axis("CY", "I", "D", DY) + axis("CZ", "A", "D", 1.0)
    if data is None and datums is None:
        data = HEIGHTS.T.astype("<f8").tobytes()
    parts = {}
    if datums is None:
        parts["bindata/data.bin"] = data
        stated = md5(data) if sums else 32 * "0"
        held = (
            "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>"
            f"<MD5ChecksumPointData>{stated}</MD5ChecksumPointData>"
        )
        if valid is not None:
            parts["bindata/valid.bin"] = valid
            held += (
                "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>"
                f"<MD5ChecksumValidPoints>{md5(valid)}</MD5ChecksumValidPoints>"
            )
        held += "</DataLink>"
    else:
        held = f"<DataList>{''.join(f'<Datum>{each}</Datum>' for each in datums)}</DataList>"
    if len(points) == 1:
        size = f"<ListDimension>{points[0]}</ListDimension>"
    else:
        sizes = (f"<Size{k}>{n}</Size{k}>" for k, n in zip("XYZ", points, strict=True))
        size = f"<MatrixDimension>{''.join(sizes)}</MatrixDimension>"
    main = (
        f'<?xml version="1.0" encoding="UTF-8"?>{head}'
        '<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">'
        f"<Record1><Revision>{revision}</Revision><FeatureType>{feature}</FeatureType>"
        f"<Axes>{axes}</Axes></Record1><Record3>{size}{held}</Record3>"
        "<Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4></p:ISO5436_2>"
    ).encode()
    parts["main.xml"] = main
    parts["md5checksum.hex"] = f"{checksum or md5(main)} *main.xml\n".encode()
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, part in parts.items():
            archive.writestr(folder + name, part)
    return content.getvalue()


@pytest.fixture
def read(tmp_path):
    def read_bytes(content, **others):
        (tmp_path / "map.x3p").write_bytes(content)
        return measurement(tmp_path / "map.x3p", **others)

    return read_bytes


def stored(heights, type_):
    dtype, step = TYPES[type_]
    return np.round(heights.T / step).astype(dtype) if "i" in dtype else heights.T.astype(dtype)


def bits_of(holes):
    return np.packbits(~holes.T.ravel(), bitorder="little").tobytes()


def axes_of(type_):
    step = TYPES[type_][1]
    return axis("CX", "I", "D", DX) + axis("CY", "I", "D", DY) + axis("CZ", "A", type_, step, 1e-5)


@pytest.mark.parametrize("in_xml", [False, True])
@pytest.mark.parametrize("type_", TYPES)
def test_heights_of_every_type_are_read_and_missing_points_are_missing(read, type_, in_xml):
    numbers = stored(HEIGHTS, type_)
    if in_xml:
        texts = [repr(each.item()) for each in numbers.ravel()]
        texts = np.where(HOLES.T.ravel(), "", texts)
        found = read(x3p(axes=axes_of(type_), datums=texts))
    else:
        found = read(x3p(axes=axes_of(type_), data=numbers.tobytes(), valid=bits_of(HOLES)))
    assert (found.kind, found.unit, found.format) == ("surface", "m", "X3P")
    assert found.sizes == (NX * DX, NY * DY)
    assert (found.unknown == HOLES).all()
    expected = 1e-5 + TYPES[type_][1] * numbers.T
    assert np.allclose(found.heights[~HOLES], expected[~HOLES], rtol=1e-15)
    assert np.abs(expected - 1e-5 - HEIGHTS).max() < 1e-10
    assert found.doubts == ()


@pytest.mark.parametrize(
    "revision", ["ISO5436 – 2000", "ISO25178-72:2017/DAM1", "", "ISO 25178 of the future"]
)
@pytest.mark.parametrize("folder", ["", "my scan/"])
def test_revisions_and_folders_change_no_height(read, revision, folder):
    found = read(x3p(revision=revision, folder=folder))
    assert np.array_equal(found.heights, HEIGHTS)
    assert len(found.doubts) == ("future" in revision)


def test_a_map_whose_points_have_positions_is_that_of_its_grid(read):
    x, y = (DX * np.arange(NX), DY * np.arange(NY))
    axes = "".join(axis(name, "A", "D", 1.0) for name in ("CX", "CY", "CZ"))
    rows = np.stack([*np.meshgrid(x, y), HEIGHTS.T], axis=-1)
    for points in ((NX, NY, 1), (NX * NY,)):
        found = read(x3p(points, axes=axes, data=rows.tobytes(), feature="PCL"))
        assert np.array_equal(found.heights, HEIGHTS)
        assert found.sizes == pytest.approx((NX * DX, NY * DY))
    rows[..., 0] += 3e-7 * np.random.default_rng(1).standard_normal((NY, NX))
    with pytest.raises(rl.InputError, match="on no regular grid"):
        read(x3p(axes=axes, data=rows.tobytes()))


@pytest.mark.parametrize("is_even", [True, False])
def test_one_row_is_a_line_scan(read, is_even):
    z = HEIGHTS[:, 0]
    counted = x3p((NX, 1, 1), data=z.tobytes(), feature="PRF")
    found = read(counted)
    assert (found.kind, found.sizes, found.positions) == ("profile", (NX * DX,), None)
    assert np.array_equal(found.heights, z)
    x = DX * np.arange(NX) * (1 if is_even else 1 + np.arange(NX) / NX)
    axes = axis("CX", "A", "D", 1.0) + axis("CY", "I", "D", 0.0) + axis("CZ", "A", "D", 1.0)
    placed = read(x3p((NX, 1, 1), axes=axes, data=np.stack([x, z], axis=1).tobytes()))
    assert (placed.kind, np.array_equal(placed.heights, z)) == ("profile", True)
    if is_even:
        assert placed.sizes == pytest.approx((NX * DX,))
    else:
        assert np.array_equal(placed.positions, x)


def test_layers_are_channels(read):
    content = x3p((NX, NY, 2), data=np.stack([HEIGHTS.T, 2 * HEIGHTS.T]).tobytes())
    assert read(content).channels == ("0 layer 0", "1 layer 1")
    assert np.array_equal(read(content, channel=1).heights, 2 * HEIGHTS)
    with pytest.raises(rl.InputError, match="has no channel 2; it has 2 layers"):
        read(content, channel=2)


def test_numbers_that_are_none_are_missing_points(read):
    z = HEIGHTS.astype("<f4")
    z[2, 3], z[4, 5] = np.nan, np.inf
    data = bytearray(z.T.tobytes())
    data[:4] = b"\1\0\x80\x7f"  # of which a processor warns when it is converted
    found = read(x3p(axes=axes_of("F"), data=bytes(data)))
    assert np.argwhere(found.unknown).tolist() == [[0, 0], [2, 3], [4, 5]]


def test_axes_that_fall_mirror_the_map(read):
    axes = axis("CX", "I", "D", -DX) + axis("CY", "I", "D", DY) + axis("CZ", "A", "D", 1.0)
    found = read(x3p(axes=axes))
    assert np.array_equal(found.heights, HEIGHTS[::-1])
    assert found.sizes == (NX * DX, NY * DY)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"checksum": 32 * "a"}, "is not that of its main.xml"),
        ({"sums": False}, "is not that of its bindata/data.bin"),
    ],
)
def test_a_checksum_of_something_else_is_said_and_the_heights_are_read(tmp_path, wrong, said):
    (tmp_path / "map.x3p").write_bytes(x3p(**wrong))
    body = rl.read(tmp_path / "map.x3p", trend="none")
    assert np.array_equal(body.heights, HEIGHTS)
    assert any(said in str(each) for each in suspicions(body))


def test_the_checksum_of_the_heights_beside_main_is_no_doubt(read):
    """SurfaceTopography writes it so."""
    found = read(x3p(checksum=md5(HEIGHTS.T.tobytes())))
    assert found.doubts == ()
    assert "is that of the heights" in found.corrected[0]


BOMB = "<!DOCTYPE a [<!ENTITY b 'c'>]>"
BAD_AXES = [
    axis("CX", "I", "D", DX) + axis("CY", "I", "D", DY) + axis("CZ", *wrong)
    for wrong in (("I", "D", 1.0), ("A", "S", 1.0), ("A", "D", 0.0), ("A", "D", "nan"))
]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"head": BOMB}, "declares a document type"),
        ({"points": (NX, NY, 0)}, "numbers of points are 31 x 20 x 0"),
        ({"points": (-NX, NY, 1)}, "numbers of points are"),
        ({"points": (10**6, 10**6, 1)}, "declares 1000000 x 1000000 points"),
        ({"points": (NX, NY + 1, 1)}, "has 4960 bytes, and 5208 are needed"),
        ({"datums": ["1"] * 3}, "lists 3 points, and 620 are needed"),
        ({"datums": ["1;2"] * NX * NY}, 'point 0 is "1;2"'),
        ({"axes": BAD_AXES[0]}, "z axis counts points"),
        ({"axes": BAD_AXES[1]}, 'axis CZ is of type "A", "S"'),
        ({"axes": BAD_AXES[2]}, "the step of an axis is 0"),
        ({"axes": BAD_AXES[3]}, "CZ/Increment is "),
        ({"head": "<a>"}, "main.xml is damaged"),
        ({"valid": b"\0"}, "valid.bin has 1 bytes, and 78 are needed"),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_line(read, wrong, message):
    with pytest.raises(rl.InputError, match=f"map.x3p .*{message}") as caught:
        read(x3p(**wrong))
    assert "\n" not in str(caught.value)
    assert str(caught.value).count("map.x3p") == 1


def test_an_archive_that_would_unpack_to_too_much_is_refused_unread(read):
    content = x3p((10**4, 10**4, 1), data=bytes(8 * 10**7), axes=axes_of("L"))
    tracemalloc.start()
    with pytest.raises(rl.InputError, match="would unpack to"):
        read(content)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 4e7


@pytest.mark.parametrize("start", range(4))
def test_a_file_that_is_cut_or_changed_is_read_whole_or_refused(tmp_path, start):
    whole = x3p()
    rng = np.random.default_rng(start)
    for place in rng.integers(len(whole), size=8):
        changed = bytearray(whole)
        changed[place] ^= 1 << rng.integers(8)
        for content in (whole[:place], bytes(changed)):
            (tmp_path / "map.x3p").write_bytes(content)
            assert_whole_or_refused(tmp_path / "map.x3p")


def assert_whole_or_refused(file):
    try:
        found = measurement(file)
    except rl.InputError as refused:
        assert "\n" not in str(refused)  # noqa: PT017 - it may be read as well
    else:
        assert np.array_equal(found.heights, HEIGHTS)


def test_another_program_reads_the_same(tmp_path):
    x3pio = pytest.importorskip("x3pio")
    for type_ in x3pio.DataType:
        file = tmp_path / f"{type_}.x3p"
        z = np.where(HOLES, np.nan, HEIGHTS).T
        scale = 1e-13 if type_.name == "INT32" else 1e-10 if type_.name == "INT16" else 1.0
        x3pio.write(file, z, x_scale=DX, y_scale=DY, z_type=type_, z_scale=scale)
        judge, found = x3pio.read(file), measurement(file)
        assert np.array_equal(np.ma.filled(found.heights, np.nan).T, judge.layers[0].z, True)


@pytest.mark.parametrize("content", [x3p(valid=bits_of(HOLES)), x3p(datums=LISTED)])
@seeds(10, 2000)
def test_a_changed_head_gives_a_body_or_one_line(tmp_path, content, seeds):
    file = tmp_path / "map.x3p"
    assert_each_is_read_or_refused_in_one_line(file, content, "main.xml", seeds)
