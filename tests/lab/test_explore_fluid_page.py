"""A fluid in Explore, ticked, hovered, touched and dragged as a person would."""

from functools import partial

import numpy as np
import pytest

import roughline as rl
from lab.explore_driven import (
    SMALL,
    address,
    assert_linked,
    assert_taken_away,
    drawn,
    image,
    settled,
    source,
    strip,
    table,
    typed,
)
from lab.looks import texts_stand_out
from lab.test_explore_page import E_STAR, HEIGHT, LENGTH, SCALE, box_of, spectrum
from lab.unpacked import HALF_A_STEP

FLOWS = SMALL + "&fluid=x&shown=flux"
CELL = (40, 22)  # of the map, which is open there


def at_rest(page, **wanted):
    """Wait until everything at rest is drawn, with what flows."""
    settled(page, **wanted)
    drawn(page, "aperture", what="fluid")


def pressed(force_bar=0.2):
    return rl.press(
        spectrum().surface(64, 3), E_star=E_STAR, forces=[force_bar * SCALE], fields=True
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


def flow_is_shown(page, elastic):
    flow = rl.flow(pressed().fields[0])
    flux = np.hypot(*flow.flux) * LENGTH / flow.inflow
    flux[flow.gap == 0] = np.nan
    shown = np.array(image(page, "contact"), dtype=float).reshape(64, 64).T
    step = 1.01 * HALF_A_STEP * np.ptp(shown[~np.isnan(shown)])  # of logarithms, as they are sent
    is_drawn = ~np.isnan(shown) & (shown > -2 + step)
    np.testing.assert_allclose(shown[is_drawn], np.log10(flux[is_drawn]), rtol=1e-9, atol=step)
    np.testing.assert_array_equal(np.isnan(shown), flow.gap == 0)
    assert source(page, "contact rings") == [
        [each] for each in map(pytest.approx, middle_of(flow.constriction))
    ]
    assert page.is_visible("#plot-explore-aperture")
    said = strip(page)
    assert said.keys() - elastic.keys() == {"aperture", "channel"}
    aperture = flow.hydraulic_aperture / HEIGHT
    assert float(said["aperture"][0].removesuffix(" h")) == pytest.approx(aperture, rel=0.01)
    assert address(page)["fluid"] == "x"
    assert address(page)["shown"] == "flux"
    assert "Bruggeman" in page.inner_text('[data-remarks="aperture"]')


def map_tells_the_mouse(page):
    page.mouse.move(*on_the_map(page, *middle_of(CELL)))
    gap, flux = told_of(CELL)
    place = page.locator("#explore-contact .point")
    told = place.inner_text()
    assert told.startswith("x 0.633 L, y 0.352 L; height ")
    assert f"; gap {gap:#.3g} h; " in told
    assert told.endswith(f"; flux {flux:#.3g} of its mean")
    touching = tuple(np.argwhere(pressed().fields[0].contact)[0])
    page.mouse.move(*on_the_map(page, *middle_of(touching)))
    assert "; in contact" in place.inner_text()
    page.mouse.move(*on_the_map(page, -0.05, 0.5))
    assert not place.is_visible()


def sealed_loads_are_shown(page):
    assert strip(page)["aperture"][0] == "sealed"
    assert "sealed" in page.inner_text('[data-caption="shown"]')
    assert "seals between F̄ = " in page.inner_text('[data-caption="aperture"]')
    start, end = page.evaluate(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("aperture here"));
            const {y_range} = made.get_model_by_name("explore-aperture");
            return [y_range.start, y_range.end];
        }"""
    )
    _, feet = source(page, "aperture sealed")
    [force], [here] = source(page, "aperture here")
    assert force == pytest.approx(9)
    assert {here, *feet} == {here}
    assert start < here < start * (end / start) ** 0.1
    assert min(source(page, "aperture curve")[1]) > here
    assert [row for row in table(page, "aperture") if row[1] == "sealed" and row[2] == "3D"]


@pytest.mark.parametrize(("theme", "all_of_it"), [("light", False), ("dark", True)])
def test_walk_over_a_fluid(pages, theme, all_of_it):
    page = pages.open(SMALL, theme=theme)
    settled(page, points=64)
    elastic = strip(page)
    page.focus("#tab-spectrum")
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => document.activeElement.id") == "tab-area"  # there is no other
    assert not page.is_visible("#tab-aperture")
    page.focus("#explore-adds-fluid")
    page.keyboard.press("Space")
    at_rest(page, points=64)
    page.focus("#tab-spectrum")
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => document.activeElement.id") == "tab-aperture"
    flow_is_shown(page, elastic)
    map_tells_the_mouse(page)
    texts_stand_out(page, "explore")
    if all_of_it:
        page.select_option("#saved", "curve.png")
        with page.expect_download() as coming:
            page.click("#save")
        assert coming.value.suggested_filename == "curve.png"
        page.select_option('#explore [data-key="shown"]', "gap")
        assert_linked(page, pages, "fluid", "aperture", partial(at_rest, points=64))
        page.select_option('#explore [data-key="shown"]', "flux")
    typed(page, "F", "9")
    at_rest(page, points=64, F=9)
    sealed_loads_are_shown(page)
    typed(page, "F", "0.2")
    assert_taken_away(page, "fluid", "aperture", elastic)
    assert source(page, "contact rings") == [[], []]
    assert page.inner_text('[data-remarks="aperture"]') == ""
    page.context.close()


def test_a_finger_is_told_the_same(pages):
    page = pages.open(FLOWS, width=390, height=844, has_touch=True, is_mobile=True)
    at_rest(page, points=64)
    page.touchscreen.tap(*on_the_map(page, *middle_of(CELL)))
    gap, _ = told_of(CELL)
    page.locator("#explore-contact .point").filter(has_text=f"; gap {gap:#.3g} h; ").wait_for()
    page.context.close()


@pytest.mark.parametrize("key", ["F", "D_f", "roll_off"])
def test_sliders_go_to_both_ends_with_a_fluid(tab, key):
    page = tab(FLOWS)
    at_rest(page, points=64)
    for end in ("Home", "End"):
        page.focus(f"#explore-{key}")
        page.keyboard.press(end)
        settled(page, points=64)
        assert "aperture" in strip(page)
    page.locator(f"#explore-{key}").dblclick()
    at_rest(page, points=64)
