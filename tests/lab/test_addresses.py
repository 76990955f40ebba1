"""Any address that the page writes gives the same state again."""

from pathlib import Path
from urllib.parse import parse_qsl, urlencode

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roughline.lab.controls import VERSION, usable
from roughline.lab.explore import controls as explore
from roughline.lab.explore.physics import PHYSICS
from roughline.lab.explore.reading import read_state as explore_state
from roughline.lab.explore.state import ExploreState
from roughline.lab.measured import controls as measured
from roughline.lab.measured.state import Source, control_texts, page_question
from roughline.lab.published import controls as published
from roughline.lab.published.state import read_state as published_state
from roughline.units import engineering

NUMBERS = [each for key, each in explore.NUMBERS.items() if key != "seed"]
DIMENSIONS = [f"{each:g}" for each in published.DIMENSIONS]
WORDS = (explore.CHOICES["rms"], explore.CHOICES["boundary"], explore.CHOICES["shown"])


def texts(control):
    """Numbers of a control as they may be typed or written, its ends among them."""
    ends = st.sampled_from([control.low, control.high, control.default])
    value = st.floats(control.low, control.high) | ends
    return st.tuples(value, st.integers(4, 17)).map(lambda each: f"{each[0]:.{each[1]}g}")


def quantities(unit, least, most):
    """Quantities as they may be typed, with a prefix."""
    value = st.floats(least, most)
    return st.tuples(value, st.integers(2, 12)).map(lambda v: engineering(v[0], unit, v[1]))


def some(controls):
    """Texts of some of the controls."""
    return st.fixed_dictionaries({}, optional=controls)


STATES = some(
    {
        **{each.key: texts(each) for each in NUMBERS},
        **{each.key: texts(each) for kind in PHYSICS for each in kind.controls},
        "fluid": st.just("x"),
        **{each.key: st.sampled_from(list(each.options)) for each in WORDS},
        "n": st.sampled_from(["64", "128"]),
        "seed": st.integers(0, 999_999).map(str),
        "L": quantities("m", 1e-12, 1e3),
        "E": quantities("Pa", 1, 1e14),
        "theories": st.lists(st.sampled_from(list(explore.CHOICES["theories"].options))).map(
            ",".join
        ),
    }
)
WITH_UNITS = some(
    {
        "L": quantities("m", 1e-6, 1),
        "h": quantities("m", 1e-9, 1e-3),
        "roll_off": quantities("m", 1e-6, 1),
        "cutoff": quantities("m", 1e-7, 1e-1),
        "F": quantities("N", 1e-3, 1e3) | quantities("Pa", 1e3, 1e9),
        "hardness_bar": quantities("Pa", 1e6, 1e11),
    }
)


@settings(max_examples=150, deadline=None)
@given(STATES, WITH_UNITS)
def test_an_address_of_explore_gives_its_state_again(said, with_units):
    asked = {"state": said | with_units}
    state, _ = usable(asked, explore_state, lambda found: {})
    assert explore_state(state.address()) == state
    added = {each.key for each in state.added}
    assert {kind.key for kind in PHYSICS} & state.address().keys() == added
    assert all(kind.key in said | with_units for kind in PHYSICS if kind.key in added)


@settings(max_examples=150, deadline=None)
@given(
    some(
        {
            **{key: texts(each) for key, each in published.NUMBERS.items()},
            **{key: st.sampled_from(list(each.options)) for key, each in published.CHOICES.items()},
            "D_f": st.lists(st.sampled_from(DIMENSIONS), min_size=1).map(",".join),
        }
    )
)
def test_an_address_of_the_paper_gives_its_state_again(said):
    state, _ = usable({"state": said}, published_state, lambda found: {})
    assert published_state(state.address()) == state


CHOICES = [each for key, each in measured.CHOICES.items() if key != "elastic"]
LENGTHS = quantities("m", 1e-9, 1)
LOADS = quantities("N", 1e-9, 1e6) | quantities("Pa", 1, 1e12)
MATERIALS = st.sampled_from(["steel", "gold", "E=70 GPa nu=0.33", "steel hardness=2 GPa", "Glass"])
OF_MY_SURFACE = some(
    {
        **{each.key: st.sampled_from(list(each.options)) for each in CHOICES},
        **{"first": MATERIALS, "second": MATERIALS | st.just("rigid")},
        **{"low_pass": LENGTHS, "tip_radius": LENGTHS, "blur": LENGTHS | st.just("0")},
        "size": st.lists(LENGTHS, min_size=1, max_size=2).map(", ".join),
        "crop": st.lists(LENGTHS, min_size=4, max_size=4).map(", ".join),
        "unit": st.sampled_from(["nm", "um", "µm", "mm", "m"]),
        "resample": st.integers(2, measured.MOST_POINTS).map(str),
        "most_missing": st.floats(0, 99).map(lambda share: f"{share:g} %") | st.just("1e-6"),
        "E": quantities("Pa", 1, 1e14),
        "loads": st.lists(LOADS, max_size=4).map("; ".join),
        "joint_area": quantities("m", 1e-9, 1).map(lambda length: f"{length}^2"),
        "hardness": quantities("Pa", 1e3, 1e12),
        "elastic": st.just("no"),
        "friction": st.floats(1e-9, 5).map(repr),
        "frequency": quantities("Hz", 1, 1e9),
        "fluid": st.sampled_from(["water", "oil VG 46", "helium", "viscosity=20 mPa s"]),
        "theories": st.lists(st.sampled_from(["persson", "greenwood-williamson"])).map(",".join),
    }
)


