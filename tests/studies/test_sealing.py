"""The study of sealing: what is measured of a body, and verdicts from data that are made up."""

import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.fluid.winding import windings
from roughline.statistics.verdict import Verdict
from studies.sealing import study
from studies.sealing.body import ELASTIC, FULL, LOADS, MEDIA, MOSTLY, PEAKS, WEAK, Case, measured
from studies.sealing.claims import claims
from studies.sealing.measure import Data, mean, plastic_factor, ratio, theory_of
from studies.sealing.run import COUNTS, HARDNESSES, HURSTS, body_of, counts, leaks, planned, run
from studies.sealing.scaling import (
    PERCOLATION,
    WINDING,
    at_sealing,
    at_share,
    first_and_last,
    fitted,
    scaling,
    threshold_of,
)
from studies.sealing.study import STUDY, claims_table, told
from studies.study import DOCS, filled

SMALL = Case(waves=2, hurst=0.8, hardness=ELASTIC, cells=4)
FACTOR = {ELASTIC: 1.0, WEAK: 1.5, MOSTLY: 2.0, FULL: 8.0}
"""By which the leak of made-up bodies is lower than that of elastic ones."""
AREA = {ELASTIC: 0.42, WEAK: 0.42, MOSTLY: 0.46, FULL: 0.5}
TENFOLD = {ELASTIC: 0.9, WEAK: 0.8, MOSTLY: 0.4, FULL: 0.1}


def made_up(scatter=0.02, factor=FACTOR, area=AREA):
    """Bodies as the claims say, with a scatter that both directions and all loads share.

    Areas near their limits as in two-dimensional percolation, and as many wind there.
    """
    bodies = {}
    for case, number in planned():
        hard = case.hardness
        one = scatter * np.random.default_rng([case.waves, number]).uniform(-1, 1)
        found = {"waves": case.waves, "version": "0"}
        places = np.random.default_rng([case.waves, number, 1]).uniform(0, 1, 2) - (1 - WINDING)
        for along, place in zip(("x", "y"), places, strict=True):
            found[f"area_{along}"] = area[hard] + 0.3 * place * case.waves**-PERCOLATION
            found[f"cells_{along}"] = area[hard] + 0.02
            found[f"plastic_{along}"] = 1 - min(hard, 1)
            found[f"sealing_{along}"] = 0.2
        if leaks((case, number)):
            found |= made_up_leaks(case, one, factor)
        bodies[case, number] = found
    return Data(bodies)


def made_up_leaks(case, one, factor):
    """What leaks through a body that differs from the mean by some share."""
    hard, found = case.hardness, {}
    theory = [
        theory_of("critical-junction", 0.42, replace(case, hardness=ELASTIC, cells=8), p)
        for p in case.loads
    ]
    for threshold in MEDIA:
        found[f"medium_{threshold:g}"] = [each * (1 + one) for each in theory]
    for along in ("x", "y"):
        found[f"permeance_{along}"] = [each / factor[hard] * (1 + one) for each in theory]
    for peak in PEAKS[:-1]:
        found[f"tenfold_{peak:g}"] = TENFOLD[hard] * (1 + one)
        found[f"loading_{peak:g}"] = 1 + one
        found[f"unloading_{peak:g}"] = (1 + one) / (1.0 if hard == ELASTIC else 20)
    return found | {f"opens_{PEAKS[-1]:g}": TENFOLD[hard] / PEAKS[-1] * (1 + one)}


@pytest.fixture(scope="module")
def as_said():
    return made_up()


