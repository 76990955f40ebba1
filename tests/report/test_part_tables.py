"""How far answers scatter between the maps of a part, in words."""

from types import SimpleNamespace

import numpy as np
import pytest

from roughline.report.answers import scatter_in_words


@pytest.mark.parametrize(
    ("factor", "count", "words"),
    [
        (1.123, 3, "12%"),
        (2.5, 2, "factor 2.5"),
        (1.0, 3, "none"),  # it was given, and did not come out
        (np.nan, 3, "-"),
        (1.123, 1, "-"),
    ],
)
def test_a_factor_is_written_in_per_cent_where_it_is_small(factor, count, words):
    answer = SimpleNamespace(scatter=np.array([factor]), count=np.array([count]))
    assert scatter_in_words(answer, 0) == words
