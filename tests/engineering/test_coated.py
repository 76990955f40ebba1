"""Coated bodies: their texts, what they are made of, and what a pair of them is."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.engineering.pair import MaterialPair
from roughline.engineering.rules import rules
from roughline.exact.layers import BondedLayer

RUBBER, STEEL, GOLD, NICKEL, COPPER = (
    rl.material(name) for name in ("rubber", "steel", "gold", "nickel", "copper")
)


@pytest.mark.parametrize(
    ("text", "layers", "base"),
    [
        ("rubber 2 mm on steel", [(RUBBER, 2e-3)], STEEL),
        ("Rubber 2mm ON Steel", [(RUBBER, 2e-3)], STEEL),
        ("gold 0.5 µm on nickel 2 um on copper", [(GOLD, 0.5e-6), (NICKEL, 2e-6)], COPPER),
        ("gold 1e-6 m on nickel 1 um on gold 3 nm on copper", 3 * [None], COPPER),
        ("rubber 1 mm on rigid", [(RUBBER, 1e-3)], rl.material("rigid")),
    ],
)
def test_layers_and_their_thicknesses_are_read(text, layers, base):
    found = rl.material(text)
    assert isinstance(found, rl.Coated)
    assert found.base == base
    assert len(found.layers) == len(layers)
    if layers[0] is not None:
        assert found == rl.Coated(layers, base)
        assert found.surface == layers[0][0]


def test_values_stand_before_a_thickness_and_those_of_the_base_after():
    found = rl.material("E=5 MPa nu=0.49 2 mm on steel hardness=2 GPa")
    (layer, thickness), base = found.layers[0], found.base
    assert (layer.E, layer.nu, thickness) == (5e6, 0.49, 2e-3)
    assert (base.name, base.hardness) == ("steel", 2e9)
    spaced = rl.material("nu = 0.49; E = 5 MPa; 2 mm on E = 3 GPa nu = .3")
    assert (spaced.surface.E, spaced.layers[0][1], spaced.base.E) == (5e6, 2e-3, 3e9)
    assert rl.material("stainless steel 20 um on glass").name == "stainless-steel 20 µm on glass"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("rubber on steel", '"rubber" is no layer: write its material, and its thickness last'),
        ("2 mm on steel", '"2 mm" is no layer'),
        ("2 mm rubber on steel", '"2 mm rubber" is no layer'),
        ("rubber 2 mm nu=0.49 on steel", '"rubber 2 mm nu=0.49" is no layer'),
        ("gold 1 um on nickel on copper", '"nickel" is no layer'),
        ("on steel", '"on" stands between a layer and what it lies on, such as "rubber 2 mm on'),
        ("E=5 MPa nu=0.49 on steel", "is no layer"),
        ("E=5 MPa nu = 0.49 on steel", "is no layer"),
        ("rubber 2 mm on", '"on" stands between a layer and what it lies on'),
        ("rubber 1 mm on on steel", '"on" stands between a layer and what it lies on'),
        ("rubber 2 mm", "lies on nothing: .* or leave out its thickness, 2 mm"),
        ("rubber 2 mm steel", '"rubber 2 mm" lies on nothing: add "on" and what it lies on'),
        ("rubber 2 mm over steel", '"rubber 2 mm" lies on nothing'),
        ("rubber 2 mm on steel 3 mm", '"steel 3 mm" lies on nothing'),
        ("rubber 2 on steel", 'thickness of the layer of rubber is "2", without a unit'),
        ("rubber 2 MPa on steel", "which is no quantity in m"),
        ("rubber 0,5 mm on steel", 'a comma in "0,5"'),
        ("rubber 0 mm on steel", "the layer of rubber is 0 m thick; a positive, finite thickness"),
        ("rubber -2 mm on steel", "is -2 mm thick; a positive, finite thickness is needed"),
        ("rubber nan mm on steel", "is nan m thick; a positive, finite thickness is needed"),
        ("rubber inf mm on steel", "is inf m thick; a positive, finite thickness is needed"),
        ("ruber 2 mm on steel", 'no material is called "ruber"; did you mean "rubber"'),
        ("rubber 2 mm on stel", 'no material is called "stel"; did you mean "steel"'),
        ("E=5 MPa nu=0.6 2 mm on steel", "nu of E=5 MPa nu=0.6 is 0.6; allowed is -1 to 0.5"),
        (
            "E=5 MPa nu=-0.1 2 mm on steel",
            "nu of E=5 MPa nu=-0.1 is -0.1; of layers and their base",
        ),
        ("rubber 2 mm on steel nu=-0.1", "nu of steel is -0.1; of layers and their base"),
        (
            "rigid 1 mm on steel",
            "a rigid layer hides what lies below it: give a rigid body without",
        ),
    ],
)
def test_bad_layers_get_one_line(text, message):
    with pytest.raises(rl.InputError, match=message) as caught:
        rl.material(text)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) <= 350


@pytest.mark.parametrize(
    ("layers", "message"),
    [
        ([], r"layers is \[\]; at least one is needed"),
        (RUBBER, "layers is a Material; at least one is needed"),
        ([RUBBER], "layers holds a Material; a layer is a Material and its thickness"),
        ([(RUBBER, "2 mm")], "a layer is a Material and its thickness in m"),
        ([(RUBBER, True)], "a layer is a Material and its thickness in m"),
        ([(RUBBER, math.nan)], "is nan m thick; a positive, finite thickness is"),
    ],
)
def test_coated_bodies_are_checked_when_they_are_made(layers, message):
    with pytest.raises(rl.InputError, match=message):
        rl.Coated(layers, STEEL)
    with pytest.raises(rl.InputError, match='base is "steel"; a Material'):
        rl.Coated([(RUBBER, 1e-3)], "steel")


def test_two_homogeneous_bodies_are_one_modulus_as_before():
    pair = MaterialPair(STEEL, COPPER)
    for periodic in (False, True):
        found = pair.half_space(periodic=periodic)
        assert found == rl.Homogeneous(rl.contact_modulus(STEEL, COPPER), periodic)
        assert found.softest == found.E_star
        assert found.interface == replace(found, periodic=True)


def test_a_coated_pair_gives_way_by_the_sum_of_both_bodies():
    h, q = 2e-6, np.geomspace(1e3, 1e8, 40)
    coated = rl.material("gold 2 um on copper")
    layer = BondedLayer(GOLD.E, GOLD.nu, h, COPPER.E, COPPER.nu).compliance(q)
    of_steel = 2 * (1 - STEEL.nu**2) / (STEEL.E * q)
    for first, second in ((coated, STEEL), (STEEL, coated)):
        pair = MaterialPair(first, second)
        for periodic in (False, True):
            found = pair.half_space(periodic=periodic)
            assert found.periodic == periodic
            np.testing.assert_allclose(found.spectrum(q), layer + of_steel, rtol=1e-8)
            assert found.E_star == pytest.approx(rl.contact_modulus(GOLD, STEEL), rel=1e-14)
    both = MaterialPair(coated, coated).half_space()
    np.testing.assert_allclose(both.spectrum(q), 2 * layer, rtol=1e-8)
    alone = MaterialPair(coated, rl.material("rigid")).half_space()
    np.testing.assert_allclose(alone.spectrum(q), layer, rtol=1e-8)


def test_a_thick_layer_is_its_material_and_a_thin_one_its_base():
    """At a rate: the waves of a layer of q h differ from those of its base by about q h."""
    q, steel = np.array([1e5]), STEEL.half_space()

    def off(thickness, material):
        coated = rl.Coated([(GOLD, thickness)], STEEL).half_space()
        modulus = float(coated.modulus(q)[0])
        return abs(modulus / material.half_space().E_star - 1)

    assert off(1e-3, GOLD) < 1e-12
    assert steel.modulus(q)[0] == steel.E_star
    thin = [off(thickness, STEEL) for thickness in (4e-8, 2e-8, 1e-8)]
    assert thin[2] < 2e-3
    assert thin[0] / thin[1] == pytest.approx(2, rel=0.02)
    assert thin[1] / thin[2] == pytest.approx(2, rel=0.01)


def test_repeated_layers_on_a_rigid_base_are_displaced_from_their_mean():
    pair = MaterialPair(rl.material("E=3 MPa nu=0.5 1 mm on rigid"), rl.material("rigid"))
    assert pair.half_space().interface.mean_is_free
    assert pair.layers_compliance == 0  # it keeps its volume
    pair = MaterialPair(rl.material("E=3 MPa nu=0.4 1 mm on rigid"), rl.material("rigid"))
    oedometric = 3e6 * (1 - 0.4) / ((1 + 0.4) * (1 - 0.8))
    assert pair.layers_compliance == pytest.approx(1e-3 / oedometric, rel=1e-12)
    whole = pair.half_space(periodic=True)
    assert whole.spectrum(np.zeros(1))[0] == pytest.approx(1e-3 / oedometric, rel=1e-12)
    assert whole.interface.mean_is_free


def test_strain_is_that_of_the_layer_where_it_is_soft_and_of_the_material_where_it_is_thick():
    rigid = rl.material("rigid")
    thin = MaterialPair(rl.material("E=3 MPa nu=0.4 10 um on steel"), rigid).half_space()
    oedometric = 3e6 * (1 - 0.4) / ((1 + 0.4) * (1 - 0.8))
    assert thin.strain(1e5, 1.0) == pytest.approx(1e5 / oedometric, rel=1e-3)
    thick = MaterialPair(rl.material("E=3 MPa nu=0.4 1 m on steel"), rigid).half_space()
    soft = MaterialPair(rl.material("E=3 MPa nu=0.4"), rigid)
    assert thick.strain(1e5, 1e-3) == pytest.approx(1e5 / soft.E_star, rel=1e-3)
    equal = MaterialPair(rl.material("steel 1 um on steel"), COPPER).half_space()
    of_one = MaterialPair(STEEL, COPPER)
    assert equal.strain(1e6, 1e-3) == pytest.approx(1e6 / of_one.E_star, rel=1e-9)
    assert equal.softest == pytest.approx(of_one.E_star, rel=1e-12)


def test_the_hardness_of_a_coated_body_is_that_of_its_top_layer():
    coated = rl.material("gold 2 um on copper")
    pair = MaterialPair(STEEL, coated)
    assert (pair.hardness, pair.hardness_factor) == (GOLD.hardness, 1.5)
    assert pair.softer is coated
    assert pair.bearer == "the softer body"
    given = pair.with_hardness(1e9)
    assert given.second.surface.hardness == 1e9
    assert given.second.base == COPPER
    rubber = rl.material("rubber 2 mm on steel")
    assert MaterialPair(rubber, STEEL).hardness is None  # rubber is softer, and elastic
    assert MaterialPair(rubber, STEEL).lacking("hardness") == [
        "the first body (rubber 2 mm on steel)"
    ]


def test_what_holds_for_one_material_only_is_left_out_with_the_reason():
    coated = rl.material("gold 2 um on copper")
    said = " / ".join(map(str, rules.left_out(MaterialPair(coated, STEEL), 5e6)))
    for name, reason in (
        ("tangential stiffness", "its ratio to the normal one"),
        ("estimates for comparison", "they are of bodies of one material each"),
        ("reflection", "layers reflect a part of the wave"),
    ):
        assert f"no {name} of coated bodies: {reason}" in said
    assert MaterialPair(coated, STEEL).both("resistivity") is None
    assert MaterialPair(COPPER, STEEL).both("resistivity") is not None
    assert not rules.left_out(MaterialPair(COPPER, STEEL), 5e6)


def test_currents_need_the_properties_of_all_layers():
    pair = MaterialPair(rl.material("gold 2 um on copper"), STEEL)
    assert pair.resistances("resistivity") == (
        ((GOLD.resistivity, COPPER.resistivity), (2e-6,)),
        ((STEEL.resistivity,), ()),
    )
    assert pair.resistances("conductivity")[1] == ((1 / STEEL.conductivity,), ())
    unknown = MaterialPair(rl.material("gold 2 um on rubber 1 mm on copper"), STEEL)
    assert unknown.resistances("resistivity") is None
    assert str(unknown.lacks("resistivity", "constriction resistance")).startswith(
        "no constriction resistance: the resistivity of rubber in the first body (gold 2 µm on "
    )
    assert [each.name for each in rules.measures(unknown, None)] == [
        "effective_modulus",
        "mean_gap",
        "thermal_spreading",
    ]
    assert [each.name for each in rules.measures(MaterialPair(COPPER, STEEL), None)] == ["mean_gap"]


def test_a_coated_body_has_no_contact_modulus():
    with pytest.raises(rl.InputError, match="first is a Coated; a Material"):
        rl.contact_modulus(rl.material("gold 2 um on copper"), STEEL)
