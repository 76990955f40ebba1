"""Persson's theory on layers: its limits, a plain double integral, and the full model."""

import math

import numpy as np
import pytest
from scipy import integrate

import roughline as rl
from roughline.exact.layers import BondedLayer
from roughline.spectra.moments import bands
from roughline.theories.layers import HOLDS_UP_TO, effective_roughness, stiffening
from theories.test_theories import IN_OTHER_UNITS, SPECTRUM

SLOPE = SPECTRUM.lattice(256).rms_slope
LOADS = np.geomspace(1e-3, 1.0, 12) * SLOPE
NAMES = ("persson", "critical-junction", "bruggeman")
QUANTITIES = ("area_fraction", "stiffness", "mean_gap", "hydraulic_aperture")


def on(half_space, name="persson", roughness=SPECTRUM, pressure=LOADS):
    return rl.theory(name, roughness, pressure=pressure, half_space=half_space)


def alike(one, other, rtol):
    for name in QUANTITIES:
        first, second = getattr(one, name), getattr(other, name)
        assert (first is None) == (second is None)
        if first is not None:
            np.testing.assert_allclose(first, second, rtol=rtol, atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_a_homogeneous_half_space_and_equal_layers_are_the_contact_modulus(name):
    plain = rl.theory(name, SPECTRUM, 2.0, LOADS)
    same = on(rl.Homogeneous(2.0), name)
    assert same.validity == plain.validity
    alike(same, plain, 0)
    equal = rl.Layered(1.5, 0.5, 0.01, 1.5, 0.5)
    alike(on(equal, name), plain, 1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_a_thick_layer_is_its_material_and_a_thin_one_its_base(name):
    layer, base = rl.Homogeneous(1 / (1 - 0.3**2)), rl.Homogeneous(5 / (1 - 0.2**2))
    alike(on(rl.Layered(1.0, 0.3, 100.0, 5.0, 0.2), name), on(layer, name), 1e-9)
    for quantity in ("area_fraction", "mean_gap", "hydraulic_aperture"):
        # gaps vanish near full contact, and what is left of them is not compared
        light = LOADS if quantity == "area_fraction" else LOADS[:6]
        if (wanted := getattr(on(base, name, pressure=light), quantity)) is None:
            continue
        off = []
        for thickness in (2e-7, 1e-7):
            thin = on(rl.Layered(1.0, 0.3, thickness, 5.0, 0.2), name, pressure=light)
            off.append(float(np.abs(getattr(thin, quantity) / wanted - 1).max()))
        assert off[1] < 1e-3
        assert off[0] / off[1] == pytest.approx(2, rel=0.01)


def test_units_are_neutral():
    one = on(rl.Layered(1.0, 0.3, 0.05, 10.0, 0.3))
    layers = rl.Layered(1e9, 0.3, 5e4, 1e10, 0.3)
    other = on(layers, roughness=IN_OTHER_UNITS, pressure=LOADS * 1e9)
    np.testing.assert_allclose(other.area_fraction, one.area_fraction, rtol=1e-9)
    np.testing.assert_allclose(other.stiffness, one.stiffness * 1e3, rtol=1e-9)
    np.testing.assert_allclose(other.mean_gap, one.mean_gap * 1e6, rtol=1e-9)


def test_area_and_gap_against_plain_integrals_over_the_pressures_of_full_contact():
    """The definitions, with the closed form of one layer: variance of the pressure, and energy."""
    young, poisson, h, base = 1.0, 0.35, 0.02, 8.0
    layer = BondedLayer(young, poisson, h, base, 0.3)
    p = 0.1 * SLOPE
    q0, qr, q1 = SPECTRUM.q_low, SPECTRUM.q_roll, SPECTRUM.q_high

    def power(q):  # of waves of a unit of q
        return 2 * math.pi * q * float(SPECTRUM.C_2d(np.array([q]))[0])

    def compliance(q):
        return float(layer.compliance(np.array([q]))[0])

    def variance(q):
        ends = [(q0, min(q, qr)), (qr, q)] if q > qr else [(q0, q)]
        return sum(
            integrate.quad(lambda k: power(k) / compliance(k) ** 2, *each, limit=200)[0]
            for each in ends
        )

    found = on(rl.Layered(young, poisson, h, base, 0.3), pressure=[p])
    area = math.erf(p / math.sqrt(2 * variance(q1)))
    assert found.area_fraction[0] == pytest.approx(area, rel=1e-4)

    def inner(spread):  # energy that the pressure s releases, as Yang and Persson share it
        def integrand(s):
            x = s / spread
            return (0.45 + 3 * 0.55 * math.erf(x) ** 2) * math.exp(-(x**2)) / s

        return integrate.quad(integrand, p, max(8 * spread, 2 * p), limit=200)[0]

    def outer(q):
        spread = math.sqrt(2 * variance(q))
        return power(q) / compliance(q) / (spread * math.sqrt(math.pi)) * inner(spread)

    gap = sum(
        integrate.quad(outer, a, b, limit=100, epsrel=1e-4)[0]
        for a, b in ((q0 * (1 + 1e-6), qr), (qr, q1))
    )
    assert found.mean_gap[0] == pytest.approx(gap, rel=5e-3)


def test_stiffness_is_the_slope_of_the_gap():
    p = np.geomspace(1e-3, 0.5, 400) * SLOPE
    curve = on(rl.Layered(1.0, 0.49, 0.02, 100.0, 0.3), pressure=p)
    slope = -np.gradient(p, curve.mean_gap)
    assert curve.stiffness[5:-5] == pytest.approx(slope[5:-5], rel=2e-3)


def test_spheres_on_summits_have_no_layers_and_senseless_half_spaces_get_one_line():
    layers = rl.Layered(1.0, 0.3, 0.02, 10.0, 0.3)
    for name in ("greenwood-williamson", "bush-gibson-thomas"):
        with pytest.raises(
            rl.InputError, match=f"half_space has layers, and the summits of {name}"
        ):
            on(layers, name, pressure=[1e-4 * SLOPE])
        one = on(rl.Homogeneous(2.0), name, pressure=[1e-4 * SLOPE])
        alike(one, rl.theory(name, SPECTRUM, 2.0, [1e-4 * SLOPE]), 0)
    with pytest.raises(rl.InputError, match="half_space and E_star are given"):
        rl.theory("persson", SPECTRUM, 1.0, LOADS, half_space=layers)
    with pytest.raises(rl.InputError, match="an rl.HalfSpace is needed"):
        rl.theory("persson", SPECTRUM, pressure=LOADS, half_space=2.0)
    with pytest.raises(rl.InputError, match="theory needs pressure="):
        rl.theory("persson", SPECTRUM, half_space=layers)
    with pytest.raises(rl.InputError, match="E_star is None"):
        rl.theory("persson", SPECTRUM, pressure=LOADS)


def test_validity_says_how_stiffly_waves_are_met():
    spectrum = bands(SPECTRUM)
    stiff, soft = rl.Layered(1.0, 0.3, 0.005, 1e3), rl.Layered(1.0, 0.3, 0.05, 0.01)
    ratio = stiffening(spectrum, stiff)
    assert ratio > HOLDS_UP_TO
    assert f"met {ratio:.2g} times as stiffly" in on(stiff).validity
    assert "above 1.1, area was found to be down to 0.25 times" in on(stiff).validity
    assert stiffening(spectrum, soft) < 1
    assert "0.65 to 1.2 times, stiffness 0.75 to 1.25 times" in on(soft).validity


CASES = [  # young of the layer is 1
    *((base, 0.3, share) for base in (0.1, 0.01) for share in (0.3, 1.0, 3.0)),
    *((base, 0.3, 4.0) for base in (10.0, 100.0, math.inf)),
]
"""Modulus of the base, Poisson's ratio, and thickness times the roll-off's wavenumber."""


@pytest.mark.parametrize(("base", "poisson", "share"), CASES)
def test_persson_against_the_full_model_where_it_holds(base, poisson, share):
    """From 3 to 65 % contact, as accurate as of homogeneous bodies; those give 0.76 to 0.91."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-3, q_roll=math.tau * 8, q_high=math.tau * 32)
    surface = spectrum.surface(128, 3)
    layers = rl.Layered(1.0, poisson, share / spectrum.q_roll, base, 0.3, periodic=True)
    own = bands(surface)
    assert stiffening(own, layers) < HOLDS_UP_TO
    waves = effective_roughness(own, layers)
    steepness = math.sqrt(float(waves.q**2 @ waves.power)) * layers.E_star
    p = steepness * np.array([0.02, 0.05, 0.1, 0.2, 0.4])
    curve = rl.press(surface, half_space=layers, forces=p, rtol=1e-4)
    of_persson = on(layers, roughness=surface, pressure=p)
    k = curve.stiffness
    if math.isinf(base):  # the theory is of the interface alone
        k = 1 / (1 / k - float(layers.spectrum(np.zeros(1))[0]))
    area = of_persson.area_fraction / curve.area_fraction_corrected
    assert ((area > 0.65) & (area < 1.2)).all()
    ratio = of_persson.stiffness / k
    assert ((ratio > 0.75) & (ratio < 1.25)).all()


@pytest.mark.parametrize(
    ("n", "base", "share", "tolerance"),
    [
        (64, 10.0, 3.0, 0.08),
        *((128, 0.1, 0.3, 0.08), (128, 0.01, 0.3, 0.08), (128, 0.1, 3.0, 0.08)),
        *((128, 10.0, 3.0, 0.08), (128, 0.01, 1.0, 0.18)),
    ],
)
def test_theories_of_flow_on_layers_are_off_as_on_one_material(n, base, share, tolerance):
    """Their apertures over that of the solved flow, up to 13 % contact, and the mean gap.

    They are least alike where a hard layer is about as thick as the longest waves.
    """
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=math.tau * 8, q_high=math.tau * 16)
    layers = rl.Layered(1.0, 0.3, share / spectrum.q_roll, base, 0.3, periodic=True)
    names = {"critical-junction": [1.221, 1.335, 1.522], "bruggeman": [1.171, 1.271, 1.442]}
    solved, theories, gaps = np.zeros(3), np.zeros((2, 3)), np.zeros((2, 3))
    for seed in range(4):
        surface = spectrum.surface(n, seed)
        waves = effective_roughness(bands(surface), layers)
        steepness = math.sqrt(float(waves.q**2 @ waves.power)) * layers.E_star
        p = steepness * np.array([0.01, 0.03, 0.06])
        curve = rl.press(surface, half_space=layers, forces=p, fields=True, rtol=1e-4)
        flows = [rl.flow(fields, surface.sizes, along="both") for fields in curve.fields]
        solved += [sum(flow.permeance for flow in both) / 2 for both in flows]
        found = [on(layers, name, surface, p) for name in names]
        theories += [curve.hydraulic_aperture**3 for curve in found]
        gaps += found[0].mean_gap, [fields.gap.mean() for fields in curve.fields]
    assert gaps[0] == pytest.approx(gaps[1], rel=0.15)
    for ratio, of_one_material in zip(np.cbrt(theories / solved), names.values(), strict=True):
        assert ratio == pytest.approx(of_one_material, rel=tolerance)
