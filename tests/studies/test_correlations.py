"""The page on the handbooks' correlations: it is that of the data, and the data are the plan's."""

import math
from statistics import NormalDist

import numpy as np
import pytest

from roughline.engineering import formulas
from roughline.statistics.averages import average
from roughline.statistics.verdict import Verdict
from studies.correlations.claims import at_all_pressures, judge
from studies.correlations.measure import (
    BANDS,
    DIMENSIONS,
    ELASTIC,
    FULL,
    HARDNESSES,
    data,
    holm,
    mikic,
    plan,
    sample,
    yovanovich,
)
from studies.correlations.ratios import (
    ELASTIC_BANDS,
    MIDDLE,
    change_with_band,
    common_law,
    extremes,
    heights,
    over_holm,
    over_root_sum,
)
from studies.correlations.study import BETWEEN, STUDY
from studies.judged import Found, growth_to_decide
from studies.study import DOCS

AGAIN = "the page is not that of the data any more: run make published"
NEEDED = ("rms_slope", "area_fraction", "stiffness", "unloading_stiffness")


@pytest.fixture(scope="module")
def main_samples():
    return [
        sample("main", hardness, dimension)
        for hardness in (ELASTIC, *HARDNESSES)
        for dimension in DIMENSIONS
    ]


def test_the_page_is_that_of_the_data():
    assert (DOCS / "correlations.md").read_text("utf-8") == STUDY.page, AGAIN


def test_the_data_are_those_of_the_plan():
    names = {name.split("/")[0] for name in data() if "/" in name}
    assert names == {ensemble.name for ensemble in plan().ensembles} | {"heights"}
    for ensemble in plan().ensembles:
        shape = (len(ensemble.fractal_dimensions), ensemble.realisations)
        assert data()[f"{ensemble.name}/rms_slope"].shape == shape
        loads = data()[f"{ensemble.name}/stiffness"]
        assert loads.shape == (*shape, len(ensemble.force_bars))


def test_a_body_of_the_data_is_what_the_library_gives():
    """The cheapest of them: 128 x 128 points, at the hardness, to single precision."""
    import roughline as rl

    ensemble = plan().ensemble("band2-hardness0.01")
    surface = ensemble.spectrum(2.5).surface(ensemble.n, ensemble.body_seed(7))
    curve = rl.press(
        surface,
        E_star=1.0,
        forces=ensemble.force_bars,
        hardness=FULL * surface.rms_slope,
        periodic=True,
    )
    kept = data()["band2-hardness0.01/unloading_stiffness"][1, 7]
    # certified to 1e-6 on every machine; the stiffness follows from the contact set
    assert kept == pytest.approx(curve.unloading_stiffness, rel=1e-4)


def test_correlations_are_those_of_the_engineering_answers():
    """In SI units, of a joint with its own height, slope and conductivities."""
    height, slope, modulus, hardness, kappa = 1e-6, 0.1, 1e11, 2e9, (100.0, 300.0)
    m = slope / math.sqrt(math.pi)
    scale = formulas.harmonic_conductivity(kappa) * m / height
    pressure = np.array([1e6, 1e7])
    elastic = formulas.mikic_conductance(pressure, modulus, height, slope, kappa)
    assert mikic(pressure / (modulus * slope)) * scale == pytest.approx(elastic)
    plastic = formulas.yovanovich_conductance(pressure, hardness, height, slope, kappa)
    assert yovanovich(pressure / hardness) * scale == pytest.approx(plastic)
    # one spot of radius a on A_0 = 1 conducts 2 a kappa_s
    radius = np.sqrt(pressure / hardness / math.pi)
    assert holm(pressure / hardness, slope) * m == pytest.approx(2 * radius)


def test_laws_of_the_model_hold_in_the_data(main_samples):
    """No point bears more than H, unloading is no less stiff than loading, softer yields more."""
    for ensemble in plan().ensembles:
        if ensemble.hardness_bar is None:
            continue
        of = {name: data()[f"{ensemble.name}/{name}"].astype(float) for name in NEEDED}
        hardness = ensemble.hardness_bar * of["rms_slope"][..., np.newaxis]
        over = of["area_fraction"] * hardness / np.array(ensemble.force_bars)
        solved = np.isfinite(over)
        assert (over[solved] > 1 - 1e-6).all()
        assert (of["unloading_stiffness"] >= of["stiffness"] * (1 - 1e-6))[solved].all()
    plastic = [
        [average(one.plastic).mean for one in main_samples if one.fractal_dimension == dimension]
        for dimension in DIMENSIONS
    ]
    assert (np.diff(plastic, axis=1) >= 0).all()


