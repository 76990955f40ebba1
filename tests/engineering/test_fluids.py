"""Fluids: the table against laws that it was not made of, and texts that describe a fluid."""

import math

import pytest

import roughline as rl
from roughline.engineering.fluids import ROOM, R, fluids

GASES = {name: each for name, each in fluids().items() if isinstance(each, rl.Gas)}
LIQUIDS = {name: each for name, each in fluids().items() if isinstance(each, rl.Liquid)}

SUTHERLAND = {  # viscosity [Pa s], temperature [K] and constant [K] of Sutherland's law
    "air": (1.716e-5, 273.0, 111.0),
    "nitrogen": (1.663e-5, 273.0, 107.0),
    "oxygen": (1.919e-5, 273.0, 139.0),
    "argon": (2.125e-5, 273.0, 144.0),
    "carbon-dioxide": (1.370e-5, 273.0, 222.0),
    "hydrogen": (8.411e-6, 273.0, 97.0),
}
"""F. M. White, Viscous Fluid Flow, 2nd ed. (1991), table 1-2; to 2 to 4 %."""

PATHS = {"air": 65.4e-9, "nitrogen": 64e-9, "helium": 190e-9, "hydrogen": 119e-9, "argon": 68e-9}
"""Mean free paths at 20 °C and 1 atm; air: S. G. Jennings, J. Aerosol Sci. 19, 159 (1988). [m]"""

GRADES = {  # kinematic viscosity at 100 °C [mm²/s] for an index of 100, and density [g/cm³]
    10: (2.60, 0.850),
    22: (4.27, 0.860),
    32: (5.35, 0.868),
    46: (6.76, 0.872),
    68: (8.73, 0.878),
    100: (11.25, 0.882),
    150: (14.8, 0.886),
}


@pytest.mark.parametrize("name", SUTHERLAND)
def test_viscosities_of_gases_follow_sutherlands_law(name):
    at, temperature, constant = SUTHERLAND[name]
    warm = ROOM / temperature
    expected = at * warm**1.5 * (temperature + constant) / (ROOM + constant)
    assert GASES[name].viscosity == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize("name", PATHS)
def test_mean_free_paths_are_the_published_ones(name):
    assert GASES[name].mean_free_path(101325.0) == pytest.approx(PATHS[name], rel=0.02)


@pytest.mark.parametrize("name", GASES)
def test_prandtl_numbers_are_those_of_kinetic_theory(name):
    """An independent bound on viscosity, conductivity, molar mass and heat capacities at once."""
    gas = GASES[name]
    eucken = rl.Gas(gas.viscosity, gas.molar_mass, heat_capacity_ratio=gas.heat_capacity_ratio)
    assert gas.prandtl == pytest.approx(eucken.prandtl, rel=0.08)


def test_accommodation_of_engineering_metals():
    """Measured on engineering metals: air 0.87 to 0.97, helium 0.3 to 0.5."""
    assert GASES["air"].accommodated == pytest.approx(0.9, rel=0.1)
    assert 0.3 < GASES["helium"].accommodated < 0.5
    own = rl.Gas(1.8e-5, 0.029, conductivity=0.026, accommodation=1.0)
    assert own.temperature_jump(1e5) == pytest.approx(
        2 * 2.8 / 2.4 * own.mean_free_path(1e5) / own.prandtl
    )


@pytest.mark.parametrize("grade", GRADES)
def test_oils_are_their_grade_at_40_degrees_taken_to_20(grade):
    """ASTM D341: log log (ν + 0.7) falls with the logarithm of the temperature."""
    at_100, density = GRADES[grade]

    def twice(viscosity):
        return math.log10(math.log10(viscosity + 0.7))

    fall = (twice(grade) - twice(at_100)) / math.log10(373.15 / 313.15)
    kinematic = 10**10 ** (twice(grade) + fall * math.log10(313.15 / ROOM)) - 0.7
    expected = kinematic * density * 1e-3
    assert LIQUIDS[f"oil-vg-{grade}"].viscosity == pytest.approx(expected, rel=0.01)


def test_every_fluid_says_where_it_is_from():
    assert {"water", "air", "nitrogen", "hydrogen", "helium", "oil-vg-46"} <= set(fluids())
    assert all(each.source for each in fluids().values())
    assert pytest.approx(8.314462618, abs=1e-9) == R


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("He", "helium"),
        ("N2", "nitrogen"),
        ("ISO VG 46", "oil-vg-46"),
        ("VG46", "oil-vg-46"),
        ("oil vg 32", "oil-vg-32"),
        ("Oil_VG_32", "oil-vg-32"),
        ("Carbon dioxide", "carbon-dioxide"),
    ],
)
def test_names_as_people_write_them(text, name):
    assert rl.fluid_of(text) is not None
    assert rl.fluid_of(text).name == name


def test_values_of_ones_own():
    assert rl.fluid_of("viscosity=40 mPa s").viscosity == 0.04
    gas = rl.fluid_of("viscosity=18 uPa s molar_mass=29 g/mol temperature=350 K")
    assert (gas.viscosity, gas.molar_mass, gas.temperature) == (1.8e-5, 0.029, 350.0)
    cold = rl.fluid_of("water viscosity=1.79 mPa s")
    assert (cold.name, cold.viscosity) == ("water", 1.79e-3)
    assert "viscosity given" in cold.source
    assert rl.fluid_of(gas) is gas


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("heliun", 'did you mean "helium"'),
        ("oil VG 47", 'did you mean "oil-vg-46"'),
        ("", "needs a name or a viscosity"),
        ("viscosity=3", "without a unit"),
        ("viscosity=3 m", "no quantity in"),
        ("viscosity=18 uPa s temperature=300 K", "molar_mass"),
        ("water molar_mass=18 g/mol", "is a liquid"),
        ("water viscosity=-1 Pa s", "positive"),
        ("N2 accommodation=2", "accommodation"),
        ("N2 colour=2", 'a fluid has no "colour"'),
    ],
)
def test_bad_fluids_get_one_line(text, words):
    with pytest.raises((rl.InputError, rl.UnitError), match=words) as caught:
        rl.fluid_of(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "given",
    [
        {"viscosity": 1.8e-5},
        {"viscosity": math.nan, "molar_mass": 0.03},
        {"viscosity": 1.8e-5, "molar_mass": 0.0},
        {"viscosity": 1.8e-5, "molar_mass": 0.03, "temperature": -3.0},
        {"viscosity": 1.8e-5, "molar_mass": 0.03, "heat_capacity_ratio": 1.0},
        {"viscosity": 1.8e-5, "molar_mass": 0.03, "heat_capacity_ratio": 3.0},
        {"viscosity": 1.8e-5, "molar_mass": 0.03, "accommodation": 0.0},
    ],
)
def test_senseless_gases_are_refused(given):
    with pytest.raises(rl.InputError):
        rl.Gas(**given)
    if len(given) == 1:
        assert rl.Liquid(**given).viscosity == 1.8e-5
