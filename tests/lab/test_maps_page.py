"""Maps on the page: frames that are filled, what is told of a point, and profiles along a line."""

import io
import re
from dataclasses import replace
from urllib.parse import parse_qsl

import numpy as np
import pytest
from matplotlib import pyplot

import roughline as rl
from lab.drawn_plots import drag, held, on_screen, source, still
from lab.explore_asked import E_STAR, HEIGHT, LENGTH, SCALE
from lab.explore_driven import SMALL, settled, typed
from lab.measured_driven import CONNECTED, answers, press
from roughline.lab.explore.reading import read_state
from seen import is_upright, lay_of_45_degrees

MAP = "explore-contact"


@pytest.fixture(scope="module")
def small(pages):
    """Return one page, for tests that set what they need."""
    return pages.open(SMALL)


def showing(page, shown, F):
    """Let a page show something of a load."""
    page.select_option('[data-key="shown"]', shown)
    typed(page, "F", F)
    settled(page, points=64, F=float(F))
    return page


@pytest.mark.parametrize(("width", "least"), [(1600, 280), (1200, 280), (390, 240)])
def test_the_map_fills_its_frame_and_the_profile_lies_below_it(pages, width, least):
    page = pages.open(SMALL, width=width, height=1000)
    settled(page, points=64)
    frame = still(page, MAP)
    ends = ("x_range.start", "x_range.end", "y_range.start", "y_range.end")
    assert held(page, MAP, *ends) == [0, 1, 1, 0]  # y counts downwards
    assert frame["width"] == pytest.approx(frame["height"], abs=1)
    assert frame["width"] >= least
    profile = still(page, "explore-profile")  # lies below, under the same places
    assert profile["left"] == pytest.approx(frame["left"], abs=1)
    assert profile["width"] == pytest.approx(frame["width"], abs=1)
    assert page.evaluate("() => document.documentElement.scrollWidth") <= width
    page.context.close()


def middle_of(cell):
    return [(i + 0.5) / 64 for i in cell]


@pytest.fixture(scope="module")
def pressed():
    surface = read_state(dict(parse_qsl(SMALL[1:]))).surface(64)
    return rl.press(surface, E_star=E_STAR, forces=[0.2 * SCALE], fields=True).fields[0]


def test_walk_over_a_map_which_tells_what_the_library_knows_of_a_point(small, pressed):
    page = showing(small, "pressure", "0.2")
    strongest = np.unravel_index(pressed.pressure.argmax(), pressed.pressure.shape)
    x, y = middle_of(strongest)
    page.mouse.move(*on_screen(page, MAP, (x, y))[0])
    told = page.locator(f"#{MAP} .point").inner_text()
    assert told.startswith(f"x {x:.3f} L, y {y:.3f} L; height ")
    assert f"pressure {pressed.pressure[strongest] / E_STAR:#.3g} E*" in told
    assert "; in contact" in told
    cross_x, cross_y = source(page, "contact cut")  # along which the profile is cut
    assert cross_y[:2] == pytest.approx([y, y], abs=0.01)
    assert cross_x[-1] == pytest.approx(x, abs=0.01)
    cut, _ = source(page, "profile surface")
    assert (cut[0], cut[-1]) == (0, 1)
    page.mouse.move(5, 5)
    assert not page.is_visible(f"#{MAP} .point")


PHONE = {"width": 390, "height": 844, "has_touch": True, "is_mobile": True}


@pytest.mark.parametrize("context", [{}, PHONE], ids=["mouse", "finger"])
def test_what_flows_there_is_told_to_a_mouse_and_to_a_finger(pages, pressed, context):
    page, cell = pages.open(SMALL + "&fluid=x&shown=flux", **context), (40, 22)  # which is open
    settled(page, points=64)
    flow = rl.flow(pressed)
    (place,) = on_screen(page, MAP, middle_of(cell))
    (page.touchscreen.tap if context else page.mouse.move)(*place)
    gap, flux = pressed.gap[cell] / HEIGHT, np.hypot(*flow.flux)[cell] * LENGTH / flow.inflow
    told = page.locator(f"#{MAP} .point").filter(has_text=f"; gap {gap:#.3g} h; ")
    assert told.inner_text().endswith(f"; flux {flux:#.3g} of its mean")
    narrowest = [[each] for each in map(pytest.approx, middle_of(flow.constriction))]
    assert source(page, "contact rings") == narrowest
    page.context.close()