@pytest.mark.parametrize("hardness", [ELASTIC, FULL])
def test_a_body_seals_where_the_library_says_and_leaks_less_under_more_load(hardness):
    case = replace(SMALL, hardness=hardness)
    found = measured(case, 3)
    for along in ("x", "y"):
        known = rl.sealing_pressure(
            case.surface(3),
            half_space=rl.Homogeneous(1.0, periodic=True),
            law=rl.Yielding(hardness * case.slope) if hardness < math.inf else None,
            along=along,
            rtol=0.002,
            interval=False,
        )
        assert found[f"sealing_{along}"] * case.slope == pytest.approx(known.value, rel=0.004)
        assert np.diff(found[f"permeance_{along}"]).max() <= 0
    for peak in PEAKS[:-1]:
        loading, unloading = found[f"loading_{peak:g}"], found[f"unloading_{peak:g}"]
        if hardness == ELASTIC:
            assert unloading == pytest.approx(loading, rel=1e-4)
        else:
            assert unloading < loading
    if hardness == ELASTIC:  # what closed last opens first
        assert found["opens_1.2"] == pytest.approx(1 / 1.2, abs=0.02)


def test_first_loading_is_the_same_at_once_or_in_steps():
    """So that a body need not be loaded again through all loads before."""
    case = Case(waves=2, hurst=0.5, hardness=FULL, cells=8)
    leaks = []
    for steps in ((1.0,), (0.1, 0.3, 0.6, 0.8, 0.9, 1.0)):
        curve = rl.press(
            case.surface(5),
            E_star=1.0,
            forces=[0.4 * FULL * case.slope * step for step in steps],
            hardness=FULL * case.slope,
            periodic=True,
            fields=True,
        )
        leaks.append(rl.flow(curve.fields[-1]).permeance)
    assert leaks[0] > 0
    assert leaks[1] == pytest.approx(leaks[0], rel=1e-4)


@pytest.mark.parametrize("processes", [1, 2])
def test_a_run_goes_on_where_it_was_cut_off_whatever_the_processes(
    tmp_path, monkeypatch, processes
):
    if processes == 1:  # in which bodies may be made up

        def made_up(case, number, leaks):
            return {"waves": case.waves, "permeance_x": [case.hardness / 3, number / 3]}

        monkeypatch.setattr("studies.sealing.run.measured", made_up)
    bodies = [(replace(SMALL, hardness=hardness), i) for i in (0, 1) for hardness in (FULL, WEAK)]
    whole, cut = tmp_path / "out" / "whole.jsonl", tmp_path / "cut.jsonl"
    run(bodies, whole)
    lines = whole.read_text("utf-8").splitlines(keepends=True)
    assert list(Data.of(lines).bodies) == bodies
    cut.write_text(lines[0] + lines[1][:200], encoding="utf-8")
    run(bodies, cut, processes)
    assert cut.read_bytes() == whole.read_bytes()


def test_a_body_that_is_not_solved_is_written_down_and_left_out(tmp_path, monkeypatch):
    def unsolved(*_):
        raise rl.ConvergenceError("a load was not solved", None)

    monkeypatch.setattr("studies.sealing.run.measured", unsolved)
    run([(SMALL, 0)], tmp_path / "run.jsonl")
    data = Data.of((tmp_path / "run.jsonl").read_text("utf-8").splitlines())
    assert (data.unsolved, data.sample(2, 0.8, ELASTIC, 4).count) == (1, 0)


def test_the_plan_has_as_many_surfaces_as_the_study_promises():
    bodies = planned()
    assert len(set(bodies)) == len(bodies)
    for waves in COUNTS:
        for hurst in HURSTS:
            for hardness in HARDNESSES:
                assert sum(case == Case(waves, hurst, hardness) for case, _ in bodies) >= 30


def test_as_many_bodies_leak_as_the_study_promises():
    for case, (count, leaking) in counts().items():
        assert 0 <= leaking <= count
        assert sum(leaks((case, number)) for number in range(count + 1)) == leaking


def test_a_body_of_which_no_leak_is_asked_for_seals_at_the_same_load():
    short, whole = (measured(replace(SMALL, hardness=WEAK), 1, each) for each in (False, True))
    assert short == {name: whole[name] for name in short}
    assert "permeance_x" not in short


def test_data_of_gaps_with_two_ends_are_refused():
    line = {"waves": 4, "hurst": 0.3, "hardness": "inf", "cells": 8, "number": 0}
    with pytest.raises(rl.StoreError, match="an inlet and an outlet"):
        body_of(json.dumps(line))
    assert body_of(json.dumps({**line, "flow": "cell"})) == (Case(4, 0.3, ELASTIC), 0)


