"""Explore in a browser, used as a person would, its figures compared with the library's numbers."""

import math
import re
from urllib.parse import urlencode

import numpy as np
import pandas
import pytest
from matplotlib import image as pictures

import roughline as rl
from lab.explore_driven import SMALL, address, drawn, image, sentence, settled, strip, table, typed
from lab.relay import Relay
from lab.unpacked import HALF_A_STEP
from lab_in_browser import NO_LINE, Pages, RunningLab
from roughline.comparison.trust import trust_map
from roughline.report.values import figure, up_to_three_digits
from roughline.units import supported_digits

E_STAR, HEIGHT, LENGTH = 110e9, 1e-6, 1e-3
SCALE = E_STAR * HEIGHT * LENGTH


@pytest.fixture(scope="module")
def small(pages):
    """Return one page on a small grid, for tests that set what they need."""
    page = pages.open(SMALL)
    settled(page, points=64)
    return page


@pytest.fixture
def fresh(small, pages):
    """Return the same page as it was opened."""
    small.goto(pages.address + SMALL)
    settled(small, points=64)
    return small


def spectrum(dimension=2.4, cutoff=0.0625):
    q_high = 2 * math.pi / LENGTH / cutoff
    return rl.SelfAffine(
        fractal_dimension=dimension, length=LENGTH, rms_height=HEIGHT, q_high=q_high
    )


def box_of(page, selector):
    place = page.locator(selector)
    place.scroll_into_view_if_needed()
    return place.bounding_box()


@pytest.mark.parametrize(("query", "points"), [("", 512), ("?view=explore&v=1&n=64", 64)])
def test_it_opens_on_a_surface_that_is_solved(pages, query, points):
    page = pages.open(query)
    drawn(page, points=points, D_f=2.2, F=0.1)
    said = re.compile(rf"^{points}², \d+ convolutions, residual \S+ certified, .* s$")
    page.locator("#explore [data-status]").filter(has_text=said).wait_for()
    surface = spectrum(2.2, 2 / points).surface(points, 20)
    asked = {"E_star": E_STAR, "forces": [0.1 * SCALE]}
    pressed = rl.press(surface, fields=True, grid_error=True, **asked)
    k, error = pressed.stiffness[0], pressed.stiffness_error[0]
    value = up_to_three_digits(k, interval(k, error), "N/m").partition(" (")[0]
    assert strip(page)["stiffness_3d"][0] == value
    assert sum(image(page, "contact")) == pressed.fields[0].contact.sum()
    page.context.close()


def interval(value, error):
    return value / (1 + error / value), value + error


