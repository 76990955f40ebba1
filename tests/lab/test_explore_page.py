"""Explore in a browser, used as a person would: it shows what is answered, and saves it."""

import json
import re
from urllib.parse import urlencode

import numpy as np
import pandas
import pytest
from matplotlib import image as pictures_on_disk

from lab.drawn_plots import drag, image, on_screen, source
from lab.explore_asked import SMALL as STATE
from lab.explore_asked import STICKS, answer, said
from lab.explore_driven import (
    address,
    assert_link_shows_the_same,
    drawn,
    save,
    sentence,
    settled,
    strip,
    table,
    typed,
)
from roughline.comparison.trust import trust_map
from roughline.lab.explore import pictures


def answered(state):
    """Return what the strip says and what the map shows of a state."""
    header, arrays = answer(pictures.full, state)
    texts = {key: [each["value"], each["below"]] for key, each in said(header).items()}
    return {key: [text for text in each if text] for key, each in texts.items()}, arrays


def shown(page):
    return {key: [text for text in each if text] for key, each in strip(page).items()}


@pytest.mark.parametrize(("query", "points"), [("", 512), ("?view=explore&v=1&n=64", 64)])
def test_it_opens_on_a_surface_that_is_solved(pages, query, points):
    page = pages.open(query)
    drawn(page, points=points, D_f=2.2, F=0.1, seed=20)
    status = re.compile(rf"^{points}², \d+ convolutions, residual \S+ certified, .* s$")
    page.locator("#explore [data-status]").filter(has_text=status).wait_for()
    texts, arrays = answered({"n": str(points)})
    assert shown(page) == texts
    np.testing.assert_array_equal(image(page, "contact"), arrays["area"].ravel())
    page.context.close()


def test_strip_and_tables_show_what_is_answered(fresh):
    full, curve, coarse = (
        answer(task, STATE)[0] for task in (pictures.full, pictures.curve, pictures.coarse)
    )
    line = coarse["line"]
    assert shown(fresh) == answered(STATE)[0]
    under_map = {row[0]: row for row in table(fresh, "contact")}
    for each in full["strip"]:
        assert under_map[each["symbol"].replace("_", "")][1] == each["value"]
    assert all(row[3] for row in under_map.values())
    of_stiffness = curve["panels"]["stiffness"]["rows"] + line["panels"]["stiffness"]["rows"]
    assert table(fresh, "stiffness")[: len(of_stiffness)] == of_stiffness
    assert table(fresh, "area") == curve["panels"]["area"]["rows"]
    spectrum = full["panels"]["spectrum"]["rows"]
    assert table(fresh, "spectrum") == [
        [cell.replace("e-", "·10−") for cell in row]
        for row in spectrum  # set high
    ]
    ratio = full["stiffness_bar_3d"] / line["stiffness_bar_1d"] - 1
    words = f"This surface is {abs(ratio):.0%} {'softer' if ratio < 0 else 'stiffer'} than lines"
    compared = fresh.inner_text("#explore [data-compared]")
    assert compared.startswith(words.replace("%", " %"))
    scatter = trust_map().at(2.4, 0.2).scatter
    assert f"single surfaces scatter by {scatter:.0%}".replace("%", " %") in compared


@pytest.mark.parametrize("key", ["pressure", "gap", "displacement", "flux"])
def test_the_second_map_shows_what_is_chosen(fresh, key):
    fresh.set_checked("#explore-adds-fluid", key == "flux")
    fresh.select_option('#explore [data-key="shown"]', key)
    settled(fresh, points=64)
    title = "deflection" if key == "displacement" else key  # which is sent when it is chosen
    fresh.locator("#explore-contact .scale", has_text=title).wait_for()
    _, arrays = answered(address(fresh))
    wanted = arrays[key].ravel()
    np.testing.assert_allclose(np.array(image(fresh, "contact"), float), wanted, rtol=1e-6)
    assert address(fresh)["shown"] == key


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
    page.goto(pages.address + "?" + urlencode({"view": "explore", "v": "1", **STATE}))
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
    slider = fresh.locator("#explore-D_f")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
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


WITH_A_HARDNESS = {
    **{"n": "64", "D_f": "2.46", "seed": "12", "cutoff": "0.0625", "L": "2 mm", "h": "0.3 um"},
    **{"F": "10 N", "boundary": "periodic", "hardness_bar": "0.3"},
}
MARKS = ("stiffness unloading", "stiffness back", "area back")
# but for what is typed with a unit: a link has the share that it is
SET = """() => [...document.querySelectorAll(
    '#explore [data-text], #explore select, #explore :is([type="radio"], [type="checkbox"])'
)].filter((each) => !["h", "F"].includes(each.dataset.text)).map(
    (each) => each.matches("[type=radio], [type=checkbox]") ? each.checked
        : Number(each.value) || each.value)"""


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
    texts, arrays = answered(WITH_A_HARDNESS)
    assert shown(fresh) == texts
    np.testing.assert_array_equal(image(fresh, "contact"), arrays["area"].ravel())
    assert strip(fresh).keys() - elastic.keys() == {"unloading", "plastic", "indentation"}
    assert "at the hardness" in fresh.inner_text('[data-caption="shown"]')
    assert all(shown_marks(fresh, name) > 3 for name in MARKS)
    other = assert_link_shows_the_same(fresh, pages, settled, points=64, seed=12)
    assert other.evaluate(SET) == fresh.evaluate(SET)
    assert "Persson" in other.inner_text('[data-remarks="area"]')
    other.context.close()
    typed(fresh, "hardness_bar", "7")
    sentence(fresh, "hardness_bar").filter(has_text="from 0.02 to 5").wait_for()
    fresh.uncheck("#explore-adds-hardness_bar")
    settled(fresh, points=64)
    fresh.wait_for_function("() => !document.querySelector('[data-answer=plastic]')")
    assert strip(fresh).keys() <= elastic.keys()
    assert not fresh.is_visible("#explore-hardness_bar")
    assert "hardness_bar" not in address(fresh)
    assert all(shown_marks(fresh, name) == 0 for name in MARKS)


