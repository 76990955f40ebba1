"""Notes and warnings: what is said together is derived from the same facts."""

import math
import re

import numpy as np
import pytest

import roughline as rl
from roughline.facts.kinds import INTERVALS
from roughline.facts.listed import listed_in_short
from roughline.margins.causes import causes
from roughline.margins.variant import AS_ASKED, Curves
from roughline.question.case import Case

PAIR = "steel,copper"


@pytest.fixture(scope="module")
def surface():
    """A surface of 64 x 64 points that is none of a larger one."""
    rough = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3)
    return rl.Surface(rough.heights, rough.sizes, "m")


def said(body, pair=PAIR, **asked):
    return rl.assess(rl.Question(body, pair, fields=False, **asked))


@pytest.mark.parametrize(
    "asked",
    [
        {"loads": "2 N"},
        {"loads": "2 N", "grid_error": False},
        {"loads": "0.1 mN", "grid_error": True},
        {"depths": "3 um"},
        {"depths": "1 nm", "grid_error": True},
        {"loads": "300 MPa", "periodic": True},
        {"loads": ["1 N", "3 N"], "ask": rl.Joint("1 cm^2")},
    ],
)
def test_what_yields_and_what_the_intervals_hold_is_said_once(surface, asked):
    result = said(surface, **asked)
    text = "; ".join(result.remarks)
    i = result.largest
    share = result.answers["plastic_fraction"].values[i]
    assert ("nothing yields" in text) == (share == 0)
    assert ("% of the contact yields" in text) == (share > 0)
    without = "values come without intervals" in text
    assert without == (
        result.answers["unloading_stiffness"].low is None
        if "ask" not in asked
        else result.answers["contact_stiffness"].low is None
    )
    assert not (without and "the intervals include that" in text)
    over_hardness = result.answers["contact_pressure_over_hardness"].values[i]
    assert (over_hardness > 0.9995) <= (share > 0.99)


def test_the_effect_of_filling_is_that_on_the_loads_that_were_asked_for(holed):
    """The lighter loads of a report's curve change more."""
    file, *_ = holed
    reading = rl.Reading(unit="m", sizes=(1e-3,))
    changes = []
    for whole_curve in (False, True):
        result = said(
            file,
            loads="10 N",
            reading=reading,
            whole_curve=whole_curve,
            grid_error=False,
            elastic=True,
        )
        changes += [note for note in result.notes if "filled by nearest instead" in note]
    assert changes[0] == changes[1]


def test_a_soft_body_of_unknown_hardness_is_elastic_and_its_partner_is_not_the_softer_one(surface):
    """Of rubber on steel, rubber is the softer one, whatever its hardness."""
    rubber = said(surface, "E=5 MPa nu=0.49, steel", loads="1 kPa")
    assert rubber.curve.hardness is None
    assert "contact_pressure_over_hardness" not in rubber.answers
    text = "; ".join(rubber.remarks)
    assert "the first body (E=5 MPa nu=0.49) is not known, and it is the softer one" in text
    assert "of the softer body" not in text
    metal = said(surface, "E=70 GPa nu=0.33, steel", loads="1 N", grid_error=False)
    text = "; ".join(metal.remarks)
    assert metal.curve.hardness == rl.material("steel").hardness
    assert "1.3 GPa, of the second body (steel)" in text
    assert "of the softer body" not in text
    with pytest.raises(rl.InputError, match=r"the second body \(steel\), of hardness 1.3 GPa"):
        said(surface, "E=70 GPa nu=0.33, steel", loads="2 GPa")


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"depths": "1 m"}, "depth 1 m is 1000 times the shorter side of the body"),
        ({"depths": ["1 um", "2 mm"]}, "depth 2 mm is 2 times the shorter side"),
        (
            {"loads": "1 MN", "elastic": True},
            "pressure of load 1 MN is 11 times the contact modulus",
        ),
    ],
)
def test_loads_far_beyond_sense_are_refused(surface, asked, message):
    with pytest.raises(rl.InputError, match=re.escape(message)) as refused:
        said(surface, **asked)
    assert "\n" not in str(refused.value)


def test_a_depth_that_indents_all_of_the_body_is_refused(surface):
    with pytest.raises(rl.InputError, match="depth 0.5 mm indents all of the body") as refused:
        said(surface, depths="0.5 mm")
    assert "\n" not in str(refused.value)


def test_strains_beyond_linear_elasticity_are_warned_of(surface):
    text = "; ".join(said(surface, loads="20 kN", elastic=True, grid_error=False).warnings)
    assert "load 20 kN is 0.22 times the contact modulus: bodies that are strained" in text
    text = "; ".join(said(surface, loads="2 kN", elastic=True, grid_error=False).warnings)
    assert "strained" not in text


def test_full_contact_is_said(surface):
    smooth = rl.Surface(surface.heights / 1000, surface.sizes, "m")
    result = said(smooth, loads=["1 mN", "20 N"], periodic=True, elastic=True)
    assert np.isinf(result.answers["contact_stiffness"].values).tolist() == [False, True]
    text = "; ".join(result.warnings)
    assert "all points touch under 20 N: no gap is left, and stiffness is infinite" in text