def test_strip_and_tables_say_what_the_library_says(fresh):
    the_line_is_in_strip_and_table(fresh)
    surface = spectrum().surface(64, 3)
    pressed = rl.press(surface, E_star=E_STAR, forces=[0.2 * SCALE], fields=True, grid_error=True)
    said = strip(fresh)
    k, area = pressed.stiffness[0], pressed.area_fraction_corrected[0]
    of_k = interval(k, pressed.stiffness_error[0])
    of_area = interval(area, pressed.area_fraction_error[0])
    of_area = of_area[0], min(of_area[1], pressed.area_fraction_most[0])
    value, _, ends = up_to_three_digits(k, of_k, "N/m").partition(" (")
    over_disc = figure(k / (E_STAR * LENGTH), supported_digits(k, of_k, 3))
    assert said["stiffness_3d"] == [value, f"({ends}, k / (E* L) {over_disc}"]
    assert said["area"][0] == figure(100 * area, supported_digits(area, of_area, 3)) + "%"
    assert said["force"] == ["22.0 N", "22.0 MPa over the nominal area"]
    assert said["roughness"][0] == "1.00 µm"
    under_map = {row[0]: row[1] for row in table(fresh, "contact")}
    assert under_map["stiffness k"] == said["stiffness_3d"][0]
    assert under_map["contact area"] == said["area"][0]
    assert all(row[3] for row in table(fresh, "contact"))
    curve = rl.press(surface, E_star=E_STAR, forces=np.geomspace(1e-3, 3, 13) * SCALE)
    rows = table(fresh, "stiffness")
    assert [row[0] for row in rows[:13]] == [figure(x) for x in curve.force_bar]
    assert [row[1].removesuffix(" *") for row in rows[:13]] == [
        figure(x) for x in curve.stiffness / (E_STAR * LENGTH)
    ]
    assert ["*" in row[1] for row in rows[:13]] == [not each for each in curve.resolved]
    assert [row[1].removesuffix(" *") for row in table(fresh, "area")] == [
        figure(x) for x in curve.area_fraction_corrected
    ]
    measured = rl.isotropic_spectrum(surface)
    known = measured.C_2d[measured.C_2d > 0]
    assert [row[1] for row in table(fresh, "spectrum")] == [
        figure(x).replace("e-", "·10−")
        for x in known[:: -(-known.size // 40)]  # set high
    ]


def the_line_is_in_strip_and_table(fresh):
    lines = [spectrum().line(2**13, seed) for seed in range(3, 23)]
    stiffness = [
        rl.press(line, E_star=E_STAR, forces=[0.2 * E_STAR * line.rms_height * LENGTH])
        for line in lines
    ]
    mean = float(np.mean([each.stiffness_bar[0] for each in stiffness]))
    assert ["0.200", figure(mean), "1D"] in table(fresh, "stiffness")
    pressed = rl.press(spectrum().surface(64, 3), E_star=E_STAR, forces=[0.2 * SCALE])
    ratio = pressed.stiffness[0] / (E_STAR * LENGTH) / mean - 1
    said = fresh.inner_text("#explore [data-compared]")
    words = f"This surface is {abs(ratio):.0%} {'softer' if ratio < 0 else 'stiffer'} than lines"
    assert said.startswith(words.replace("%", " %"))
    scatter = trust_map().at(2.4, 0.2).scatter
    assert f"single surfaces scatter by {scatter:.0%}".replace("%", " %") in said


@pytest.mark.parametrize("shown", ["pressure", "gap", "displacement"])
def test_the_second_map_shows_what_is_chosen(small, shown):
    small.select_option('#explore [data-key="shown"]', shown)
    settled(small, points=64)
    title = "deflection" if shown == "displacement" else shown  # which is sent when it is chosen
    small.locator("#explore-contact .scale", has_text=title).wait_for()
    state = drawn(small)
    surface = spectrum().surface(64, 3)
    pressed = rl.press(surface, E_star=E_STAR, forces=[state["F"] * SCALE], fields=True)
    scale = E_STAR if shown == "pressure" else HEIGHT
    wanted = getattr(pressed.fields[0], shown).T / scale
    if shown == "gap":  # blank where they touch
        wanted = np.where(pressed.fields[0].contact.T, np.nan, wanted)
    heights = surface.heights.T / HEIGHT  # with which the gap is sent
    ranges = [heights, heights + wanted] if shown == "gap" else [wanted]
    most = HALF_A_STEP * sum(np.nanmax(each) - np.nanmin(each) for each in ranges)
    found = np.array(image(small, "contact"), float).reshape(64, 64)
    np.testing.assert_allclose(found, wanted, rtol=1e-6, atol=most)
    assert address(small)["shown"] == shown


REMEMBER_STATUS = """() => {
  window.said = [];
  const status = document.querySelector("#explore [data-status]");
  new MutationObserver(() => window.said.push(status.textContent))
    .observe(status, {childList: true, characterData: true, subtree: true});
}"""


SEEN = """() => {
    const sketch = document.querySelector("#plot-explore-contact .sketch");
    if (!sketch) return false;
    const {width, height} = sketch;
    const {data} = sketch.getContext("2d").getImageData(0, 0, width, height);
    return Array.from({length: width * height}, (_, i) => data[4 * i] - data[4 * i + 2] > 50);
}"""


def test_the_contact_is_seen_before_plots_can_be_made(pages):
    page, seen = pages.blank(), []

    def look(route):
        seen.extend(page.wait_for_function(SEEN).json_value())
        seen.append(strip(page))
        route.continue_()

    page.route("**/bokeh.min.js", look)
    page.goto(pages.address + SMALL)
    drawn(page, points=64)
    assert page.locator(".sketch").count() == 0
    *cells, numbers = seen
    np.testing.assert_array_equal(cells, np.equal(image(page, "contact"), 1))
    assert numbers.keys() == strip(page).keys()


def test_no_axis_is_painted_again_while_the_load_moves(fresh):
    fresh.evaluate(
        """() => {
            const {PlotView} = Bokeh.require("models/plots/plot_canvas");
            const paint = PlotView.prototype._paint_primary;
            window.painted = [];
            PlotView.prototype._paint_primary = function (...on) {
                painted.push(this.model.name);
                paint.apply(this, on);
            };
        }"""
    )
    typed(fresh, "F", "0.21")
    settled(fresh, F=0.21)
    assert fresh.evaluate("painted") == []


def test_a_dragged_slider_is_followed_coarsely_and_sharpens_at_rest(fresh):
    fresh.check('#explore [data-key="n"][value="256"]')
    drawn(fresh, points=256)
    box = box_of(fresh, "#explore-D_f")
    middle = box["y"] + box["height"] / 2
    fresh.evaluate(REMEMBER_STATUS)  # the sharp answer may follow before one could look
    fresh.mouse.move(box["x"] + 0.4 * box["width"], middle)
    fresh.mouse.down()
    for share in (0.45, 0.5):
        fresh.mouse.move(box["x"] + share * box["width"], middle)
        value = float(fresh.input_value('#explore [data-text="D_f"]'))
        drawn(fresh, points=128, D_f=value)
        drawn(fresh, "stiffness", what="line", D_f=value)
        fresh.wait_for_function("said.splice(0).some((text) => text.includes('coarse'))")
    fresh.mouse.up()
    drawn(fresh, points=256, D_f=value)
    assert "coarse" not in fresh.inner_text("#explore [data-status]")
    assert address(fresh)["D_f"] == f"{value:g}"


def shown_is_of_the_library(page):
    """Return what the strip says, of a surface of 0.3 um that yields."""
    surface = rl.SelfAffine(
        fractal_dimension=2.46, length=2e-3, rms_height=3e-7, q_high=2 * math.pi / 1.25e-4
    ).surface(64, 12)
    hardness = 0.3 * E_STAR * surface.rms_slope
    pressed = rl.press(
        surface, E_star=E_STAR, hardness=hardness, forces=[10.0], periodic=True, fields=True
    )
    fields = pressed.fields[0]
    np.testing.assert_array_equal(
        image(page, "contact"), (fields.contact.astype(int) + fields.plastic).T.ravel()
    )
    said = strip(page)
    assert said["plastic"][0] == figure(100 * float(pressed.plastic_fraction[0])) + "%"
    assert said["roughness"][0] == "300 nm"
    assert said["force"][0] == "10.0 N"
    assert "at the hardness" in page.inner_text('[data-caption="shown"]')
    for name in ("stiffness unloading", "stiffness back", "area back"):
        assert shown_marks(page, name) > 3
    return said


# but for what is typed with a unit: a link has the share that it is
SET = """() => [...document.querySelectorAll(
    '#explore [data-text], #explore select, #explore :is([type="radio"], [type="checkbox"])'
)].filter((each) => !["h", "F"].includes(each.dataset.text)).map(
    (each) => each.matches("[type=radio], [type=checkbox]") ? each.checked
        : Number(each.value) || each.value)"""


def link_shows_the_same(page, pages):
    other = pages.open("?" + urlencode(address(page)))
    settled(other, points=64, seed=12)
    assert strip(other) == strip(page)
    np.testing.assert_array_equal(image(other, "contact"), image(page, "contact"))
    assert other.evaluate(SET) == page.evaluate(SET)
    assert "Persson" in other.inner_text('[data-remarks="area"]')
    other.context.close()


def test_walk_by_keys_typed_numbers_a_hardness_and_a_link(fresh, pages):
    elastic = strip(fresh)
    fresh.focus("#explore-D_f")
    for _ in range(3):
        fresh.keyboard.press("ArrowRight")
    settled(fresh, points=64, D_f=2.46)
    assert fresh.get_attribute("#explore-D_f", "aria-valuetext") == "2.46"
    for key, text in (("h", "0.3 um"), ("F", "10 N"), ("D_f", "H = 0.8"), ("L", "2 mm")):
        typed(fresh, key, text)
    settled(fresh, points=64, D_f=2.2, h=1.5e-4)
    assert fresh.input_value("#explore-h-text") == "0.3 um"
    assert float(fresh.input_value("#explore-D_f")) == pytest.approx(2.2)
    fresh.check('#explore [data-key="boundary"][value="periodic"]')
    fresh.check('#explore [data-key="theories"][value="persson"]')
    fresh.check("#explore-adds-hardness_bar")
    for key, text in (("D_f", "2.46"), ("seed", "12"), ("hardness_bar", "0.3")):
        typed(fresh, key, text)
    settled(fresh, points=64, D_f=2.46, seed=12, hardness_bar=0.3)
    fresh.locator("#explore-area .names li", has_text="way back").wait_for()
    said = shown_is_of_the_library(fresh)
    assert said.keys() - elastic.keys() == {"unloading", "plastic", "indentation"}
    link_shows_the_same(fresh, pages)
    typed(fresh, "hardness_bar", "7")
    sentence(fresh, "hardness_bar").filter(has_text="from 0.02 to 5").wait_for()
    fresh.uncheck("#explore-adds-hardness_bar")
    settled(fresh, points=64)
    fresh.wait_for_function("() => !document.querySelector('[data-answer=plastic]')")
    assert strip(fresh).keys() <= elastic.keys()
    assert not fresh.is_visible("#explore-hardness_bar")
    assert "hardness_bar" not in address(fresh)
    for name in ("stiffness unloading", "stiffness back", "area back"):
        assert shown_marks(fresh, name) == 0


def test_a_link_that_cannot_be_read_is_refused_in_one_sentence(small, pages):
    page = small
    page.goto(f"{pages.address}?view=explore&v=1&colour=red&L=5+mm&n=64")
    sentence(page, "").filter(has_text="set the controls by hand").wait_for()
    drawn(page, D_f=2.2)
    assert sentence(page, "").is_visible()
    assert page.input_value("#explore-L-text") == "1 mm"
    assert page.is_checked('#explore [data-key="n"][value="512"]')
    page.check('#explore [data-key="n"][value="64"]')
    settled(page, points=64)
    assert not sentence(page, "").is_visible()


def shown_marks(page, name):
    """Return how many marks a source has, and zero if the legend does not name them."""
    return page.evaluate(
        """(name) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            const isNamed = [...document.querySelectorAll("#explore .names li:not([hidden])")].some(
                (item) => item.dataset.sources.split(";").includes(name));
            return isNamed ? made.get_model_by_name(name).data.x.length : 0;
        }""",
        name,
    )


def test_a_link_by_the_hurst_exponent_leaves_its_slider_alive(small, pages):
    small.goto(pages.address + "?view=explore&v=1&H=0.5&n=64")
    settled(small, D_f=2.5)
    small.focus("#explore-D_f")
    small.keyboard.press("ArrowRight")
    settled(small, D_f=2.52)


def test_the_line_of_the_load_can_be_dragged(fresh):
    box = box_of(fresh, "#plot-explore-stiffness")
    at = fresh.evaluate(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("stiffness cursor"));
            const {frame} = Bokeh.index.find_one(made.get_model_by_name("explore-stiffness"));
            return [0.2, 1].map((force) => frame.x_scale.compute(force)).concat(frame.bbox.vcenter);
        }"""
    )
    fresh.mouse.move(box["x"] + at[0], box["y"] + at[2])
    fresh.mouse.down()
    fresh.mouse.move(box["x"] + (at[0] + at[1]) / 2, box["y"] + at[2])
    fresh.mouse.move(box["x"] + at[1], box["y"] + at[2])
    fresh.mouse.up()
    fresh.wait_for_function(
        """() => Math.abs(document.querySelector('#explore [data-text="F"]').value - 1) < 0.05"""
    )
    settled(fresh, points=64, F=float(fresh.input_value('#explore [data-text="F"]')))


def test_a_press_and_a_save_do_not_stop_each_other(fresh):
    fresh.check('#explore [data-key="n"][value="512"]')
    fresh.select_option("#saved", "surface.nc")
    with fresh.expect_download():
        fresh.click("#save")
    drawn(fresh, points=512)


MOVE_AND_SAVE = """() => {
  const find = (selector) => document.querySelector(`#explore ${selector}`);
  find("#saved").value = "curve.csv";
  find('[data-text="F"]').value = "11 MPa";
  find('[data-text="F"]').dispatchEvent(new Event("change", {bubbles: true}));
  find("#save").click();
}"""


def test_what_is_saved_is_what_is_shown_not_what_was_set_since(fresh, tmp_path):
    typed(fresh, "L", "2 mm")
    settled(fresh, points=64, F=0.2)
    with fresh.expect_download() as coming:
        fresh.evaluate(MOVE_AND_SAVE)
    coming.value.save_as(tmp_path / "before.csv")
    kept = pandas.read_csv(tmp_path / "before.csv", comment="#")
    assert kept.query("panel == 'area' and series == 'here'").x.tolist() == [0.2]
    settled(fresh, points=64, F=0.1)
    with fresh.expect_download() as coming:
        fresh.click("#save")
    coming.value.save_as(tmp_path / "after.csv")
    assert "L=2+mm" in (tmp_path / "after.csv").read_text()
    assert_all_points_are_saved(fresh, tmp_path / "after.csv")
    for which, lines in (
        ("python", ("in_si('2 mm', ", "load_in_newtons('11 MPa', surface.area)")),
        ("command", ("--length '2 mm'", "--load '11 MPa'")),
    ):
        fresh.click(f"#explore [data-code={which}]")
        code = fresh.locator("#explore-code pre")
        code.filter(has_text="rl.press" if which == "python" else "roughline press").wait_for()
        assert all(line in code.inner_text() for line in lines)
        fresh.keyboard.press("Escape")
    fresh.select_option("#saved", "contact.png")
    with fresh.expect_download() as coming:
        fresh.click("#save")
    assert coming.value.suggested_filename == "contact.png"
    coming.value.save_as(tmp_path / "contact.png")
    assert_is_as_drawn(fresh, tmp_path / "contact.png")


def assert_all_points_are_saved(page, file):
    """Check that a table has the points of all sources that the plots draw."""
    rows = pandas.read_csv(file, comment="#").groupby(["panel", "series"])
    saved = {f"{panel} {name}": columns for (panel, name), columns in rows}
    drawn = page.evaluate(
        """() => {
            const found = (name) => Bokeh.documents.map((each) => each.get_model_by_name(name))
                .find((each) => each);
            const {panels} = JSON.parse(document.querySelector("#explore").dataset.declared);
            return Object.fromEntries(panels.flatMap(({key, series}) => series.map(({name}) => {
                const {x, y} = found(`${key} ${name}`).data;
                return [`${key} ${name.replaceAll(" ", "_")}`, [[...x], [...y]]];
            })));
        }"""
    )
    assert set(saved) == {name for name, (x, _) in drawn.items() if x}
    for name, columns in saved.items():
        assert columns.x.tolist() == drawn[name][0]
        assert columns.y.tolist() == drawn[name][1]


def assert_is_as_drawn(page, file):
    """Check that the contact in a picture has the share of its colour that the strip says."""
    picture = pictures.imread(file)
    assert picture.shape[1] > 400
    colours = np.unique((picture[..., :3] * 255).astype(int).reshape(-1, 3), axis=0)
    assert len(colours) > 100


def test_a_long_press_can_be_cancelled(fresh):
    fresh.check('#explore [data-key="n"][value="1024"]')
    fresh.click("#explore .cancel")
    stopped = fresh.get_by_text("stopped: the coarse answer is shown", exact=True)
    fresh.locator("#explore [data-status]").and_(stopped).wait_for()
    fresh.wait_for_selector("#explore progress", state="hidden")
    drawn(fresh, points=128)
    fresh.check('#explore [data-key="n"][value="64"]')
    settled(fresh, points=64)


def test_a_lost_server_is_said_and_a_new_one_is_found(browser, lab, tmp_path):
    relay = Relay(lab.address)
    pages = Pages(browser, relay.address)
    page = pages.open(SMALL)
    settled(page, points=64)
    relay.drop()
    page.locator("#connection").filter(has_text="does not answer").wait_for()
    second = RunningLab(tmp_path / "second")
    relay.lead_to(second.address)
    relay.restore()
    try:
        page.context.request.get(relay.through(second.address))  # it is opened, with its own token
        page.wait_for_selector("#connection", state="hidden")
        page.focus("#explore-D_f")
        page.keyboard.press("ArrowRight")
        settled(page, points=64, D_f=2.42)
        assert [each for each in pages.complaints if not re.search(NO_LINE, each)] == []
    finally:
        pages.close()
        relay.close()
        ended = second.close()
    assert ended == (0, "")
