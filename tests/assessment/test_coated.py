"""Questions of coated bodies: limits, what is left out, remarks and refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.contact.conduction import conductance
from roughline.margins import variant as variants

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4)
SURFACE = SPECTRUM.surface(64, rng=7)
SMALL = rl.SelfAffine(hurst=0.8, length=5e-4, rms_height=1e-6, q_roll=2.5e4).surface(32, rng=7)
SMALL_OR_LARGE = pytest.mark.parametrize("body", [SMALL, SURFACE], ids=["small", "large"])
MAP = replace(SURFACE, is_cut_out=True)
RTOL = 1e-11
GOLD = (2.21e-8, 6.93e-8, 1.68e-8), (20e-6, 40e-6)
OF_ONE_MATERIAL = {
    *("tangential_stiffness", "holm_resistance", "mikic_conductance", "plastic_conductance"),
    "reflection",
}
"""Answers whose formulas do not hold of layers."""

OF_LAYERS = {"layer_stiffness", "effective_modulus"}
"""Answers of coated bodies alone."""


def assessed(materials, loads=("0.1 N", "1 N"), body=SURFACE, **others):
    return rl.assess(rl.Question(body, materials=materials, loads=loads, **others))


@pytest.fixture
def _to_rounding(monkeypatch):
    """Press so closely that no solution is farther from another than its tolerance."""
    press = variants.press
    monkeypatch.setattr(
        variants, "press", lambda body, **given: press(body, **{**given, "rtol": RTOL})
    )


def differences(first, second):
    """Largest relative difference of each answer that both have, ends of intervals included."""
    found = {}
    for key in first.answers.keys() & second.answers.keys():
        for name in ("values", "low", "high"):
            one, other = (getattr(each.answers[key], name) for each in (first, second))
            if one is None or other is None:
                continue
            with np.errstate(invalid="ignore", divide="ignore"):
                off = np.where(one == other, 0.0, np.abs(other / one - 1))
            found[f"{key} {name}"] = float(np.nanmax(off, initial=0.0))
    return found


@pytest.mark.parametrize(
    ("others", "body"),
    [
        ({"elastic": True}, SURFACE),
        ({}, SURFACE),  # copper yields
        ({"periodic": True, "elastic": True, "loads": ("1 N", "20 N", "100 N")}, SURFACE),
        *(
            ({"ask": [rl.Ultrasound("5 MHz"), rl.Fluid("helium", closure=True)]}, body)
            for body in (SMALL, SURFACE)
        ),
        *(
            ({"ask": [rl.Adhesion("50 J/m^2")], "elastic": True, "loads": "0.1 N"}, body)
            for body in (SMALL, SURFACE)
        ),
        ({"unload": True, "loads": "1 N"}, SURFACE),
    ],
)
@pytest.mark.usefixtures("_to_rounding")
def test_a_coating_of_its_base_changes_no_answer_that_is_kept(others, body):
    plain = assessed(("steel", "copper"), body=body, **others)
    coated = assessed(("steel 20 um on steel", "copper"), body=body, **others)
    of_a_piece = {"thermal_conductance_per_area", "joint_conductance"}
    left_out = OF_ONE_MATERIAL | (set() if others.get("periodic") else of_a_piece)
    assert set(plain.answers) - set(coated.answers) <= left_out
    assert set(coated.answers) - set(plain.answers) <= OF_LAYERS
    assert coated.answers["effective_modulus"].values == pytest.approx(plain.curve.E_star, rel=1e-6)
    assert max(differences(plain, coated).values()) < 1e-9
    assert coated.curve.E_star == pytest.approx(plain.curve.E_star, rel=1e-14)
    scattered = coated.hardness_scatter.keys() - OF_LAYERS
    assert scattered == coated.answers.keys() & plain.hardness_scatter.keys()


def test_spaced_loads_of_a_coating_of_its_base_are_the_same():
    """They come from a disc's stiffness, which is found from the waves."""
    each = ("steel", "copper"), ("steel 20 um on steel", "copper")
    asked = {"periodic": True, "elastic": True, "grid_error": False, "fields": False}
    plain, coated = (assessed(pair, (), **asked) for pair in each)
    np.testing.assert_allclose(coated.curve.force, plain.curve.force, rtol=1e-12)


