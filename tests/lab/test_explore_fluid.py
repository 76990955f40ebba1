"""A fluid in Explore: its flow, apertures, theories, code and files are those of the library."""

import re

import numpy as np
import pytest

import roughline as rl
from lab.explore_asked import (
    E_STAR,
    HARDNESS,
    HEIGHT,
    LENGTH,
    SCALE,
    SMALL,
    YIELDING,
    answer,
    loads,
    numbers_in,
    said,
)
from lab.unpacked import HALF_A_STEP
from roughline.lab.controls import ControlError
from roughline.lab.explore import code, pictures
from roughline.lab.explore.controls import NUMBERS
from roughline.lab.explore.reading import read_state
from roughline.question.loading import UNLOADING

FLOWS = {**SMALL, "fluid": "x"}
SEALED = {**FLOWS, "F": "9"}
APERTURE = rl.hydraulic_aperture("x")


@pytest.fixture(scope="module")
def surface():
    return read_state(SMALL).surface(64)


@pytest.fixture(scope="module")
def curve(surface):
    asked = {"forces": [0.2 * SCALE], "measures": [APERTURE]}
    return rl.press(surface, E_star=E_STAR, fields=True, grid_error=True, **asked)


def test_without_the_tick_no_flow_is_computed(monkeypatch):
    def none(*given, **named):
        raise AssertionError("a flow was computed")

    monkeypatch.setattr(rl, "flow", none)
    monkeypatch.setattr(rl, "theory", none)
    for task in (pictures.coarse, pictures.full, pictures.curve, pictures.further):
        header, arrays = answer(task, YIELDING, of="hardness_bar")
        assert "aperture" not in header["panels"]
        assert "flux" not in arrays
    with pytest.raises(ControlError) as refused:
        answer(pictures.further, SMALL, of="fluid")
    assert refused.value.at == "fluid"
    with pytest.raises(AssertionError, match="a flow"):
        answer(pictures.coarse, FLOWS)


def test_the_flux_is_that_of_the_library(curve):
    header, arrays = answer(pictures.full, {**FLOWS, "shown": "flux"})
    flow = rl.flow(curve.fields[0])
    flux = np.hypot(*flow.flux) * LENGTH / flow.inflow
    shown, is_open = arrays["flux"].T, flow.gap > 0
    np.testing.assert_array_equal(np.isnan(shown), ~is_open)
    np.testing.assert_array_equal(np.isnan(shown), curve.fields[0].contact)
    flows = is_open & (flux > 0)
    look = header["maps"]["flux"]
    most = HALF_A_STEP * (look["high"] - np.nanmin(shown))  # of the logarithms, as they are sent
    wanted = np.log10(np.maximum(flux[flows], 0.01))
    np.testing.assert_allclose(shown[flows], wanted, rtol=1e-9, atol=most)
    assert (shown[is_open & ~flows] < look["low"]).all()
    assert 10 ** look["high"] == pytest.approx(flux.max())
    assert look["rings"] == [pytest.approx([(i + 0.5) / 64 for i in flow.constriction])]
    # as a mean over every line across the flow, the flux along it is the mean flux
    mean = flow.flux[0].mean(axis=1) * LENGTH / flow.inflow
    np.testing.assert_allclose(mean, 1, rtol=1e-8)


def test_the_strip_says_how_much_comes_through_with_its_interval(curve):
    found, flow = said(answer(pictures.full, FLOWS)[0]), rl.flow(curve.fields[0])
    measured = curve.measured["hydraulic_aperture_x"]
    ends = float(measured.low[0]), float(measured.high[0])
    assert ends[0] < flow.hydraulic_aperture < ends[1]
    number = float(found["aperture"]["value"].removesuffix(" h"))
    assert number == pytest.approx(flow.hydraulic_aperture / HEIGHT, rel=0.05)
    scale = {"µm": 1e6, "nm": 1e9}[found["aperture"]["below"].rstrip(")").split()[-1]]
    wanted = [float(f"{scale * end:.3g}") for end in ends]
    assert numbers_in(found["aperture"]["below"])[1:] == wanted
    assert float(found["channel"]["value"].rstrip("%")) == pytest.approx(
        100 * flow.largest_share, rel=0.01
    )
    x, y, gap = map(float, re.findall(r"[xyp] ([\d.]+)", found["channel"]["below"]))
    cell = tuple(int(64 * place) for place in (x, y))
    assert cell == flow.constriction
    assert gap == pytest.approx(flow.gap[flow.constriction] / HEIGHT, rel=0.01)


