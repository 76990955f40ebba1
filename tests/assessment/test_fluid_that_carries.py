"""A fluid that carries a part of the load: the contact under p is that of what is left of it."""

import json

import numpy as np
import pytest
from scipy.integrate import quad
from typer.testing import CliRunner

import roughline as rl
from roughline.cli import app
from roughline.engineering.sealing import ATMOSPHERE
from roughline.question.from_fields import build_question
from roughline.report.json_output import assessment_json, to_json
from roughline.report.terminal import print_assessment

WATER, AIR = rl.Fluid("water").fluid, rl.Fluid("air").fluid
SEAL = "100 mm x 2 mm"
EXCESS = 6e5 / 2 - ATMOSPHERE / 2  # of water from 6 bar to the outside, in the mean [Pa]


@pytest.fixture(scope="module")
def body():
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2e-5, q_roll=5e4, q_high=2e5)
    return spectrum.surface(32, rng=7)


def fluid_of(fluid, inlet=6e5, outlet=None, **more):
    return rl.Fluid(fluid, inlet=inlet, outlet=outlet, seal=SEAL, **more)


def asked(body, loads, inlet="6 bar", *ask, carries=None, closes=False, **more):
    """Rubber on steel, with water that leaves at the pressure outside."""
    along = "x" if closes else "both"
    ask = [fluid_of("water", inlet, carries=carries, along=along, closure=closes), *ask]
    given = {"loads": loads, "periodic": True, "grid_error": False, **more}
    return rl.assess(rl.Question(body, "rubber,steel", ask=ask, **given))


def pressed_with_a_fluid(heights, pressure, fluid):
    """Pressures and gap of a periodic cell with a fluid in all that is open, on unit cells.

    Dense, with all pressures as unknowns: the fluid's where it is open, at least that in contact,
    and their mean is given. E* and the sides of cells are 1.
    """
    n = len(heights)
    q = 2 * np.pi * np.hypot(*np.meshgrid(np.fft.fftfreq(n), np.fft.fftfreq(n), indexing="ij"))
    q[0, 0] = np.inf  # the mean moves the bodies as a whole
    kernel = np.fft.ifft2(2 / q).real
    i, j = np.indices((n, n)).reshape(2, -1)
    K = kernel[(i[:, None] - i) % n, (j[:, None] - j) % n]
    h, closed = heights.ravel(), np.ones(n * n, bool)
    for _ in range(100):
        p = np.full(n * n, fluid)
        at, count = np.flatnonzero(closed), closed.sum()
        system = np.block([[K[np.ix_(at, at)], -np.ones((count, 1))], [np.ones((1, count)), 0]])
        known = h[at] - K[np.ix_(at, ~closed)] @ p[~closed]
        rest = pressure * n * n - fluid * (n * n - count)
        *p[at], rigid = np.linalg.solve(system, [*known, rest])
        gap = K @ p - h - rigid
        changed = (closed & (p < fluid)) | (~closed & (gap < 0))
        if not changed.any():
            return p.reshape(n, n), gap.reshape(n, n)
        closed ^= changed
    raise AssertionError("the contact was not found")


@pytest.mark.parametrize(("pressure", "fluid"), [(0.05, 0.02), (0.12, 0.1)])
def test_under_a_fluid_the_contact_is_that_of_what_is_left(pressure, fluid):
    """A uniform pressure in all that is open moves the mean alone, and all else is the excess."""
    n = 12
    heights = rl.SelfAffine(hurst=0.8, length=float(n), rms_height=0.3).surface(n, rng=3).heights
    total, gap = pressed_with_a_fluid(heights, pressure, fluid)
    assert 0 < (total > fluid).mean() < 0.9
    surface = rl.Surface(heights, (n, n))
    left = rl.press(
        surface,
        E_star=1.0,
        periodic=True,
        forces=[(pressure - fluid) * n * n],
        rtol=1e-11,
        fields=True,
    ).fields[0]
    assert total - fluid == pytest.approx(left.pressure, abs=1e-8 * pressure)
    assert np.maximum(gap, 0) == pytest.approx(left.gap, abs=1e-8 * np.ptp(heights))


