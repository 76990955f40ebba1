"""Output quantities: declared once, the same in curves, files and JSON."""

import dataclasses

import numpy as np
import pytest

import roughline as rl
from roughline.contact.quantities import IN_FILES, IN_JSON, OVER_LOADS, QUANTITIES, Quantity

OVER_THE_LOADS = [each for each in QUANTITIES.values() if each.dims == OVER_LOADS]
ON_THE_GRID = [each for each in QUANTITIES.values() if each.dims != OVER_LOADS]


@pytest.fixture(scope="module")
def surface():
    return rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(32, 7)


@pytest.fixture(scope="module")
def curve(surface):
    return rl.press(surface, E_star=1.0, forces=[0.1, 0.3], fields=True, grid_error=True)


@pytest.fixture(scope="module")
def line_curve():
    line = rl.SelfAffine(hurst=0.8, rms_height=1.0).line(1024, 7)
    return rl.press(line, E_star=1.0, forces=[0.1, 0.3])


@pytest.fixture(scope="module")
def yielding_curve(surface):
    forces, errors = [0.1, 0.3], {"fields": True, "grid_error": True}
    return rl.press(surface, E_star=1.0, hardness=5.0, forces=forces, **errors)


@pytest.fixture(scope="module")
def sticking_curve(surface):
    law = rl.Dugdale(work_of_adhesion=0.1, range=0.5)
    return rl.press(surface, E_star=1.0, law=law, forces=[0.3, 0.1], fields=True, grid_error=True)


def test_a_curve_has_what_is_declared_and_no_more(curve):
    def arrays(result):
        return {
            each.name
            for each in dataclasses.fields(result)
            if isinstance(getattr(result, each.name), np.ndarray)
        }

    derived = {"force_bar", "stiffness_bar"}
    not_written = {"border_share", "largest_pressure"}  # of which facts speak
    assert arrays(curve) - not_written == {each.name for each in OVER_THE_LOADS} - derived
    assert arrays(curve.fields[0]) == {each.attribute for each in ON_THE_GRID}


@pytest.mark.parametrize("quantity", OVER_THE_LOADS, ids=lambda each: each.name)
def test_values_have_the_declared_type(curve, line_curve, quantity):
    for one in (curve, line_curve):
        values = getattr(one, quantity.name, None)
        if values is not None:
            assert values.shape == (2,)
            assert values.dtype == np.dtype(quantity.dtype)
    of_any_path = quantity.name == "on_approach"  # which files hold where it tells the branch
    has_values = getattr(line_curve, quantity.name, None) is not None
    assert has_values == (quantity.of_lines or of_any_path)


def test_files_hold_the_declared_variables(curve, line_curve, yielding_curve, sticking_curve):
    for one in (curve, line_curve, yielding_curve, sticking_curve):
        data = one.to_dataset()
        expected = [
            each
            for each in IN_FILES
            if (one is not line_curve or each.of_lines)
            and each.is_left_by("none" if one.law is None else one.law.memory)
        ]
        assert list(data.variables) == [each.name for each in expected]
        for each in expected:
            assert data[each.name].dims == ("force", *each.dims[1:])
            assert data[each.name].attrs.get("units") == each.dimension
            assert data[each.name].attrs.get("long_name", "") == each.long_name


def test_columns_of_files_stay_in_their_places(curve, tmp_path):
    """Programs read tables by position too."""
    assert [each.column for each in IN_FILES] == list(range(len(IN_FILES)))
    curve.write(tmp_path / "curve.csv")
    header, *_ = (tmp_path / "curve.csv").read_text("utf-8").splitlines()
    assert header == (
        "force [force],depth [length],stiffness [force/length],status,resolved,residual [1],"
        "area_fraction [1],convolutions [1],area_fraction_corrected [1],"
        "stiffness_error [force/length],area_fraction_error [1]"
    )


@pytest.mark.parametrize(
    ("dimension", "in_metres", "in_micrometres"),
    [
        ("length", "m", "um"),
        ("force", "N", "force"),
        ("pressure", "Pa", "pressure"),
        ("force/length", "N/m", "force/um"),
        ("energy", "J", "energy"),
        ("1", "1", "1"),
        (None, None, None),
    ],
)
def test_units_follow_that_of_lengths(dimension, in_metres, in_micrometres):
    quantity = Quantity("some", "s", dimension, "some quantity")
    assert quantity.unit_in("m") == in_metres
    assert quantity.unit_in("um") == in_micrometres
    assert quantity.unit_in(None) == dimension


def test_an_unknown_dimension_is_refused():
    with pytest.raises(ValueError, match="dimension is 'mass/length'; known are length, force"):
        Quantity("density", "", "mass/length", "mass per length")


def test_json_gives_results_and_no_fields():
    assert [each.name for each in IN_JSON] == [
        *("depth", "force", "stiffness", "unloading_stiffness"),
        *("area_fraction", "area_fraction_corrected", "stiffness_error"),
        *("unloading_stiffness_error", "area_fraction_error"),
        *("plastic_fraction", "indentation", "work", "dissipated_work"),
        *("pulling_fraction", "on_approach", "residual", "resolved", "status"),
    ]