def test_what_is_sealed_is_said_and_its_map_shows_how_far_the_fluid_comes(surface):
    header, arrays = answer(pictures.full, {**SEALED, "shown": "flux"})
    pressed = rl.press(surface, E_star=E_STAR, forces=[9 * SCALE], fields=True)
    flow = rl.flow(pressed.fields[0])
    assert flow.is_sealed
    assert said(header)["aperture"]["value"] == "sealed"
    assert "channel" not in said(header)
    assert loads(header, "aperture", "here")[1].tolist() == [0.0]
    assert header["maps"]["flux"]["caption"].startswith("sealed")
    shown = arrays["flux"].T
    np.testing.assert_array_equal(shown == 1, flow.gap == 0)
    np.testing.assert_array_equal(shown == 2, (flow.gap > 0) & (flow.pressure == 1))


def test_apertures_over_the_load_and_theories_are_those_of_the_library(surface):
    header, _ = answer(pictures.further, FLOWS, of="fluid")
    panel = header["panels"]["aperture"]
    forces, found = loads(header, "aperture", "curve", "unsure", "sealed")
    pressed = rl.press(surface, E_star=E_STAR, forces=forces * SCALE, measures=[APERTURE])
    wanted = pressed.measured["hydraulic_aperture_x"].values / HEIGHT
    np.testing.assert_allclose(found, wanted, rtol=1e-9)
    assert wanted[-1] == 0 < wanted[0]
    last = np.flatnonzero(wanted)[-1]
    open_until, sealed_from = forces[last : last + 2]
    assert panel["caption"].startswith(
        f"seals between F̄ = {open_until:#.3g} and {sealed_from:#.3g}: marks at the foot"
    )
    for name in ("critical-junction", "bruggeman"):
        given, apertures = loads(header, "aperture", f"theory {name}")
        theory = rl.theory(name, surface, E_STAR, given * SCALE / surface.area)
        np.testing.assert_allclose(apertures, theory.hydraulic_aperture / HEIGHT)
        assert theory.validity in panel["remarks"]
    rows = {tuple(row[1:]) for row in panel["rows"]}
    assert {("sealed", "3D"), ("sealed", "critical junction"), ("sealed", "Bruggeman")} <= rows


@pytest.mark.parametrize("key", ["F", "D_f", "roll_off"])
def test_it_flows_at_both_ends_of_every_slider(key):
    for end in (NUMBERS[key].low, NUMBERS[key].high):
        state = {"n": "128", "F": "0.2", "fluid": "x", key: f"{end:g}"}
        header, _ = answer(pictures.full, state)
        assert header["refused"] == {}
        assert "aperture" in said(header)
        assert answer(pictures.further, state, of="fluid")[0]["panels"]["aperture"]["rows"]


def test_a_gap_that_no_load_seals_says_so():
    header, _ = answer(pictures.further, {**FLOWS, "roll_off": "0.07"}, of="fluid")
    assert header["panels"]["aperture"]["caption"].startswith("no load up to F̄ = ")


def test_the_way_back_has_its_apertures(surface):
    header, _ = answer(pictures.further, {**YIELDING, "fluid": "x"}, of="hardness_bar")
    asked = {"hardness": HARDNESS, "forces": 0.2 * SCALE * np.array([1, *UNLOADING])}
    pressed = rl.press(surface, E_star=E_STAR, measures=[APERTURE], **asked)
    wanted = pressed.measured["hydraulic_aperture_x"].values / HEIGHT
    _, found = loads(header, "aperture", "back")
    np.testing.assert_allclose(found[::-1], wanted[:-1], rtol=1e-9)  # no force has no place
    rows = header["panels"]["aperture"]["rows"]
    assert [row[2] for row in rows] == ["3D, way back"] * len(wanted)


def test_a_load_that_is_not_solved_has_no_flow(monkeypatch):
    solved = rl.press

    def unsolved(*given, **named):
        return solved(*given, **{**named, "solver": rl.Solver(1), "grid_error": False})

    monkeypatch.setattr(rl, "press", unsolved)
    header, arrays = answer(pictures.full, FLOWS)
    assert said(header)["stiffness_3d"]["value"] == "not solved"
    assert header["maps"] == {}
    assert list(arrays) == []


def test_as_python_gives_the_aperture_and_the_command_says_that_it_does_not(curve, ran):
    lines = ran(FLOWS, "python")
    wanted = rl.flow(curve.fields[0]).hydraulic_aperture / HEIGHT
    found = float(lines[3].removeprefix("hydraulic aperture over rms height "))
    assert found == pytest.approx(wanted, rel=1e-9)
    assert lines[4] == "sealed False"
    command = answer(code.code, FLOWS, which="command")[0]["text"]
    assert command.splitlines()[-1].startswith("# ")  # which a shell passes over
    assert "as Python" in command
    assert "#" not in answer(code.code, SMALL, which="command")[0]["text"]
