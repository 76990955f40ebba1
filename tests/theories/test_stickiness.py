"""Criteria of stickiness: the energies they compare, their laws, and what they refuse."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy import integrate

import roughline as rl

BANDS = 1e-5  # waves that differ by less than a two-hundredth of a decade are summed as one
SPECTRUM = rl.SelfAffine(hurst=0.7, rms_height=0.01, q_roll=8 * math.pi, q_high=48 * math.pi)
GIVEN = {"E_star": 2.0, "work_of_adhesion": 3e-4, "range": 1e-4}


def numbers(found):
    return np.array([criterion.number for criterion in found.criteria])


def derivatives(surface):
    """Gradient and Laplacian of a periodic surface, by its Fourier sum."""
    modes = np.fft.fft2(surface.heights)
    qx, qy = (
        2 * np.pi * np.fft.fftfreq(n, spacing)
        for n, spacing in zip(surface.shape, surface.spacing, strict=True)
    )
    qx = qx[:, np.newaxis]
    return tuple(
        np.fft.ifft2(factor * modes).real for factor in (1j * qx, 1j * qy, -(qx**2) - qy**2)
    )


def test_every_number_by_direct_sums_over_a_surface():
    surface = SPECTRUM.surface(128, 7)
    found = rl.stickiness(surface, **GIVEN)
    E_star, w, r = GIVEN.values()
    modes = np.fft.fft2(surface.heights) / surface.heights.size
    q = 2 * np.pi * np.fft.fftfreq(128, surface.spacing[0])
    energy = E_star / 4 * (np.hypot(q[:, np.newaxis], q) * np.abs(modes) ** 2).sum()
    assert found.conformal_energy == pytest.approx(energy, rel=BANDS)
    along_x, along_y, laplacian = derivatives(surface)
    slope = math.sqrt((along_x**2 + along_y**2).mean())
    curvature = math.sqrt((laplacian**2).mean()) / 2
    at_edges = slope * E_star * r / (2 * w) * (slope**2 / (curvature * r)) ** (2 / 3)
    persson_tosatti, pastewka_robbins, dalvi = numbers(found)
    assert persson_tosatti == pytest.approx(energy / w, rel=BANDS)
    assert pastewka_robbins == pytest.approx(at_edges, rel=BANDS)
    assert dalvi == pytest.approx(energy / (w * found.roughened_area), rel=BANDS)
    apparent = w * found.roughened_area - energy
    assert found.apparent_work_of_adhesion == pytest.approx(apparent, abs=BANDS * energy)


def test_the_energy_of_a_wave_is_exact():
    """U_el / A_0 = E* q Delta² / 8, half the mean of pressure and displacement."""
    x = np.arange(64) / 64
    heights = 0.01 * np.cos(4 * np.pi * x)[:, np.newaxis] + np.zeros(64)
    wave = rl.Surface(heights, sizes=(1.0, 1.0), is_cut_out=False)
    found = rl.stickiness(wave, **GIVEN)
    assert found.conformal_energy == pytest.approx(2.0 * 4 * np.pi * 1e-4 / 8, rel=1e-12)


def test_the_energy_is_that_of_the_full_model_in_full_contact():
    surface = SPECTRUM.surface(64, 3)
    found = rl.stickiness(surface, **GIVEN)
    force = 10 * GIVEN["E_star"] * surface.rms_slope
    curve = rl.press(surface, E_star=2.0, forces=[force], periodic=True, fields=True)
    assert curve.area_fraction[0] == 1
    fields = curve.fields[0]
    pressure = fields.pressure - fields.pressure.mean()
    energy = (pressure * (surface.heights - surface.heights.mean())).mean() / 2
    assert found.conformal_energy == pytest.approx(energy, rel=BANDS)


def test_the_energy_of_a_continuum_by_quadrature():
    continuum = rl.SelfAffine(hurst=0.4, C_0=1e-8, q_roll=30.0, q_high=3000.0).continuum
    found = rl.stickiness(continuum, **GIVEN)

    def share(log_q):
        return math.exp(3 * log_q) * float(continuum.C_2d(math.exp(log_q)))

    logs = np.log([continuum.band.q_low, 30.0, 3000.0])
    pieces = [integrate.quad(share, a, b)[0] for a, b in pairwise(logs)]
    assert found.conformal_energy == pytest.approx(2.0 / 4 * 2 * math.pi * sum(pieces), rel=1e-4)


@pytest.mark.parametrize("rms_slope", [0.1, 0.5, 1.5])
def test_the_roughened_area_is_that_of_gaussian_surfaces(rms_slope):
    spectrum = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_roll=16 * math.pi, q_high=64 * math.pi)
    surface = spectrum.surface(256, 5)
    along_x, along_y, _ = derivatives(surface)
    surface = surface.scaled(rms_slope / math.sqrt((along_x**2 + along_y**2).mean()))
    along_x, along_y, _ = derivatives(surface)
    true = np.sqrt(1 + along_x**2 + along_y**2).mean()
    found = rl.stickiness(surface, **GIVEN).roughened_area
    assert found - 1 == pytest.approx(true - 1, rel=0.02)


def test_spectra_of_a_surface_and_of_its_lattice_say_what_it_says():
    surface = SPECTRUM.surface(128, 7)
    of_lattice = numbers(rl.stickiness(SPECTRUM.lattice(128), **GIVEN))
    assert numbers(rl.stickiness(surface, **GIVEN)) == pytest.approx(of_lattice, rel=1e-9)
    of_rings = numbers(rl.stickiness(rl.isotropic_spectrum(surface), **GIVEN))
    assert of_rings == pytest.approx(of_lattice, rel=0.05)


@pytest.mark.parametrize("hurst", [0.2, 0.6, 0.9])
def test_how_finer_waves_change_the_numbers(hurst):
    """U_el goes as q_high^(1 - 2 H) for H < 1/2, Pastewka and Robbins' as q_high^(1 - 5 H / 3)."""
    ends = [
        numbers(rl.stickiness(spectrum.continuum, **GIVEN))
        for spectrum in (
            rl.SelfAffine(hurst=hurst, C_0=1e-12, q_roll=2 * math.pi, q_high=q_high)
            for q_high in (1e7, 1e8)
        )
    ]
    energies, at_edges, _ = np.log10(ends[1] / ends[0])
    assert at_edges == pytest.approx(1 - 5 * hurst / 3, abs=0.05)
    assert energies == pytest.approx(max(1 - 2 * hurst, 0.0), abs=0.05)


