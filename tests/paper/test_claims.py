"""The verdicts on the paper's claims, from the data of the study that comes with the sources."""

from dataclasses import replace

import numpy as np
import pytest

from roughline.paper.claim import Numbers
from roughline.paper.claims import judge_claims
from roughline.paper.findings import findings, lone_bodies
from roughline.paper.results import larger_study
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Claim, Verdict, joint_verdict, verdict


@pytest.fixture(scope="module")
def claims(published_results):
    return judge_claims(published_results)


def the(claims, *words):
    (claim,) = (each for each in claims if all(word in each.statement for word in words))
    return claim


def test_every_claim_has_one_of_three_verdicts_and_says_it_first(claims):
    for claim in claims:
        assert claim.cases.startswith(claim.verdict)
        assert "%)" not in claim.verdict
        # what depends on a sample or on the grid is never called exact
        if claim.interval == "exact":
            assert " to " not in claim.basis or "waves" in claim.basis


def test_the_sections_of_the_paper_are_all_there(claims):
    said = " ".join(claim.statement for claim in claims)
    for place in ("abstract", "§3", "§5", "§6", "§7", "§8", "eq. 4", "eq. 5", "eq. 7", "eq. 14"):
        assert place in said


def test_no_power_law_is_confirmed_where_the_exponent_changes(claims, published_results):
    """At D_f = 3 the local exponents of two decades differ by many standard errors."""
    claim = the(claims, "1D: a power law")
    assert claim.verdict is Verdict.REFUTED
    assert claim.cases.startswith("refuted at D_f = 3.0;")
    lines = published_results.reduced.sel(fractal_dimension=3.0)
    force, mean = lines.force_bar.values, lines.stiffness.values.mean(axis=0)
    local = np.gradient(np.log(mean), np.log(force))
    assert local[force < 1e-3].mean() - local[(force > 1e-2) & (force < 0.1)].mean() > 0.05


def test_the_range_of_exponents_that_the_paper_gives_for_both_models(claims):
    assert the(claims, "1D: α between 0.5 and 0.8").cases.startswith("refuted at D_f = 3.0;")
    assert the(claims, "3D: α between 0.5 and 0.8").verdict is Verdict.CONFIRMED
    assert the(claims, "1D: the power law holds down to").verdict is Verdict.CONFIRMED
    assert the(claims, "3D: the power law holds down to").verdict is Verdict.REFUTED


def test_kappa_weighs_every_load_alike_and_is_given_for_both_areas(published_results):
    """Against least squares of log A = log F + log(κ / slope), with the slope of 1."""
    inside = slice(6, 11)  # F̄ = 10^-1.5 to 10^-0.5, four loads a decade
    force = published_results.full.force_bar.values[inside]
    assert force[[0, -1]] == pytest.approx(10 ** np.array([-1.5, -0.5]))
    for name, least, most in (("cells", 2.083, 4.076), ("corrected", 1.868, 2.579)):
        found = []
        for s in published_results.laws:
            one = published_results.full.sel(fractal_dimension=s.fractal_dimension)
            variable = "area_fraction" + ("_corrected" if name == "corrected" else "")
            logs = np.log(one[variable].values[:, inside].mean(axis=0) / force)
            law = getattr(s, name)
            expected = np.exp(logs.mean()) * one.rms_slope.values.mean()
            assert law.kappa.value == pytest.approx(expected, rel=3e-3)
            assert law.kappa.low < law.kappa.value < law.kappa.high
            assert law.exponent.value == pytest.approx(1 + np.polyfit(np.log(force), logs, 1)[0])
            found.append(law.kappa.value)
        assert [min(found), max(found)] == pytest.approx([least, most], abs=0.006)


def test_what_the_grid_decides_stands_with_its_grid(claims):
    claim = the(claims, "small real area")
    assert "on 512² 33.5%, 23.0%, 14.4%, 8.7%, 5.5%, 3.9% at D_f = 2.0, 2.2" in claim.found
    assert claim.interval != "exact"
    assert "or more" not in the(claims, "all springs").found
    assert "1.6 hours for the 360 surfaces of 2048²" in the(claims, "several weeks").found


@pytest.mark.parametrize(
    ("ends", "expected"),
    [
        ((-0.01, 0.04), Verdict.CONFIRMED),
        ((0.04, 0.06), Verdict.UNDECIDED),
        ((0.06, 0.08), Verdict.REFUTED),
        ((-0.1, 0.1), Verdict.UNDECIDED),
        ((np.nan, np.nan), Verdict.UNDECIDED),
    ],
)
def test_a_verdict_needs_the_whole_interval(ends, expected):
    sure = IntervalEstimate(0.0, -0.01, 0.01)
    numbers = {"at D_f = 2.0": IntervalEstimate(0.0, *ends), "at D_f = 3.0": sure}
    claim = Claim.of("", "", "", Numbers(numbers).judge((-0.05, 0.05)))
    assert claim.verdict is expected
    assert claim.cases.startswith(expected)


def test_the_three_numbers_say_of_the_paper_what_its_claims_say(claims, published_results):
    of_claims = [
        the(claims, "3D: α ≈ 0.2567 D_f"),
        the(claims, "1D: α from 0.5 to 0.75"),
        the(claims, "Excellent agreement"),
    ]
    verbs = {"confirmed": "confirms", "refuted": "refutes", "undecided": "does not decide on"}
    found = findings(published_results, None)
    assert [each.value for each in found] == ["0.52 to 0.78", "0.50 to 0.91", "0.98 to 1.34"]
    for each, claim in zip(found, of_claims, strict=True):
        assert f"this {verbs[claim.verdict]} " in each.sentence
        assert "95 %: " in each.sentence
    assert "0.520 (95 %: 0.494 to 0.547) at D_f = 2.0" in found[0].sentence
    assert lone_bodies(published_results) == []


def test_a_claim_is_judged_by_the_numbers_that_are_drawn(claims):
    """But for what is judged on another grid as well, one number outside refutes it."""
    drawn = [claim for claim in claims if claim.numbers]
    assert len(drawn) == 18
    for claim in drawn:
        parts = [verdict(each.low, each.high, *claim.within) for each in claim.numbers.values()]
        assert joint_verdict(parts) is claim.verdict


def test_a_study_stands_before_a_larger_one_of_its_own_bodies_alone(published_results):
    assert larger_study(published_results) is None
    fewer = replace(published_results, full=published_results.full.isel(realisation=slice(2)))
    assert larger_study(fewer) is published_results
    other = fewer.full.assign_attrs(boundary="periodic")
    assert larger_study(replace(fewer, full=other)) is None
