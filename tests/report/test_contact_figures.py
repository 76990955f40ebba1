"""Figures of an assessment show what its tables say, where it is."""

from dataclasses import replace

import numpy as np
import pytest
from attrs import evolve
from matplotlib.figure import Figure

import roughline as rl
from roughline.report.answers import quantity
from roughline.report.contact_figures import (
    draw_filled,
    draw_last_contact,
    draw_stiffness,
    overview,
    overview_in_words,
)
from roughline.report.contact_report import write_contact_report
from roughline.report.fields_of_load import (
    fields_figure,
    fields_table,
    flow_figure,
    write_fields,
)
from roughline.units import engineering

PAIR = ("steel", "copper")
FLOW = ("critical-junction", "bruggeman")  # theories of the flow


@pytest.fixture
def small(points):
    """A surface of some points a side."""
    surface = rl.SelfAffine(hurst=0.7, length=5e-4, rms_height=1e-6).surface(points, 3)
    return replace(surface, unit="m")


@pytest.fixture(scope="module")
def pressed():
    """What a report on a surface of 64 x 64 points shows."""
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3)
    loads = ["1 N", "10 N"]
    return rl.assess(rl.Question(replace(surface, unit="m"), PAIR, loads=loads, whole_curve=True))


def test_one_area_is_told_everywhere(pressed):
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


def test_a_crop_and_what_a_low_pass_leaves_out_are_told_in_lengths_of_the_whole(holed, tmp_path):
    file, *_ = holed
    question = rl.Question(
        file,
        E_star=1e11,
        loads="1 N",
        reading=rl.Reading(unit="m", sizes=(1e-3,)),
        preparation=rl.Preparation(crop=(1.5625e-4, 1e-3, 0, 1e-3), low_pass=1e-4),
    )
    pressed = rl.assess(question)
    (part,) = pressed.topographies
    assert pressed.body.shape == (54 - 6, 64 - 6)
    assert (part.filled_region.heights == np.isnan(np.load(file))[13:-3, 3:-3]).all()
    write_contact_report(pressed, tmp_path, "")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "x 156.2 µm to 1 mm and y 0 m to 1 mm (points x 10:64, y 0:64)" in page
    assert "waves shorter than 100 µm (Gaussian, ISO 16610), half of it left out at borders" in page


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


def test_gap_pressure_and_patches_are_those_of_the_load_that_is_shown(pressed):
    fields = pressed.fields
    _, rows = fields_table(fields)
    told = dict(rows)
    assert told["mean gap"] == engineering(fields.mean_gap, "m", 3)
    touching = fields.pressure[fields.contact]
    assert told["mean pressure in contact"] == engineering(touching.mean(), "Pa", 3)
    assert told["highest pressure"] == engineering(touching.max(), "Pa", 3)
    patches = fields.patches()
    assert told["contact patches"] == str(patches.count)
    assert told["largest patch"].startswith(engineering(patches.areas[0], "m²", 3))
    assert [axes.get_xlabel()[:4] for axes in fields_figure(fields).axes] == [
        "gap ",
        "pres",
        "area",
    ]


@pytest.mark.parametrize("grid_error", [False, True])
def test_the_report_has_them_and_a_line_scan_has_none(rough, only_drawn, tmp_path, grid_error):
    only_drawn()
    question = rl.Question(rough, PAIR, loads="10 N", fields=True, grid_error=grid_error)
    pressed = rl.assess(question)
    files = write_contact_report(pressed, tmp_path / "map", "")
    assert {"distributions.png", "distributions.pdf"} <= {each.name for each in files}
    page = (tmp_path / "map" / "report.html").read_text(encoding="utf-8")
    assert "Gap, pressure and contact patches at 10 N" in page
    without = replace(pressed, curve=replace(pressed.curve, fields=()))
    assert write_fields(without, tmp_path) == ([], [])