@pytest.mark.parametrize("joint", [[], [rl.Joint("2 cm^2")]])
@pytest.mark.usefixtures("_to_rounding")
def test_of_a_map_the_values_are_the_same_and_the_larger_surface_is_left_open(joint):
    pair = ("steel", "copper"), ("steel", "copper 20 um on copper")
    plain, coated = (assessed(each, "1 MPa", MAP, elastic=True, ask=joint) for each in pair)
    assert coated.answers.keys() - plain.answers.keys() == OF_LAYERS
    for key in coated.answers.keys() & plain.answers.keys():
        np.testing.assert_allclose(coated.answers[key].values, plain.answers[key].values, rtol=1e-9)
    assert "thermal_conductance_per_area" in coated.answers
    assert ("constriction_resistance" in coated.answers) == bool(joint)
    assert plain.answers["interface_stiffness"].low is not None
    assert coated.answers["interface_stiffness"].low is None
    said = [each for each in coated.notes if "how far a larger surface may be from its map" in each]
    assert len(said) == 1
    assert "interface stiffness" in said[0]


def test_numbers_are_those_of_the_full_model_on_the_sum_of_both_bodies():
    layer = rl.Layered([78e9], [0.44], [20e-6], 129.8e9, 0.343)
    steel = rl.Homogeneous(211.9e9 / (1 - 0.291**2))
    curve = rl.press(SURFACE, half_space=layer + steel, forces=[0.1, 1.0])
    for pair in (("gold 20 um on copper", "steel"), ("steel", "gold 20 um on copper")):
        found = assessed(pair, elastic=True)
        for name in ("depth", "stiffness", "area_fraction"):
            np.testing.assert_allclose(
                getattr(found.curve_as_asked, name), getattr(curve, name), rtol=1e-7
            )


def test_a_thick_layer_is_its_material():
    layer = assessed(("rubber", "rigid"), "10 mN")
    coated = assessed(("rubber 1 km on steel", "rigid"), "10 mN")
    off = differences(layer, coated)
    assert max(off[f"{key} values"] for key in coated.answers.keys() & layer.answers.keys()) < 1e-5
    assert coated.answers["effective_modulus"].values == pytest.approx(
        coated.curve.E_star, rel=1e-5
    )
    # the base is felt by the approach of the body as a whole, in proportion to its distance
    nearer = assessed(("rubber 10 m on steel", "rigid"), "10 mN")
    moved = differences(layer, nearer)["contact_stiffness values"]
    assert moved == pytest.approx(100 * off["contact_stiffness values"], rel=0.05)


@pytest.mark.parametrize("n", [64, 128])
def test_a_thin_layer_is_its_base_within_its_thickness(n):
    """Contacts many cells wide, on layers of 2, 1 and 0.5 cells: half the layer, at most half."""
    wide = rl.SelfAffine(hurst=1.0, length=1e-3, rms_height=1e-6, q_high=1.3e4).surface(n, rng=3)
    base = assessed(("steel", "rigid"), "2 kN", wide, elastic=True, grid_error=False)
    k = base.answers["contact_stiffness"].values[0]
    off = []
    for cells in (2, 1, 0.5):
        text = f"gold {cells * 1e-3 / n:.12g} m on steel"
        found = assessed((text, "rigid"), "2 kN", wide, elastic=True, grid_error=False)
        off.append(1 - found.answers["contact_stiffness"].values[0] / k)
    assert 0 < off[2] < 2e-3
    assert off[0] > 1.9 * off[1] > 3.6 * off[2]