def draw(page, name, start, end, button="[data-profile=explore-profile]"):
    """Press the button if there is one, and drag across a map, from and to shares of its frame."""
    if button:
        page.click(button)
    frame = still(page, name)
    sides = (("left", "width"), ("top", "height"))
    drag(
        page,
        *(
            [frame[at] + part * frame[side] for part, (at, side) in zip(each, sides, strict=True)]
            for each in (start, end)
        ),
    )


def assert_fits(page, axis, values):
    """An axis has a twentieth of room about values; heights go on to round numbers."""
    name = "explore-profile"
    low, high = held(page, name, f"{axis}_range.start", f"{axis}_range.end")
    room = 0.05 * (max(values) - min(values))
    ends = min(values) - room, max(values) + room
    if axis == "x":
        assert (low, high) == pytest.approx(ends)
    else:
        step = (ends[1] - ends[0]) / 4  # the next of 1, 2, 5, 10 is 2.5 times as large at most
        assert ends[0] - step < low <= ends[0] < ends[1] <= high < ends[1] + step


def test_a_line_across_a_map_shows_the_profile_of_both_bodies(small):
    page = showing(small, "area", "1")
    draw(page, MAP, (0.1, 0.5), (0.9, 0.5))
    surface, body = (source(page, f"profile {which}") for which in ("surface", "body"))
    assert surface[0][-1] == pytest.approx(0.8, abs=0.02)
    assert all(low <= high + 1e-6 for low, high in zip(surface[1], body[1], strict=True))
    assert any(high - low < 1e-6 for low, high in zip(surface[1], body[1], strict=True))
    line = source(page, "contact cut")
    assert line == [pytest.approx([0.1, 0.9], abs=0.02), pytest.approx([0.5, 0.5], abs=0.02)]
    assert_fits(page, "x", surface[0])
    assert_fits(page, "y", surface[1] + body[1])
    showing(page, "area", "0.1")  # which the profile follows
    _, lifted = source(page, "profile body")
    assert sum(lifted) > sum(body[1])
    assert_fits(page, "y", surface[1] + lifted)
    page.click("[data-profile=explore-profile]")  # the cross is there again
    assert source(page, "profile surface")[0][-1] == 1
    page.click("[data-profile=explore-profile]")


def test_a_line_ends_where_the_mouse_is_released_also_beside_the_map(small):
    page = showing(small, "area", "0.2")
    draw(page, MAP, (0.1, 0.5), (-0.6, 0.5))
    ends = source(page, "contact cut")
    assert ends == [pytest.approx([0.1, 0], abs=0.02), pytest.approx([0.5, 0.5], abs=0.02)]
    page.mouse.move(*on_screen(page, MAP, (0.8, 0.8))[0])
    assert source(page, "contact cut") == ends
    for _ in range(2):
        page.click("[data-profile=explore-profile]")


def test_a_line_is_forgotten_with_the_surface_that_it_lies_on(pages, tmp_path):
    page = pages.open("?view=measured")
    page.wait_for_selector(CONNECTED)
    for length, name in ((1e-3, "one.nc"), (1e-5, "other.nc")):
        spectrum = rl.SelfAffine(hurst=0.7, length=length, rms_height=length / 1000)
        rl.write(replace(spectrum.surface(16, 3), unit="m"), tmp_path / name)
        page.set_input_files("#measured [data-file]", tmp_path / name)
        press(page, loads="1 MPa")
        answers(page)
        assert not page.is_visible("#measured-profile")
        draw(page, "measured-contact", (0.1, 0.5), (0.9, 0.5), "[data-profile=measured-profile]")
        page.wait_for_selector("#measured-profile")
    page.context.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_scale_of_a_map_has_its_name_its_unit_and_its_colours(pages, theme):
    page = pages.open(SMALL + "&fluid=x&shown=flux", theme=theme)
    settled(page, points=64)
    scale = page.locator(f"#{MAP} .scale")
    for shown, name in (("flux", "flux"), ("pressure", "pressure"), ("gap", "gap / h")):
        page.select_option('[data-key="shown"]', shown)
        scale.locator("> span").filter(has_text=name).wait_for()
        bar = scale.locator("i")
        assert bar.locator("span").count() >= 2
        drawn = bar.evaluate("(each) => getComputedStyle(each).backgroundImage")
        assert drawn.startswith("linear-gradient")
        assert len(set(re.findall(r"rgba?\([^)]*\)", drawn))) > 9, shown
    page.select_option('[data-key="shown"]', "area")
    assert scale.inner_text() == ""
    page.select_option('[data-key="shown"]', "height")
    assert scale.locator("> span").inner_text() == "height / h"
    page.context.close()


