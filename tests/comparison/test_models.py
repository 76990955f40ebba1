"""Both models of one roughness, with the same waves."""

import numpy as np
import pytest

import roughline as rl
from roughline.statistics.verdict import Verdict


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


def test_the_roll_off_is_that_of_the_spectrum_in_any_unit():
    unit = rl.SelfAffine(hurst=0.5, rms_height=1.0, q_roll=8 * np.pi, q_high=16 * 2 * np.pi)
    tiny = rl.SelfAffine(
        hurst=0.5, length=1e-6, rms_height=1e-9, q_roll=8e6 * np.pi, q_high=16 * 2e6 * np.pi
    )
    found = rl.compare(tiny, n=32, surfaces=2, force_bars=[0.1])
    seeds = [np.random.SeedSequence(0, spawn_key=(i,)) for i in range(2)]
    full = [rl.press(unit.surface(32, s), E_star=1.0, forces=[0.1]).stiffness for s in seeds]
    assert found.full.mean == pytest.approx(np.mean(full, axis=0))


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


def test_one_surface_decides_little():
    """At H = 1 and F̄ = 0.01 a surface scatters by 0.28, which its interval must include."""
    surface = rl.SelfAffine(hurst=1.0, rms_height=1.0, q_high=16 * 2 * np.pi).surface(64, rng=1)
    found = rl.compare(surface, force_bars=[0.01])
    assert found.scatter[0] == pytest.approx(0.28, rel=0.2)
    assert np.log((1 + found.high[0]) / (1 + found.low[0])) > 2 * 1.96 * 0.22
    assert found.differences()[0].verdict() is Verdict.UNDECIDED
    assert found.trusted() is None