def test_sentences_without_numbers_are_true_too(main_samples):
    elastic_band = change_with_band(ELASTIC, MIDDLE, min(BANDS), max(ELASTIC_BANDS))
    plastic_band = change_with_band(FULL, MIDDLE, min(BANDS), max(BANDS))
    # "elastic conductance hardly depends on short waves", "that of the surface grows less"
    assert -0.15 < elastic_band.low < elastic_band.high < 0.15
    assert plastic_band.high < -0.15
    # "conductance rises faster at the highest pressures"
    for one in main_samples[: len(DIMENSIONS)]:
        mean = average(one.ratio).mean
        assert mean[-1] > mean[-3]
    # "in its own limit each overestimates the conductance, between them both underestimate it"
    for hardness in (ELASTIC, FULL):
        assert extremes(lambda each: each.ratio, (hardness,))[1] < 1
    assert extremes(lambda each: each.over_mikic, (BETWEEN,))[0] > 1
    assert extremes(lambda each: each.over_yovanovich, (BETWEEN,))[0] > 1
    # "separate spots conduct better"
    for dimension in DIMENSIONS:
        plastic = sample("main", FULL, dimension)
        assert (average(over_holm(plastic)).low[plastic.in_window] > 1).all()


def test_judgements_have_three_values():
    one = sample("main", FULL, MIDDLE)
    shape = one.ratio.shape
    scatter = 1 + 0.01 * np.random.default_rng(0).standard_normal(shape)

    def of(value, tolerance):
        found = at_all_pressures(
            one, lambda each: value * scatter[: each.count, : each.pressure.size]
        )
        return judge("at Hurst 0.5", found, tolerance)

    assert of(1.0, 0.1).verdict is Verdict.CONFIRMED
    assert of(0.7, 0.2).verdict is Verdict.REFUTED
    assert of(0.9, 0.1).verdict is Verdict.UNDECIDED
    assert math.isnan(of(1.0, 0.1).enough)


def test_four_times_the_surfaces_halve_an_interval():
    """Seen from the mean: an interval that is twice too wide needs four times the surfaces."""
    for ends, growth, refutes in (
        ((0.75, 0.85, 0.85, 0.95), 4.0, True),
        ((1.0, 1.15, 1.15, 1.3), 9.0, True),
        ((0.8, 1.0, 1.0, 1.2), 4.0, False),
        ((0.7, 0.85, 0.92, 1.0), math.inf, False),
    ):
        found = growth_to_decide(Found(*ends, count=10), (0.9, 1.1))
        assert found == (pytest.approx(growth), refutes)
    wide = Found(0.75, 0.85, 0.85, 0.95, count=10).judged("at H = 0.5", (0.9, 1.1))
    assert (wide.verdict, wide.enough) == (Verdict.UNDECIDED, pytest.approx(40))


def test_heights_are_gaussian():
    """Moments to 0.02 and 0.04, shares above heights to three standard errors, heights to 2 %."""
    found = heights()
    assert abs(found.skewness[0]) < 0.02
    assert abs(found.excess_kurtosis[0]) < 0.04
    for gaussian, share, error in found.bearing:
        assert share == pytest.approx(gaussian, abs=3 * error)
        height, expected = (-NormalDist().inv_cdf(each) for each in (share, gaussian))
        assert height == pytest.approx(expected, rel=0.02)


def test_common_laws_and_root_sums_are_as_near_as_the_page_says():
    for hardness in (ELASTIC, FULL):
        law = common_law(hardness)
        for dimension in DIMENSIONS:
            one = sample("main", hardness, dimension)
            mean = average(one.conductance).mean
            off = mean / (law.prefactor * one.variable**law.exponent) - 1
            assert np.abs(off[one.in_window]).max() <= law.deviation * (1 + 1e-12)
    limit = sample("main", FULL, MIDDLE)
    elastic = sample("main", ELASTIC, MIDDLE)
    inside = limit.pressure >= 1e-2  # where the elastic surface has the same load
    assert np.isnan(over_root_sum(limit)[:, ~inside]).all()
    assert elastic.count == limit.count
