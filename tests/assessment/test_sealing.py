"""Answers about a fluid in the gap: from the map to the leak of the seal."""

import json
import re

import numpy as np
import pytest
from attrs import evolve

import roughline as rl
from roughline.assessment import cost
from roughline.fluid import measures
from roughline.fluid.rarefied import Rarefied
from roughline.report.contact_tables import symbol_table
from roughline.report.fields_of_load import _flow_caption
from roughline.report.json_output import assessment_json, to_json
from roughline.report.terminal import print_assessment
from roughline.report.typeset import formula_in_symbols
from roughline.units import engineering

LOADS = ["20 MPa", "60 MPa"]
ASKED = {"inlet": "6 bar", "outlet": "1 bar", "seal": "100 mm x 2 mm"}
WATER, HELIUM = rl.Fluid("water", **ASKED), rl.Fluid("helium", **ASKED)
GAS_CONSTANT = 8.314462618


@pytest.fixture(scope="module")
def surface():
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=5e4, q_high=4e5)
    return spectrum.surface(64, rng=7)


def asked(surface, ask, **more):
    given = {"loads": LOADS, "periodic": True, "elastic": True, "grid_error": False, **more}
    return rl.assess(rl.Question(surface, "steel,steel", ask=ask, **given))


@pytest.fixture(scope="module")
def kept(surface):
    """Fields of the same loads."""
    E_star = rl.contact_modulus(rl.material("steel"), rl.material("steel"))
    forces = [20e6 * surface.area, 60e6 * surface.area]
    return rl.press(surface, E_star=E_star, forces=forces, periodic=True, fields=True).fields


def flows(kept, along, path=0.0):
    return [rl.flow(each, each.sizes, along=along, mean_free_path=path) for each in kept]


def test_a_liquid_leaks_as_reynolds_says(surface, kept):
    answers = asked(surface, WATER).answers
    apertures = [[flow.hydraulic_aperture for flow in flows(kept, along)] for along in "xy"]
    u_h = np.max(apertures, axis=0)
    assert answers["hydraulic_aperture"].values == pytest.approx(u_h, rel=1e-9)
    assert answers["hydraulic_aperture_x"].values == pytest.approx(apertures[0], rel=1e-9)
    assert answers["hydraulic_aperture_y"].values == pytest.approx(apertures[1], rel=1e-9)
    eta = rl.Fluid("water").fluid.viscosity
    leak = 50 * u_h**3 * 5e5 / (12 * eta)
    assert answers["leak_rate"].values == pytest.approx(leak, rel=1e-9)
    assert answers["leak_rate"].unit == "m³/s"
    assert "water" in answers["leak_rate"].validity
    assert not {"leak_mass", "leak_throughput", "gas_conductance"} & {*answers}


def test_a_gas_expands_and_slips(surface, kept):
    """Its mass follows from the squares of pressures, and from its free path at the mean one."""
    answers = asked(surface, HELIUM).answers
    gas = rl.Fluid("helium").fluid
    path = gas.mean_free_path(3.5e5)
    found = [[flow.hydraulic_aperture for flow in flows(kept, along, path)] for along in "xy"]
    u = np.max(found, axis=0)
    assert answers["aperture_with_slip"].values == pytest.approx(u, rel=1e-9)
    assert (u > answers["hydraulic_aperture"].values).all()
    throughput = 50 * u**3 * (6e5**2 - 1e5**2) / (24 * gas.viscosity)
    assert answers["leak_throughput"].values == pytest.approx(10 * throughput, rel=1e-9)
    mass = throughput * gas.molar_mass / (GAS_CONSTANT * 293.15)
    assert answers["leak_mass"].values == pytest.approx(mass, rel=1e-9)
    assert "leak_rate" not in answers


@pytest.mark.parametrize("outlet", ["0 bar", "1 bar"])
def test_a_rare_gas_leaks_as_plates_of_its_aperture_do(surface, outlet):
    """Value and ends are those of the aperture, into a vacuum too."""
    body = rl.Surface(surface.heights, surface.sizes, "m")
    ask = rl.Fluid("helium", **ASKED | {"outlet": outlet}, along="x")
    found = asked(body, ask, grid_error=True, loads=["60 MPa"])
    gas, second = ask.fluid, ask.outlet
    mean = (6e5 + second) / 2
    along = Rarefied(gas.mean_free_path(mean), (6e5 - second) / (6e5 + second))
    through = along.plates(found.measured["hydraulic_aperture_x"].rows[:, 0])
    expected = 10 * 50 * through * (6e5**2 - second**2) / (24 * gas.viscosity)
    leak = found.answers["leak_throughput"]
    ends = [leak.values[0], leak.low[0], leak.high[0]]
    assert ends == pytest.approx(expected, rel=1e-9)
    assert leak.low[0] < leak.values[0] < leak.high[0]


