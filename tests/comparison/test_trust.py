"""The map of the difference between the two models, and its verdicts."""

import numpy as np
import pytest

import roughline as rl
from roughline.comparison.trust import COLUMNS, Difference, TrustMap
from roughline.statistics.verdict import Verdict


def test_verdicts_on_a_difference():
    assert Difference(0.02, -0.03, 0.05, 0.1, True).verdict() is Verdict.CONFIRMED
    assert Difference(0.3, 0.2, 0.4, 0.1, True).verdict() is Verdict.REFUTED
    assert Difference(-0.3, -0.4, -0.2, 0.1, True).verdict(0.1) is Verdict.REFUTED
    assert Difference(0.08, 0.02, 0.14, 0.1, True).verdict() is Verdict.UNDECIDED
    assert str(Difference(0.08, 0.02, 0.14, 0.1, False)) == (
        "+8% (+2% to +14%), at the limit of the grid"
    )


def test_the_map_is_as_unsure_as_its_surfaces_scatter():
    """Its intervals are no narrower than Student's, of 20 surfaces, the lines being exact."""
    found = rl.trust_map()
    sure = found.resolved
    widths = np.log((1 + found.high[sure]) / (1 + found.low[sure])) / 2
    least = 2.093 * found.scatter[sure] / np.sqrt(20)
    assert np.median(widths / least) > 1


def test_the_map_is_read_at_its_points_and_between():
    axes = ([1.0, 4.0], [2.0, 2.5, 3.0], [0.01, 0.1, 1.0])
    rows = np.array(
        [
            (r, d, f, np.log(r) + d + np.log(f), -1.0, 1.0, 0.1, f > 0.02)
            for r in axes[0]
            for d in axes[1]
            for f in axes[2]
        ]
    )
    trust = TrustMap.from_rows(rows)
    assert len(COLUMNS) == rows.shape[1]
    assert trust.at(2.5, 0.1, 4.0).value == pytest.approx(np.log(4) + 2.5 + np.log(0.1))
    assert trust.at(2.3, 0.05, 2.0).value == pytest.approx(np.log(2) + 2.3 + np.log(0.05))
    assert trust.at(2.3, 0.5).resolved
    assert not trust.at(2.3, 0.05).resolved
    for place, message in (
        ((1.9, 0.1), "fractal_dimension is 1.9; the map reaches from 2 to 3"),
        ((2.5, 10.0), "force_bar is 10; the map reaches from 0.01 to 1"),
        ((2.5, 0.1, 32.0), "roll_off_ratio is 32; the map reaches from 1 to 4"),
    ):
        with pytest.raises(rl.InputError, match=message):
            trust.at(*place)