def test_all_answers_of_the_contact_are_those_of_what_is_left(body):
    """Beside force and pressure, which are of the load, and what a fluid does."""
    wet = asked(body, ["0.6 MPa", "0.8 MPa"])
    given = {"loads": [f"{p - EXCESS} Pa" for p in (6e5, 8e5)], "periodic": True}
    ask = fluid_of("water", carries=False)
    dry = rl.assess(rl.Question(body, "rubber,steel", ask=ask, grid_error=False, **given))
    own = {"normal_force", "mean_pressure", "opening_pressure", "fluid_share", "leak_rate"}
    assert {*dry.answers} | {"fluid_share"} == {*wet.answers}
    for key in {*dry.answers} - own:
        assert wet.answers[key].values == pytest.approx(dry.answers[key].values, rel=1e-4), key
    assert wet.answers["mean_pressure"].values == pytest.approx([6e5, 8e5])
    assert wet.answers["fluid_share"].values == pytest.approx(EXCESS / np.array([6e5, 8e5]))
    u_h = dry.answers["hydraulic_aperture"].values
    leak = 50 * u_h**3 * (6e5 - ATMOSPHERE) / (12 * WATER.viscosity)
    assert wet.answers["leak_rate"].values == pytest.approx(leak, rel=1e-3)
    (said,) = [each for each in wet.warnings if "above the outside" in each]
    assert said == (
        "water at 249.3 kPa above the outside, in the mean of the gap, carries 31% to 42% of loads "
        "from 600 kPa to 800 kPa: the bodies press with the rest"
    )


@pytest.mark.parametrize(
    ("outlet", "pressure", "opens"),
    [
        (ATMOSPHERE, 2e5, ATMOSPHERE + 4e5),  # half of what is above the outside
        (0.0, 2e5, 2 * (2e5 + ATMOSPHERE)),
        (1e6, 2e5, 1e6),  # the outlet alone lifts them
    ],
)
def test_a_liquid_opens_a_seal_where_its_mean_pressure_reaches_the_load(outlet, pressure, opens):
    found = fluid_of(WATER, 2e6, outlet).opens_at(np.array([pressure]))
    assert found == pytest.approx([opens], rel=1e-12)


@pytest.mark.parametrize("outlet", [0.0, ATMOSPHERE, 2e5])
@pytest.mark.parametrize("pressure", [2e5, 1e7])
def test_a_gas_opens_a_seal_where_its_mean_pressure_reaches_the_load(outlet, pressure):
    """The square of its pressure falls evenly: the mean of that is found by quadrature."""
    (opens,) = fluid_of(AIR, 6e5, outlet).opens_at(np.array([pressure]))
    x, weights = np.polynomial.legendre.leggauss(200)
    square = opens**2 + (outlet**2 - opens**2) * (x + 1) / 2
    assert np.sqrt(square) @ weights / 2 == pytest.approx(pressure + ATMOSPHERE, rel=1e-6)
    if outlet == 0:
        assert opens == pytest.approx(1.5 * (pressure + ATMOSPHERE), rel=1e-12)


def test_at_the_pressure_that_opens_it_nothing_is_left_of_the_load():
    for fluid in (WATER, AIR):
        (opens,) = fluid_of(fluid).opens_at(np.array([3e5]))
        assert fluid_of(fluid, float(opens)).excess == pytest.approx(3e5, rel=1e-12)
        (left,) = fluid_of(fluid, 0.99 * float(opens)).force_on_bodies(np.array([3e5]), 1.0)
        assert 0 < left < 0.02 * 3e5


@pytest.mark.parametrize("carries", [None, True, False])
def test_loads_follow_from_what_is_left_of_them(carries):
    asked, loads = fluid_of(WATER, carries=carries), np.geomspace(1e5, 1e8, 100) * 1e-6
    left = asked.force_on_bodies(loads, 1e-6)
    assert asked.load_on(left, 1e-6) == pytest.approx(loads, rel=1e-12)
    assert (np.diff(left) > 0).all()