def test_a_vacuum_on_both_sides_is_refused():
    with pytest.raises(rl.InputError, match="enters where its pressure is higher"):
        rl.Fluid("helium", inlet="0 bar", outlet="0 bar", seal="100 mm x 2 mm")


def test_the_flow_of_a_gas_is_solved_once_for_each_load(surface, monkeypatch):
    solved = []
    monkeypatch.setattr(
        measures, "flow", lambda *given, **named: solved.append(named) or rl.flow(*given, **named)
    )
    asked(surface, HELIUM)
    assert [each["along"] for each in solved] == ["both"] * len(LOADS)


def test_the_flow_factor_is_that_of_patir_and_cheng(surface, kept):
    answers = asked(surface, rl.Fluid("water", along="x")).answers
    factor = (answers["hydraulic_aperture"].values / answers["mean_gap"].values) ** 3
    assert answers["pressure_flow_factor"].values == pytest.approx(factor, rel=1e-9)
    assert (factor < 1).all()
    assert "along x" in answers["hydraulic_aperture"].name
    assert "hydraulic_aperture_x" not in answers
    assert "leak_rate" not in answers  # no pressures and no seal


def test_gas_conducts_beside_the_spots(surface, kept):
    answers = asked(surface, [rl.Fluid("air")]).answers
    gas = rl.Fluid("air").fluid
    jump = gas.temperature_jump(101325.0)
    expected = [
        gas.conductivity * np.where(each.contact, 0.0, 1 / (each.gap + jump)).mean()
        for each in kept
    ]
    found = answers["gas_conductance"].values
    assert found == pytest.approx(expected, rel=1e-5)
    h_c = answers["thermal_conductance_per_area"].values
    assert answers["joint_conductance"].values == pytest.approx(h_c + found, rel=1e-12)


def test_without_a_fluid_no_flow_is_solved(surface, monkeypatch):
    def refuse(*_given, **_named):
        raise AssertionError("a flow is solved")

    monkeypatch.setattr(measures, "flow", refuse)
    answers = asked(surface, []).answers
    assert "mean_gap" in answers
    assert not [each for each in answers.values() if each.rule.group == "sealing"]


def test_grid_and_hardness_are_in_the_interval_of_the_leak(surface):
    result = asked(surface, WATER, elastic=False, grid_error=True)
    leak, u_h = result.answers["leak_rate"], result.answers["hydraulic_aperture"]
    assert (leak.low < leak.values).all()
    assert (leak.values < leak.high).all()
    least, most = result.hardness_scatter["leak_rate"]
    assert (least < 1).all()
    assert (most > 1).all()
    ratio = leak.high / leak.values
    assert ratio == pytest.approx((u_h.high / u_h.values) ** 3, rel=1e-9)


def test_sealed_is_exactly_zero_and_says_what_the_grid_leaves_open(surface, capsys):
    """Under so large a load that no path is left on this grid, but one may be on a finer one."""
    rough = rl.SelfAffine(hurst=0.5, length=1e-3, rms_height=1e-6, q_roll=5e4).surface(64, rng=3)
    E_star = rl.contact_modulus(rl.material("steel"), rl.material("steel"))
    load = f"{0.3 * E_star * rough.rms_slope / 1e6} MPa"
    result = asked(rough, WATER, loads=[load], grid_error=True)
    leak = result.answers["leak_rate"]
    assert leak.values[0] == 0
    assert leak.low[0] == 0
    assert leak.high[0] > 0
    print_assessment(result)
    said = capsys.readouterr().out
    assert "0 m³/s (up to " in said or "0 m³/s  (up to " in said
    assert "no path leads through the map" in said
    assert json.loads(to_json(assessment_json(result)))["answers"]["Q"]["values"] == [0.0]


