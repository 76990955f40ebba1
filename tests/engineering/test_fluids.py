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

CONDUCTIVITIES = {  # [W/(m K)], and the same two
    "air": (0.0241, 273.0, 194.0),
    "nitrogen": (0.0242, 273.0, 150.0),
    "oxygen": (0.0244, 273.0, 240.0),
    "argon": (0.0163, 273.0, 170.0),
    "carbon-dioxide": (0.0146, 273.0, 1800.0),
    "hydrogen": (0.168, 273.0, 120.0),
}
"""The same, table 1-3."""

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

    for degrees in (0, 10, 30, 40, 60, 80, 100):
        cold = math.log10(313.15 / (degrees + 273.15))
        kinematic = 10**10 ** (twice(grade) + fall * cold) - 0.7
        expected = kinematic * (density - 0.65e-3 * (degrees - 20)) * 1e-3
        found = rl.fluid_of(f"ISO VG {grade} at {degrees} °C").viscosity
        assert found == pytest.approx(expected, rel=0.011 if degrees == 40 else 0.04)


@pytest.mark.parametrize("degrees", [0, 20, 40, 60, 80, 100])
def test_water_follows_the_release_on_liquid_water(degrees):
    """IAPWS SR6-08: viscosity at 0.1 MPa, sum of a (T / 300 K)^b."""
    warmth = (degrees + 273.15) / 300
    terms = ((280.68, -1.9), (511.45, -7.7), (61.131, -19.6), (0.45903, -40.0))
    expected = 1e-6 * sum(a * warmth**b for a, b in terms)
    found = rl.fluid_of(f"water at {degrees} °C").viscosity
    assert found == pytest.approx(expected, rel=0.015)


@pytest.mark.parametrize("degrees", [0, 20, 50, 100])
@pytest.mark.parametrize("name", SUTHERLAND)
def test_warm_gases_follow_sutherlands_law(name, degrees):
    gas = rl.fluid_of(f"{name} at {degrees} °C")
    for found, law in ((gas.viscosity, SUTHERLAND), (gas.conductivity, CONDUCTIVITIES)):
        at, temperature, constant = law[name]
        warm = gas.temperature / temperature
        expected = at * warm**1.5 * (temperature + constant) / (gas.temperature + constant)
        assert found == pytest.approx(expected, rel=0.04)


def test_a_temperature_is_written_as_people_do():
    first = rl.fluid_of("helium at 60 °C")
    assert (first.name, first.temperature) == ("helium at 60 °C", 333.15)
    for text in ("He at 60C", "he at 333.15 K", "helium temperature=60 °C", "N2 at 60 °C"):
        assert rl.fluid_of(text).temperature == first.temperature
    assert rl.fluid_of("He at 60C") == first
    oil = rl.fluid_of("ISO VG 46 at 60 °C")
    assert oil == rl.fluid_of("oil vg46 temperature=60 degC")
    assert oil.name == "oil-vg-46 at 60 °C"
    assert rl.fluid_of("water at 20 °C").viscosity == rl.fluid_of("water").viscosity
    own = rl.fluid_of("air at 400 K viscosity=23 uPa s conductivity=33 mW/m/K")
    assert (own.viscosity, own.temperature, own.name) == (23e-6, 400.0, "air")
    assert own.conductivity == 0.033
    assert rl.fluid_of("air at 400 K viscosity=23 uPa s").conductivity is None  # not that at 20 °C


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
        ("air at 400 K", 'temperature is "400 K", where the table does not know air; give its'),
        ("water at -5 °C", 'temperature is "-5 °C", where the table does not know water'),
        ("ethanol at 40 °C", "where the table does not know ethanol"),
        ("water at noon", 'did you mean "water"|no fluid is called'),
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
        {"viscosity": 1.8e-5, "molar_mass": 28.0},  # g/mol
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


@pytest.mark.parametrize("pressure", [-1.0, math.nan])
def test_a_pressure_below_vacuum_is_refused(pressure):
    for length in (GASES["helium"].mean_free_path, GASES["helium"].temperature_jump):
        with pytest.raises(rl.InputError, match=r"pressure is .*, 0 \(vacuum\) or more"):
            length(pressure)
    assert GASES["helium"].mean_free_path(0.0) == math.inf


def test_oils_are_known_to_a_factor_that_holds_other_indices_and_the_grade():
    """From a viscosity index of 80 to one of 140, and 10 % of the grade at 40 °C."""
    at_100 = {80: 6.35, 140: 7.7}  # of a grade of 46, ASTM D2270 [mm²/s]

    def twice(viscosity):
        return math.log10(math.log10(viscosity + 0.7))

    oil = rl.fluid_of("ISO VG 46")
    assert oil.viscosity_factor == 1.3
    for warm in at_100.values():
        for grade in (0.9 * 46, 1.1 * 46):
            fall = (twice(46) - twice(warm)) / math.log10(373.15 / 313.15)
            kinematic = 10**10 ** (twice(46) + fall * math.log10(313.15 / ROOM)) - 0.7
            found = kinematic * grade / 46 * 0.872e-3
            assert oil.viscosity / 1.3 < found < oil.viscosity * 1.3
    assert rl.fluid_of("ISO VG 46 viscosity=0.1 Pa s").viscosity_factor == 1.0
    assert rl.fluid_of("ISO VG 46 at 40 °C").viscosity_factor == 1.3
    assert rl.fluid_of("water").viscosity_factor == 1.0
    with pytest.raises(rl.InputError, match="viscosity_factor"):
        rl.Liquid(0.1, viscosity_factor=0.9)