def test_the_page_is_that_of_the_whole_data_or_there_is_none():
    page = DOCS / "sealing.md"
    try:
        expected = STUDY.page
    except rl.StoreError:
        assert not page.exists()
    else:
        assert page.read_text("utf-8") == expected, "run make published"


def test_a_part_of_the_data_is_kept_and_makes_no_page(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "DATA", tmp_path / "data.jsonl")
    (case, number), other = planned()[:2]
    lines = [
        json.dumps(
            {
                "waves": one.waves,
                "hurst": one.hurst,
                "hardness": str(one.hardness),
                "cells": one.cells,
                "number": i,
                "flow": "cell",
            }
        )
        + "\n"
        for one, i in (other, (case, number))
    ]
    (tmp_path / "run.jsonl").write_text("".join(lines) + lines[0][:20], encoding="utf-8")
    study.reduce(tmp_path / "run.jsonl")
    kept = (tmp_path / "data.jsonl").read_text("utf-8")
    assert kept == lines[1] + lines[0]
    study.data.cache_clear()
    with pytest.raises(rl.StoreError, match=rf"{len(planned()) - 2} of {len(planned())} bodies"):
        _ = replace(STUDY).page
    study.data.cache_clear()


def test_data_that_are_as_is_said_confirm_it(as_said):
    judged = claims(as_said)
    by_words = {claim.statement: claim.verdict for claim in judged}
    for words in (
        "Elastic contacts seal at A/A_0 = 0.42",
        "Fully plastic contacts seal",
        "Elastic contacts leak as the critical junction",
        "Unloaded elastic",
    ):
        (found,) = [of for each, of in by_words.items() if each.startswith(words)]
        assert found is Verdict.CONFIRMED, words
    near = next(words for words in by_words if words.startswith("Finite contacts near"))
    assert by_words[near] is not Verdict.REFUTED  # an exponent takes more bodies to be confirmed
    for hurst in HURSTS:
        exponent = scaling(as_said, hurst, ELASTIC, free=True).exponent()
        assert exponent.low < PERCOLATION < exponent.high
    of_hursts = [of for words, of in by_words.items() if "whatever the Hurst" in words]
    assert of_hursts == [Verdict.CONFIRMED] * len(HARDNESSES)
    assert by_words[next(words for words in by_words if "= 0.4 (" in words)] is Verdict.REFUTED
    said = {words.rpartition(": ")[2]: of for words, of in by_words.items() if "taken" in words}
    assert said["elastic"] is said["weakly plastic"] is Verdict.REFUTED
    assert said["fully plastic"] is Verdict.CONFIRMED


def test_data_that_are_not_as_is_said_refute_it():
    other = made_up(factor={**FACTOR, FULL: 40.0}, area={**AREA, ELASTIC: 0.45})
    refuted = [claim.statement for claim in claims(other) if claim.verdict is Verdict.REFUTED]
    for words in ("Elastic contacts seal", "Plastic flow lowers the leak"):
        assert any(each.startswith(words) for each in refuted), refuted


@pytest.mark.parametrize("exponent", [PERCOLATION, 1.0])
def test_a_limit_and_an_exponent_come_back_within_their_intervals(exponent):
    held, tried = np.zeros(2), np.linspace(0.3, 2.0, 171)
    for seed in range(100):
        rng = np.random.default_rng(seed)
        areas = {
            waves: 0.4
            + np.outer(rng.normal(size=30), [0.2, 0.3]) * waves**-exponent
            + [-0.2 * waves**-exponent, 0.1 * waves**-exponent]
            + 0.1 * waves**-exponent * rng.normal(size=(30, 2))
            for waves in (4, 8, 16, 32)
        }
        free, fixed = fitted(areas, tried), fitted(areas, np.array([exponent]))
        found = fixed.limit(), free.exponent()
        held += [
            one.low <= true <= one.high for one, true in zip(found, (0.4, exponent), strict=True)
        ]
    assert (held >= 90).all(), held


