"""Answers of bodies that yield: hardness and its scatter, histories, and elastic ones beside."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from attrs import evolve

import roughline as rl
from roughline.assessment.answers import ends_in_common
from roughline.engineering.formulas import electrical_resistance, partial_slip
from roughline.margins import variant as variants
from roughline.margins.larger_surface import Differences
from roughline.margins.parts import BehindMaps
from roughline.question import case as cases
from roughline.report.answers import answer_table, elastic_in_words

PAIR = "steel,copper"
H = rl.material("copper").hardness
FACTOR = rl.material("copper").hardness_factor


@pytest.fixture(scope="module", params=[32, 64])
def surface(request):
    """A surface that is none of a larger one."""
    seed = {32: 1, 64: 3}[request.param]
    rough = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(request.param, seed)
    return rl.Surface(rough.heights, rough.sizes, "m")


@pytest.fixture(scope="module")
def pressed(surface):
    """Steel on copper under two loads, with all that is varied."""
    return rl.assess(rl.Question(surface, PAIR, loads=["2 N", "20 N"], grid_error=True))


def test_the_softer_body_yields_at_the_hardness_of_the_table(surface, pressed):
    curve = rl.press(surface, E_star=pressed.curve.E_star, hardness=H, forces=[2.0, 20.0])
    for name in ("depth", "stiffness", "unloading_stiffness", "plastic_fraction", "work"):
        assert getattr(pressed.curve, name).tolist() == getattr(curve, name).tolist(), name
    answers = pressed.answers
    assert answers["unloading_stiffness"].values.tolist() == curve.unloading_stiffness.tolist()
    assert answers["plastic_fraction"].values.tolist() == curve.plastic_fraction.tolist()
    assert answers["indentation"].values.tolist() == curve.indentation.tolist()
    assert (answers["contact_pressure_over_hardness"].values <= 1 + 1e-9).all()
    assert any("yields at the largest load: it bears" in note for note in pressed.notes)
    assert not any("hardness; beyond" in text for text in pressed.warnings)


def test_intervals_hold_the_answers_of_the_softest_and_the_hardest_body(surface, pressed):
    """As pressed independently; each end by as much as the hardness moves it, and the grid."""
    question, E_star = pressed.question, pressed.curve.E_star
    exact = rl.assess(evolve(question, hardness=H))
    metals = [rl.material(name).resistivity for name in ("steel", "copper")]
    for value in (H / FACTOR, H * FACTOR):
        curve = rl.press(surface, E_star=E_star, hardness=value, forces=[2.0, 20.0])
        expected = {
            "contact_stiffness": curve.stiffness,
            "unloading_stiffness": curve.unloading_stiffness,
            "contact_area_fraction": curve.area_fraction_corrected,
            "constriction_resistance": electrical_resistance(
                curve.unloading_stiffness, E_star, metals
            ),
        }
        for key, moved in expected.items():
            found, without = pressed.answers[key], exact.answers[key]
            assert found.values.tolist() == without.values.tolist()
            beyond = 1 + 1e-12  # where all yields, an end is F / H, rounded
            assert ((found.low <= moved * beyond) & (moved <= found.high * beyond)).all(), key
            ratio = moved / found.values
            most = {
                "contact_area_fraction": 1.0,
                "contact_stiffness": pressed.answers["unloading_stiffness"].high,
            }.get(key, np.inf)
            assert (found.low <= without.low * ratio * beyond).all(), key
            assert (found.high * beyond >= np.minimum(without.high * ratio, most)).all(), key
            low, high = pressed.hardness_scatter[key]
            assert ((low <= ratio * beyond) & (ratio <= high * beyond)).all(), key
    assert exact.hardness_scatter == {}
    for name in ("stiffness_interval", "unloading_interval", "area_interval"):
        wide, narrow = getattr(pressed, name), getattr(exact, name)
        assert (wide[0] <= narrow[0]).all()
        assert (wide[1] >= narrow[1]).all()


def test_nothing_lies_beyond_what_can_be(pressed):
    answers = pressed.answers
    assert (answers["contact_pressure_over_hardness"].high <= 1).all()
    assert (answers["contact_area_fraction"].high <= 1).all()
    force = answers["normal_force"].values
    assert (answers["contact_pressure"].low >= force / 1e-6).all()
    factor = FACTOR**0.5  # by R = (rho1 + rho2) sqrt(pi H / F) / 4
    holm = answers["holm_resistance"]
    assert holm.low == pytest.approx(holm.values / factor, rel=1e-9)
    assert holm.high == pytest.approx(holm.values * factor, rel=1e-9)


def test_the_answers_of_elastic_bodies_stand_beside(surface, pressed):
    elastic = rl.assess(evolve(pressed.question, elastic=True))
    for key, answer in elastic.answers.items():
        assert pressed.elastic[key].values.tolist() == answer.values.tolist(), key
    k = elastic.answers["contact_stiffness"].values
    assert pressed.elastic["unloading_stiffness"].values.tolist() == k.tolist()
    assert "unloading_stiffness" not in elastic.answers
    assert elastic.elastic == {}
    (warned,) = (text for text in elastic.warnings if "hardness; beyond" in text)
    assert "leave out elastic=True" in warned


def test_ceramics_that_do_not_yield_have_no_other_answers(surface, monkeypatch):
    solved = []
    original = variants.press
    monkeypatch.setattr(variants, "press", lambda *a, **k: solved.append(k) or original(*a, **k))
    result = rl.assess(rl.Question(surface, "alumina,glass", loads="0.5 N"))
    # none harder, and the softest bears as much; and the flat punch
    assert [case["hardness"] for case in solved] == [5.5e9, None]
    assert result.elastic == {}
    low, high = result.hardness_scatter["contact_stiffness"]
    assert (low, high) == (1, 1)
    lowest = result.hardness_scatter["contact_pressure_over_hardness"][0]
    assert lowest == pytest.approx(1 / FACTOR, rel=1e-15)  # both are rounded
    assert any("this changes no answer there except p_c/H" in note for note in result.notes)
    assert any(note.startswith("nothing yields at the largest load") for note in result.notes)


@pytest.mark.parametrize(
    ("asked", "hardness", "scatters", "told"),
    [
        ({"materials": "steel,rigid"}, 1.3e9, True, "1.3 GPa, of the softer body"),
        ({"materials": "E=70 GPa nu=0.3, glass"}, 5.5e9, True, "that of the other is taken as"),
        ({"materials": "steel hardness=0.2 GPa, copper"}, 0.2e9, False, "200 MPa, given"),
        ({"materials": PAIR, "hardness": "2 GPa"}, 2e9, False, "2 GPa, given"),
        ({"materials": "rigid,copper", "hardness": 1e9}, 1e9, False, "1 GPa, given"),
        ({"E_star": "90 GPa", "hardness": "1 GPa"}, 1e9, False, "1 GPa, given"),
        ({"materials": PAIR, "hardness": math.inf}, None, False, ""),
        ({"materials": PAIR, "elastic": True}, None, False, ""),
        ({"materials": "E=70 GPa nu=0.3, rigid"}, None, False, "so both bodies are taken as"),
        ({"E_star": 9e10}, None, False, ""),
    ],
)
def test_which_hardness_answers(surface, asked, hardness, scatters, told):
    result = rl.assess(rl.Question(surface, loads=["10 N"], grid_error=False, **asked))
    assert result.curve.hardness == hardness
    assert bool(result.hardness_scatter) == scatters
    assert told in " ".join(result.notes)
    yields = hardness is not None and result.curve.plastic_fraction[0] > 0
    assert bool(result.elastic) == (yields and "materials" in asked)
    assert ("unloading_stiffness" in result.answers) == (
        hardness is not None and "materials" in asked
    )
    if yields and "materials" in asked:
        over = result.elastic["contact_pressure_over_hardness"].values
        assert over == pytest.approx(result.elastic["contact_pressure"].values / hardness)
    if hardness is not None and "materials" in asked:
        over = result.answers["contact_pressure_over_hardness"].values
        assert over == pytest.approx(result.answers["contact_pressure"].values / hardness)


def test_without_materials_a_hardness_gives_curve_and_intervals(surface):
    pressed = {"E_star": "90 GPa", "hardness": "1 GPa", "loads": "10 N", "grid_error": True}
    result = rl.assess(rl.Question(surface, **pressed))
    assert result.answers == {}
    assert result.stiffness_interval[0] < result.curve.stiffness < result.stiffness_interval[1]
    k_u = result.curve.unloading_stiffness
    assert result.unloading_interval[0] < k_u < result.unloading_interval[1]


def test_loads_that_the_softest_body_does_not_bear_have_no_interval(surface):
    """And the others are moved as ever; 0.8 H is more than H / 1.5."""
    loads = ["20 N", f"{0.8 * H:g} Pa", "2 N"]
    asked = {"grid_error": True, "fields": False}
    result = rl.assess(rl.Question(surface, PAIR, loads=loads, **asked))
    alone = rl.assess(rl.Question(surface, PAIR, loads=["2 N", "20 N"], **asked))
    for key in ("contact_stiffness", "constriction_resistance", "contact_area"):
        found = result.answers[key]
        assert np.isfinite(found.values).all()
        assert np.isnan([found.low[1], found.high[1]]).all()
        assert np.isfinite(found.rows[:, [2, 0]]).all()
        for end, kept in zip(
            result.hardness_scatter[key], alone.hardness_scatter[key], strict=True
        ):
            assert end[[2, 0]] == pytest.approx(kept, rel=1e-6), key
    assert any("does not bear the largest load" in note for note in result.notes)


@pytest.mark.parametrize("asked", [{}, {"ask": rl.Joint("1 cm^2")}])
def test_loads_that_no_body_bears_are_refused_where_they_act(surface, asked):
    on = "the joint" if asked else "the map"
    most = "37 kN" if asked else "370 N"
    message = f"of hardness 370 MPa, bears less than {most} on {on} (H A_0)"
    with pytest.raises(rl.InputError, match=re.escape(message)):
        rl.assess(rl.Question(surface, PAIR, loads=["1 N", "370 MPa"], **asked))


def test_a_history_is_that_of_the_surface_as_each_load_left_it(surface):
    forces = [2.0, 8.0, 4.0, 4.0, 0.0, 8.0, 12.0]
    asked = {"history": True, "grid_error": True, "fields": False}
    result = rl.assess(rl.Question(surface, PAIR, loads=forces, **asked))
    curve = rl.press(surface, E_star=result.curve.E_star, hardness=H, forces=forces)
    for name in ("force", "depth", "stiffness", "unloading_stiffness"):
        assert getattr(result.curve_as_asked, name).tolist() == getattr(curve, name).tolist()
    assert result.headings == ["2 N", "8 N", "4 N", "4 N", "0 N", "8 N", "12 N"]
    assert result.largest == 6
    answers = result.answers
    k = answers["contact_stiffness"]
    assert (k.values[4], k.low[4], k.high[4]) == (0, 0, 0)
    assert math.isinf(answers["constriction_resistance"].values[4])
    assert answers["unloading_stiffness"].values[5] == pytest.approx(
        answers["unloading_stiffness"].values[1], rel=1e-4
    )  # it shakes down
    elastic = result.elastic["contact_stiffness"].values
    assert elastic[2] == elastic[3] > elastic[0]


def test_unloading_takes_the_largest_load_off_in_steps(surface):
    result = rl.assess(rl.Question(surface, PAIR, loads=["8 N", "2 N"], unload=True))
    falling = [6.0, 4.0, 2.0, 0.8, 0.0]
    assert result.curve_as_asked.force == pytest.approx([8.0, 2.0, *falling])
    assert result.headings[2:] == [
        *(f"unloaded to {share}%" for share in (75, 50, 25, 10)),
        "unloaded",
    ]
    assert result.largest == 0
    depth = result.answers["depth"].values
    assert (np.diff(depth[[0, *range(2, 7)]]) < 0).all()
    assert depth[-1] > 0
    alone = rl.press(surface, E_star=result.curve.E_star, hardness=H, forces=[2.0, 8.0, *falling])
    assert result.curve.depth.tolist() == alone.depth.tolist()


def test_theories_stand_beside_an_unloading(surface):
    """At each load once, rising, so that the last is the largest; none where nothing touches."""
    result = rl.assess(
        rl.Question(surface, PAIR, loads=["8 N", "2 N"], ask=rl.Theories("persson"), unload=True)
    )
    (persson,) = result.theories
    assert persson.pressure * result.area == pytest.approx([0.8, 2.0, 4.0, 6.0, 8.0])
    assert (np.diff(persson.area_fraction) > 0).all()


def test_depths_rise_and_fall_too(surface):
    depths = ["0.5 um", "1 um", "0.9 um", "0.1 um"]
    result = rl.assess(rl.Question(surface, PAIR, depths=depths, history=True))
    assert result.largest == 1
    force = result.answers["normal_force"].values
    assert force[2] < force[1]
    assert force[3] == 0  # its indentations are deeper
    low, high = result.hardness_scatter["normal_force"]
    assert low[1] < 1 < high[1]  # what a depth takes depends on the hardness


def test_the_curve_of_a_report_leads_up_to_the_history(surface):
    question = rl.Question(surface, PAIR, loads=["4 N", "8 N", "1 N"], history=True)
    alone = rl.assess(question)
    whole = rl.assess(evolve(question, whole_curve=True))
    assert whole.curve.force.size > 3 + 10
    assert whole.curve.force[-3:].tolist() == [4.0, 8.0, 1.0]
    for key in ("unloading_stiffness", "contact_area"):
        # lighter loads before change nothing, to the tolerance of the sets
        assert whole.answers[key].values == pytest.approx(alone.answers[key].values, rel=1e-3)


def test_a_contact_slides_back_as_it_unloads(surface):
    """Against the unloading branch itself, pressed as a dense history."""
    question = rl.Question(surface, PAIR, loads="10 N", ask=rl.Friction(0.3), whole_curve=True)
    slip = rl.assess(question).partial_slip
    pair = question.pair
    back = 10.0 * np.append(np.geomspace(1, 1e-3, 40), 0.0)
    curve = rl.press(surface, E_star=pair.E_star, hardness=H, forces=back)
    rising = slice(None, None, -1)
    depth = (curve.depth - curve.depth[-1])[rising]
    displacement, force = partial_slip(
        depth[1:], curve.force[rising][1:], pair.E_star, pair.G_star, 0.3
    )
    assert slip.force[-1] == pytest.approx(3.0)
    # straight lines between the loads of both curves
    expected = np.interp(slip.displacement, displacement, force)
    assert slip.force == pytest.approx(expected, abs=0.01 * 3.0)
    elastic = rl.assess(evolve(question, elastic=True)).partial_slip
    assert slip.displacement[-1] < 0.8 * elastic.displacement[-1]  # what yielded does not slide


@pytest.mark.parametrize("solved", [1, 2, 3])
def test_interrupted_in_the_variants_the_answers_stay_and_lose_their_intervals(
    surface, monkeypatch, solved
):
    """Of what the scatter leaves open nothing is known, so narrower intervals are not shown."""
    original, count = variants.press, []

    def press(*arguments, progress, **named):
        count.append(named["hardness"])

        def stop(done, total):
            if len(count) > solved:
                raise KeyboardInterrupt

        return original(*arguments, progress=stop, **named)

    monkeypatch.setattr(variants, "press", press)
    result = rl.assess(rl.Question(surface, PAIR, loads=["2 N", "20 N"]))
    assert result.interrupted
    assert result.curve.converged.all()
    assert result.intervals is None
    assert np.isfinite(result.answers["constriction_resistance"].values).all()
    assert all(each.ends is None for each in result.answers.values())
    assert bool(result.elastic) == (solved > 2)  # after itself and the flat punch
    assert any(
        "interrupted before the effect of that on the answers was known" in note
        for note in result.notes
    )


@pytest.mark.parametrize("n", [32, 64])
def test_filled_maps_and_two_bodies_yield_too(tmp_path, n):
    rough = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(n, 3)
    heights, file = rough.heights.copy(), tmp_path / "holed.npy"
    heights[10:13, 20:25] = np.nan
    np.save(file, heights)
    reading = rl.Reading(unit="m", sizes="1 mm")
    asked = {"against": file, "reading": reading, "grid_error": True, "fields": False}
    result = rl.assess(rl.Question(file, PAIR, loads="10 N", **asked))
    assert result.curve.hardness == H
    assert result.answers["plastic_fraction"].values > 0
    for key in ("unloading_stiffness", "interface_stiffness"):
        answer = result.answers[key]
        assert answer.low < answer.values < answer.high
    assert any("filled by nearest instead" in note for note in result.notes)


@pytest.mark.parametrize("n", [32, 64])
def test_the_interface_of_a_map_springs_back_with_the_surface_around_it(n):
    """Its interval holds the variants of the periodic half-space, which it follows from."""
    length, q_roll = n * 62.5e-6, math.tau / 125e-6
    spectrum = rl.SelfAffine(hurst=0.7, length=length, rms_height=1e-6, q_roll=q_roll)
    piece = spectrum.surface(4 * n, 3).cropped((0, n), (0, n)).detrended()
    result = rl.assess(rl.Question(piece, PAIR, loads="5 MPa", grid_error=True))
    k_i = result.answers["interface_stiffness"]
    for value in (H / FACTOR, H, H * FACTOR):
        curve = rl.press(
            piece,
            E_star=result.curve.E_star,
            hardness=value,
            forces=[5e6 * piece.area],
            periodic=True,
        )
        assert k_i.low < curve.unloading_stiffness < k_i.high
        if value == H:
            assert k_i.values == pytest.approx(curve.unloading_stiffness, rel=1e-6)
    # the hardness is the same for all maps of a part, so none of its scatter averages out
    low, high = result.hardness_scatter["interface_stiffness"]
    nothing = Differences((np.zeros(1),) * 2, (np.zeros(1),) * 2)
    missed, _ = ends_in_common(result, BehindMaps(None, nothing, nothing))
    missed_low, missed_high = missed["interface_stiffness"]
    assert k_i.low < missed_low < k_i.values * low
    assert k_i.high > missed_high > k_i.values * high


@pytest.mark.parametrize("n", [16, 32])
def test_a_part_of_several_maps_is_unloaded(n):
    rough = rl.SelfAffine(hurst=0.7, length=n * 62.5e-6, rms_height=1e-6).surface(2 * n, 3)
    maps = [rough.cropped((0, n), (i, i + n)).detrended() for i in (0, n)]
    asked = {"loads": ["2 MPa", f"{0.8 * H:g} Pa"], "unload": True, "grid_error": True}
    part = rl.assess(rl.Question(maps, PAIR, fields=False, **asked))
    assert part.headings[-1] == "unloaded"
    assert part.largest == 1
    k = part.answers["unloading_stiffness"]
    assert k.mean[-1] == 0 or np.isnan(k.mean[-1])  # nothing touches
    assert np.isfinite(k.mean[:-1]).all()
    assert k.low[0] < k.mean[0] < k.high[0]
    scatter = [each.hardness_scatter["unloading_stiffness"] for each in part.assessments]
    assert k.low[0] < k.mean[0] * max(low[0] for low, _ in scatter)
    assert k.high[0] > k.mean[0] * min(high[0] for _, high in scatter)


def test_the_mean_of_elastic_bodies_stands_beside_that_of_a_part(surface):
    """Of all maps; one in which nothing yields gives its own."""
    smooth = replace(surface, heights=surface.heights / 1000)
    asked = {"loads": ["0.5 N"], "grid_error": False, "fields": False}
    part = rl.assess(rl.Question([surface, smooth], "alumina hardness=0.1 GPa, glass", **asked))
    assert [bool(each.elastic) for each in part.assessments] == [True, False]
    yields, stays = part.assessments
    for key in ("contact_stiffness", "unloading_stiffness", "contact_area_fraction"):
        expected = np.sqrt(yields.elastic[key].values * stays.answers[key].values)
        assert part.elastic[key].mean == pytest.approx(expected), key
    alike = [replace(surface, heights=surface.heights * (1 + 0.001 * i)) for i in range(3)]
    part = rl.assess(rl.Question(alike, "alumina hardness=0.1 GPa, glass", **asked))
    said = elastic_in_words(part)
    assert said.startswith("for comparison, if nothing yielded: ")
    assert "contact area fraction" in said
    rows = [row[0] for row in answer_table(part, [0], with_elastic=True)[1]]
    assert rows[rows.index("contact area fraction A/A_0") + 1] == "if nothing yielded"
    alone = rl.assess(rl.Question([smooth], "alumina,glass", **asked))
    assert alone.elastic == {}
    assert elastic_in_words(alone) == ""


@pytest.mark.parametrize("n", [128, 256])
def test_a_large_map_is_judged_on_half_as_many_points_a_side(monkeypatch, n):
    """Ratios of other hardnesses to the table's agree within a few per cent of those of all."""
    side = n / 256  # of five roll-offs [mm]
    waves = {"q_roll": math.tau / (side * 2e-4), "q_high": math.tau / 3e-5}
    rough = rl.SelfAffine(hurst=0.8, length=side * 1e-3, rms_height=side * 1e-6, **waves).surface(
        n, 5
    )
    question = rl.Question(
        rl.Surface(rough.heights, rough.sizes, "m"), PAIR, loads=["3 MPa", "30 MPa"], fields=False
    )
    on_all = rl.assess(question)
    monkeypatch.setattr(cases, "HALVED_FROM", n**2)
    solved = []
    original = variants.press
    monkeypatch.setattr(
        variants, "press", lambda body, **k: solved.append(body.shape) or original(body, **k)
    )
    on_half = rl.assess(question)
    half = n // 2
    # itself, elastic and three hardnesses, and the flat punches of both grids
    assert sorted(solved) == [(half, half)] * 4 + [(n, n)] * 3
    for key in ("unloading_stiffness", "contact_area", "thermal_conductance_per_area"):
        for found, wanted in zip(
            on_half.hardness_scatter[key], on_all.hardness_scatter[key], strict=True
        ):
            assert found == pytest.approx(wanted, rel=0.05), key
        assert on_half.answers[key].values.tolist() == on_all.answers[key].values.tolist()


