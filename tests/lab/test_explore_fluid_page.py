"""A fluid in Explore, ticked, hovered, touched and dragged as a person would."""

from urllib.parse import urlencode

import numpy as np
import pytest

import roughline as rl
from lab.explore_driven import SMALL, address, drawn, image, settled, strip, table, typed
from lab.looks import asked, cut_off, faint
from lab.test_explore_page import E_STAR, HEIGHT, LENGTH, SCALE, box_of, spectrum

FLOWS = SMALL + "&fluid=x&shown=flux"
PHONE = {"width": 390, "height": 844, "has_touch": True, "is_mobile": True}
CELL = (40, 22)  # of the map, which is open there


@pytest.fixture(scope="module")
def small(pages):
    """Return one page on a small grid, for tests that set what they need."""
    page = pages.open(SMALL)
    settled(page, points=64)
    return page


@pytest.fixture
def fresh(small, pages):
    """Return the same page with a fluid."""
    small.goto(pages.address + FLOWS)
    at_rest(small, points=64)
    return small


def at_rest(page, **wanted):
    """Wait until everything at rest is drawn, with what flows."""
    settled(page, **wanted)
    drawn(page, "aperture", what="fluid")


def pressed(force_bar=0.2):
    return rl.press(
        spectrum().surface(64, 3), E_star=E_STAR, forces=[force_bar * SCALE], fields=True
    )


def source(page, name):
    """Return x and y of what is drawn."""
    return page.evaluate(
        """(name) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            const {x, y} = made.get_model_by_name(name).data;
            return [[...x], [...y]];
        }""",
        name,
    )


def on_the_map(page, x, y):
    """Return where a place of the map, in its sides, is on the screen."""
    box = box_of(page, "#plot-explore-contact")
    at = page.evaluate(
        """([x, y]) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("explore-contact"));
            const {frame} = Bokeh.index.find_one(made.get_model_by_name("explore-contact"));
            return [frame.x_scale.compute(x), frame.y_scale.compute(y)];
        }""",
        [x, y],
    )
    return box["x"] + at[0], box["y"] + at[1]


def middle_of(cell):
    return [(i + 0.5) / 64 for i in cell]


def told_of(cell):
    """Say what the library knows of a cell, as the page does."""
    fields = pressed().fields[0]
    flow = rl.flow(fields)
    flux = np.hypot(*flow.flux)[cell] * LENGTH / flow.inflow
    return fields.gap[cell] / HEIGHT, flux


def test_the_tick_shows_where_the_fluid_goes_and_how_much_and_takes_it_away_again(small):
    elastic = strip(small)
    assert not small.is_visible("#tab-aperture")
    small.check("#explore-adds-fluid")
    at_rest(small, points=64)
    drawn(small, "aperture", what="fluid")
    flow = rl.flow(pressed().fields[0])
    flux = np.hypot(*flow.flux) * LENGTH / flow.inflow
    flux[flow.gap == 0] = np.nan
    shown = np.array(image(small, "contact"), dtype=float).reshape(64, 64).T
    is_drawn = ~np.isnan(shown) & (shown > -2)
    np.testing.assert_allclose(10 ** shown[is_drawn], flux[is_drawn], rtol=1e-5)
    np.testing.assert_array_equal(np.isnan(shown), flow.gap == 0)
    assert source(small, "contact rings") == [
        [each] for each in map(pytest.approx, middle_of(flow.constriction))
    ]
    assert small.is_visible("#plot-explore-aperture")
    said = strip(small)
    assert said.keys() - elastic.keys() == {"aperture", "channel"}
    aperture = flow.hydraulic_aperture / HEIGHT
    assert float(said["aperture"][0].removesuffix(" h")) == pytest.approx(aperture, rel=0.01)
    assert address(small)["fluid"] == "x"
    assert address(small)["shown"] == "flux"
    assert "Bruggeman" in small.inner_text('[data-remarks="aperture"]')
    small.uncheck("#explore-adds-fluid")
    settled(small, points=64)
    small.wait_for_function("() => !document.querySelector('[data-answer=aperture]')")
    assert strip(small) == elastic
    assert not small.is_visible("#tab-aperture")
    assert small.is_visible("#plot-explore-area")
    assert small.input_value('#explore [data-key="shown"]') == "area"
    assert "fluid" not in address(small)
    assert set(image(small, "contact")) == {0, 1}
    assert source(small, "contact rings") == [[], []]
    assert small.inner_text('[data-remarks="aperture"]') == ""