@pytest.mark.parametrize("points", [16, 32])
def test_the_flow_is_that_of_the_load_that_is_shown(small, only_drawn, tmp_path):
    only_drawn()
    asked = rl.Question(small, PAIR, loads=["0.3 N", "3 N"])
    pressed = rl.assess(evolve(asked, ask=[rl.Fluid("water")]))
    along_x, along_y = pressed.flows
    assert (along_x.along, along_y.along) == ("x", "y")
    assert along_x.permeance == rl.flow(pressed.fields_of_gap, along="x").permeance
    titles = [axes.get_title() for axes in flow_figure(pressed).axes]
    for each in pressed.flows:
        assert any(engineering(each.hydraulic_aperture, "m", 3) in title for title in titles)
    (section, _), files = write_fields(pressed, tmp_path)
    assert section.heading == "Where the fluid goes at 3 N"
    assert {each.name for each in files[2:]} == {"flow.png", "flow.pdf"}
    assert section.pictures[0].path.name == "flow.png"
    without = rl.assess(evolve(asked, whole_curve=True))
    (section,), files = write_fields(without, tmp_path)
    assert "patches" in section.heading
    assert {each.name for each in files} == {"distributions.png", "distributions.pdf"}
    of_one = rl.assess(evolve(asked, ask=rl.Fluid("water", along="y")))
    assert [each.permeance for each in of_one.flows] == [along_y.permeance]
    assert len([axes for axes in flow_figure(of_one).axes if axes.axison]) == 2  # and its scale


@pytest.mark.parametrize("points", [16, 32])
def test_the_flow_that_is_shown_is_the_one_that_is_answered(small, only_drawn, tmp_path):
    """A map that was cut out leaks as a part of a larger surface, in the answer and the picture."""
    only_drawn()
    cut_out = replace(small, is_cut_out=True)
    asked = rl.Question(cut_out, PAIR, loads=["3 N", "0.3 N"])
    pressed = rl.assess(evolve(asked, ask=rl.Fluid("water")))
    assert pressed.fields_of_gap is not pressed.fields
    largest = pressed.asked[pressed.largest]
    for flow in pressed.flows:
        assert flow.sides == "periodic"
        answered = pressed.measured[f"hydraulic_aperture_{flow.along}"].values[largest]
        assert flow.hydraulic_aperture == answered
    (section, _), _ = write_fields(pressed, tmp_path)
    assert "repeated on all sides" in section.pictures[0].caption
    repeated = rl.assess(evolve(asked, ask=[rl.Fluid("water"), rl.Joint("1 cm^2")]))
    assert repeated.fields_of_gap is repeated.fields
    (section, _), _ = write_fields(repeated, tmp_path)
    assert "repeated on all sides" not in section.pictures[0].caption


def test_intervals_of_apertures_are_drawn_about_them():
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4, q_high=1e5)
    asked = {"loads": ["20 MPa", "60 MPa"], "ask": rl.Fluid("water", along="x")}
    body = spectrum.surface(32, rng=1)
    given = {"periodic": True, "elastic": True, "grid_error": True, "fields": False}
    found = rl.assess(rl.Question(body, materials="steel,copper", **asked, **given))
    rows = found.measured["hydraulic_aperture_x"].rows
    (axes,) = [each for each in overview(found).axes if "aperture" in each.get_ylabel()]
    (band,) = axes.collections
    drawn = band.get_paths()[0].vertices[:, 1]
    unit = float(axes.get_lines()[0].get_ydata()[0]) / rows[0, 0]
    assert drawn.min() == pytest.approx(unit * rows[1].min())
    assert drawn.max() == pytest.approx(unit * rows[2].max())


@pytest.mark.parametrize("points", [32, 64])
def test_apertures_stand_over_force_with_theories_of_flow_alone(points):
    """Each theory has dashes of its own; what is sealed is marked at the foot."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4, q_high=1e5)
    names = ("persson", "bush-gibson-thomas", "greenwood-williamson", *FLOW)
    asked = [rl.Fluid("water"), rl.Theories(*names)]
    loads = ["20 MPa", "100 MPa", "350 MPa"]
    question = rl.Question(
        spectrum.surface(points, rng=1), materials="steel,copper", loads=loads, ask=asked
    )
    assessment = rl.assess(question)
    figure = overview(assessment)
    (axes,) = [each for each in figure.axes if "aperture" in each.get_ylabel()]
    shown = [text.get_text() for text in axes.get_legend().get_texts()]
    assert shown == ["along x", "along y", "sealed", *FLOW]
    (area,) = [each for each in figure.axes if "contact area" in each.get_ylabel()]
    lines = [line for line in area.get_lines() if line.get_label() in names]
    assert [line.get_label() for line in lines] == list(names[:3])
    assert "hydraulic aperture over force" in overview_in_words(assessment)
