"""How a window smears the spectrum of a map: the file kept for square maps is what is computed."""

from dataclasses import asdict

import numpy as np
import pytest

from roughline.spectra.leakage import (
    compute_map_leakage,
    compute_power_inside,
    map_leakage,
    power_inside,
)


def test_what_is_kept_for_square_maps_is_what_is_computed():
    kept = [*asdict(map_leakage(1.0)).values(), *power_inside(1.0)]
    computed = [*asdict(compute_map_leakage(1.0)).values(), *compute_power_inside(1.0)]
    for before, now in zip(kept, computed, strict=True):
        assert before == pytest.approx(now, rel=1e-12, abs=1e-13)


def test_maps_that_are_nearly_square_are_smeared_as_square_ones():
    distances, share = power_inside(1.0)
    others, nearly = power_inside(1.0 + 1e-9)
    assert np.interp(distances, others, nearly) == pytest.approx(share, abs=1e-3)
    kept, computed = map_leakage(1.0), map_leakage(1.0 + 1e-9)
    count = min(kept.waves.size, computed.waves.size)
    assert computed.response[:, :count].sum(axis=1) == pytest.approx(
        kept.response[:, :count].sum(axis=1), rel=1e-3
    )