def test_units_are_neutral():
    length, pressure = 1e-6, 1e9
    surface = SPECTRUM.surface(64, 3)
    other = rl.Surface(
        surface.heights * length, sizes=(length, length), is_cut_out=surface.is_cut_out
    )
    E_star, w, r = GIVEN.values()
    scaled = rl.stickiness(other, E_star * pressure, w * pressure * length, r * length)
    found = rl.stickiness(surface, **GIVEN)
    assert numbers(scaled) == pytest.approx(numbers(found), rel=1e-9)
    energy = found.conformal_energy * pressure * length
    assert scaled.conformal_energy == pytest.approx(energy, rel=1e-9)


def test_bodies_stick_less_the_stiffer_they_are_and_more_the_more_they_pull():
    surface = SPECTRUM.surface(64, 3)
    E_star, w, r = GIVEN.values()
    found = numbers(rl.stickiness(surface, E_star, w, r))
    assert numbers(rl.stickiness(surface, 3 * E_star, w, r)) == pytest.approx(3 * found)
    assert numbers(rl.stickiness(surface, E_star, 3 * w, r)) == pytest.approx(found / 3)
    longer = numbers(rl.stickiness(surface, E_star, w, 8 * r))
    assert longer == pytest.approx(found * [1, 2, 1])
    assert (numbers(rl.stickiness(surface.scaled(2), E_star, w, r)) > found).all()


def test_a_criterion_says_sticky_below_one_and_where_it_holds():
    surface = SPECTRUM.surface(64, 3)
    energy = rl.stickiness(surface, **GIVEN).conformal_energy
    for factor, sticks in ((1.001, True), (0.999, False)):
        found = rl.stickiness(surface, E_star=2.0, work_of_adhesion=factor * energy, range=1e-4)
        assert found.criteria[0].sticky is sticks
        assert found.criteria[2].sticky is (found.apparent_work_of_adhesion > 0)
    assert [criterion.name for criterion in found.criteria] == [
        "Persson and Tosatti",
        "Pastewka and Robbins",
        "Dalvi and others",
    ]
    assert all("(20" in criterion.source for criterion in found.criteria)
    curvature = math.sqrt((derivatives(surface)[2] ** 2).mean()) / 2
    slope = math.sqrt(sum(each**2 for each in derivatives(surface)[:2]).mean())
    g = 16 * slope**2 / (3 * curvature)
    assert f"here the range is {1e-4 / g:.2g} g" in found.criteria[1].validity
    long_waves = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_high=300.0)
    for criterion in rl.stickiness(long_waves, **GIVEN).criteria:
        assert "of the continuum" in criterion.validity


def test_bad_questions_get_one_line():
    surface = SPECTRUM.surface(64, 3)
    for name in GIVEN:
        for wrong in (0.0, -1.0, math.nan, math.inf):
            with pytest.raises(rl.InputError, match=f"{name} is .*a positive, finite"):
                rl.stickiness(surface, **{**GIVEN, name: wrong})
    with pytest.raises(rl.InputError, match="a Surface or a spectrum is needed"):
        rl.stickiness(surface.heights, **GIVEN)
    with pytest.raises(rl.InputError, match="has no upper end"):
        rl.stickiness(rl.SelfAffine(hurst=0.8, rms_height=1.0), **GIVEN)
    with pytest.raises(rl.InputError, match="the heights are constant"):
        rl.stickiness(rl.Surface(np.zeros((16, 16)), sizes=(1.0, 1.0)), **GIVEN)