@settings(max_examples=150, deadline=None)
@given(OF_MY_SURFACE)
def test_an_address_of_my_surface_asks_the_same_again(said):
    if said.get("bodies") == "modulus":
        said = {key: text for key, text in said.items() if key not in ("joint_area", "friction")}
        for key in ("frequency", "fluid", "sealing_pressure"):
            said.pop(key, None)
    said.pop("fluid_carries", None)  # which belongs to an inlet
    if "fluid" not in said and said.get("sealing_pressure") != "yes":
        said.pop("flow_along", None)
    state = {"first": "steel", "second": "copper", "E": "1 GPa", "v": VERSION} | said
    again = dict(parse_qsl(urlencode(sorted(state.items())), keep_blank_values=True))
    source = Source(Path("a.nc"), "a.nc", "key")
    first, second = (
        page_question(control_texts({"state": each}), source) for each in (state, again)
    )
    assert first == second


@pytest.mark.parametrize(
    "link", ["view=measured", "view=measured&v=1&bodies=modulus&E=110+GPa&example=film&loads=5+N"]
)
def test_a_link_of_my_surface_of_an_older_lab_is_read(link):
    said = control_texts({"state": {"first": "steel", "second": "copper"} | dict(parse_qsl(link))})
    assert page_question(said, Source(Path("a.nc"), "a.nc", "key")).loading.headings == (
        ["5 N"] if "loads" in link else []
    )


OF_0_2_0 = {
    "explore": "v=1&D_f=2.2&H=0.8&roll_off=0.5&cutoff=0.01&rms=slope&h=0.001&slope=0.1&seed=3&n=128"
    "&boundary=periodic&hardness_bar=0.5&F=0.1&shown=gap&L=2+mm&E=200+GPa&theories=persson"
    "&view=explore&theme=dark",
    "published": "v=1&D_f=2,2.2&mean=geometric&punch=exact&low_1D=0.0001&high_1D=0.01&low_3D=0.01"
    "&high_3D=0.1&tolerance=0.1&roll_off=2&map_D_f=2.2&map_F=0.1&claims=confirmed&view=published",
    "measured": "v=1&example=film&unit=um&size=1+mm&fill=nearest&most_missing=20+%25&trend=tilt"
    "&outliers=remove&crop=0+um,+2+um,+0+um,+2+um&low_pass=1+um&resample=64&bodies=materials"
    "&first=steel&second=copper&E=110+GPa&loads=2+MPa&boundary=periodic&friction=0.3"
    "&frequency=5+MHz&theories=persson&grid_error=no&elastic=no&hardness=2+GPa&joint_area=2+cm%5E2"
    "&channel=0&view=measured",
}
"""Links that set every key of version 0.2.0."""


def test_links_of_version_0_2_0_are_read():
    published = published_state(dict(parse_qsl(OF_0_2_0["published"]))).address()
    assert published.items() >= dict(parse_qsl(OF_0_2_0["published"].split("&claims")[0])).items()
    said = control_texts({"state": dict(parse_qsl(OF_0_2_0["measured"]))})
    question = page_question(said, Source(Path("a.nc"), "a.nc", "key"))
    assert question.loading.headings == ["2 MPa"]
    assert question.friction == 0.3
    assert question.reading.channel == "0"
    assert question.preparation.points == 64


OF_0_3_0 = {
    "explore": OF_0_2_0["explore"].replace("shown=gap", "shown=flux")
    + "&t=0.1&E_l=2&nu_l=0.3&nu_b=0.25&fluid=x",
    "sticking": "v=1&D_f=2.4&n=64&seed=3&F=0.2&w=0.01&h0=0.05&shown=retreat",
    "measured": OF_0_2_0["measured"].replace("fill=nearest", "tilt=mounting&pixels=means")
    + "&fluid=helium&inlet=2+bar&outlet=1+bar"
    + "&seal=20+mm+..+24+mm&flow_along=x&sealing_pressure=yes&blur=1+um&tip_radius=2+um",
}
"""Links that set what version 0.3.0 added."""


@pytest.mark.parametrize(
    "link",
    [
        *(OF_0_2_0["explore"], OF_0_3_0["explore"], OF_0_3_0["sticking"], "v=1&H=0.5&n=64"),
        *("v=1&F=0.1&cutoff=0.00195312&n=64", "v=1&h=5e-05&n=64", "v=1&roll_off=0.03125&n=128"),
    ],
)
def test_links_of_explore_of_older_labs_set_what_they_set(link):
    said = dict(parse_qsl(link))
    found, refused = usable({"state": said}, explore_state, ExploreState.texts)
    assert refused == {}
    again = found.texts()
    kept = said.keys() - {"v", "view", "theme", "H", "D_f", "cutoff"}
    assert {key: again[key] for key in kept} == {key: said[key] for key in kept}
    cutoff = again["cutoff"]
    assert float(cutoff) == pytest.approx(float(said.get("cutoff", cutoff)), rel=1e-5)


def test_links_of_version_0_3_0_are_read():
    said = control_texts({"state": dict(parse_qsl(OF_0_3_0["measured"]))})
    question = page_question(said, Source(Path("a.nc"), "a.nc", "key"))
    assert (question.sealing.inlet, question.sealing.outlet) == (2e5, 1e5)
    assert question.sealing.along == "x"
    assert question.preparation.points == 64
