"""NMS of NanoFocus: lengths in nm, points without a signal missing."""

import struct

import numpy as np
import pytest

import roughline as rl
from mutated_heads import assert_each_is_read_or_refused_in_one_line
from random_cases import seeds
from roughline.topography.files.read import measurement

NX, NY, STEP = 16, 12, 312.5  # nm
COUNTS = np.random.default_rng(7).integers(1, 2**16, (NY, NX), dtype=np.uint16)
LOW, HIGH = -3.0, 5.0  # um


def nms(*, mark=b"OM_MS_2.0", type_=2, kind=1, points=(NX, NY), steps=(STEP, STEP), signal=None):
    """The bytes of a file; older ones have zeros in place of the mark and what it tells."""
    head = bytearray(3468)
    struct.pack_into("<2d", head, 16, LOW, HIGH)
    if mark:
        struct.pack_into("<4i", head, 0, type_, kind, 1, 2**16 - 1)
        head[32 : 32 + len(mark)] = mark
        struct.pack_into("<i", head, 1416, signal is not None)
    struct.pack_into("<2i2d", head, 1368, *points, *steps)
    return bytes(head) + COUNTS.tobytes() + (b"" if signal is None else signal.tobytes())


@pytest.mark.parametrize(("mark", "name"), [(b"OM_MS_2.0", "a.orginal"), (b"", "a.NMS")])
def test_sides_are_in_nm_and_heights_in_um(tmp_path, mark, name):
    (tmp_path / name).write_bytes(nms(mark=mark))
    body = rl.read(tmp_path / name, trend="none")
    assert body.sizes == pytest.approx((NX * STEP * 1e-9, NY * STEP * 1e-9))
    expected = 1e-6 * (HIGH - LOW) / (2**16 - 2) * COUNTS.T.astype(float)
    assert np.ptp(body.heights - expected) < 1e-18
    assert "takes them for mm" in body.settings["corrected"]


def test_points_without_a_signal_are_missing(tmp_path):
    signal = np.ones((NY, NX), np.uint8)
    signal[2, 5] = 0
    (tmp_path / "a.nms").write_bytes(nms(signal=signal))
    assert np.argwhere(measurement(tmp_path / "a.nms").unknown).tolist() == [[5, 2]]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"points": (10**6, NY)}, "states 1000000 x 12 points"),
        ({"points": (-NX, NY)}, "states -16 x 12 points"),
        ({"points": (NX, NY + 9)}, "ends before its 16 x 21 points do"),
        ({"steps": (0.0, STEP)}, "points 0 nm x 312.5 nm apart"),
        ({"steps": (float("nan"), STEP)}, "points nan nm"),
        ({"type_": 5}, "numbers of type 5"),
        ({"signal": np.ones(3, np.uint8)}, "ends before"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(tmp_path, wrong, message):
    (tmp_path / "a.nms").write_bytes(nms(**wrong))
    with pytest.raises(rl.InputError, match=f"a.nms .*{message}"):
        rl.read(tmp_path / "a.nms")


def test_a_head_that_is_cut_is_refused(tmp_path):
    (tmp_path / "a.nms").write_bytes(nms()[:2000])
    with pytest.raises(rl.InputError, match="within the head of NMS"):
        rl.read(tmp_path / "a.nms")


@seeds(10, 2000)
def test_a_changed_head_gives_a_body_or_one_line(tmp_path, seeds):
    assert_each_is_read_or_refused_in_one_line(tmp_path / "map.nms", nms(), 3468, seeds)