@pytest.mark.parametrize(("inlet", "changes"), [("1.8 bar", False), ("1.85 bar", True)])
def test_from_a_twentieth_of_the_load_on_it_counts(body, inlet, changes):
    """At 1.811 bar, water from there to the outside carries a twentieth of 0.8 MPa."""
    loads = ["0.8 MPa"]
    usual, never, always = (
        asked(body, loads, inlet, carries=each).answers for each in (None, False, True)
    )
    same = never if not changes else always
    for key in usual:
        assert (usual[key].values == same[key].values).all()
    assert ("fluid_share" in usual) == changes
    assert usual["contact_area"].values > always["contact_area"].values or changes
    assert "opening_pressure" in never


def test_a_seal_that_opens_has_no_leak_and_says_so_in_one_line(body, capsys):
    found = asked(body, ["0.2 MPa", "0.8 MPa"])
    assert found.curve.status.tolist() == [rl.Status.LIFTED, rl.Status.CONVERGED]
    of_load = {"normal_force", "mean_pressure", "opening_pressure", "fluid_share"}
    for key, each in found.answers.items():
        assert np.isnan(each.values[0]) == (key not in of_load), key
    opens = found.answers["opening_pressure"].values
    assert opens == pytest.approx([4e5 + ATMOSPHERE, 16e5 + ATMOSPHERE])
    (fact,) = [each for each in found.facts if each.kind == "fluid_lifts"]
    said = str(fact)
    assert said.startswith("water at 249.3 kPa above the outside, in the mean of the gap, lifts ")
    assert "under the load at 200 kPa: the seal is open" in said
    assert fact.is_grave
    print_assessment(found)
    page = capsys.readouterr().out
    assert page.count("lifts the bodies apart") == 1
    assert "opens at P_o" in page


def test_where_all_loads_open_it_the_pressure_that_does_is_all_that_is_known(body):
    found = asked(body, ["0.1 MPa", "0.2 MPa"])
    expected = {"normal_force", "mean_pressure", "opening_pressure", "fluid_share"}
    assert {*found.answers} == expected
    assert found.answers["opening_pressure"].leads
    assert found.is_solved
    content = json.loads(to_json(assessment_json(found)))
    assert content["curve"]["status"] == ["lifted", "lifted"]
    assert content["answers"]["P_o"]["values"] == pytest.approx([301325.0, 501325.0])


def test_nothing_is_said_of_a_load_that_was_not_asked_for(body):
    """The highest peak is at the border, which would carry all of a light load."""
    peak = np.unravel_index(np.argmax(body.heights), body.shape)
    heights = np.roll(body.heights, (-peak[0], -peak[1]), (0, 1))
    piece = rl.Surface(heights, body.sizes, "m", is_cut_out=True)
    warnings = asked(piece, ["0.1 MPa"], periodic=False).warnings
    assert not [each for each in warnings if "border" in each]


def test_each_load_of_a_history_has_its_share(body):
    """Metal keeps the dents of a load when the fluid lifts it midway."""
    given = {"hardness": "3 MPa", "loads": ["0.8 MPa", "0.2 MPa", "0.5 MPa"]}
    wet = asked(body, given.pop("loads"), "6 bar", history=True, **given)
    E_star = wet.curve.E_star
    left = (np.array([8e5, 5e5]) - EXCESS) * body.area
    dry = rl.press(body, E_star=E_star, forces=left, hardness=3e6, periodic=True)
    assert wet.curve.status.tolist() == [0, rl.Status.LIFTED, 0]
    assert wet.curve.depth[[0, 2]] == pytest.approx(dry.depth, rel=1e-9)
    assert wet.curve.surface_after(2).heights == pytest.approx(dry.surface_after(1).heights)
    assert any("as if the fluid came first" in each for each in wet.warnings)


def test_a_load_that_is_taken_off_opens_the_seal(body):
    found = asked(body, ["0.8 MPa"], "6 bar", unload=True)
    assert found.headings[-1] == "unloaded"
    assert np.isnan(found.answers["leak_rate"].values).tolist() == [False] * 3 + [True] * 3


