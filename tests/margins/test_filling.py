"""Points that were missing: what the force on them, and their number, leave of the answers."""

import numpy as np
import pytest

import roughline as rl

LENGTH = 1e-4
SPECTRUM = rl.SelfAffine(hurst=0.8, length=LENGTH, rms_height=4e-7, q_roll=8 * np.pi / LENGTH)


def asked_of(heights, folder, load="0.05 N", **reading):
    file = folder / "map.txt"
    np.savetxt(file, heights)
    question = rl.Question(
        file,
        E_star="100 GPa",
        loads=[load],
        grid_error=True,
        reading=rl.Reading("m", sizes=f"{LENGTH} m", **reading),
    )
    return rl.assess(question)


def plane(lean):
    x = np.arange(64) * LENGTH / 64
    return lean * (x[:, np.newaxis] + x)


@pytest.mark.parametrize("lean", [-0.03, 0.03])
def test_a_lean_does_not_lift_what_is_filled_at_a_corner(tmp_path, lean):
    heights = np.array(SPECTRUM.surface(64, 2).heights)
    heights[:18, :18] = np.nan
    level, leaning = (asked_of(heights + plane(each), tmp_path) for each in (0.0, lean))
    assert leaning.curve.stiffness == pytest.approx(level.curve.stiffness, rel=1e-6)
    assert leaning.on_filled == pytest.approx(level.on_filled, abs=1e-6)


def test_force_on_filled_points_is_said_and_widens_intervals(tmp_path):
    i, j = np.indices((64, 64)) - 31
    heights = np.array(SPECTRUM.surface(64, 2).heights) - 1e-8 * (i**2 + j**2)  # of a dome
    is_known = (i % 2 == 0) & (j % 2 == 0)
    heights[(np.hypot(i, j) < 9) & ~is_known] = np.nan
    found = asked_of(heights, tmp_path, "5 N")
    share = found.on_filled[0]
    assert 0.1 < share < 0.9
    fact = next(each for each in found.facts if each.kind == "on_filled_points")
    said = str(fact)
    assert said.startswith(f"{share:.0%} of the force of load 5 N stands on points that were")
    assert fact.is_grave == (share > 0.5)
    low, high = (each[0] for each in found.intervals.stiffness)
    stiffness = found.curve.stiffness[0]
    assert high >= stiffness / (1 - share)
    assert low <= stiffness * (1 - share)


def test_no_interval_holds_where_many_points_are_missing(tmp_path):
    heights = np.array(SPECTRUM.surface(64, 2).heights)
    heights[np.random.default_rng(5).random(heights.shape) < 0.89] = np.nan
    found = asked_of(heights, tmp_path, missing=rl.Missing(most=0.95))
    assert found.intervals is None
    first = found.warnings[0]
    assert first.startswith("89% of the points are missing and were filled")
    assert first.endswith("all values come without an interval")
    assert found.facts[0].is_grave


def test_where_all_points_are_known_nothing_is_said_of_filled_ones(tmp_path):
    found = asked_of(np.array(SPECTRUM.surface(64, 2).heights), tmp_path)
    assert found.on_filled is None
    assert not any("filled" in each for each in found.remarks)


def test_points_of_either_of_two_bodies_count_as_filled(tmp_path):
    heights = np.array(SPECTRUM.surface(64, 2).heights)
    other = tmp_path / "other.txt"
    np.savetxt(other, heights)
    holed = heights.copy()
    holed[5:9, 10:20] = np.nan
    found = asked_of(holed, tmp_path)
    question = rl.Question(
        other,
        against=tmp_path / "map.txt",
        E_star="100 GPa",
        loads=["1 N"],
        reading=rl.Reading("m", sizes=f"{LENGTH} m"),
    )
    second = rl.assess(question)
    expected = np.zeros((64, 64), bool)
    expected[64 - 9 : 64 - 5, 10:20] = True
    pressure = second.curve.fields[0].pressure
    assert second.on_filled[0] == pytest.approx(pressure[expected].sum() / pressure.sum())
    assert found.on_filled is not None


PAIR = ("E=3 GPa nu=0.38", "E=3 GPa nu=0.38")
OF_SHEAR = ("shear_displacement", "stiffness_on_return", "cycle_energy", "fretting")


def sheared(heights, folder, load, filling="harmonic"):
    """The answers of a shear force on a map of which points are missing."""
    file = folder / "map.txt"
    np.savetxt(file, heights)
    question = rl.Question(
        file,
        PAIR,
        loads=load,
        ask=[rl.Friction(0.3), rl.Shear(f"{0.2 * load} N")],
        grid_error=True,
        reading=rl.Reading("m", sizes=f"{LENGTH} m", missing=rl.Missing(filling)),
    )
    return rl.assess(question)


def test_intervals_of_stick_and_slip_hold_what_another_filling_gives(tmp_path):
    heights = np.array(SPECTRUM.surface(32, 2).heights)
    heights[heights > np.quantile(heights, 0.995)] = np.nan  # spots that were too steep to see
    heights[5:8, 20:23] = np.nan
    found, other = (sheared(heights, tmp_path, 0.1, each) for each in ("harmonic", "nearest"))
    assert 0 < found.on_filled[0] < 0.1
    for key in OF_SHEAR:
        answer, there = found.answers[key], other.answers[key].values[0]
        (margin,) = (each for each in answer.margins if each.cause == "filling")
        factor = np.exp(abs(np.log(there / answer.values[0])))
        assert margin.high[0] == pytest.approx(answer.values[0] * factor, rel=1e-5)
        assert margin.low[0] == pytest.approx(answer.values[0] / factor, rel=1e-5)
        assert answer.low[0] <= margin.low[0] < margin.high[0] <= answer.high[0]
    assert "shear_left_open" not in {each.kind for each in found.facts}


def test_what_slips_where_much_stands_on_filled_points_is_not_known(tmp_path):
    i, j = np.indices((32, 32)) - 15
    heights = np.array(SPECTRUM.surface(32, 2).heights) - 4e-8 * (i**2 + j**2)  # of a dome
    is_known = (i % 2 == 0) & (j % 2 == 0)
    heights[(np.hypot(i, j) < 5) & ~is_known] = np.nan
    found = sheared(heights, tmp_path, 0.1)
    assert found.on_filled[0] > 0.1
    assert found.answers["cycle_energy"].low is None
    (told,) = (each for each in found.facts if each.kind == "shear_left_open")
    assert "much of the force stands on filled points" in str(told)
