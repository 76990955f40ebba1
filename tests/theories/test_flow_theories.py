"""Critical junction and effective medium: closed forms, limits, and the full model."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate, optimize
from scipy.special import erf, erfinv

import roughline as rl
from roughline.exact import flow as exact
from roughline.spectra.moments import bands, moments
from roughline.theories.interfacial_separation import separation

SPECTRUM = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_roll=4 * 2 * math.pi, q_high=64 * 2 * math.pi)
SLOPE = moments(SPECTRUM).rms_slope
THRESHOLDS = {"critical-junction": 0.42, "bruggeman": 0.5}
STEPS = 1e-3  # of a difference quotient over 2 % of the wavenumber, and of bands with other edges


@pytest.mark.parametrize("threshold", [0.3, 0.42, 0.5])
@pytest.mark.parametrize("contact", [0.0, 0.1, 0.25])
def test_one_gap_and_a_share_of_contact(threshold, contact):
    """1 - c d / (d - 1) of the open gap's permeance."""
    gap = np.where(np.arange(400) < 400 * contact, 0.0, 0.3).reshape(20, 20)
    found = rl.effective_medium(gap, threshold)
    assert found**3 == pytest.approx(exact.uniform(0.3) * (1 - contact / threshold), rel=1e-12)


def test_two_gaps_of_equal_shares_are_a_chessboard():
    gap = np.array([[0.2, 0.8], [0.8, 0.2]])
    assert rl.effective_medium(gap) ** 3 == pytest.approx(exact.self_dual(gap), rel=1e-12)


def test_logarithms_that_lie_alike_about_their_mean_give_the_geometric_mean():
    logs = np.random.default_rng(2).normal(0.0, 1.5, 500)
    gap = 0.7 * np.exp(np.concatenate([logs, -logs]))
    assert rl.effective_medium(gap) == pytest.approx(0.7, rel=1e-12)


@given(
    st.lists(st.just(0.0) | st.floats(1e-9, 1e3), min_size=1, max_size=30),
    st.floats(0.05, 0.95),
    st.floats(1e-12, 1e12),
    st.integers(0, 29),
)
def test_the_medium_lies_between_its_gaps(gaps, threshold, scale, which):
    """It has any unit, lies in Wiener's bounds, and closes where a gap does."""
    gap = np.array(gaps)
    found = rl.effective_medium(gap, threshold)
    assert rl.effective_medium(gap * scale, threshold) == pytest.approx(found * scale, rel=1e-9)
    assert found**3 <= np.mean(gap**3) * (1 + 1e-9)
    if (gap > 0).all():
        assert found**3 >= exact.in_series(gap) * (1 - 1e-9)
    narrower = gap.copy()
    narrower[which % gap.size] *= 0.5
    assert rl.effective_medium(narrower, threshold) <= found * (1 + 1e-9)


def test_a_medium_at_its_threshold_hangs_on_its_narrowest_gap():
    """Half of the interface is far wider, and c / sigma = sigma / c_1 + sigma / c_2 balances."""
    found = rl.effective_medium(np.array([15.0, 1e-9, 0.0, 1.0]), 0.5)
    harmonic = 1 / (1 / 15.0**3 + 1)
    assert found == pytest.approx((1e-27 * harmonic) ** (1 / 6), rel=1e-6)


def test_the_medium_seals_at_its_threshold():
    gap = np.ones(100)
    for contact, is_open in ((49, True), (50, False), (100, False)):
        gap[:contact] = 0.0
        assert (rl.effective_medium(gap) > 0) == is_open


@pytest.mark.parametrize("share", [0.1, 0.25, 0.42, 0.6])
def test_the_separation_is_the_fall_of_the_gaps_volume_with_the_contact(share):
    """u_1 = d(u A) / dA, with u of Persson's theory for the waves beyond the magnification."""
    p = 0.3 * share * SLOPE

    def area(q):
        seen = rl.SelfAffine(hurst=0.7, C_0=SPECTRUM.C_0, q_roll=SPECTRUM.q_roll, q_high=q)
        return rl.theory("persson", seen, 1.0, p).area_fraction[0]

    def volume(q):
        beyond = rl.SelfAffine(
            hurst=0.7, C_0=float(SPECTRUM.C_2d(q)), length=2 * math.pi / q, q_high=SPECTRUM.q_high
        )
        return area(q) * rl.theory("persson", beyond, 1.0, p / area(q)).mean_gap[0]

    q = optimize.brentq(lambda q: area(q) - share, SPECTRUM.q_roll * 1.05, SPECTRUM.q_high)
    expected = (volume(1.01 * q) - volume(0.99 * q)) / (area(1.01 * q) - area(0.99 * q))
    found = rl.theory("critical-junction", SPECTRUM, 1.0, p, threshold=share)
    assert found.hydraulic_aperture[0] == pytest.approx(expected, rel=STEPS)


