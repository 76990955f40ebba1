"""The study of finite size: laws that are known come back from samples that were made of them."""

import csv
import itertools
import math
import re

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_curves import CROSSING_FORCES as FORCES
from benchmarks.made_curves import Crossing
from studies.finite_size.claims import MANY
from studies.finite_size.crossover import (
    BETWEEN_THEM,
    EXPONENT_TOLERANCE,
    cross_over,
    local_exponents,
    scaling_exponent_of,
)
from studies.finite_size.measure import (
    SEVERAL,
    crossing,
    exponents_beside_gamma,
    over_persson,
    pressures_near_one,
)
from studies.finite_size.samples import (
    BAND,
    HURSTS,
    REDUCED,
    SIZES,
    WIDE,
    persson,
    sample,
)
from studies.finite_size.study import STUDY
from studies.study import DOCS

AGAIN = "the page is not that of the data any more: run make published"


@pytest.mark.parametrize(("hurst", "count"), [(0.8, 20), (0.5, 60)])
def test_a_known_law_comes_back_within_its_intervals(hurst, count):
    """Exponents at single loads, the loads where they pass, and gamma."""
    law = Crossing(hurst)
    sample = law.surfaces(count, np.random.default_rng(17))
    found, local = cross_over(FORCES, sample, hurst), local_exponents(FORCES, sample)
    assert np.mean((local.low <= law.exponents) & (law.exponents <= local.high)) >= 0.9
    assert found.gamma.low < law.gamma < found.gamma.high
    for passed, value in (
        (found.leaves, scaling_exponent_of(hurst) + EXPONENT_TOLERANCE),
        (found.halfway, (scaling_exponent_of(hurst) + BETWEEN_THEM) / 2),
        (found.reaches, 1 - EXPONENT_TOLERANCE),
    ):
        low, high = passed.force.low, passed.force.high  # an end may be open
        assert np.nan_to_num(low, nan=0.0) <= law.load_of(value)
        assert law.load_of(value) <= np.nan_to_num(high, nan=np.inf)


@pytest.mark.parametrize(
    ("count", "hursts"), [(1000, [0.5]), (1000, [0.8, 0.5, 0.2]), (3000, [0.8, 0.5, 0.2])]
)
def test_estimates_of_many_surfaces_are_those_of_the_law(count, hursts):
    for hurst in hursts:
        law = Crossing(hurst)
        found = cross_over(FORCES, law.surfaces(count, np.random.default_rng(1)), hurst)
        assert found.gamma.value == pytest.approx(law.gamma, rel=0.01 * math.sqrt(3000 / count))
        for passed, value in (
            (found.leaves, scaling_exponent_of(hurst) + EXPONENT_TOLERANCE),
            (found.reaches, 1 - EXPONENT_TOLERANCE),
        ):
            assert passed.force.value == pytest.approx(
                law.load_of(value), rel=0.3 * math.sqrt(3000 / count)
            )


@pytest.mark.parametrize("seeds", [4, 10])
def test_half_of_the_surfaces_widen_intervals_by_the_square_root_of_two(seeds):
    ratios = []
    for seed in range(seeds):
        sample = Crossing(0.5).surfaces(160, np.random.default_rng(seed))
        whole, half = (local_exponents(FORCES, each) for each in (sample, sample[:80]))
        ratios.append((half.high - half.low) / (whole.high - whole.low))
    assert np.mean(ratios) == pytest.approx(math.sqrt(2), rel=0.05)


def test_gamma_is_not_told_where_heavier_loads_may_show_more():
    sample = Crossing(0.5).surfaces(100, np.random.default_rng(2))
    light = FORCES < 3
    found = cross_over(FORCES[light], sample[:, light], 0.5).gamma
    assert math.isnan(found.value)
    assert math.isnan(found.high)
    assert found.low == pytest.approx((FORCES / sample.mean(axis=0))[light][-1], rel=0.1)


def test_the_page_is_that_of_the_data():
    assert (DOCS / "finite_size.md").read_text("utf-8") == STUDY.page, AGAIN


def test_no_load_is_left_out_silently():
    unsolved, loads = REDUCED.unsolved_loads()
    assert unsolved == 0
    assert loads == sum(each.cases * len(each.force_bars) for each in REDUCED.plan.ensembles)
    for geometry in ("periodic", "free", "lines"):
        for band, sizes in SIZES.items():
            for size in sizes:
                one = sample(geometry, band, size, 0.5)
                name = f"{'wide-' if band == WIDE else ''}{geometry}-{size}"
                assert one.force.size + one.left_out == len(REDUCED.plan.ensemble(name).force_bars)
                assert one.count == REDUCED.plan.ensemble(name).realisations