def test_what_dents_seal_on_the_way_back_is_not_said_to_be_sealed_from_there_on():
    """On first loading the same load leaves a path."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2.5e-7, q_roll=5e4)
    given = {"periodic": True, "grid_error": False, "ask": WATER}
    loads = ["120 MPa", "300 MPa", "120 MPa"]
    said = {}
    for history in (True, False):
        question = rl.Question(
            spectrum.surface(32, rng=3),
            "steel,copper",
            loads=loads if history else loads[:2],
            history=history,
            **given,
        )
        found = rl.assess(question)
        apertures = found.answers["hydraulic_aperture"].values
        assert (apertures > 0).tolist() == [True, False, False][: apertures.size]
        (said[history],) = [each for each in found.notes if "no path leads" in each]
    assert "through the map from 300 MPa on:" in said[False]
    assert "under 2 of 3 loads, which are from 120 MPa to 300 MPa:" in said[True]


def test_one_channel_that_carries_half_of_the_flow_is_told(surface):
    heights = np.zeros((64, 64))
    heights[:, 20:24] = -1e-5  # a groove along x through a flat plateau
    grooved = rl.Surface(heights, (1e-3, 1e-3), unit="m", is_cut_out=False)
    result = asked(grooved, rl.Fluid("water", along="x"), loads=["10 MPa"])
    assert result.answers["largest_channel"].values == pytest.approx([1.0])
    (told,) = [each for each in result.warnings if "single channel" in each]
    assert "100% of the flow" in told


def test_of_a_map_it_is_that_of_the_map_that_goes_on(surface):
    """A joint's load on a map that was cut out: the gap is that of the periodic half-space."""
    piece = surface.cropped((0, 32), (0, 32))
    alone = asked(piece, WATER, periodic=False)
    joint = asked(piece, [WATER, rl.Joint("4 mm^2")], periodic=False)
    assert alone.answers["leak_rate"].values == pytest.approx(joint.answers["leak_rate"].values)
    assert not alone.curve.measured


@pytest.mark.parametrize(
    ("points", "shares"), [(32, [0.02, 0.14]), (48, [0.02, 0.08, 0.14, 0.18])], ids=["32", "48"]
)
def test_the_interval_of_one_map_holds_the_leak_of_the_part(points, shares):
    """Of a whole part, nine maps large, the truth is the flow through its own gap."""
    spectrum = rl.SelfAffine(hurst=0.7, length=3e-4, rms_height=1e-6, q_roll=3e5, q_high=1e6)
    part = spectrum.surface(3 * points, rng=11)
    E_star = rl.contact_modulus(rl.material("steel"), rl.material("steel"))
    pressures = E_star * part.rms_slope * np.array(shares)
    measures = [rl.hydraulic_aperture("x"), rl.hydraulic_aperture("y"), rl.MEAN_GAP]
    truth = rl.press(
        part, E_star=E_star, forces=pressures * part.area, periodic=True, measures=measures
    )
    loads, ask = [f"{each} Pa" for each in pressures], [rl.Fluid("water"), rl.Joint(part.area)]
    piece = part.cropped((0, points), (0, points))
    result = asked(piece, ask, loads=loads, periodic=False, grid_error=True)
    for measure in measures:
        answer, true = result.answers[measure.name], truth.measured[measure.name].values
        assert (answer.low <= true).all(), measure.name
        assert (true <= answer.high).all(), measure.name
        low, high = result.larger.spreads["grid"].measures[measure.name]
        assert (answer.high > high).all()
        assert (answer.low <= low).all()
    assert "of a joint 3 times" in result.answers["hydraulic_aperture"].validity


@pytest.mark.parametrize(("loads", "along"), [(LOADS[1:], "x"), (LOADS, "both")])
def test_a_seal_much_longer_than_a_map_without_roll_off_has_no_interval(surface, loads, along):
    piece = surface.cropped((0, 32), (0, 32))
    short, long = (
        asked(
            piece,
            rl.Fluid("water", **ASKED | {"seal": seal}, along=along),
            loads=loads,
            grid_error=True,
        )
        for seal in ("4 mm x 4 mm", "100 mm x 10 mm")
    )
    assert (short.answers["leak_rate"].high > short.answers["leak_rate"].values).all()
    assert "of a seal 8 times as long as the map" in short.answers["leak_rate"].validity
    assert long.answers["leak_rate"].low is None
    assert "what its longer waves do is not known" in long.answers["leak_rate"].validity
    (said,) = (each for each in long.warnings if each.startswith("what leaks has no interval"))
    assert "times as long as the map, which shows no roll-off" in said
    assert not any("what leaks has no interval" in each for each in short.warnings)


