"""A ball on the command line, beside Hertz, the exact sphere, and Johnson, Kendall and Roberts."""

import json
import math

import numpy as np
import pytest
import xarray
from scipy import integrate

import roughline as rl
from roughline.ball import BallQuestion, press_ball
from roughline.engineering.formulas import largest_pressure_under_ball
from roughline.exact.indenters import paraboloid

RADIUS, E_STAR = 1e-2, 1e11
HERTZ = ("ball", "--radius", "10 mm", "--modulus", "100 GPa")
GEL = ("ball", "--radius", "20 um", "--modulus", "5 MPa", "--adhesion", "50 mJ/m^2")


@pytest.fixture
def pressed(invoke):
    def press(*arguments, code=0):
        ended, out, errors = invoke(*arguments, "--json")
        assert (ended, errors) == (code, "")
        return json.loads(out)

    return press


def test_a_ball_is_that_of_hertz(pressed):
    found = pressed(*HERTZ, "--load", "1 mN", "--load", "10 N")
    F, exact = np.array([1e-3, 10.0]), paraboloid(RADIUS, E_STAR)
    a = np.cbrt(3 * F * RADIUS / (4 * E_STAR))
    expected = {
        "force": F,
        "depth": a**2 / RADIUS,
        "contact_radius": a,
        "contact_area": math.pi * a**2,
        "stiffness": exact.stiffness(a**2 / RADIUS),
        "mean_pressure": F / (math.pi * a**2),
        "largest_pressure": 1.5 * F / (math.pi * a**2),
    }
    for name, values in expected.items():
        assert found[name] == pytest.approx(values, rel=1e-9), name


@pytest.mark.parametrize("share", [0.01, 0.3, 0.8])
def test_a_sphere_is_the_exact_one(share):
    """F and d of the sphere over its contact radius: Segedin 1957."""
    ratio = math.log((1 + share) / (1 - share))
    depth = RADIUS * share * ratio / 2
    force = E_STAR * RADIUS**2 * ((1 + share**2) / 2 * ratio - share)
    ball = press_ball(BallQuestion("10 mm", E_star=E_STAR, depths=depth, is_sphere=True))
    assert ball.contact_radius[0] == pytest.approx(share * RADIUS, rel=1e-4)
    assert ball.curve.force[0] == pytest.approx(force, rel=1e-4)

    def slope_over_x(x):  # of the reduced profile g = x artanh x
        return 1 / (1 - x**2) + (math.atanh(x) / x if x else 1.0)

    in_the_middle = E_STAR / math.pi * integrate.quad(slope_over_x, 0, share)[0]
    found = largest_pressure_under_ball(share * RADIUS, RADIUS, E_STAR, is_sphere=True)
    assert found == pytest.approx(in_the_middle, rel=1e-9)


def test_a_ball_that_sticks_is_that_of_jkr(pressed):
    w, R, E = 0.05, 20e-6, 5e6
    found = pressed(*GEL, "--load", "1 uN", "--load", "0 N", "--load", "-2 uN")
    faint = pressed(*GEL[:-1], "1e-18 J/m^2", "--load", "1 uN")
    assert faint["pull_off_force"] == pytest.approx(-1.5e-18 * math.pi * R, rel=1e-6)
    assert found["pull_off_force"] == pytest.approx(-1.5 * math.pi * w * R, rel=1e-6)
    pull, F = 3 * math.pi * w * R, np.array(found["force"])
    a = np.cbrt(3 * R / (4 * E) * (F + pull + np.sqrt(2 * pull * F + pull**2)))
    assert found["contact_radius"] == pytest.approx(a, rel=1e-6)
    assert found["depth"] == pytest.approx(a**2 / R - np.sqrt(2 * math.pi * a * w / E), rel=1e-6)
    p = 2 * E * a / (math.pi * R) - np.sqrt(2 * w * E / (math.pi * a))
    assert found["largest_pressure"] == pytest.approx(p, rel=1e-6)


