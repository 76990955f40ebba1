"""Both models of one roughness, and the map of their difference."""

from pathlib import Path

import numpy as np
import pytest
import xarray

import roughline as rl
from roughline.comparison.models import difference_of_one, scatter_of_surfaces
from roughline.comparison.trust import COLUMNS, Difference, from_rows
from roughline.statistics.verdict import Verdict, of_all, verdict

STUDY = Path(__file__).parents[2] / "studies" / "paper" / "data"


@pytest.fixture(scope="module")
def compared():
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=1.0, q_high=16 * 2 * np.pi)
    return rl.compare(spectrum, n=64, surfaces=6, force_bars=[0.01, 0.1, 1.0, 30.0])


def test_both_models_are_pressed_with_the_same_waves(compared):
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=1.0, q_high=16 * 2 * np.pi)
    forces = compared.force_bar
    seeds = [np.random.SeedSequence(0, spawn_key=(i,)) for i in range(6)]
    full = [rl.press(spectrum.surface(64, s), E_star=1.0, forces=forces).stiffness for s in seeds]
    assert compared.full.mean == pytest.approx(np.mean(full, axis=0))
    assert (compared.surfaces, compared.lines) == (6, 200)
    assert compared.difference == pytest.approx(compared.full.mean / compared.reduced.mean - 1)
    assert ((compared.low <= compared.difference) & (compared.difference <= compared.high)).all()
    # near saturation the models must differ as the punches do
    assert compared.difference[-1] == pytest.approx(0.1523, abs=0.02)
    assert compared.differences()[-1].verdict(0.1) is Verdict.REFUTED
    assert compared.trusted(1e-6) is None
    assert compared.trusted(0.9) == (0.1, 30.0) or compared.trusted(0.9) == (0.01, 30.0)


def test_scale_does_not_matter(compared):
    """Forces and stiffness are dimensionless: the same shape in other units is the same."""
    tiny = rl.SelfAffine(hurst=0.5, length=1e-6, rms_height=1e-9, q_high=16 * 2e6 * np.pi)
    other = rl.compare(tiny, n=64, surfaces=6, force_bars=[0.01, 0.1, 1.0, 30.0])
    assert other.difference == pytest.approx(compared.difference, rel=1e-6)


def test_a_surface_is_compared_with_lines_of_its_spectrum():
    spectrum = rl.SelfAffine(hurst=0.5, length=1e-3, rms_height=1e-6, q_high=16 * 2e3 * np.pi)
    surface = spectrum.surface(64, rng=4)
    found = rl.compare(surface, force_bars=[0.03, 0.3, 30.0])
    forces = np.array([0.03, 0.3, 30.0]) * surface.rms_height * surface.length
    curve = rl.press(surface, E_star=1.0, forces=forces)
    assert found.full.mean == pytest.approx(curve.stiffness / surface.length)
    assert (found.surfaces, found.lines) == (1, 200)
    assert found.difference[-1] == pytest.approx(0.1523, abs=0.02)
    assert all(np.isfinite(d.scatter) for d in found.differences())


def test_bad_input():
    spectrum = rl.SelfAffine(hurst=0.5, rms_height=1.0)
    with pytest.raises(rl.InputError, match="surfaces is 1; an interval needs at least 2"):
        rl.compare(spectrum, surfaces=1)
    with pytest.raises(rl.InputError, match="q_high|n is 2"):
        rl.compare(spectrum, n=2)
    with pytest.raises(rl.InputError):
        rl.compare(spectrum, n=16, surfaces=2, force_bars=[-1.0])


def test_verdicts():
    assert Difference(0.02, -0.03, 0.05, 0.1, True).verdict() is Verdict.CONFIRMED
    assert Difference(0.3, 0.2, 0.4, 0.1, True).verdict() is Verdict.REFUTED
    assert Difference(-0.3, -0.4, -0.2, 0.1, True).verdict(0.1) is Verdict.REFUTED
    assert Difference(0.08, 0.02, 0.14, 0.1, True).verdict() is Verdict.UNDECIDED
    assert verdict(np.nan, np.nan, 0, 1) is Verdict.UNDECIDED
    assert of_all([Verdict.CONFIRMED, Verdict.CONFIRMED]) is Verdict.CONFIRMED
    assert of_all([Verdict.CONFIRMED, Verdict.UNDECIDED]) is Verdict.UNDECIDED
    assert of_all([Verdict.UNDECIDED, Verdict.REFUTED]) is Verdict.REFUTED
    assert str(Difference(0.08, 0.02, 0.14, 0.1, False)) == (
        "+8% (+2% to +14%), at the limit of the grid"
    )


def test_the_interval_beside_one_surface_holds_its_scatter():
    """Each of 60 surfaces alone, against what all of them say of the two models."""
    surfaces, lines = (
        xarray.open_dataset(STUDY / f"{name}.nc", engine="h5netcdf").load()
        for name in ("surfaces", "matched")
    )
    half = 2  # loads, eight a decade: F̄ / 1.8
    shares = []
    for dimension in surfaces.fractal_dimension.values:
        full, reduced = (
            data.sel(fractal_dimension=dimension).stiffness.values for data in (surfaces, lines)
        )
        truth = (full.mean(axis=0) / reduced.mean(axis=0) - 1)[half:]
        at_half, reduced = reduced[:, :-half], reduced[:, half:]
        scatter = scatter_of_surfaces(reduced, at_half)
        ends = [difference_of_one(surface[half:], reduced, scatter)[1:] for surface in full]
        low, high = np.array(ends).transpose(1, 0, 2)
        shares.append(((low <= truth) & (truth <= high)).mean(axis=0))
    # 60 surfaces: 95 % less three standard errors is 87 %
    assert np.min(shares) > 0.86
    assert np.mean(shares) > 0.95


def test_one_surface_decides_little():
    """At H = 1 and F̄ = 0.01 a surface scatters by 0.28, which its interval must include."""
    surface = rl.SelfAffine(hurst=1.0, rms_height=1.0, q_high=16 * 2 * np.pi).surface(64, rng=1)
    found = rl.compare(surface, force_bars=[0.01])
    assert found.scatter[0] == pytest.approx(0.28, rel=0.2)
    assert np.log((1 + found.high[0]) / (1 + found.low[0])) > 2 * 1.96 * 0.22
    assert found.differences()[0].verdict() is Verdict.UNDECIDED
    assert found.trusted() is None


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
    trust = from_rows(rows)
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