def test_of_maps_of_which_one_is_sealed_the_leakiest_places_are_told(surface):
    flat = rl.Surface(0.005 * surface.heights, surface.sizes, "m", is_cut_out=False)
    part = asked([surface, flat], WATER)
    assert np.isnan(part.answers["leak_rate"].mean).all()
    (told,) = [each for each in part.warnings if "hangs on the leakiest places" in each]
    assert "under 20 MPa, map 2 let nothing through" in told


def test_several_maps_have_one_leak(surface):
    maps = [surface.cropped((x, x + 32), (0, 32)) for x in (0, 32)]
    part = asked(maps, WATER)
    assert part.answers["leak_rate"].count.tolist() == [2, 2]


@pytest.mark.parametrize(("points", "along"), [(32, "x"), (64, "both")])
def test_the_pressure_that_seals_is_an_answer_with_its_interval(surface, points, along):
    surface = surface.cropped((0, points), (0, points))
    ask = rl.Fluid(along=along, closure=True)
    result = asked(surface, ask, elastic=False, grid_error=True)
    seals = result.answers["sealing_pressure"]
    assert (seals.values == seals.values[0]).all()
    found = result.sought.closing.pressure
    assert found.low < seals.values[0] < found.high
    assert seals.low[0] < found.low
    assert found.high < seals.high[0]
    curve = result.curve
    repeated = rl.Homogeneous(curve.E_star, periodic=True)
    given = {"half_space": repeated, "law": rl.Yielding(curve.hardness), "along": along}
    alone = rl.sealing_pressure(surface, rtol=0.02, interval=False, **given)
    assert found.value == pytest.approx(alone.value)
    least, most = result.hardness_scatter["sealing_pressure"]
    assert least[0] < 1 < most[0]
    assert 0 <= result.answers["reopening"].values[0] < 1
    assert "leak_rate" not in result.answers


@pytest.mark.parametrize("given", [{}, {"elastic": False, "hardness": "4 GPa"}])
@pytest.mark.parametrize("points", [32, 64])
def test_ten_times_as_much_of_a_liquid_leaks_again_whatever_the_fluid(surface, points, given):
    """Of a gas in the gap the aperture is another; what the load has left is pressed as it is."""
    surface = surface.cropped((0, points), (0, points))
    gas = rl.Fluid("helium", inlet="1.1 bar", outlet="0 bar", seal="9 mm x 2 mm", closure=True)
    result = asked(surface, gas, loads=["20 N", "400 N"], **given)
    found = result.sought.closing.reopening
    pressed = rl.press(
        surface,
        E_star=result.curve.E_star,
        periodic=True,
        hardness=result.curve.hardness,
        forces=[result.curve.force[-1]],
    )
    alone = rl.reopening(pressed, rtol=0.02)
    assert (found.low, found.high) == (alone.low, alone.high)
    assert 0 < found.low < found.high < 1


