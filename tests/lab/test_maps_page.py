"""Maps on the page: frames that are filled, what is told of a point, and profiles along a line."""

import io
import re
from urllib.parse import parse_qsl

import numpy as np
import pytest
from matplotlib import pyplot

import roughline as rl
from lab.explore_driven import SMALL, image, settled, typed
from lab.test_measured_page import CONNECTED
from roughline.lab.explore.reading import read_state
from seen import is_upright, lay_of_45_degrees

FRAME = """(name) => {
    const root = Bokeh.documents.flatMap((each) => each.roots()).find((each) => each.name === name);
    const {frame, canvas_view} = Bokeh.index.find_one(root);
    const {left, top} = canvas_view.events_el.getBoundingClientRect(), {bbox} = frame;
    const {x_range: x, y_range: y} = root;
    return {left: left + bbox.left, top: top + bbox.top, width: bbox.width, height: bbox.height,
            ranges: [x.start, x.end, y.start, y.end]};
}"""
STILL = f"""(name) => {{
    const now = ({FRAME})(name), text = JSON.stringify(now);
    const {{still = 0, at}} = window.rest ?? {{}};
    window.rest = {{still: text === at ? still + 1 : 0, at: text}};
    return window.rest.still >= 3 && now;
}}"""
SOURCE = """(name) => {
    const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
    return Object.fromEntries(Object.entries(made.get_model_by_name(name).data)
        .map(([key, values]) => [key, [...values]]));
}"""
MAP = "explore-contact"


def still(page, name):
    """Return the frame of a plot when it has been the same in some pictures of the screen."""
    page.evaluate("() => { window.rest = null; }")
    return page.wait_for_function(STILL, arg=name).json_value()


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
    assert frame["ranges"] == [0, 1, 1, 0]  # y counts downwards
    assert frame["width"] == pytest.approx(frame["height"], abs=1)
    assert frame["width"] >= least
    profile = still(page, "explore-profile")  # lies below, under the same places
    assert profile["left"] == pytest.approx(frame["left"], abs=1)
    assert profile["width"] == pytest.approx(frame["width"], abs=1)
    assert page.evaluate("() => document.documentElement.scrollWidth") <= width
    page.context.close()


def test_walk_over_a_map_which_tells_place_height_pressure_and_gap(small):
    page = showing(small, "pressure", "1")
    pressure = image(page, "contact")
    strongest = max(range(len(pressure)), key=lambda i: pressure[i])
    row, column = divmod(strongest, 64)
    frame = still(page, MAP)
    x, y = (column + 0.5) / 64, (row + 0.5) / 64
    page.mouse.move(frame["left"] + x * frame["width"], frame["top"] + y * frame["height"])
    told = page.locator(f"#{MAP} .point").inner_text()
    assert f"x {x:.3f}"[:5] in told
    assert re.search(rf"pressure {pressure[strongest]:#.3g} E\*", told)
    assert re.search(r"height -?[\d.]+ h", told)
    assert "in contact" in told
    cross = page.evaluate(SOURCE, "contact cut")  # along which the profile is cut
    assert cross["y"][:2] == pytest.approx([y, y], abs=0.01)
    assert cross["x"][-1] == pytest.approx(x, abs=0.01)
    cut = page.evaluate(SOURCE, "profile surface")
    assert (cut["x"][0], cut["x"][-1]) == (0, 1)
    page.mouse.move(5, 5)
    assert not page.is_visible("#explore-contact .point")


def draw(page, name, start, end, button="[data-profile=explore-profile]"):
    """Press the button if there is one, and drag across a map, from and to shares of its frame."""
    if button:
        page.click(button)
    frame = still(page, name)
    for act, (x, y) in ((page.mouse.down, start), (page.mouse.up, end)):
        page.mouse.move(
            frame["left"] + x * frame["width"],
            frame["top"] + y * frame["height"],
            steps=4,
        )
        act()


def assert_fits(page, axis, values):
    """An axis has a twentieth of room about values; heights go on to round numbers."""
    low, high = page.evaluate(
        """(axis) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("explore-profile"));
            const {start, end} = made.get_model_by_name("explore-profile")[`${axis}_range`];
            return [start, end];
        }""",
        axis,
    )
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
    surface, body = (page.evaluate(SOURCE, f"profile {which}") for which in ("surface", "body"))
    assert surface["x"][-1] == pytest.approx(0.8, abs=0.02)
    assert all(low <= high + 1e-6 for low, high in zip(surface["y"], body["y"], strict=True))
    assert any(high - low < 1e-6 for low, high in zip(surface["y"], body["y"], strict=True))
    line = page.evaluate(SOURCE, "contact cut")
    assert line["x"] == pytest.approx([0.1, 0.9], abs=0.02)
    assert line["y"] == pytest.approx([0.5, 0.5], abs=0.02)
    for axis, values in (("x", surface["x"]), ("y", surface["y"] + body["y"])):
        assert_fits(page, axis, values)
    showing(page, "area", "0.1")  # which the profile follows
    lifted = page.evaluate(SOURCE, "profile body")
    assert sum(lifted["y"]) > sum(body["y"])
    assert_fits(page, "y", surface["y"] + lifted["y"])
    page.click("[data-profile=explore-profile]")  # the cross is there again
    assert page.evaluate(SOURCE, "profile surface")["x"][-1] == 1
    page.click("[data-profile=explore-profile]")


def test_the_scale_of_a_map_has_its_name_and_unit(small):
    page = showing(small, "gap", "0.2")
    assert page.inner_text("#explore-contact .scale > span") == "gap / h"
    assert page.locator("#explore-contact .scale i span").count() >= 2
    page.select_option('[data-key="shown"]', "area")
    assert page.inner_text("#explore-contact .scale") == ""
    page.select_option('[data-key="shown"]', "height")
    assert page.inner_text("#explore-contact .scale > span") == "height / h"


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_scale_of_a_map_has_its_colours(pages, theme):
    page = pages.open(SMALL + "&fluid=x&shown=flux", theme=theme)
    settled(page, points=64)
    for shown in ("flux", "pressure", "gap"):
        page.select_option('[data-key="shown"]', shown)
        page.locator("#explore-contact .scale > span").filter(has_text=shown).wait_for()
        bar = page.locator("#explore-contact .scale i")
        drawn = bar.evaluate("(each) => getComputedStyle(each).backgroundImage")
        assert drawn.startswith("linear-gradient")
        assert len(set(re.findall(r"rgba?\([^)]*\)", drawn))) > 9, shown
    page.context.close()


def of_screen(page, name):
    """Brightness of a map on the screen, rows from the top downwards."""
    page.locator(f"#plot-{name}").scroll_into_view_if_needed()
    frame = still(page, name)
    page.mouse.move(1, 1)  # whose tools are hidden then
    inside = {key: frame[key] + 2 for key in ("left", "top")}
    clip = {"x": inside["left"], "y": inside["top"]}
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
