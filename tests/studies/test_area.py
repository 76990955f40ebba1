"""The study of the area: the page is that of the data, and known laws come back."""

import math

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_curves import PRESSURES, areas, pressure_of
from studies.area.claims import MIDDLE, common_law, main_samples, over_law
from studies.area.measure import (
    AREAS,
    BANDS,
    HURSTS,
    REDUCED,
    exponent,
    grid_shift,
    kappa,
    kappa_in_cells,
    line_over_nayak,
    log_kappa,
    sample,
    size_shift,
)
from studies.area.rings import POINTS, area_of, rings, rings_surface
from studies.area.study import STUDY
from studies.study import DOCS

AGAIN = "the page is not that of the data any more: run make published"


@pytest.mark.parametrize("count", [20, 100])
@pytest.mark.parametrize("level", [0.01, 0.05, 0.15])
def test_a_known_kappa_comes_back_within_its_interval(count, level):
    """At light and heavy loads."""
    pressure, table = pressure_of(level), areas(count, np.random.default_rng(3))
    found = log_kappa(table, PRESSURES, level).interval_estimate().exp()
    assert found.low < level / pressure < found.high
    # two standard errors of the areas to both sides; more of few, which may be skew
    errors = (table / table.mean(axis=0)).std(axis=0, ddof=1) / math.sqrt(count)
    error = np.interp(math.log(pressure), np.log(PRESSURES), errors)
    assert 0.9 < math.log(found.high / found.low) / (4 * error) < 1.4


def test_half_of_the_surfaces_widen_an_interval_by_the_square_root_of_two():
    ratios = []
    for one in main_samples():
        whole, half = (kappa(each, MIDDLE) for each in (one, one.first(one.count // 2)))
        ratios.append((half.high - half.low) / (whole.high - whole.low))
    assert np.mean(ratios) == pytest.approx(math.sqrt(2), rel=0.1)


def test_surfaces_of_two_rings_are_what_the_library_gives():
    one = rings()[0]
    surface, nayak = rings_surface(one.long_waves, 3)
    assert one.nayak == pytest.approx(nayak)
    assert one.area[3] == pytest.approx(area_of(surface), rel=1e-5)
    slope = math.sqrt(np.mean(np.square(np.gradient(surface.heights * POINTS)).sum(axis=0)))
    assert slope == pytest.approx(1, rel=0.06)  # by central differences, of eight cells a wave


def test_the_law_of_self_affine_spectra_is_off_for_those_of_two_rings():
    """By more than it is off for any of its own, so that it is told with them."""
    own = common_law(MIDDLE).deviation
    found = [over_law(one) for one in rings()]
    assert all(2 * own < each.low for each in found)
    lowest, highest = (f(each.value for each in found) for f in (min, max))
    answer = STUDY.page.split("\n\n")[1]
    assert f"lie {lowest:.1%} to {highest:.1%} above this line" in answer
    assert "Among self-affine spectra" in answer


def test_the_page_is_that_of_the_data():
    assert (DOCS / "area.md").read_text("utf-8") == STUDY.page, AGAIN


def test_no_load_is_left_out():
    unsolved, loads = REDUCED.unsolved_loads()
    assert unsolved == 0
    assert loads == sum(each.cases * len(each.force_bars) for each in REDUCED.plan.ensembles)


def test_a_surface_of_the_data_is_what_the_library_gives():
    """The cheapest spectrum: 128 x 128 points, to single precision."""
    ensemble = REDUCED.plan.ensemble("main-4-2.5")
    surface = ensemble.spectrum(2.5).surface(ensemble.n, ensemble.body_seed(7))
    curve = rl.press(surface, E_star=1.0, forces=ensemble.force_bars, periodic=True)
    one = sample("main", 4, 0.5)
    # certified to 1e-6 on every machine: single cells may be in contact or not
    assert one.area[7] == pytest.approx(curve.area_fraction_corrected, rel=2e-3)
    assert one.cells[7] == pytest.approx(curve.area_fraction, rel=2e-3)


def test_nayak_and_slope_are_those_of_the_surfaces():
    """Moments of the spectrum on its lattice, against the waves of a generated surface."""
    for band, hurst in ((4, 0.2), (16, 0.8)):
        ensemble = REDUCED.plan.ensemble(f"main-{band}-{3 - hurst:g}")
        surface = ensemble.spectrum(3 - hurst).surface(ensemble.n, ensemble.body_seed(0))
        n = ensemble.n
        power = np.abs(np.fft.fft2(surface.heights - surface.heights.mean()) / n**2) ** 2
        q = 2 * math.pi * np.fft.fftfreq(n, 1 / n)
        q_x, q_y = q[:, np.newaxis], q[np.newaxis, :]
        m_0, m_2, m_4 = ((q_x**order * power).sum() for order in (0, 2, 4))
        along_y = (q_y**2 * power).sum(), (q_y**4 * power).sum()
        m_2, m_4 = (m_2 + along_y[0]) / 2, (m_4 + along_y[1]) / 2
        one = sample("main", band, hurst)
        assert one.nayak == pytest.approx(m_0 * m_4 / m_2**2, rel=0.02)
        slope = ensemble.force_bars[0] / one.pressure[0]
        assert slope == pytest.approx(math.sqrt(2 * m_2), rel=1e-6)


def test_the_common_line_is_that_of_least_squares_and_its_interval_that_of_the_surfaces():
    samples = main_samples()
    x = np.log10([one.nayak for one in samples]) - 1
    found = [kappa(one, MIDDLE) for one in samples]
    slope, at_ten = np.polyfit(x, [each.value for each in found], 1)
    line = line_over_nayak(samples, MIDDLE)
    assert [line[0].value, line[1].value] == pytest.approx([at_ten, slope], rel=1e-9)
    # independent errors of the fifteen means, carried through the weights of the line
    weights = np.linalg.pinv(np.stack([np.ones_like(x), x], axis=1))
    widths = np.array([each.high - each.low for each in found])
    for each, weight in zip(line, weights, strict=True):
        assert each.high - each.low == pytest.approx(np.hypot.reduce(weight * widths), rel=0.15)


def test_sentences_without_numbers_are_true_too():
    # "less under heavier loads"
    for one in main_samples():
        levels = [level for level in AREAS if one.area.mean(axis=0)[0] < level]
        assert (np.diff([kappa(one, level).value for level in levels]) < 0).all()
        assert exponent(one, (0.005, 0.15)).value < 1
        # the area in cells is larger, the more so the longer its outline
        assert kappa_in_cells(one, MIDDLE) > kappa(one, MIDDLE).value
    for hurst in HURSTS:
        # finer grids raise kappa, by less than a per cent
        for band in (4, 8, 16):
            assert 0 < grid_shift(band, hurst, MIDDLE).value < 0.01
        # larger surfaces have the same kappa
        for band in (4, 16):
            found = size_shift(band, hurst, MIDDLE)
            assert found.low < 0 < found.high
        # kappa falls from each band to the next
        kappas = [kappa(sample("main", band, hurst), MIDDLE).value for band in BANDS]
        assert (np.diff(kappas) < 0).all()