def test_a_fit_that_does_not_hold_has_a_wider_interval():
    rng = np.random.default_rng(4)
    noise = {waves: 0.01 * rng.normal(size=(40, 2)) for waves in (4, 8, 16, 32)}
    bent = {waves: each + 0.05 * (waves == 8) for waves, each in noise.items()}
    straight, other = (fitted(each, np.array([PERCOLATION])) for each in (noise, bent))
    assert straight.misfit < 3 < other.misfit
    widths = [one.limit().high - one.limit().low for one in (straight, other)]
    assert widths[1] == pytest.approx(
        widths[0] * math.sqrt(other.misfit / max(1, straight.misfit)), rel=0.1
    )


def closing_shares(points, rng):
    """Shares of closed sites, closed in random order, at which those open wind no more."""
    order = rng.permutation(points**2).reshape(points, points)
    found = []
    for axis in (0, 1):
        winding, sealed = 0, points**2
        while sealed - winding > 1:
            middle = (winding + sealed) // 2
            leads = windings(order >= middle, (True, True)).leads(axis)
            winding, sealed = (middle, sealed) if leads else (winding, middle)
        found.append(sealed / points**2)
    return found


def test_the_threshold_of_sites_that_close_at_random_comes_back_both_ways():
    """Open sites of a square lattice percolate from p = 0.592746 on (Newman and Ziff 2001)."""
    rng, known = np.random.default_rng(1), 1 - 0.592746
    shares = {n: np.array([closing_shares(n, rng) for _ in range(100)]) for n in (8, 16, 32)}
    of_means = fitted({n: np.sort(each, axis=1) for n, each in shares.items()}, np.array([0.75]))
    for found in (of_means.limit(), threshold_of(shares).interval_estimate()):
        assert found.low < known < found.high
    assert found.high - found.low < 0.02
    winding = np.mean([each > known for each in shares.values()])
    assert winding == pytest.approx(WINDING, abs=3 * 0.5 / math.sqrt(300))


def test_areas_of_made_up_bodies_are_found(as_said):
    for hurst in HURSTS:
        found = at_sealing(as_said, hurst, ELASTIC)
        assert found.low <= AREA[ELASTIC] <= found.high
        one = as_said.sample(32, hurst, ELASTIC)
        first, last = first_and_last(one).T
        assert (first < last).all()
        share = at_share(one)
        assert share.low <= share.value <= share.high
        fit = scaling(as_said, hurst, ELASTIC, free=True)
        assert fit.exponent().low <= PERCOLATION <= fit.exponent().high


def test_a_factor_of_leaks_comes_back_with_its_interval(as_said):
    for load in (each for each in LOADS if each < FULL):
        found = plastic_factor(as_said, 16, 0.5, FULL, load)
        assert found.low <= found.value <= found.high
        assert found.value == pytest.approx(FACTOR[FULL])
    assert plastic_factor(as_said, 16, 0.5, FULL, LOADS[-1]) is None


def test_values_that_are_nearly_all_equal_have_an_interval():
    """Resamples without the one that differs have no error of their own."""
    one = np.ones(30)
    other = one.copy()
    other[3] += 1e-4
    found = ratio(one, other)
    assert 1 - 1e-4 < found.low < found.value < found.high < 1 + 1e-4
    stepped = mean(other, step=0.03)
    assert 0.003 < stepped.high - stepped.low < 0.03


def test_the_text_and_the_figures_are_those_of_data(as_said):
    table = claims_table({"Verdict": claims(as_said)})
    text = (STUDY.folder / "text.md").read_text("utf-8")
    page = filled(text, {"verdicts": table, **told(as_said)}, "sealing")
    assert re.search(r"elastic contact closes where 0\.4[12]\d of the nominal area", page)
    assert "nan" not in page
    drawn = study.sealing_figure(as_said).axes
    assert len(drawn) == 2
    lines = [[*line.get_ydata()] for axes in drawn for line in axes.lines]
    assert all(math.isfinite(y) for line in lines for y in line)