def test_depths_are_those_of_the_bodies_and_the_load_is_more(body):
    depths = ["10 um", "40 um"]
    wet, dry = (asked(body, [], depths=depths, carries=each).answers for each in (None, False))
    assert wet["contact_area"].values == pytest.approx(dry["contact_area"].values)
    more = wet["mean_pressure"].values - dry["mean_pressure"].values
    assert more == pytest.approx([EXCESS, EXCESS])


def test_the_load_that_seals_is_that_of_the_bodies_and_of_the_fluid(body):
    found = asked(body, ["0.8 MPa"], "6 bar", closes=True)
    dry = asked(body, ["0.8 MPa"], "1.1 bar", closes=True)
    for key in ("sealing_pressure", "reopening"):
        assert "beside the 249.3 kPa that the fluid carries" in found.answers[key].validity
        assert "beside" not in dry.answers[key].validity
    seals = found.answers["sealing_pressure"].values
    assert seals == pytest.approx(dry.answers["sealing_pressure"].values)


@pytest.mark.parametrize("periodic", [True, False])
def test_where_the_fluid_lifts_the_bodies_it_is_still_known_what_seals(body, periodic):
    """It is of the bodies alone, of a map that was cut out as it repeats."""
    piece = rl.Surface(body.heights, body.sizes, "m", is_cut_out=not periodic)
    wet, dry = (
        asked(piece, ["0.2 MPa"], inlet, closes=True, periodic=periodic)
        for inlet in ("6 bar", "1.1 bar")
    )
    expected = dry.answers["sealing_pressure"].values
    assert wet.answers["sealing_pressure"].values == pytest.approx(expected)
    assert "reopening" not in wet.answers
    (said,) = [each for each in wet.notes if "seals" in each]
    assert said.endswith("of the load that seals the fluid carries 249.3 kPa beside that")
    assert not [each for each in dry.notes if "that seals" in each]


def test_bodies_are_strained_by_what_they_press_with(body):
    """Rubber's modulus is 2.9 MPa: a load of 0.8 MPa is 0.27 of it, 0.55 MPa are 0.19."""
    wet, dry = (asked(body, ["0.8 MPa"], carries=each).warnings for each in (None, False))
    so_far = "times the contact modulus: bodies that are strained so far"
    assert any(f"load 0.8 MPa is 0.27 {so_far}" in each for each in dry)
    own = f"load 0.8 MPa, without what the fluid carries, is 0.19 {so_far}"
    assert any(own in each for each in wet)
    lifted = asked(body, ["0.8 MPa"], "30 bar").warnings
    assert not any("strained" in each for each in lifted)


@pytest.mark.parametrize("fluid", [WATER, AIR])
@pytest.mark.parametrize("outlet", [0.0, ATMOSPHERE])
def test_in_a_wide_ring_the_pressure_falls_with_the_logarithm_of_the_radius(fluid, outlet):
    """Of a gas, the square of it does; the mean over the area is found by quadrature."""
    inner, outer, power = 5e-3, 5e-2, 1 if fluid is WATER else 2
    ring = rl.Fluid(fluid, inlet=6e5, outlet=outlet, seal="5 mm .. 50 mm")
    for enters_inside, found in zip((True, False), ring.excess_in_ring, strict=True):

        def pressure(r, enters_inside=enters_inside):
            share = np.log(r / inner) / np.log(outer / inner)
            fallen = share if enters_inside else 1 - share
            return (6e5**power + (outlet**power - 6e5**power) * fallen) ** (1 / power)

        total = quad(lambda r: 2 * r * pressure(r), inner, outer, limit=200)[0]
        expected = total / (outer**2 - inner**2) - ATMOSPHERE
        assert found == pytest.approx(expected, rel=1e-4)
    assert ring.excess_in_ring[0] < ring.excess < ring.excess_in_ring[1]


