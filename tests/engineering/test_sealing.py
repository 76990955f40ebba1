"""The face of a seal, as it is typed."""

import math

import pytest

import roughline as rl
from roughline.engineering.sealing import SealShape


@pytest.mark.parametrize(
    ("typed", "ratio"),
    [
        ("100 mm x 2 mm", 50.0),
        ("100 mm×2 mm", 50.0),
        ("1e2 mm x 2000 um", 50.0),
        ("20 mm .. 24 mm", 2 * math.pi / math.log(1.2)),
        ("20 mm...24 mm", 2 * math.pi / math.log(1.2)),
    ],
)
def test_a_seal_has_a_ratio(typed, ratio):
    assert SealShape.of(typed).ratio == pytest.approx(ratio, rel=1e-12)
    assert SealShape.of(typed).width in (0.1, 2 * math.pi * 20e-3)
    assert rl.Fluid("water", inlet="6 bar", seal=typed).seal == SealShape.of(typed)


@pytest.mark.parametrize("width", [1e-3, 1e-5])
def test_a_narrow_ring_is_a_strip_as_long_as_its_circumference(width):
    ring = SealShape.of(f"20 mm .. {20 * (1 + width)} mm")
    assert ring.width == pytest.approx(2 * math.pi * 20e-3, rel=1e-12)
    strip = 2 * math.pi * (1 + width / 2) / width
    assert ring.ratio == pytest.approx(strip, rel=width**2)


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("100 mm", "seal is .*give its length across the flow"),
        ("24 mm .. 20 mm", "inner radius comes first"),
        ("20 mm .. 20 mm", "inner radius comes first"),
        ("0 mm x 2 mm", "positive, finite"),
        ("100 x 2 mm", "without a unit"),
        ("100 mm x 2 N", "no quantity in m"),
        ("1 mm x 2 mm x 3 mm", "give its length across the flow"),
        ("", "give its length across the flow"),
        (2.0, "give its length across the flow"),
    ],
)
def test_what_is_no_seal_is_refused_in_one_line(typed, said):
    with pytest.raises(rl.InputError, match=said) as refused:
        rl.Fluid("water", inlet="6 bar", seal=typed)
    assert "\n" not in str(refused.value)