def test_the_interface_of_a_piece_leaves_out_what_a_flat_punch_on_the_same_layers_gives():
    found = assessed(("E=3 MPa nu=0.4 100 um on steel", "rigid"), ["20 mN", "0.1 N"])
    flat = rl.Surface(np.zeros((64, 64)), (1e-3, 1e-3))
    of_punch = rl.press(flat, half_space=found.curve.half_space, forces=[1.0]).stiffness[0]
    k = found.answers["contact_stiffness"].values
    k_i = found.answers["interface_stiffness"].values
    np.testing.assert_allclose(1 / k_i, 1 / k - 1 / of_punch, rtol=1e-6)
    remark = next(each for each in found.remarks if "punch with its outline" in each)
    assert "a fifth less stiff" not in remark


def test_a_rigid_base_is_the_limit_of_a_stiff_one_for_the_interface():
    """Layers on either are repeated without what even pressure displaces them by."""
    of = [
        assessed((f"E=3 MPa nu=0.4 50 um on {base}", "rigid"), "0.1 N", periodic=True)
        for base in ("rigid", "E=3000 GPa nu=0.3")
    ]
    assert max(differences(*of).values()) < 1e-4
    note = next(each for each in of[0].remarks if "those of the interface alone" in each)
    even = 50e-6 / (3e6 * (1 - 0.4) / ((1 + 0.4) * (1 - 0.8)))
    assert f"{even * 1e5 * 1e9:.1f} nm under 100 kPa" in note
    assert note in of[1].remarks


def test_layers_give_way_as_a_whole_in_series_with_the_interface():
    """A slab of the base, ten waves deep on a rigid plate, is the periodic body as a whole."""
    depth, area = 4e-3, SMALL.area
    pair = "E=5 MPa nu=0.45 200 um on E=9 MPa nu=0.3", "rigid"
    found = assessed(pair, "0.01 N", SMALL, periodic=True, grid_error=False)
    k, k_l = (found.answers[f"{name}_stiffness"].values for name in ("contact", "layer"))
    of_slab = area * _constrained(9e6, 0.3) / depth
    assert k_l == pytest.approx(area * _constrained(5e6, 0.45) / 200e-6, rel=1e-12)
    slab = rl.Layered((5e6, 9e6), (0.45, 0.3), (200e-6, depth), math.inf, periodic=True)
    whole = rl.press(SMALL, half_space=slab, forces=[0.01])
    assert whole.stiffness == pytest.approx(1 / (1 / k + 1 / k_l + 1 / of_slab), rel=1e-5)
    assert k > 0.1 * k_l
    assert any("in series with k" in each for each in found.warnings)


def _constrained(young, poisson):
    """Stress over strain where sides cannot move, by Hooke's law. [Pa]"""
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    stiffness = np.full((3, 3), lame) + np.eye(3) * young / (1 + poisson)
    return (stiffness @ [1.0, 0.0, 0.0])[0]


def test_layers_of_a_joint_give_way_as_its_area_does_and_those_of_a_piece_alone_are_in_k():
    layered = ("E=5 MPa nu=0.45 200 um on steel", "E=5 MPa nu=0.45 100 um on steel")
    joint = assessed(layered, "2 kPa", MAP, ask=[rl.Joint("2 cm^2")], grid_error=False)
    found = joint.answers["layer_stiffness"].values
    assert found == pytest.approx(2e-4 * _constrained(5e6, 0.45) / 300e-6, rel=1e-12)
    free = assessed(layered, "2 kPa", grid_error=False)
    assert "layer_stiffness" not in free.answers