def test_ctrl_c_while_it_is_sought_keeps_the_curve(surface, monkeypatch):
    def stop(*_given, **_named):
        raise KeyboardInterrupt

    monkeypatch.setattr("roughline.assessment.sought.sealing_pressure", stop)
    result = asked(surface, rl.Fluid(closure=True))
    assert result.interrupted
    assert "sealing_pressure" not in result.answers
    assert np.isfinite(result.answers["contact_stiffness"].values).all()


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: rl.Fluid("watr"), "water"),
        (lambda: rl.Fluid("water", inlet="-1 bar"), "inlet is .*zero in vacuum"),
        (lambda: rl.Fluid("water", inlet="6 m"), "inlet is .*no quantity in Pa"),
        (lambda: rl.Fluid("water", inlet="6 barg"), "add that of the air"),
        (lambda: rl.Fluid("water", along="z"), 'along is "z"; allowed are "both", "x" and "y"'),
        (lambda: rl.Fluid(), "give one of fluid= and closure=True"),
        (lambda: rl.Fluid(along="x"), "give one of fluid= and closure=True"),
        *(
            (lambda name=name: rl.Fluid(**{name: ASKED[name]}), f"{name}= belongs to a fluid")
            for name in ASKED
        ),
        (lambda: rl.Fluid("water", inlet="6 bar"), "a leak needs seal= beside inlet="),
        (lambda: rl.Fluid("water", seal="1 mm x 1 mm"), "a leak needs inlet= beside seal="),
        (lambda: rl.Fluid("water", **ASKED | {"inlet": "1 bar"}), "pressure is higher"),
        (lambda: rl.Fluid(closure=True).medium, "fluid is not named; give one"),
        (lambda: [rl.Fluid("water"), rl.Fluid("air")], "several"),
    ],
)
def test_what_cannot_be_asked_is_refused_in_one_line(surface, ask, said):
    with pytest.raises(rl.InputError, match=said) as refused:
        rl.Question(surface, "steel,steel", loads=LOADS, ask=ask())
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("ask", [rl.Fluid("water"), rl.Fluid(closure=True)])
def test_it_needs_materials_and_a_surface(surface, ask):
    with pytest.raises(rl.InputError, match="needs two materials"):
        rl.Question(surface, E_star="100 GPa", loads=LOADS, ask=ask)
    line = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).line(256, rng=7)
    with pytest.raises(rl.InputError, match="in one dimension, any contact stops"):
        rl.Question(line, "steel,steel", loads=["1 N"], ask=ask)