def of_screen(page, name):
    """Brightness of a map on the screen, rows from the top downwards."""
    frame = still(page, name)
    page.mouse.move(1, 1)  # whose tools are hidden then
    clip = {"x": frame["left"] + 2, "y": frame["top"] + 2}
    clip |= {key: frame[key] - 4 for key in ("width", "height")}
    return pyplot.imread(io.BytesIO(page.screenshot(clip=clip)))[..., :3].mean(axis=-1)


def test_a_map_is_upright_on_the_screen_and_a_box_keeps_what_it_shows(pages, tmp_path):
    surface = lay_of_45_degrees(48, "m")
    rl.write(surface, tmp_path / "lay.nc")
    page = pages.open("?view=measured")
    page.wait_for_selector(CONNECTED)
    page.set_input_files("#measured [data-file]", tmp_path / "lay.nc")
    page.locator("#measured-step-preparation").evaluate("(each) => { each.open = true; }")
    page.wait_for_selector('#measured [data-result="preparation"]')
    assert is_upright(of_screen(page, "measured-before"), surface.heights)
    draw(page, "measured-before", (0.0, 0.0), (0.5, 0.25), button="")  # upper left
    page.wait_for_selector("#measured-crop-text:not(:placeholder-shown)")
    ends = [float(each.split()[0]) for each in page.input_value("#measured-crop-text").split(",")]
    assert ends == pytest.approx([0, 0.5, 0, 0.25], abs=0.008)  # mm
    page.wait_for_selector('#measured [data-caption="measured-after"]:has-text("24 x 12")')
    after = of_screen(page, "measured-after")
    rows, columns = after.shape
    kept = after[: rows // 4 - 2, : columns // 2 - 2]
    assert is_upright(kept, surface.heights[:24, :12])
    page.context.close()


RELIEF = """async ([rows, sizes]) => {
    const {reliefOf} = await import("/lab/maps.js");
    const shown = reliefOf({values: rows.flat(), shape: [rows.length, rows[0].length]}, sizes);
    return [...shown].map((colour) => colour & 255);
}"""


def relief(page, heights, sizes):
    """Brightness of a surface in the light, in the shape of its heights."""
    found = page.evaluate(RELIEF, [heights.T.tolist(), sizes])
    return np.reshape(found, heights.T.shape).T


def test_the_light_comes_from_the_upper_left(small):
    heights = np.zeros((40, 20))
    heights[10:30, 5:15] = 1e-5
    light = relief(small, heights, [4e-4, 1e-4])
    flat = light[2, 2]
    assert light[15:25, 4].max() > flat > light[15:25, 15].min()  # edges above and below
    assert light[9, 8:12].max() > flat > light[30, 8:12].min()  # at the left and at the right


def test_light_on_points_that_are_not_square_is_that_of_their_slopes(small):
    wave = np.sin(np.arange(32))
    along_x = relief(small, np.tile(wave[:, None], (1, 32)), [32.0, 64.0])
    along_y = relief(small, np.tile(wave[None, :], (32, 1)), [64.0, 32.0])
    assert (along_x[:, 16] == along_y[16]).mean() > 0.9


def test_a_lit_surface_and_its_contact_are_upright(small):
    page = showing(small, "area", "0.2")
    surface = read_state(dict(parse_qsl(SMALL[1:]))).surface(64)
    shown = of_screen(page, MAP)
    assert is_upright(shown, relief(page, surface.heights, surface.sizes))