def test_a_layer_that_keeps_its_volume_may_be_repeated_on_a_rigid_base():
    found = assessed(("E=3 MPa nu=0.5 50 um on rigid", "rigid"), "0.1 N", periodic=True)
    nearly = assessed(("E=3 MPa nu=0.49999 50 um on rigid", "rigid"), "0.1 N", periodic=True)
    of_layers, of_nearly = (each.answers.pop("layer_stiffness") for each in (found, nearly))
    assert max(differences(found, nearly).values()) < 2e-3
    assert np.isinf(of_layers.values).all()
    assert of_nearly.values == pytest.approx(SURFACE.area * 50e9 / 50e-6, rel=1e-3)
    assert any("keep their volume" in each for each in found.notes)


@SMALL_OR_LARGE
def test_the_hardness_is_that_of_the_top_layer_and_a_remark_says_so(body):
    values = {"grid_error": False, "fields": False, "body": body}
    found = assessed(("steel", "gold 20 um on nickel 40 um on copper"), "1 N", **values)
    assert found.curve.hardness == rl.material("gold").hardness
    said = " / ".join(found.notes)
    assert "the hardness of gold 20 µm on nickel 40 µm on copper is that of its top layer" in said
    elastic = assessed(("steel", "gold 20 um on copper"), "1 N", elastic=True, **values)
    assert (
        "no plasticity index of coated bodies: it is of summits of one material each"
        in " / ".join(elastic.notes)
    )
    assert not any("plasticity index is" in each for each in elastic.remarks)
    given = assessed(("steel", "gold 20 um on copper"), "1 N", hardness="1 GPa", **values)
    assert given.curve.hardness == 1e9


def test_what_is_left_out_is_named_with_its_reason():
    found = assessed(("gold 20 um on copper", "steel"), "1 N", ask=rl.Ultrasound("5 MHz"))
    assert not OF_ONE_MATERIAL & found.answers.keys()
    said = " / ".join(map(str, found.left_out))
    for name in ("tangential stiffness", "estimates for comparison"):
        assert f"no {name} of coated bodies: " in said
    assert "no reflection of coated bodies: layers reflect a part of the wave themselves" in said


@pytest.mark.parametrize("surface", [SMALL, SURFACE], ids=["small", "large"])
def test_currents_are_solved_through_the_layers(surface):
    """Of a piece all of it, of a map its interface, of a joint both; each says what it lacks."""
    gold, bodies = "gold 20 um on nickel 40 um on copper", (GOLD, ((1.6e-7,), ()))
    map_ = replace(surface, is_cut_out=True)
    piece = assessed((gold, "steel"), "1 N", surface, elastic=True)
    touching = piece.fields.contact
    R = 1 / conductance(touching, surface.sizes, bodies, False)
    assert piece.answers["constriction_resistance"].values[0] == pytest.approx(R, rel=1e-9)
    assert "thermal_conductance_per_area" not in piece.answers
    assert any("no conductance per area of its interface" in each for each in piece.notes)
    homogeneous = assessed(("gold", "steel"), "1 N", surface, elastic=True)
    assert pytest.approx(homogeneous.answers["constriction_resistance"].values[0], rel=0.01) != R
    of_map = assessed((gold, "steel"), "1 MPa", map_, elastic=True)
    assert "constriction_resistance" not in of_map.answers
    assert any("neither resistance nor conductance of the map alone" in n for n in of_map.notes)
    joint = assessed((gold, "steel"), "1 MPa", map_, elastic=True, ask=rl.Joint("2 cm^2"))
    h_c = [each.answers["thermal_conductance_per_area"].values[0] for each in (of_map, joint)]
    assert h_c[0] == pytest.approx(h_c[1], rel=1e-6)
    G = joint.answers["thermal_conductance"].values[0]
    assert pytest.approx(h_c[1] * 2e-4, rel=1e-12) == G
    rho_c = joint.answers["specific_contact_resistance"].values[0]
    R = joint.answers["constriction_resistance"].values[0]
    assert rho_c == pytest.approx(R * 2e-4, rel=1e-12)
    even = 20e-6 * 2.21e-8 + 40e-6 * 6.93e-8
    assert any(f"adds {even:.3g} Ω m² of electricity" in each for each in joint.notes)