def test_the_mean_over_a_wide_ring_is_told_where_the_fluid_carries(body):
    told = []
    for seal in ("20 mm .. 24 mm", "5 mm .. 50 mm", SEAL):
        ask = rl.Fluid("water", inlet="6 bar", seal=seal)
        given = {"loads": ["0.2 MPa", "0.8 MPa"], "periodic": True, "grid_error": False}
        warnings = rl.assess(rl.Question(body, "rubber,steel", ask=ask, **given)).warnings
        told.append([each for each in warnings if "narrow ring" in each])
    assert [len(each) for each in told] == [0, 2, 0]
    means = "the mean is 103 kPa if the fluid enters inside, and 395 kPa if outside"
    assert all(means in each for each in told[1])


def test_the_hardness_limits_what_is_left(body):
    """H A_0 is borne by the bodies, and more with a fluid between them."""
    (found,) = asked(body, ["1.1 MPa"], hardness="1 MPa").curve.force
    assert found < 1e6 * body.area
    with pytest.raises(rl.InputError, match="bears less than 1.249 N on the map"):
        asked(body, ["1.3 MPa"], hardness="1 MPa")


def test_of_a_map_and_of_a_joint_it_carries_as_much(body):
    piece = rl.Surface(body.heights, body.sizes, "m", is_cut_out=True)
    alone, joint = (
        asked(piece, ["0.2 MPa", "0.8 MPa"], "6 bar", *ask, periodic=False)
        for ask in ([], [rl.Joint("4 mm^2")])
    )
    for key in ("opening_pressure", "fluid_share", "mean_pressure", "leak_rate"):
        same = alone.answers[key].values
        assert joint.answers[key].values == pytest.approx(same, nan_ok=True), key
    ratio = joint.answers["normal_force"].values / alone.answers["normal_force"].values
    assert ratio == pytest.approx([4, 4])


def test_bodies_that_stick_are_told_to_be_left_alone_where_the_fluid_lifts_them(body):
    rough = rl.Surface(0.01 * body.heights, body.sizes, "m", is_cut_out=False)
    found = asked(rough, ["8 kPa", "50 kPa"], "1.2 bar", rl.Adhesion("50 mJ/m^2"))
    assert found.curve.status.tolist() == [rl.Status.LIFTED, rl.Status.CONVERGED]
    said = " ".join(found.warnings)
    assert "bodies that stick may hold, which is not solved" in said
    assert "what draws them apart is of the bodies alone" in said
    assert "hold out longer" in found.answers["opening_pressure"].validity


def test_a_fluid_below_the_outside_changes_nothing(body):
    ask = fluid_of("air", "1 bar", "0 bar", carries=True)
    given = {"loads": ["0.2 MPa"], "periodic": True, "grid_error": False}
    found = rl.assess(rl.Question(body, "rubber,steel", ask=ask, **given))
    assert found.curve.force == pytest.approx(0.2e6 * body.area, rel=1e-9)
    assert "fluid_share" not in found.answers


@pytest.mark.parametrize("switch", ["--fluid-carries", "--no-fluid-carries", None])
def test_the_command_line_has_a_switch(body, switch, tmp_path):
    rl.write(rl.Surface(body.heights, body.sizes, "m"), tmp_path / "body.nc")
    words = ["press", str(tmp_path / "body.nc"), "--materials", "rubber,steel", "--periodic"]
    words += ["--load", "0.2 MPa", "--fluid", "water", "--inlet", "6 bar"]
    words += ["--seal", "100 mm x 2 mm", "--json", *([switch] if switch else [])]
    found = CliRunner().invoke(app, words)
    assert found.exit_code == 0
    answers = json.loads(found.stdout)["answers"]
    assert ("A" in answers) == (switch == "--no-fluid-carries")


def test_whether_it_carries_load_belongs_to_an_inlet(body):
    told = {"materials": ("rubber", "steel"), "fluid": "water", "carries": False}
    with pytest.raises(rl.InputError, match="^carries= belongs to inlet=: give that too$"):
        build_question(body, told)
    with pytest.raises(rl.InputError, match="carries is 3; True or False is needed"):
        fluid_of("water", carries=3)
