"""No interval reaches beyond what can be, whatever is not known."""

import numpy as np
import pytest

import roughline as rl
from roughline.margins.spread import loading_under_unloading

PAIR = "steel,copper"
H = rl.material("copper").hardness
HARDEST = H * rl.material("copper").hardness_factor


@pytest.fixture(scope="module")
def maps():
    """Three maps of one rough surface, so steep that nearly all of the contact yields."""
    rough = rl.SelfAffine(hurst=0.8, length=4e-4, rms_height=1e-6).surface(128, 5)
    places = [(0, 0), (64, 0), (0, 64)]
    return [rough.cropped((x, x + 64), (y, y + 64)).detrended() for x, y in places]


def asked(body, **more):
    given = {"loads": "3 MPa", "grid_error": True, "fields": False, **more}
    return rl.assess(rl.Question(body, PAIR, **given))


def no_higher(low, high):
    """Whether an end is no higher than another, but for rounding."""
    return (low <= high * (1 + 1e-12)).all()


@pytest.mark.parametrize(
    "more",
    [{}, {"hardness": H}, {"ask": rl.Joint("1 mm^2")}, {"ask": rl.Joint("1 mm^2"), "hardness": H}],
)
def test_points_at_the_hardness_bear_no_more_on_loading(maps, more):
    """So the stiffness on loading is at most that on unloading, at both ends."""
    result = asked(maps[0], **more)
    k = result.answers["contact_stiffness"]
    k_u = result.answers["interface_stiffness" if "ask" in more else "unloading_stiffness"]
    assert k.values < 0.5 * k_u.values
    assert no_higher(k.high, k_u.high)
    assert 0 <= k.low < k.values < k.high
    assert no_higher(result.stiffness_interval[1], result.unloading_interval[1])
    if "ask" not in more:
        per_area = result.answers["stiffness_per_area"]
        assert no_higher(per_area.high * result.area, k_u.high)


def test_the_grid_of_the_stiffness_on_loading_counts_in_a_joint_too(maps):
    """It decides single points at the edges, which the surface behind the map does not mend."""
    result = asked(maps[0], hardness=H, ask=rl.Joint("1 mm^2"))
    k, k_i = (result.answers[key] for key in ("contact_stiffness", "interface_stiffness"))
    error = result.curve.stiffness_error
    assert k.low < k.values / (1 + error / (k.values / result.scale)) * (1 + 1e-9)
    assert k.low / k.values < k_i.low / k_i.values


def test_loading_lies_between_none_and_unloading_where_its_own_ends_are_not_known():
    """As where all of the contact yields on a coarser grid; without those of unloading, nothing."""
    unknown = np.array([np.nan, 0.0, 1.0, np.nan])
    unloading = np.array([2.0, 2.0, 2.0, np.nan]), np.array([5.0, 5.0, 5.0, np.nan])
    own_high = np.array([np.nan, np.inf, 3.0, np.nan])
    low, high = loading_under_unloading((unknown, own_high), unloading)
    assert low.tolist()[:3] == [0.0, 0.0, 1.0]
    assert high.tolist()[:3] == [5.0, 5.0, 3.0]
    assert np.isnan([low[3], high[3]]).all()


@pytest.mark.parametrize("more", [{}, {"hardness": H}])
def test_no_place_of_a_joint_bears_more_than_the_hardness(maps, more):
    """Not of the larger surface behind the map either."""
    result = asked(maps[0], ask=rl.Joint("1 mm^2"), **more)
    hardest = H if more else HARDEST
    answers = result.answers
    assert no_higher(answers["contact_pressure"].high, np.array([hardest]))
    assert no_higher(3e6 / hardest, answers["contact_area_fraction"].low)
    assert no_higher(3e6 / hardest * 1e-6, answers["contact_area"].low)


@pytest.mark.parametrize("more", [{}, {"hardness": H}, {"elastic": True}])
def test_a_reflection_is_at_least_that_of_welded_bodies_and_at_most_all(maps, more):
    result = asked(maps[0], ask=rl.Ultrasound("0.5 MHz"), **more)
    first, second = (rl.material(name).impedance for name in PAIR.split(","))
    reflected = result.answers["reflection"]
    assert no_higher(abs(first - second) / (first + second), reflected.low)
    assert reflected.low < reflected.values < reflected.high
    assert no_higher(reflected.high, np.ones(1))


@pytest.mark.parametrize("joint", [(), (rl.Joint("1 mm^2"),)])
def test_the_interval_of_a_part_keeps_to_it(maps, joint):
    part = asked(maps[:2], ask=[*joint, rl.Ultrasound("0.5 MHz")])  # two places leave much open
    answers = part.answers
    for key in ("contact_area_fraction", "contact_pressure_over_hardness", "reflection"):
        assert no_higher(answers[key].high, np.ones(1)), key
    assert no_higher(answers["plastic_fraction"].high, np.ones(1))
    assert no_higher(answers["contact_pressure"].high, np.array([HARDEST]))
    stiffest = answers["interface_stiffness" if joint else "unloading_stiffness"]
    k = answers["contact_stiffness"]
    assert no_higher(k.high, stiffest.high)
    assert k.low < k.mean < k.high
    if not joint:
        per_area = answers["stiffness_per_area"]
        assert per_area.high / per_area.mean == pytest.approx(k.high / k.mean)


def test_of_elastic_bodies_the_pressure_may_be_more(maps):
    part = asked(maps, elastic=True, grid_error=False)
    over = part.answers["contact_pressure_over_hardness"]
    assert over.high > over.mean > 1


@pytest.mark.parametrize("more", [{"periodic": True}, {"ask": rl.Joint("1 mm^2")}, {}])
def test_a_load_that_only_the_softest_body_does_not_bear_is_answered(maps, more):
    """In any half-space; how far the answers move is not known then."""
    result = asked(maps[0], loads=f"{0.8 * H:g} Pa", **more)
    for key in ("interface_stiffness", "constriction_resistance", "contact_area"):
        found = result.answers[key]
        assert np.isfinite(found.values).all()
        assert np.isnan([found.low, found.high]).all()
    assert any("does not bear the largest load" in note for note in result.notes)


def test_near_full_contact_a_repeated_interface_has_no_upper_end_and_in_full_contact_no_end():
    """With a last gap open its stiffness depends on that gap; without one it is infinite."""
    rough = rl.SelfAffine(hurst=0.8, length=1e-4, rms_height=1e-7, q_high=2e6).surface(64, 5)
    smooth = rl.Surface(rough.heights, rough.sizes, "m")
    q = 2e4 * np.pi * np.hypot(*np.meshgrid(*[np.fft.fftfreq(64, 1 / 64)] * 2, indexing="ij"))
    heights = np.fft.fft2(smooth.heights)
    pair = ("E=2 MPa nu=0.49 hardness=1 GPa", "rigid")
    E_star = rl.Question(smooth, pair).modulus
    closing = -np.fft.ifft2(E_star * q / 2 * heights).real.min()
    loads = [f"{share * closing} Pa" for share in (0.97, 1.01)]
    result = rl.assess(rl.Question(smooth, pair, loads=loads, periodic=True, grid_error=True))
    for key in ("contact_stiffness", "unloading_stiffness", "tangential_stiffness"):
        found = result.answers[key]
        assert 0 < found.low[0] < found.values[0] / 2 < found.values[0] < np.inf
        assert found.high[0] == np.inf
        assert found.values[1] == np.inf
        assert found.low[1] == np.inf