def test_the_interval_of_a_current_is_as_wide_as_that_of_the_stiffness():
    found = assessed(("gold 20 um on copper", "steel"), "1 N", elastic=True)
    k, R = (found.answers[key] for key in ("contact_stiffness", "constriction_resistance"))
    assert R.low[0] / R.values[0] == pytest.approx(k.values[0] / k.high[0], rel=1e-9)
    assert R.high[0] / R.values[0] == pytest.approx(k.values[0] / k.low[0], rel=1e-9)


@SMALL_OR_LARGE
def test_theories_stay_where_they_hold(body):
    theories = rl.Theories("persson", "bush-gibson-thomas", "greenwood-williamson")
    asked = {"loads": "20 kPa", "body": body, "ask": theories}
    thick = assessed(("E=3 MPa nu=0.4 300 um on steel", "rigid"), **asked)
    assert [each.name for each in thick.theories] == ["persson"]
    said = " / ".join(map(str, thick.left_out))
    assert "no bush-gibson-thomas: its summits are spheres of one material" in said
    thin = assessed(("E=3 MPa nu=0.4 20 um on steel", "rigid"), **asked)
    assert thin.theories == []
    assert "no persson: the layers meet these waves" in " / ".join(map(str, thin.left_out))
    plain = assessed(("steel", "copper"), **asked)
    coated = assessed(("steel 20 um on steel", "copper"), **asked)
    assert len(plain.theories) == len(coated.theories) == 3
    for one, other in zip(plain.theories, coated.theories, strict=True):
        np.testing.assert_allclose(one.area_fraction, other.area_fraction, rtol=1e-9)


def test_soft_layers_under_high_pressure_are_warned_of():
    found = assessed(("E=3 MPa nu=0.4 50 um on steel", "rigid"), ["0.1 N", "2 N"])
    assert any("times the contact modulus of the softest materials" in w for w in found.warnings)
    light = assessed(("E=3 MPa nu=0.4 50 um on steel", "rigid"), "5 mN")
    assert not any("softest materials" in each for each in light.warnings)


@SMALL_OR_LARGE
def test_a_layer_that_is_indented_through_is_warned_of(body):
    rough = body.scaled(4.0)
    said = "the layer of gold, 8 µm, is indented by up to"
    thin, thick = (
        assessed((f"gold {h} on nickel", "steel"), "9 MPa", rough, hardness="10 MPa")
        for h in ("8 um", "80 um")
    )
    assert thin.curve.indentation.max() > 8e-6
    assert any(each.startswith(said) for each in thin.warnings)
    assert 8e-6 < thick.curve.indentation.max() < 80e-6
    assert not any("is indented by up to" in each for each in thick.warnings)


