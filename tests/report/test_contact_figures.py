"""Figures of an assessment show what its tables say, where it is."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughline as rl
from roughline.report.answers import quantity
from roughline.report.contact_figures import draw_filled, draw_last_contact, draw_stiffness


def test_one_area_is_told_everywhere(rough):
    pressed = rl.assess(
        rl.Question(rough, ("steel", "copper"), loads=["1 N", "10 N"], ask=rl.WholeCurve())
    )
    axes = Figure().subplots()
    draw_last_contact(axes, pressed.body, pressed)
    area = pressed.answers["contact_area_fraction"]
    told = quantity(area, 1).split("%")[0]
    assert axes.get_title() == f"corrected area {told}% at 10 N\nred: at the hardness"
    assert area.values[1] == pressed.curve_as_asked.area_fraction_corrected[1]


def test_filled_points_are_marked_where_they_were(holed):
    file, *_ = holed
    missing = np.isnan(np.load(file))
    question = rl.Question(
        file,
        E_star=1e11,
        loads="1 N",
        reading=rl.Reading(unit="m", sizes=(1e-3,)),
        preparation=rl.Preparation(crop=(1.5625e-4, 1e-3, 0, 1e-3)),
    )
    pressed = rl.assess(question)
    (part,) = pressed.topographies
    assert (part.filled_region.heights == missing[10:]).all()
    axes = Figure().subplots()
    draw_filled(axes, pressed)
    outline = np.concatenate([path.vertices for path in axes.collections[-1].get_paths()])
    low, high = outline.min(axis=0), outline.max(axis=0)
    pixel = 1 / 64  # mm
    assert low == pytest.approx([0, 20 * pixel], abs=pixel)
    assert high == pytest.approx([3 * pixel, 25 * pixel], abs=pixel)


def test_theories_are_drawn_in_the_units_of_the_curve():
    spectrum = rl.SelfAffine(hurst=0.7, length=3e-3, rms_height=1e-6)
    surface = replace(spectrum.surface(32, 3), unit="m")
    pressed = rl.assess(
        rl.Question(surface, E_star=1e9, loads=[0.1, 1.0], ask=rl.Theories("persson"))
    )
    axes = Figure().subplots()
    draw_stiffness(axes, pressed)
    (persson,) = pressed.theories
    (theory,) = (line for line in axes.lines if line.get_label() == "persson")
    (curve,) = (line for line in axes.lines if len(line.get_xdata()) == 2 and line is not theory)
    ratio = persson.stiffness * pressed.area / pressed.curve.stiffness
    assert theory.get_xdata() == pytest.approx(curve.get_xdata(), rel=1e-9)
    assert theory.get_ydata() / curve.get_ydata() == pytest.approx(ratio, rel=1e-9)