def shown_marks(page, name):
    """Return how many marks a source has, and zero if the legend does not name them."""
    named = page.evaluate(
        """() => [...document.querySelectorAll("#explore .names li:not([hidden])")].flatMap(
            (item) => item.dataset.sources.split(";"))"""
    )
    return len(source(page, name)[0]) if name in named else 0


def test_a_link_by_the_hurst_exponent_leaves_its_slider_alive(tab):
    page = tab("?view=explore&v=1&H=0.5&n=64")
    settled(page, D_f=2.5)
    page.focus("#explore-D_f")
    page.keyboard.press("ArrowRight")
    settled(page, D_f=2.52)


def test_the_line_of_the_load_can_be_dragged(fresh):
    drag(fresh, *on_screen(fresh, "explore-stiffness", (0.2, 0.3), (0.5, 0.3), (1, 0.3)))
    fresh.wait_for_function(
        """() => Math.abs(document.querySelector('#explore [data-text="F"]').value - 1) < 0.05"""
    )
    settled(fresh, points=64, F=float(fresh.input_value('#explore [data-text="F"]')))


def test_a_press_and_a_save_do_not_stop_each_other(fresh, tmp_path):
    fresh.check('#explore [data-key="n"][value="512"]')
    save(fresh, "surface.nc", tmp_path)
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
    kept = rows_of(tmp_path / "before.csv")
    assert kept.query("panel == 'area' and series == 'here'").x.tolist() == [0.2]
    settled(fresh, points=64, F=0.1)
    after = save(fresh, "curve.csv", tmp_path)
    assert "L=2+mm" in after.read_text()
    assert_all_points_are_saved(fresh, after)
    for which, lines in (
        ("python", ("in_si('2 mm', ", "load_in_newtons('11 MPa', surface.area)")),
        ("command", ("--length '2 mm'", "--load '11 MPa'")),
    ):
        fresh.click(f"#explore [data-code={which}]")
        code = fresh.locator("#explore-code pre")
        code.filter(has_text="rl.press" if which == "python" else "roughline press").wait_for()
        assert all(line in code.inner_text() for line in lines)
        fresh.keyboard.press("Escape")
    picture = pictures_on_disk.imread(save(fresh, "contact.png", tmp_path))
    assert picture.shape[1] > 400
    colours = np.unique((picture[..., :3] * 255).astype(int).reshape(-1, 3), axis=0)
    assert len(colours) > 100


def rows_of(file):
    """Read a saved table; some versions of pandas read a number one unit off by themselves."""
    return pandas.read_csv(file, comment="#", converters={"x": float, "y": float})


def assert_all_points_are_saved(page, file):
    """Check that a table has the points of all sources that the plots draw."""
    rows = rows_of(file).groupby(["panel", "series"])
    saved = {f"{panel}_{name}": columns for (panel, name), columns in rows}
    declared = json.loads(page.get_attribute("#explore", "data-declared"))
    drawn = {
        f"{panel['key']} {series['name']}".replace(" ", "_"): source(
            page, f"{panel['key']} {series['name']}"
        )
        for panel in declared["panels"]
        for series in panel["series"]
    }
    assert set(saved) == {name for name, (x, _) in drawn.items() if x}
    for name, columns in saved.items():
        assert columns.x.tolist() == drawn[name][0]
        assert columns.y.tolist() == drawn[name][1]


@pytest.mark.parametrize(
    ("state", "points", "told"),
    [
        ({"n": "1024"}, 128, "stopped: the coarse answer is shown"),
        ({**STICKS, "n": "256"}, 256, "stopped"),
    ],
    ids=["a press", "both ways"],
)
def test_what_takes_long_can_be_cancelled(tab, state, points, told):
    page = tab("?" + urlencode({"view": "explore", "v": "1", **state}))
    page.wait_for_selector("#explore .cancel:visible")
    drawn(page, points=points)
    page.click("#explore .cancel")
    page.locator("#explore [data-status]").filter(has_text=told).wait_for()
    page.wait_for_selector("#explore progress", state="hidden")
    page.wait_for_selector("#explore .cancel", state="hidden")
    drawn(page, points=points)
    page.check('#explore [data-key="n"][value="64"]')
    settled(page, points=64)


def test_heights_that_were_held_when_they_were_asked_for_are_drawn(fresh):
    for seed in range(1, 5):  # as many as are held
        typed(fresh, "seed", str(seed))
        settled(fresh, seed=seed)
    fresh.evaluate(
        """async () => {
            const text = document.querySelector("#explore-seed-text");
            for (const seed of ["5", "1"]) { // the fifth takes the place of the first
                text.value = seed;
                text.dispatchEvent(new Event("change", {bubbles: true}));
                await new Promise((done) => setTimeout(done, 5));
            }
        }"""
    )
    settled(fresh, seed=1)