@pytest.mark.parametrize("n", [32, 64])
def test_several_maps_have_a_mean_and_say_what_is_not_known(n):
    maps = [replace(SPECTRUM.surface(n, rng=seed), is_cut_out=True) for seed in (1, 2)]
    found = assessed(("gold 20 um on copper", "steel"), "1 MPa", maps, elastic=True)
    k_i = found.answers["interface_stiffness"]
    assert np.isfinite(k_i.mean).all()
    assert np.isnan(k_i.low).all()
    assert any(
        "how maps differ from the part behind them is known of bodies of one" in each
        for each in found.warnings
    )


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (
            {"materials": ("gold 7 um on copper", "steel")},
            "materials have a layer of gold, 7 µm, thinner than half a cell of 15.62 µm: leave it "
            "out, as what lies below is felt alone",
        ),
        (
            {"materials": ("gold 20 um on copper", "steel"), "ask": rl.Friction(0.3)},
            "partial slip (rl.Friction) follows from the ratio .* gold 20 µm on copper is coated",
        ),
        (
            {"materials": "rubber 2 mm on steel"},
            'give two with a comma between, such as "steel,copper" or "rubber 2 mm on steel,rigid"',
        ),
        (
            {"materials": ("rubber on steel", "rigid")},
            'materials "rubber on steel" cannot be used: "rubber" is no layer: write its material',
        ),
        (
            {"materials": "rubber 50 um on steel, rigid", "loads": "5 kN"},
            "the mean pressure of load 5 kN strains the layers or their base by about",
        ),
        (
            {"materials": ("gold 20 um on copper", "steel"), "body": SPECTRUM.line(512, rng=1)},
            'materials "gold 20 µm on copper" is coated, and the springs of a line have one',
        ),
        (
            {
                "materials": ("steel", "gold 20 um on copper"),
                "body": rl.Line(SURFACE.heights[0], 1e-3, "m", kind="profile"),
            },
            "is coated, and the springs of a line have one modulus: give a body of one material",
        ),
    ],
)
def test_what_cannot_be_asked_of_layers_gets_one_line(asked, message):
    with pytest.raises(
        rl.InputError, match=message.replace("(", r"\(").replace(")", r"\)")
    ) as told:
        rl.assess(rl.Question(**{"body": SURFACE, "loads": "1 N", **asked}))
    assert "\n" not in str(told.value)
    assert len(str(told.value)) <= 350
    assert told.value.argument == "materials" or "rl.Friction" in message or "strains" in message


@pytest.mark.parametrize(
    ("surface", "load", "along"),
    [(SMALL, "25 mN", "x"), (SURFACE, "0.1 N", "both")],
    ids=["small", "large"],
)
def test_thin_layers_have_no_bound_of_a_coarser_grid_where_they_are_sealed(surface, load, along):
    """Half as many points would not resolve the layer, so what they leave open is not known."""
    pair = ("E=3 MPa nu=0.4 12 um on steel", "rigid")
    ask = rl.Fluid("water", along=along, closure=True)
    found = assessed(pair, load, surface, ask=ask)
    sealing = found.answers["sealing_pressure"]
    assert np.isfinite(sealing.values).all()
    assert sealing.low is None
    assert math.isfinite(found.answers["hydraulic_aperture"].values[0])


def plated(film):
    """A map of spots that are some micrometres wide, pressed by something hard."""
    spectrum = rl.SelfAffine(hurst=0.8, length=5e-5, rms_height=3e-7, q_roll=5e5, q_high=1e6)
    surface = replace(spectrum.surface(64, rng=3), unit="m")
    pair = (film, "steel hardness=8 GPa")
    given = {"loads": ["60 MPa"], "periodic": True, "grid_error": True}
    return rl.assess(rl.Question(surface, pair, **given))


@pytest.mark.parametrize(
    ("film", "way", "solid"),
    [
        ("gold 0.5 um on nickel", "harder, so area and conductance are too large", "nickel"),
        ("nickel 0.5 um on gold", "softer, so area and conductance are too small", "gold"),
    ],
)
def test_spots_wider_than_a_film_is_thick_feel_what_lies_below(film, way, solid):
    """The interval holds the area of the solid below; a thick film is that of its own."""
    thin, below = plated(film), plated(solid)
    area = thin.answers["contact_area"]
    inside = below.answers["contact_area"].values
    assert area.low < inside < area.high
    assert any(way in each for each in thin.remarks)
    thick = plated(film.replace("0.5 um", "50 um"))
    assert not any("as well, which is" in each for each in thick.remarks)
    assert not thick.answers["contact_area"].low < inside < thick.answers["contact_area"].high


def test_a_film_whose_hardness_is_given_is_told_without_an_interval():
    given = plated("gold hardness=220 MPa 0.5 um on nickel")
    (said,) = (each for each in given.remarks if "contact spots have a mean radius" in each)
    assert said.endswith("no interval includes that, as the hardness of the layer is given")
    table = plated("gold 0.5 um on nickel").answers["contact_area"]
    assert given.answers["contact_area"].low > table.low