def test_half_of_the_surfaces_of_the_data_widen_intervals_by_the_square_root_of_two():
    ratios = []
    for hurst in HURSTS:
        for size in SIZES[BAND]:
            one = sample("periodic", BAND, size, hurst)
            half = one.first(one.count // 2)
            whole, part = (local_exponents(each.force, each.stiffness) for each in (one, half))
            ratios.append(np.median((part.high - part.low) / (whole.high - whole.low)))
    assert np.mean(ratios) == pytest.approx(math.sqrt(2), rel=0.1)


@pytest.mark.parametrize(("name", "body"), [("periodic-1", 17), ("free-2", 3), ("lines-4", 5)])
def test_a_body_of_the_data_is_what_the_library_gives(name, body):
    """To single precision; surfaces are certified to 1e-6."""
    ensemble, hurst = REDUCED.plan.ensemble(name), 0.5
    spectrum, seed = ensemble.spectrum(3 - hurst), ensemble.body_seed(body)
    kept = (
        REDUCED.data[name].sel(fractal_dimension=3 - hurst).isel(realisation=body).stiffness.values
    )
    if ensemble.model == "reduced":
        curve = rl.press(spectrum.line(ensemble.n, seed), E_star=1.0, forces=ensemble.force_bars)
    else:
        curve = rl.press(
            spectrum.surface(ensemble.n, seed),
            E_star=1.0,
            forces=ensemble.force_bars,
            periodic=ensemble.boundary == "periodic",
        )
    assert kept == pytest.approx(curve.stiffness, rel=1e-4)


def test_perssons_stiffness_is_that_of_the_mean_gap():
    """The slope of the pressure over the mean gap, by differences."""
    one = sample("periodic", BAND, 8, 0.8)
    lattice = REDUCED.plan.ensemble("periodic-8").spectrum(2.2).lattice(512)
    steps = 1e-4
    up, down = (
        rl.theory("persson", lattice, 1.0, one.force_bar * (1 + sign * steps)).mean_gap
        for sign in (1, -1)
    )
    found = one.force_bar * 2 * steps / (down - up)
    assert persson(one) / one.size == pytest.approx(found, rel=1e-3)


def cells(table, column):
    """The numbers of a column of a table of the study, without intervals, by Hurst and size."""
    with (DOCS / "data" / "finite_size" / f"{table}.csv").open(encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    place = head.index(column)
    cell = {(float(row[0]), int(row[1])): row[place].split(" (")[0] for row in rows}
    return {case: float(text) for case, text in cell.items() if not text.startswith((">", "<"))}


def test_the_answer_is_what_the_tables_say():
    """Where the exponent nears 1: every cell lies in the range that is told of its kind."""
    page = STUDY.page
    lead = page.split("\n\n")[1]
    near = cells("periodic", "near 1, p λ_r/(E* h)")
    assert len(near) == len(HURSTS) * len(SIZES[BAND])
    told = {}
    for of_size, sizes in (("on surfaces of one wave", [1]), ("on those of two", [2])):
        low, high = re.search(rf"([\d.]+) to ([\d.]+) {of_size}", lead).groups()
        told |= {(hurst, size): (low, high) for hurst in HURSTS for size in sizes}
    for hurst in HURSTS:
        low, high = re.search(rf"([\d.]+) to ([\d.]+) at Hurst {hurst:g}", lead).groups()
        told |= {(hurst, size): (low, high) for size in SIZES[BAND] if size > 2}
    for case, (low, high) in told.items():
        assert float(low) - 0.006 <= near[case] <= float(high) + 0.006, case
    wide = cells("wide_band", "near 1, p λ_r/(E* h)").values()
    assert f"{min(wide):.2f} to {max(wide):.2f}, and differ" in page


def test_the_dependence_on_the_hurst_exponent_is_no_scatter():
    """From four waves on the ranges of Hurst exponents do not overlap; they rise as H falls."""
    ranges = [pressures_near_one(BAND, SEVERAL, hurst) for hurst in HURSTS]
    for first, then in itertools.pairwise(ranges):
        assert max(first) < min(then)


def test_the_exponent_passes_one_without_a_rest():
    """Gamma is a maximum of F / k: the exponent is below 1 before it, and above 1 after it."""
    beside = exponents_beside_gamma()
    assert len(beside) >= 10
    assert all(before < 1 - EXPONENT_TOLERANCE / 2 for before, _ in beside)
    assert all(after > 1 for _, after in beside)
    assert all(after - before > 2 * EXPONENT_TOLERANCE for before, after in beside)


def test_sentences_without_numbers_are_true_too():
    for hurst in HURSTS:
        found = {size: crossing("periodic", BAND, size, hurst) for size in SIZES[BAND]}
        # "so under ever lower mean pressures"
        halves = [found[size].halfway.force.value / size for size in (1, 2, 4, MANY)]
        assert (np.diff(halves) < 0).all()
        # "over more decades the larger the surface is"
        begins = [found[size].reaches.force.value for size in SIZES[BAND]]
        assert (np.diff(begins) > 0).all()
        # "at a pressure that depends on the Hurst exponent and hardly on the size"
        pressures = np.array(begins) / np.square(SIZES[BAND])
        assert pressures[2:].max() < 1.1 * pressures[2:].min()
        # and smaller surfaces need a higher one
        assert (np.diff(pressures[:3]) < 0).all()
        assert pressures[0] > 1.4 * pressures[2:].max()
        for size in SIZES[BAND]:
            one = sample("periodic", BAND, size, hurst)
            # lighter loads are further from Persson's theory
            if size >= MANY:
                assert np.diff([over_persson(one, below).value for below in (0, 1, 2)]).min() > 0
            # "A line saturates at E* L, and has no linear law."
            lines = sample("lines", BAND, size, hurst)
            assert lines.whole.max() <= size * (1 + 1e-6)
