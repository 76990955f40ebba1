"""Materials: a table with sources, values of one's own, and what pairs of them have."""

import math

import pytest

import roughline as rl
from roughline.engineering.materials import Material, material, materials
from roughline.engineering.pair import MaterialPair, contact_modulus


def test_every_material_is_whole_and_says_where_it_is_from():
    table = materials()
    assert {"steel", "copper", "gold", "aluminium", "glass", "rigid"} <= set(table)
    for each in table.values():
        assert each.source
        assert each.name == "rigid" or 1e6 < each.E < 1e12
        assert each.density is None or 900 < each.density < 2e4
        assert each.resistivity is None or 1e-8 < each.resistivity < 1e-6
        assert each.hardness is None or each.hardness < each.E / 7
        if each.resistivity is not None and each.name not in ("stainless-steel", "steel"):
            # Wiedemann and Franz: an independent bound on both conductivities of a metal
            lorenz = each.conductivity * each.resistivity / 293
            assert 2.0e-8 < lorenz < 3.4e-8


def test_by_name_by_values_and_both():
    assert material("Stainless Steel") == materials()["stainless-steel"]
    own = material("E=70 GPa nu=0.33 density = 2700 kg/m^3")
    assert (own.E, own.nu, own.density, own.hardness) == (70e9, 0.33, 2700, None)
    hard = material("steel hardness=2 GPa; resistivity=2e-7 ohm m")
    assert (hard.E, hard.hardness) == (materials()["steel"].E, 2e9)
    assert hard.resistivity == pytest.approx(2e-7)
    assert "hardness, resistivity given" in hard.source
    warm = material("steel conductivity=20 W/(m K) density=7.9e3 kg/m3")
    assert (warm.conductivity, warm.density) == (20, 7900)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("coper", 'no material is called "coper"; did you mean "copper"'),
        ("", "needs both E and nu"),
        ("E=70 GPa", "needs both E and nu"),
        ("E=70 nu=0.3", 'E is "70", without a unit'),
        ("E=70 mm nu=0.3", "no quantity in Pa"),
        ("E=70 GPa nu=0.6", "nu of E=70 GPa nu=0.6 is 0.6; allowed is -1 to 0.5"),
        ("E=-70 GPa nu=0.3", "a positive modulus is needed"),
        ("E=nan GPa nu=0.3", "a positive modulus is needed"),
        ("steel colour=grey", 'a material has no "colour"'),
        ("steel nu=zero", 'nu is "zero"; a number such as 0.3 is needed'),
        ("steel nu=0.2 nu=0.3", "gives nu twice"),
        ("steel nu=0,33", 'nu is "0,33", with a comma in "0,33"; numbers take a decimal point'),
        ("E=70,5 GPa nu=0.3", 'a comma in "70,5"'),
        ("steel density=inf kg/m^3", "density of steel is inf"),
    ],
)
def test_bad_materials_get_one_line(text, message):
    with pytest.raises((rl.InputError, rl.UnitError), match=message.replace("(", r"\(")) as caught:
        material(text)
    assert "\n" not in str(caught.value)


def test_pairs():
    steel, rigid = materials()["steel"], materials()["rigid"]
    assert contact_modulus(steel, rigid) == pytest.approx(steel.E / (1 - steel.nu**2))
    assert contact_modulus(steel, steel) == pytest.approx(steel.E / (1 - steel.nu**2) / 2)
    ratio = MaterialPair(steel, steel).G_star / contact_modulus(steel, steel)
    assert ratio == pytest.approx((2 - 2 * steel.nu) / (2 - steel.nu), rel=1e-12)
    for modulus in ("E_star", "G_star"):
        with pytest.raises(rl.InputError, match="both materials are rigid"):
            getattr(MaterialPair(rigid, rigid), modulus)


def test_a_pair_says_what_it_lacks():
    steel, glass, rigid = (materials()[name] for name in ("steel", "glass", "rigid"))
    assert MaterialPair(steel, glass).lacking("resistivity") == ["the second body (glass)"]
    assert MaterialPair(glass, glass).lacking("resistivity") == [
        "the first body (glass)",
        "the second body (glass)",
    ]
    assert MaterialPair(steel, glass).lacking("hardness") == []
    assert MaterialPair(steel, rigid).lacking("hardness") == []  # a rigid body never yields
    assert MaterialPair(steel, rigid).lacking("conductivity") == ["the second body (rigid)"]


def test_impedance_of_steel_is_the_textbook_value():
    # 46e6 kg / (m² s), longitudinal speed 5.9 km/s
    steel = materials()["steel"]
    assert steel.impedance == pytest.approx(46e6, rel=0.02)
    assert steel.impedance / steel.density == pytest.approx(5.9e3, rel=0.02)
    assert Material("x", 1e9, 0.5, density=1e3).impedance is None
    assert materials()["rigid"].impedance is None
    assert math.isinf(materials()["rigid"].shear_modulus)


# Second sources: elastic constants from N. E. Dowling, "Mechanical Behavior of Materials", table
# 5.2; resistivities at 20 °C from R. A. Serway, "Principles of Physics", 2nd ed. (1998), and others
DOWLING = {
    "aluminium": (70.3, 0.345),
    "alumina": (400, 0.22),
    "brass": (101, 0.350),
    "copper": (130, 0.343),
    "fused-silica": (70, 0.18),
    "glass": (69, 0.20),
    "pmma": (2.7, 0.35),
    "steel": (212, 0.293),
    "titanium": (120, 0.361),
    "tungsten": (411, 0.280),
}
RESISTIVITIES = {
    "silver": 1.59e-8,
    "copper": 1.68e-8,
    "gold": 2.44e-8,
    "aluminium": 2.82e-8,
    "tungsten": 5.60e-8,
    "zinc": 5.90e-8,
    "nickel": 6.99e-8,
    "tin": 1.09e-7,
    "steel": 1.43e-7,
    "titanium": 4.20e-7,
    "stainless-steel": 6.9e-7,
}


