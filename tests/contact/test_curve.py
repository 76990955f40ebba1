"""What a curve is of: a surface, or the line or profile of the reduced model."""

import inspect
from dataclasses import fields

import numpy as np
import pytest

import roughline as rl
from roughline.contact.press import _PressArguments

SPECTRUM = rl.SelfAffine(hurst=0.8, rms_height=0.01)
SURFACE, LINE = SPECTRUM.surface(16, 7), SPECTRUM.line(64, 7)
R = np.linspace(0, 1, 33)
BALL = rl.Profile(R, -(R**2) / 2)


@pytest.mark.parametrize(
    ("body", "kind"), [(SURFACE, rl.SurfaceCurve), (LINE, rl.LineCurve), (BALL, rl.LineCurve)]
)
def test_the_body_decides_the_kind_of_its_curve(body, kind):
    curve = rl.press(body, E_star=1.0, forces=[1e-3, 1e-4])
    assert type(curve) is kind
    assert isinstance(curve, rl.Curve)
    assert curve.on_approach.tolist() == [True, False]


def test_a_surface_has_all_that_was_not_asked_for_but_errors_of_the_grid():
    curve = rl.press(SURFACE, E_star=1.0, forces=[1e-3])
    lacking = {each.name for each in fields(curve) if getattr(curve, each.name) is None}
    asked_for = {"stiffness_error", "unloading_stiffness_error", "area_fraction_error"}
    assert lacking == asked_for | {"unit"}
    assert not lacking - {"unit"} & {*vars(rl.press(LINE, E_star=1.0, forces=[1e-3]))}


@pytest.mark.parametrize("name", ["fields", "measured", "convolutions", "surface_after"])
def test_what_the_reduced_model_does_not_have_is_told_in_a_line(name):
    curve = rl.press(LINE, E_star=1.0, forces=[1e-3])
    assert not hasattr(curve, name)
    told = f"a LineCurve has no {name}, which the reduced model does not give: press a Surface"
    with pytest.raises(rl.InputError) as missing:
        getattr(curve, name)
    assert str(missing.value) == told
    with pytest.raises(AttributeError, match="object has no attribute 'feilds'"):
        curve.feilds  # noqa: B018


def test_the_contact_of_a_profile_is_a_disc_and_a_line_has_no_area():
    ball = rl.press(BALL, E_star=1.0, forces=[1e-3])
    assert ball.area_fraction_corrected is ball.area_fraction
    assert rl.press(LINE, E_star=1.0, forces=[1e-3]).area_fraction_corrected is None


def test_types_of_a_press_are_those_of_its_signature():
    """Its overloads tell the kind of curve, and group the arguments beside the body."""
    arguments = inspect.signature(rl.press).parameters
    typed = {name: each.__forward_arg__ for name, each in _PressArguments.__annotations__.items()}
    assert {"body": arguments["body"].annotation, **typed} == {
        name: each.annotation for name, each in arguments.items()
    }