def test_the_cost_of_all_variants_is_told_before(surface, monkeypatch):
    from roughline.assessment import cost

    monkeypatch.setattr(cost, "_ANNOUNCED_POINTS", 1)
    told = []

    def stop(text):  # as Ctrl-C does, before anything is pressed
        told.append(text)
        raise KeyboardInterrupt

    for asked in ({}, {"hardness": H}, {"elastic": True}):
        question = rl.Question(surface, PAIR, loads="1 N", **asked)
        with pytest.raises(KeyboardInterrupt):
            rl.assess(question, announce=stop)
    of_hardness = "for elastic bodies and the scatter of the hardness if points yield"
    assert [of_hardness in each for each in told] == [True, True, False]


def test_a_line_scan_has_no_yield_and_says_how_far_it_serves():
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3)
    scan = rl.Line(surface.heights[0], 1e-3, "m", kind="profile")
    result = rl.assess(rl.Question(scan, PAIR, loads="1 N"))
    assert result.curve.hardness is None
    most = 0.8 * H / result.curve.E_star
    (said,) = (each for each in result.warnings if "the reduced model has no yield" in each)
    assert f"rms slopes over 0.8 H / E* = {most:.2g} exceed" in said
    assert f"the rms slope of the scan is {scan.rms_slope:.2g}, so these elastic answers do" in said
    smooth = replace(scan, heights=scan.heights * 0.5 * most / scan.rms_slope)
    result = rl.assess(rl.Question(smooth, PAIR, loads="1 N"))
    (said,) = (each for each in result.notes if "the reduced model has no yield" in each)
    assert said.endswith(f"the rms slope of the scan is {0.5 * most:.2g}")
    for asked in ({"hardness": "1 GPa"}, {"history": True}, {"unload": True}):
        with pytest.raises(
            rl.InputError, match="belong to a surface; the reduced model"
        ) as refusal:
            rl.Question(scan, PAIR, loads="1 N", **asked)
        (name,) = asked
        assert f"leave {name}={'' if name == 'hardness' else True} out" in str(refusal.value)


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"hardness": 0}, "hardness is 0; a positive pressure is needed"),
        ({"hardness": "-2 GPa"}, 'hardness is "-2 GPa"; a positive pressure is needed'),
        ({"hardness": math.nan}, "hardness is nan; a positive pressure is needed"),
        ({"hardness": "5 m"}, 'hardness is "5 m", which is no quantity in Pa'),
        ({"hardness": "5"}, 'hardness is "5", without a unit'),
        ({"hardness": "1,5 GPa"}, "numbers take a decimal point"),
        ({"hardness": 1e9, "elastic": True}, "hardness= and elastic=True contradict each other"),
        ({"loads": (), "history": True}, "history=True needs loads= or depths="),
        ({"loads": [0, 1.0], "history": True}, "and zero only to unload after others"),
        ({"loads": [1.0, 0]}, "loads is 0; give positive ones"),
        ({"unload": True, "history": True}, "write the falling values yourself"),
        ({"unload": True, "loads": (), "depths": "1 um"}, "the falling values yourself"),
    ],
)
def test_hardness_and_histories_that_cannot_be_are_refused(asked, message):
    with pytest.raises(rl.InputError, match=re.escape(message)):
        rl.Question("nowhere.x3p", PAIR, **{"loads": "1 N", **asked})