@pytest.mark.parametrize("name", DOWLING)
def test_moduli_agree_with_a_second_table(name):
    E, nu = DOWLING[name]
    assert pytest.approx(E * 1e9, rel=0.12) == rl.material(name).E
    assert rl.material(name).nu == pytest.approx(nu, abs=0.045)


@pytest.mark.parametrize("name", RESISTIVITIES)
def test_resistivities_agree_with_a_second_table(name):
    assert rl.material(name).resistivity == pytest.approx(RESISTIVITIES[name], rel=0.13)


def test_the_hardness_of_the_table_scatters_and_a_given_one_does_not():
    assert rl.material("copper").hardness_factor == 1.5
    assert rl.material("copper resistivity=2e-8 ohm m").hardness_factor == 1.5
    assert rl.material("copper hardness=1 GPa").hardness_factor == 1
    assert rl.Material("own", E=1e9, nu=0.3, hardness=1e8).hardness_factor == 1
    for wrong in (0.5, float("nan"), float("inf")):
        with pytest.raises(rl.InputError, match="hardness_factor of own is .*; 1 or more"):
            rl.Material("own", E=1e9, nu=0.3, hardness_factor=wrong)


def shore_modulus(shore):
    """A. N. Gent, Rubber Chem. Technol. 31, 896 (1958). [Pa]"""
    return 0.0981e6 * (56 + 7.62336 * shore) / (0.137505 * (254 - 2.54 * shore))


@pytest.mark.parametrize(
    ("name", "shore", "ends", "bulk_modulus"),
    [
        ("fkm", 70, {65: 4.4e6, 75: 7.1e6}, 2.9e9),
        ("nbr", 70, {65: 4.4e6, 75: 7.1e6}, 2.9e9),
        ("epdm", 70, {65: 4.4e6, 75: 7.1e6}, 2.9e9),
        ("silicone", 50, {40: 1.7e6, 60: 3.6e6}, 1e9),
    ],
)
def test_rubbers_have_the_modulus_of_their_shore_hardness(name, shore, ends, bulk_modulus):
    rubber = rl.material(name)
    for hardness, modulus in {shore: rubber.E, **ends}.items():
        assert modulus == pytest.approx(shore_modulus(hardness), rel=0.02)
    assert rubber.nu == pytest.approx(0.5 - rubber.E / (6 * bulk_modulus), abs=5e-5)
    assert rubber.hardness is None


def test_natural_and_silicone_rubber_lie_where_their_shore_hardness_does():
    assert pytest.approx(shore_modulus(50), rel=0.15) == rl.material("rubber").E
    pdms = rl.material("pdms")  # 44 to 54 Shore A as it is cured
    assert shore_modulus(40) < pdms.E < shore_modulus(54)
    for rubber in (rl.material("rubber"), pdms, rl.material("silicone")):
        assert rubber.nu == pytest.approx(0.5 - rubber.E / 6e9, abs=5e-5)


def test_plated_metals_are_as_hard_as_their_standards_say():
    knoop, vickers = 9.80665e6, 10.6e6  # on the projected area [Pa]
    for name, low, high, annealed in (
        ("hard-gold", 130 * knoop, 200 * knoop, "gold"),
        ("plated-nickel", 130 * vickers, 500 * vickers, "nickel"),
    ):
        plated, soft = rl.material(name), rl.material(annealed)
        assert plated.hardness == pytest.approx(math.sqrt(low * high), rel=0.03)
        assert plated.hardness / plated.hardness_factor < low
        assert high < plated.hardness * plated.hardness_factor
        assert (plated.E, plated.nu) == (soft.E, soft.nu)
        assert name in soft.layer_hardness
        assert not plated.layer_hardness


def test_what_layers_have_instead_goes_with_a_value_that_is_given():
    gold, dlc = rl.material("gold"), rl.material("dlc")
    assert "2 GPa" in gold.layer_hardness
    assert rl.material("gold E=80 GPa").layer_hardness == gold.layer_hardness
    for given in (rl.material("gold hardness=1 GPa"), gold.with_hardness(1e9)):
        assert not given.layer_hardness
    assert dlc.layer_E == "100 to 760 GPa"
    assert rl.material("dlc hardness=20 GPa").layer_E == dlc.layer_E
    assert not rl.material("dlc E=200 GPa").layer_E


def test_the_softer_body_yields():
    steel, copper, rigid = (rl.material(name) for name in ("steel", "copper", "rigid"))
    unknown = rl.material("E=70 GPa nu=0.3")
    for first, second, hardness, factor in (
        (steel, copper, copper.hardness, 1.5),
        (copper, steel, copper.hardness, 1.5),
        (rl.material("steel hardness=0.2 GPa"), copper, 0.2e9, 1),
        (rigid, steel, steel.hardness, 1.5),
        (unknown, steel, steel.hardness, 1.5),
        (unknown, rigid, None, 1),
    ):
        pair = MaterialPair(first, second)
        assert (pair.hardness, pair.hardness_factor) == (hardness, factor)
    given = MaterialPair(rigid, copper).with_hardness(2e9)
    assert (given.hardness, given.hardness_factor) == (2e9, 1)
    assert given.first == rigid
    assert given.second.source == f"{copper.source}; hardness given"