def sealed_by(inlet, loads, fluid="water", outlet="1.01325 bar"):
    """Rubber, which a fluid may lift, but is taken not to."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2e-5, q_roll=5e4, q_high=2e5)
    body = spectrum.surface(32, rng=7)
    ask = rl.Fluid(fluid, inlet=inlet, outlet=outlet, seal="100 mm x 2 mm", carries=False)
    given = {"loads": loads, "periodic": True, "grid_error": False}
    return rl.assess(rl.Question(body, "rubber,steel", ask=ask, **given))


def test_a_fluid_that_lifts_the_bodies_leaves_no_leak_and_says_so():
    """Water at 6 bar is 0.25 MPa above the outside in the mean of the gap."""
    lifted = sealed_by("6 bar", ["0.1 MPa", "0.2 MPa"])
    assert "leak_rate" not in lifted.answers
    assert "hydraulic_aperture" in lifted.answers
    said = lifted.warnings[0]
    assert lifted.facts[0].is_grave
    assert not any("no path leads" in each for each in lifted.notes)
    assert said.startswith("no leak rate: water at 249.3 kPa above the outside, in the mean of")
    partly = sealed_by("6 bar", ["0.2 MPa", "0.3 MPa"])
    assert np.isnan(partly.answers["leak_rate"].values).tolist() == [True, False]
    assert partly.warnings[0].startswith("no leak rate under 50% of the loads: ")
    assert any("carries up to 83% of the load" in each for each in partly.warnings)


@pytest.mark.parametrize(
    ("inlet", "outlet", "fluid", "share"),
    [
        ("1.5 bar", "1.01325 bar", "water", 0.122),
        ("1.4 bar", "1.01325 bar", "water", None),
        ("1 bar", "0 bar", "air", None),  # the outside presses as well
        ("1.5 bar", "1.01325 bar", "air", 0.126),  # the square of its pressure falls evenly
    ],
)
def test_a_fluid_that_carries_a_tenth_of_the_load_is_told(inlet, outlet, fluid, share):
    found = sealed_by(inlet, ["0.2 MPa"], fluid, outlet)
    said = [each for each in found.warnings if "of the load, which no answer includes" in each]
    assert [f"carries up to {share:.0%}" in each for each in said] == ([True] if share else [])


def test_a_liquid_in_a_gap_of_molecules_is_told(surface):
    flat = rl.Surface(2e-3 * surface.heights, surface.sizes, "m", is_cut_out=False)
    for body, told in ((surface, False), (flat, True)):
        said = " ".join(asked(body, WATER, loads=["0.5 MPa"]).warnings)
        assert ("ten molecules or so" in said) == told


def test_inertia_is_told_where_it_counts(surface):
    """Water under 5 bar through 2 mm creeps in gaps of 2 µm, and not in those of 11 µm."""
    rough = rl.Surface(5 * surface.heights, surface.sizes, "m", is_cut_out=False)
    for body, told in ((surface, False), (rough, True)):
        assert ("inertia" in " ".join(asked(body, WATER).warnings)) == told


@pytest.mark.parametrize("ask", [WATER, HELIUM])
def test_every_symbol_of_its_formulas_is_on_the_page(surface, ask):
    result = asked(surface, ask)
    _, rows = symbol_table(result)
    told = {row[0] for row in rows} | {each.symbol for each in result.answers.values()}
    for key in ("leak_rate", "leak_throughput", "leak_mass", "gas_conductance"):
        if key in result.answers:
            letters = re.findall(r"[A-Za-z]+(?:_[a-z]+)?\d?", result.answers[key].formula)
            words = {"at", "C", "of", "the", "open", "gap", "temperature", "jump", "length"}
            left = {*letters} - words - {"with", "slip"}
            assert {*map(formula_in_symbols, left)} <= told


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        ("100 mm x 2 mm", {"W": "100 mm", "B": "2 mm"}),
        ("20 mm .. 24 mm", {"W/B": "34.46"}),
    ],
)
def test_the_seal_of_its_formulas_has_its_values_on_the_page(surface, shape, expected):
    ask = rl.Fluid("water", inlet="6 bar", seal=shape)
    _, rows = symbol_table(asked(surface, ask, loads="20 MPa"))
    found = {symbol: value for symbol, _, value in rows}
    assert {each: found.get(each) for each in ("W", "B", "W/B") if each in found} == expected


def test_the_aperture_with_slip_is_that_of_the_pictures_of_a_gas(surface):
    result = asked(surface, HELIUM, loads="60 MPa")
    apertures = [flow.hydraulic_aperture for flow in result.flows]
    assert result.answers["aperture_with_slip"].values == pytest.approx(max(apertures), rel=1e-9)
    assert "aperture_with_slip" not in asked(surface, WATER, loads="60 MPa").answers
    text = _flow_caption(result, 0)
    u_h = result.answers["hydraulic_aperture_x"].values[0]
    assert f"along the seal, it is {engineering(u_h, 'm', 3)} along x and" in text


def test_the_temperature_jump_is_that_at_the_mean_pressure(surface):
    _, rows = symbol_table(asked(surface, HELIUM))
    (row,) = (row for row in rows if row[0] == "M")
    wanted = rl.Fluid("helium").fluid.temperature_jump(3.5e5)
    assert engineering(wanted, "m") in row


def test_a_gas_in_the_gap_is_not_said_to_be_missing(surface):
    assert not [note for note in asked(surface, HELIUM).notes if "as in vacuum" in note]
    assert [note for note in asked(surface, WATER).notes if "as in vacuum" in note]


@pytest.mark.parametrize("points", [32, 64])
def test_a_surface_that_yielded_leaks_less_on_the_way_back(surface, points):
    """Its dents keep channels narrow: at each load less leaks than when the load rose."""
    surface = surface.cropped((0, points), (0, points))
    ask = evolve(WATER, along="x")
    given = {"elastic": False, "loads": ["60 MPa"]}
    back = asked(surface, ask, unload=True, **given).answers["leak_rate"].values
    assert (np.diff(back[:-1]) > 0).all()  # from the largest load down
    assert np.isnan(back[-1])  # without a load, water lifts the bodies
    rising = asked(surface, ask, **given | {"loads": ["45 MPa", "30 MPa", "15 MPa"]})
    assert (back[1:4] < rising.answers["leak_rate"].values).all()


@pytest.mark.parametrize("points", [64, 1024])
def test_what_flows_is_in_the_cost_that_is_told(monkeypatch, points):
    """Nothing is pressed: Ctrl-C comes as soon as the cost is told."""
    if points < 1024:
        monkeypatch.setattr(cost, "_ANNOUNCED_POINTS", 1)  # else it is not told of so few
    large = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(points, rng=1)
    told = []

    def stop(text):
        told.append(text)
        raise KeyboardInterrupt

    for ask in ([], WATER, evolve(HELIUM, closure=True)):
        question = rl.Question(large, "steel,steel", loads=LOADS, elastic=True, ask=ask)
        with pytest.raises(KeyboardInterrupt):
            rl.assess(question, announce=stop)
    assert ["for what flows" in text for text in told] == [False, True, True]
    assert ["for the pressure that seals" in text for text in told] == [False, False, True]