def test_a_pull_that_no_contact_bears_draws_the_ball_off(invoke, pressed):
    load = ("--load", "1 uN", "--load", "-5 uN")
    assert pressed(*GEL, *load, code=1)["status"] == ["converged", "pulled_off"]
    code, out, _ = invoke(*GEL, *load)
    assert code == 1
    assert "-5 uN: pulled off: no contact bears so large a pull" in out
    assert "pull-off force under a falling load: -4.712 µN" in out
    assert "below about 25 nm, from which on Tabor's parameter is above 5" in out


@pytest.mark.parametrize(("load", "warned"), [(0.98, False), (1.02, True)])
def test_first_yield_is_told_from_six_tenths_of_the_hardness_on(load, warned):
    """F_y = pi³ R² p_y³ / (6 E*²), Johnson 1985, eq. 4.24."""
    hardness = 2e9
    force = math.pi**3 * RADIUS**2 * (0.6 * hardness) ** 3 / (6 * E_STAR**2)
    asked = BallQuestion("10 mm", E_star=E_STAR, hardness=hardness, loads=load * force)
    told = press_ball(asked).warnings
    assert [("yields below the contact" in each) for each in told] == [True] * warned


def test_the_hardness_is_that_of_the_softer_body_and_said_to_be_unknown(pressed):
    arguments = "ball", "--radius", "10 mm", "--load", "100 N", "--materials"
    copper = pressed(*arguments, "steel,copper")
    assert copper["hardness"] == rl.material("copper").hardness
    assert "3.1 times the softer body's hardness, 370 MPa" in copper["notes"][0]
    unknown = pressed(*arguments, "E=70 GPa nu=0.33, rigid")
    assert unknown["hardness"] is None
    assert "not known whether it yields; give it with --hardness" in unknown["notes"][0]


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_the_curve_is_written(tmp_path, invoke, suffix):
    path = tmp_path / "new" / f"ball{suffix}"
    code, out, _ = invoke(*HERTZ, "--depth", "1 um", "--depth", "2 um", "--out", path)
    assert code == 0
    header = next(line for line in out.splitlines() if line.startswith("load"))
    assert " ".join(header.split()) == "load force F radius a area A stiffness k mean p largest p"
    assert out.endswith(f"wrote {path}\n")
    if suffix == ".nc":
        force = paraboloid(RADIUS, E_STAR).force([1e-6, 2e-6])
        with xarray.open_dataset(path, engine="h5netcdf") as data:
            assert data.force.values == pytest.approx(force, rel=1e-9)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ((*HERTZ,), "give forces, --load '10 N', or depths, --depth '1 um', one of the two"),
        ((*HERTZ, "--load", "2 MPa"), '--load is "2 MPa", which is no quantity in N'),
        ((*HERTZ, "--load", "-1 N"), '--load is "-1 N"; a positive one is needed, and zero only'),
        ((*HERTZ[:2], "1 fm", *HERTZ[3:]), '--radius is "1 fm"; a length from 1 pm to'),
        ((*HERTZ, "--load", "9 GN"), '--load is "9 GN": so much presses in all of the ball'),
        ((*HERTZ, "--depth", "2 cm"), '--depth is "2 cm": so much presses in all of the ball'),
        ((*HERTZ, "--load", "1 N", "--out", "x.txt"), 'x.txt ends in neither ".nc"'),
        ((*GEL[:-1], "1 kJ/m^2", "--load", "0 N"), "--adhesion is"),
        ((*GEL[:-1], "1 J/m^2 over 1 nm", "--load", "0 N"), "--adhesion is"),
        (
            (
                "ball",
                "--radius",
                "1 mm",
                "--load",
                "1 N",
                "--materials",
                "gold 1 um on steel,steel",
            ),
            '--materials is "gold 1 µm on steel"; a ball is pressed into a body of one material',
        ),
        (("ball", "--radius", "1 mm", "--load", "1 N"), "give either a contact modulus (--modulus"),
    ],
)
def test_what_a_ball_cannot_be_asked_is_refused_in_one_line(invoke, arguments, told):
    code, out, errors = invoke(*arguments)
    assert (code, out, errors.count("\n")) == (2, "", 1)
    assert errors.startswith(f"roughline: {told}")
