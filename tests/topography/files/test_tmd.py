"""TMD of TrueMap and GelSight: a comment of any length, lengths in mm."""

import struct

import numpy as np
import pytest

import roughline as rl
from mutated_heads import assert_each_is_read_or_refused_in_one_line
from random_cases import seeds
from roughline.topography.files.read import measurement

NX, NY = 12, 9
HEIGHTS = np.random.default_rng(7).standard_normal((NX, NY)).astype("<f4")


def tmd(comment=b"Created by TrueMap v6\r\n", points=(NX, NY), sides=(1.2, 0.9)):
    head = struct.pack("<2I4f", *points, *sides, 0.0, 0.0)
    return b"Binary TrueMap Data File v2.0\r\n\0" + comment + b"\0" + head + HEIGHTS.T.tobytes()


@pytest.mark.parametrize("comment", [b"Created by TrueMap v6\r\n", b"", 300 * b"GelSight "])
def test_heights_follow_a_comment_of_any_length(tmp_path, comment):
    (tmp_path / "a.tmd").write_bytes(tmd(comment))
    found = measurement(tmp_path / "a.tmd")
    assert np.array_equal(found.heights, HEIGHTS)
    assert (found.unit, found.sizes) == ("mm", pytest.approx((1.2, 0.9)))
    assert found.doubts == ()


def test_a_program_that_writes_other_units_is_doubted(tmp_path):
    (tmp_path / "a.tmd").write_bytes(tmd(b"Exported by surfalize\r\n"))
    assert "1000 times too large" in measurement(tmp_path / "a.tmd").doubts[0]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (tmd()[:60], "ends within the head"),
        (tmd(sides=(0.0, 1.0)), "sides are 0 mm x 1 mm"),
        (tmd(sides=(1.0, float("nan"))), "sides are 1 mm x nan mm"),
        (tmd(points=(0, NY)), "holds 0 x 9 points"),
        (tmd(points=(10**6, 10**6)), "declares 1000000 x 1000000 points"),
        (tmd()[:-1], "has 431 bytes of heights, and its 12 x 9 points need 432"),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_line(tmp_path, content, message):
    (tmp_path / "a.tmd").write_bytes(content)
    with pytest.raises(rl.InputError, match=f"a.tmd .*{message}"):
        rl.read(tmp_path / "a.tmd")


@pytest.mark.filterwarnings("ignore:overflow:RuntimeWarning")  # of heights of 1e38 mm, squared
@seeds(10, 2000)
def test_a_changed_head_gives_a_body_or_one_line(tmp_path, seeds):
    assert_each_is_read_or_refused_in_one_line(tmp_path / "map.tmd", tmd(), 90, seeds)