@pytest.mark.parametrize("roughness", [SPECTRUM, SPECTRUM.surface(128, 3)])
@pytest.mark.parametrize("load", [1e-3, 0.05, 0.2])
def test_all_separations_make_up_the_mean_gap(roughness, load):
    p = load * SLOPE
    of_persson = rl.theory("persson", roughness, 1.0, p)
    farthest = float(erfinv(of_persson.area_fraction[0]))  # p / t, t of all waves

    def integrand(s):  # over t = s t of all waves, where A = erf(p / t)
        x = farthest / s
        u_1 = separation(bands(roughness), 1.0, p, np.array([float(erf(x))]))[0]
        return u_1 * 2 / math.sqrt(math.pi) * x / s * math.exp(-(x**2))

    # at smaller t the share has rounded to 1, and the waves that long are few
    volume = integrate.quad(integrand, farthest / 5, 1.0, limit=60, epsrel=1e-4)[0]
    assert volume == pytest.approx(of_persson.mean_gap[0], rel=0.02)


@pytest.mark.parametrize(("name", "threshold"), THRESHOLDS.items())
def test_apertures_fall_with_the_load_and_vanish_at_the_threshold(name, threshold):
    p = np.geomspace(1e-4, 2.0, 40) * SLOPE
    curve = rl.theory(name, SPECTRUM, 1.0, p)
    aperture, is_open = curve.hydraulic_aperture, curve.area_fraction < threshold
    assert 5 < is_open.sum() < 38
    assert (aperture[~is_open] == 0).all()
    assert (aperture[is_open] > 0).all()
    assert (np.diff(aperture[is_open]) < 0).all()
    higher = rl.theory(name, SPECTRUM, 1.0, p, threshold=0.6).hydraulic_aperture
    assert (higher[is_open] > aperture[is_open]).all()
    # A = erf(sqrt(2) p / slope): the pressure that seals, and a little less
    sealing = float(erfinv(threshold)) * SLOPE / math.sqrt(2)
    near = rl.theory(name, SPECTRUM, 1.0, sealing * np.array([0.9, 0.99, 0.999, 1.0 + 1e-9]))
    assert near.hydraulic_aperture[3] == 0
    assert near.hydraulic_aperture[2] < 0.1 * near.hydraulic_aperture[0]


@pytest.mark.parametrize("name", THRESHOLDS)
def test_the_apertures_under_light_loads_follow_the_mean_gap(name):
    """All else being far apart, the gap is that of two plates up to the waves' own heights."""
    curve = rl.theory(name, SPECTRUM, 1.0, 1e-9 * SLOPE)
    assert curve.hydraulic_aperture == pytest.approx(curve.mean_gap, rel=0.1)


def test_a_threshold_belongs_to_theories_of_flow_and_is_a_share():
    with pytest.raises(rl.InputError, match=r"threshold is 0\.4; theories of flow alone have one"):
        rl.theory("persson", SPECTRUM, 1.0, 1.0, threshold=0.4)
    for threshold in (0.0, 1.0, math.nan):
        with pytest.raises(rl.InputError, match="a share of contact between 0 and 1 is needed"):
            rl.theory("bruggeman", SPECTRUM, 1.0, 1.0, threshold=threshold)
        with pytest.raises(rl.InputError, match="a share of contact between 0 and 1 is needed"):
            rl.effective_medium([1.0], threshold)


@pytest.mark.parametrize(
    ("gap", "said"),
    [([], "at least one cell"), ([1.0, -1e-9], "0 or more"), ([1.0, math.nan], "0 or more")],
)
def test_senseless_gaps_get_one_line(gap, said):
    with pytest.raises(rl.InputError, match=said):
        rl.effective_medium(gap)


@pytest.mark.parametrize("n", [64, 128])
def test_theories_against_the_solved_flow(n):
    """The table of the handbook, of half its surfaces: the mean flow both ways."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=16 * math.pi, q_high=32 * math.pi)
    solved, theories, media = np.zeros((3, 2, 4))
    for seed in range(4):
        surface = spectrum.surface(n, seed)
        p = surface.rms_slope * np.array([0.01, 0.03, 0.06, 0.14])  # 2, 7, 13 and 28 % contact
        curve = rl.press(surface, E_star=1.0, forces=p, periodic=True, fields=True, rtol=1e-4)
        flows = [rl.flow(fields, surface.sizes, along="both") for fields in curve.fields]
        solved += [[flow.permeance for flow in both] for both in zip(*flows, strict=True)]
        theories += [
            rl.theory(name, surface, 1.0, p).hydraulic_aperture ** 3 for name in THRESHOLDS
        ]
        media += [
            [rl.effective_medium(flow.gap, threshold) ** 3 for flow, _ in flows]
            for threshold in THRESHOLDS.values()
        ]
    flow = np.cbrt(solved.mean(axis=0))
    of_junction, of_medium = np.cbrt(theories) / flow
    assert of_junction == pytest.approx([1.22, 1.33, 1.52, 2.6], rel=0.03)
    assert of_medium == pytest.approx([1.17, 1.27, 1.44, 2.6], rel=0.03)
    tighter, wider = np.cbrt(media) / flow
    assert tighter == pytest.approx([0.98, 0.97, 0.945, 0.89], rel=0.02)
    assert wider == pytest.approx([1.05, 1.085, 1.13, 1.47], rel=0.02)