@pytest.mark.parametrize(
    ("half_space", "rest"),
    [
        (
            rl.Layered(1e9, 0.3, 1e-4, base_young=math.inf, periodic=True),
            "k is that of even pressure on the rigid base",
        ),
        (rl.Homogeneous(1e9, periodic=True), "stiffness is infinite"),
        (rl.Homogeneous(1e9), "k is that of a flat punch"),
    ],
)
def test_how_stiff_a_full_contact_is_follows_from_the_half_space(surface, half_space, rest):
    smooth = rl.Surface(surface.heights / 1000, surface.sizes, "m")
    result = said(smooth, loads=["1 mN", "20 N"], periodic=True, elastic=True)
    curve = rl.press(smooth, half_space=half_space, forces=result.curve.force)
    found = causes["grid"].facts(Case.of(result.question), Curves({AS_ASKED: curve}))
    assert any(str(each).endswith(f"no gap is left, and {rest}") for each in found)
    assert np.isinf(curve.stiffness[-1]) == (rest == "stiffness is infinite")


def test_a_wide_interval_names_its_largest_cause_first(surface):
    """Few points in contact leave more open than the hardness; many of a metal do not."""
    cropped = rl.Surface(surface.heights, surface.sizes, "m", is_cut_out=True)
    few = said(cropped, loads="1 N", ask=rl.Joint("1 cm^2"), grid_error=True)
    (note,) = [text for text in few.warnings if "is left open by" in text]
    cells = round(few.curve.area_fraction[0] * 64**2)
    assert f"with {cells} of 4096 points in contact" in note
    factors = [float(each) for each in re.findall(r"\(a factor of ([0-9.e+]+)\)", note)]
    assert factors == sorted(factors, reverse=True)
    k_i = few.answers["interface_stiffness"]
    assert k_i.high[0] / k_i.low[0] >= 4
    known = said(surface, loads="20 N", periodic=True, hardness="370 MPa", grid_error=True)
    assert not [text for text in known.warnings if "is left open by" in text]


@pytest.mark.parametrize(
    ("pair", "told"),
    [
        (
            "gold 20 um on copper, steel",
            [
                "the hardness of gold is 220 MPa here, of annealed metal, and layers of it have up "
                "to 2 GPa where they are plated, as hard-gold"
            ],
        ),
        ("gold, steel", []),
        ("gold hardness=1 GPa 20 um on copper, steel", []),
        ("hard-gold 20 um on copper hardness=2 GPa, steel hardness=3 GPa", []),
        ("dlc, steel", ["E of dlc is 259 GPa here, and layers of it have 100 to 760 GPa"]),
        ("dlc E=200 GPa, steel", []),
        (
            "TiN 20 um on steel, copper",
            ["E of titanium-nitride is 464 GPa here, and layers of it have 250 to 590 GPa"],
        ),
    ],
)
def test_a_layer_is_told_from_the_bulk_that_the_table_has(pair, told):
    rough = rl.SelfAffine(hurst=0.8, length=5e-4, rms_height=1e-6, q_roll=2.5e4).surface(16, rng=7)
    result = said(rough, pair, loads="1 mN", grid_error=False)
    kinds = ("layer_modulus_differs", "layer_hardness_differs")
    found = [fact for fact in result.facts if fact.kind in kinds]
    assert [
        str(note).partition(", which no interval includes: give it with")[0] for note in found
    ] == told
    assert all(note.about == INTERVALS for note in found)


def test_a_hardness_that_is_given_or_not_used_needs_no_word_on_layers():
    rough = rl.SelfAffine(hurst=0.8, length=5e-4, rms_height=1e-6, q_roll=2.5e4).surface(16, rng=7)
    for asked in ({"hardness": "1 GPa"}, {"elastic": True}):
        result = said(rough, "gold 20 um on copper, steel", loads="1 mN", grid_error=False, **asked)
        assert not [note for note in result.notes if "layers of it have" in note]


@pytest.mark.parametrize("pair", ["steel,steel", "rubber,glass"])
def test_a_whole_curve_has_the_words_of_the_loads_that_were_asked_for(surface, pair):
    """A page presses lighter loads for its pictures, and warns of none of them."""
    cut = rl.Surface(surface.heights, surface.sizes, "m", is_cut_out=True)
    given = {"loads": ["1 N"], "grid_error": False, "elastic": True}
    asked, whole = (
        rl.assess(rl.Question(cut, pair, whole_curve=each, **given)) for each in (False, True)
    )
    assert whole.curve.force.size > asked.curve.force.size
    assert whole.remarks == asked.remarks
    assert any("within 5% of the border" in each for each in asked.warnings)


def test_a_sentence_names_three_and_counts_the_others():
    assert listed_in_short(["depth"]) == "depth"
    assert listed_in_short(["depth", "force", "area"]) == "depth, force and area"
    assert listed_in_short(["depth", "force", "area", "gap", "work"]).endswith("area and 2 more")