def test_a_link_shows_the_same_flow(fresh, pages):
    fresh.select_option('#explore [data-key="shown"]', "gap")
    other = pages.open("?" + urlencode(address(fresh)))
    at_rest(other, points=64)
    assert strip(other) == strip(fresh)
    assert other.input_value('#explore [data-key="shown"]') == "gap"
    np.testing.assert_array_equal(image(other, "contact"), image(fresh, "contact"))
    assert table(other, "aperture") == table(fresh, "aperture")
    assert other.is_checked("#explore-adds-fluid")
    other.context.close()


def test_the_map_tells_place_gap_and_flux_where_the_mouse_is(fresh):
    fresh.mouse.move(*on_the_map(fresh, *middle_of(CELL)))
    gap, flux = told_of(CELL)
    place = fresh.locator("#explore-contact .point")
    told = place.inner_text()
    assert told.startswith("x 0.633 L, y 0.352 L; height ")
    assert f"; gap {gap:#.3g} h; " in told
    assert told.endswith(f"; flux {flux:#.3g} of its mean")
    touching = tuple(np.argwhere(pressed().fields[0].contact)[0])
    fresh.mouse.move(*on_the_map(fresh, *middle_of(touching)))
    assert "; in contact" in place.inner_text()
    fresh.mouse.move(*on_the_map(fresh, -0.05, 0.5))
    assert not place.is_visible()


def test_a_finger_is_told_the_same(pages):
    page = pages.open(FLOWS, **PHONE)
    at_rest(page, points=64)
    page.touchscreen.tap(*on_the_map(page, *middle_of(CELL)))
    gap, _ = told_of(CELL)
    page.locator("#explore-contact .point").filter(has_text=f"; gap {gap:#.3g} h; ").wait_for()
    page.context.close()


def test_sealed_loads_stand_at_the_foot_and_are_said(fresh):
    typed(fresh, "F", "9")
    at_rest(fresh, points=64, F=9)
    assert strip(fresh)["aperture"][0] == "sealed"
    assert "sealed" in fresh.inner_text('[data-caption="shown"]')
    assert "seals between F̄ = " in fresh.inner_text('[data-caption="aperture"]')
    start, end = fresh.evaluate(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("aperture here"));
            const {y_range} = made.get_model_by_name("explore-aperture");
            return [y_range.start, y_range.end];
        }"""
    )
    _, feet = source(fresh, "aperture sealed")
    [force], [here] = source(fresh, "aperture here")
    assert force == pytest.approx(9)
    assert {here, *feet} == {here}
    assert start < here < start * (end / start) ** 0.1
    assert min(source(fresh, "aperture curve")[1]) > here
    assert [row for row in table(fresh, "aperture") if row[1] == "sealed" and row[2] == "3D"]


@pytest.mark.parametrize("key", ["F", "D_f", "roll_off"])
def test_sliders_go_to_both_ends_with_a_fluid(fresh, key):
    for end in ("Home", "End"):
        fresh.focus(f"#explore-{key}")
        fresh.keyboard.press(end)
        settled(fresh, points=64)
        assert "aperture" in strip(fresh)
    fresh.locator(f"#explore-{key}").dblclick()
    at_rest(fresh, points=64)


def test_the_tick_and_its_curve_are_reached_by_keys(small, pages):
    small.goto(pages.address + SMALL)
    settled(small, points=64)
    small.focus("#tab-spectrum")
    small.keyboard.press("ArrowRight")
    assert small.evaluate("() => document.activeElement.id") == "tab-area"  # there is no other
    small.focus("#explore-adds-fluid")
    small.keyboard.press("Space")
    at_rest(small, points=64)
    small.focus("#tab-spectrum")
    small.keyboard.press("ArrowRight")
    assert small.evaluate("() => document.activeElement.id") == "tab-aperture"
    assert small.is_visible("#plot-explore-aperture")
    assert asked(small, "nameless", "explore") == []
    assert asked(small, "undescribed", "explore") == []


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_texts_of_the_flow_stand_out_and_none_is_cut_off(pages, theme):
    page = pages.open(FLOWS, theme=theme)
    at_rest(page, points=64)
    page.mouse.move(*on_the_map(page, *middle_of(CELL)))
    page.locator("#explore-contact .point").wait_for()
    assert faint(page) == []
    for width, height in ((390, 844), (1200, 800), (1600, 1100)):
        assert cut_off(page, "explore", width, height) == []
        assert asked(page, "tiny", "explore") == []
    page.context.close()


def test_a_picture_of_the_flow_arrives(fresh, tmp_path):
    fresh.select_option("#saved", "curve.png")
    with fresh.expect_download() as coming:
        fresh.click("#save")
    assert coming.value.suggested_filename == "curve.png"
