"""How values and their intervals are written."""

import math

import numpy as np
import pytest

from roughline.report.page import KeyFigure
from roughline.report.values import up_to_three_digits, value_and_interval, with_interval
from roughline.units import supported_digits


@pytest.mark.parametrize(
    ("value", "ends", "unit", "written"),
    [
        (4.839e9, (0.176e9, 137e9), "N/m", "5 GN/m (0.18 to 140 GN/m)"),
        (1.2e3, (68.0, 28e3), "N/m", "1.2 kN/m (0.068 to 28 kN/m)"),
        (1.2e3, (0.0, 28e3), "N/m", "1.2 kN/m (0 to 28 kN/m)"),
        (1.2e3, (100.0, 3.9e3), "N/m", "1.2 kN/m (0.1 to 3.9)"),
        (802.5e-15, None, "m", "below 1 pm"),
        (802.5e-15, (0.0, 3e-13), "m", "below 1 pm"),
        (802.5e-15, (1e-13, 3.1e-9), "m", "below 1 pm (up to 3.1 nm)"),
        (1.0, (0.99999, 1.0), "%", "100% (99.99 to 100%)"),
        (1.02, (1.01, 1.03), "%", "102% ± 0.98%"),
        (0.995, (0.994, 0.996), "%", "99.5% ± 0.1%"),
        (14.79e6, (7.52e6, 19.1e6), "N/m", "15 MN/m (7.5 to 19)"),
        (14.79e6, (13.8e6, 15.9e6), "N/m", "14.8 MN/m ± 7.5%"),
        (14.79e6, (14.788e6, 14.792e6), "N/m", "14.79 MN/m ± 0.014%"),
        (14.79e6, None, "N/m", "14.79 MN/m"),
        (9.88e14, (2.98e14, math.inf), "N/m", "1 PN/m (0.3 to infinite)"),
        (math.inf, (math.inf, math.inf), "N/m", "infinite"),
        (math.nan, (math.nan, math.nan), "N/m", "not solved"),
        (0.0, (0.0, 0.0), "N/m", "0 N/m"),
        (2.769e-2, (1.86e-2, 4.31e-2), "%", "2.8% (1.9 to 4.3%)"),
        (1.0, (0.92, 1.0), "%", "100% (92 to 100%)"),
        (0.9759, (0.896, 1.0), "1", "0.976 (0.896 to 1)"),
    ],
)
def test_digits_follow_the_interval_and_shares_have_their_sign(value, ends, unit, written):
    assert with_interval(value, ends, unit) == written
    assert "".join(value_and_interval(written)).replace(" ", "") == written.replace(" ", "")


def test_no_digit_is_written_that_the_interval_does_not_support():
    """Rounding moves a value by at most a sixth of the shorter side, until one digit is left."""
    rng = np.random.default_rng(3)
    for value, below, above in np.exp(rng.normal(0, 4, (300, 3))):
        ends = value / (1 + below), value * (1 + above)
        digits = supported_digits(value, ends)
        assert 1 <= digits <= 4
        shorter = min(value - ends[0], ends[1] - value)
        place = 10 ** (math.floor(math.log10(value)) - digits + 1)  # of the last digit
        if digits > 1:
            assert place <= shorter / 3 * (1 + 1e-9) or digits == 4
        if digits < 4:
            assert place > shorter / 30 * (1 - 1e-9)


@pytest.mark.parametrize(
    ("value", "ends", "unit", "written"),
    [
        (297e3, (150e3, 900e3), "N/m", "300 kN/m (150 to 900 kN/m)"),
        (2.0, None, "m", "2.00 m"),
        (802.5e-15, None, "m", "below 1 pm"),
        (0.123456, (0.1234, 0.1244), "%", "12.3% (12.3 to 12.4%)"),
        (0.0, (0.0, 0.01), "%", "0% (up to 1%)"),
        (1.5, (1.2, np.inf), "N", "1.5 N (1.2 to infinite)"),
    ],
)
def test_the_lab_writes_three_digits_at_most_and_both_ends(value, ends, unit, written):
    assert up_to_three_digits(value, ends, unit) == written


def test_a_key_figure_has_its_interval_with_the_whole_unit():
    figure = KeyFigure.of("conductance", "2.0 MW/(m² K) (0.74 to 4.8 MW/(m² K))")
    assert (figure.value, figure.interval) == ("2.0 MW/(m² K)", "0.74 to 4.8 MW/(m² K)")
    assert KeyFigure.of("stiffness", "14.8 MN/m ± 7.5%").interval == "± 7.5%"
