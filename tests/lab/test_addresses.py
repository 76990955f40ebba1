"""Any address that the page writes gives the same state again."""

from hypothesis import given, settings
from hypothesis import strategies as st

from roughline.lab.controls import usable
from roughline.lab.explore import controls as explore
from roughline.lab.explore.address import state_of as explore_state
from roughline.lab.published import controls as published
from roughline.lab.published.state import state_of as published_state
from roughline.units import engineering

NUMBERS = (explore.D_F, explore.ROLL_OFF, explore.CUTOFF, explore.HEIGHT, explore.SLOPE)
NUMBERS += (explore.FORCE, explore.HARDNESS)
DIMENSIONS = [f"{each:g}" for each in published.DIMENSIONS]
WORDS = (explore.ROUGHNESS, explore.BOUNDARY, explore.SHOWN)


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
        **{each.key: st.sampled_from(list(each.options)) for each in WORDS},
        "n": st.sampled_from(["64", "128"]),
        "seed": st.integers(0, 999_999).map(str),
        "L": quantities("m", 1e-12, 1e3),
        "E": quantities("Pa", 1, 1e14),
        "theories": st.lists(st.sampled_from(list(explore.THEORIES.options))).map(",".join),
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
    state, _ = usable(asked, lambda used: explore_state(used, 1024), lambda found: {})
    assert explore_state(state.address(), 1024) == state


@settings(max_examples=150, deadline=None)
@given(
    some(
        {
            **{each.key: texts(each) for each in published.NUMBERS},
            **{each.key: st.sampled_from(list(each.options)) for each in published.CHOICES},
            "D_f": st.lists(st.sampled_from(DIMENSIONS), min_size=1).map(",".join),
        }
    )
)
def test_an_address_of_the_paper_gives_its_state_again(said):
    state, _ = usable({"state": said}, published_state, lambda found: {})
    assert published_state(state.address()) == state
