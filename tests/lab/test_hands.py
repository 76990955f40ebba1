"""Hands on the page: wheel, mouse, one finger, two fingers; what they scroll, zoom and change."""

import functools
import re
import time
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from lab.drawn_plots import still, values
from lab.explore_driven import SMALL, settled
from lab.measured_driven import READY, answers

QUERIES = {"explore": SMALL, "measured": "?view=measured", "published": "?view=published"}
PHONE = {"width": 390, "height": 844, "has_touch": True, "is_mobile": True}

RANGES = """(name) => {
    const root = Bokeh.documents.flatMap((each) => each.roots()).find((each) => each.name === name);
    return [root.x_range, root.y_range].flatMap(({start, end}) => [start, end]);
}"""
LENGTHS = """(name) => {
    const root = Bokeh.documents.flatMap((each) => each.roots()).find((each) => each.name === name);
    return [[root.x_range, root.x_scale], [root.y_range, root.y_scale]]
        .filter(([range]) => range.type !== "FactorRange")
        .map(([{start, end}, {type}]) =>
            type === "LogScale" ? Math.log(end / start) : Math.abs(end - start));
}"""
SAID = """(view) =>
    [...document.querySelectorAll(`#${view} :is(input, [data-point], [data-table^=fit], .strip)`)]
        .map(({type, checked, value, textContent}) =>
            ["radio", "checkbox"].includes(type) ? checked : value ?? textContent)"""
PLOTS = """(view) => [...document.querySelectorAll(`#${view} .plot`)]
    .filter((each) => each.checkVisibility()).map((each) => each.id.slice("plot-".length))"""


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A small map, which is soon prepared."""
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(32, 3)
    path = tmp_path_factory.mktemp("hands") / "map.nc"
    rl.write(replace(surface, unit="m"), path)
    return path


@pytest.fixture(scope="module")
def desk(pages, file):
    """Views in a low window of a desk, each opened once, by their names."""
    return functools.cache(lambda view: opened(pages, view, file, height=700))


@pytest.fixture(scope="module")
def phone(pages, file):
    """The same on a phone."""
    return functools.cache(lambda view: opened(pages, view, file, **PHONE))


def plots(page, view):
    """Return the plots that a view shows; of those that are made alike, one stands for all."""
    alike = r"(line|y|contact|deflection)-[123]$|^study-.*-[1-9]$|trust-[2-9]"
    return [name for name in page.evaluate(PLOTS, view) if not re.search(alike, name)]


def opened(pages, view, file, **context):
    """Open a view with all it has to show."""
    page = pages.open(QUERIES[view], **context)
    if view == "explore":
        settled(page, points=64)
    elif view == "measured":
        page.set_input_files("#measured [data-file]", file)
        page.click("#measured-step-preparation > summary")
        page.click(READY)
        answers(page)
        page.click("[data-compare]")
        page.wait_for_selector('[data-table="measured-models"] tbody tr', state="attached")
    else:
        page.wait_for_selector('[data-table="fit-3D"] tbody tr')
        page.wait_for_selector('[data-table="published-trust-1"] tbody tr', state="attached")
        for name in page.evaluate(PLOTS, view)[::-1]:  # what is embedded later would move others
            brought(page, name)
    return page


def brought(page, plot):
    """Bring a plot to the middle of the window, where it rests; return the middle of it."""
    frame = still(page, plot)
    return frame["left"] + frame["width"] / 2, frame["top"] + frame["height"] / 2


def way(page):
    """Return 1 where the page can be scrolled on, -1 where it ends."""
    return page.evaluate("scrollY < 150 ? 1 : -1")


def scrolled(page, before):
    page.wait_for_function("(before) => Math.abs(scrollY - before) > 20", arg=before)


def shows(page, name, ranges):
    """Wait until a plot shows these ranges."""
    page.wait_for_function(
        f"""([name, ranges]) => ({RANGES})(name).every((each, i) =>
            !(Math.abs(each - ranges[i]) > 1e-6 * Math.abs(ranges[i])))""",
        arg=[name, ranges],
    )


def changed(page, name, ranges):
    """Wait until a plot shows something else."""
    page.wait_for_function(
        f"([name, ranges]) => ({RANGES})(name).join() !== ranges.join()",
        arg=[name, ranges],
    )


class Mouse:
    """A mouse whose wheel scrolls, and zooms with a modifier."""

    def __init__(self, page):
        self._mouse, self._page = page.mouse, page

    def scroll(self, x, y, way):
        self._mouse.move(x, y)
        self._mouse.wheel(0, 100 * way)

    def zoom(self, x, y):
        self._wheel_with_a_modifier(x, y, -100)

    def zoom_out(self, x, y):
        """As far as it goes."""
        self._wheel_with_a_modifier(x, y, *[3000] * 6)

    def tap_twice(self, x, y):
        self._mouse.dblclick(x, y)

    def _wheel_with_a_modifier(self, x, y, *turns):
        self._mouse.move(x, y)
        self._page.keyboard.down("Control")
        for turn in turns:
            self._mouse.wheel(0, turn)
        self._page.keyboard.up("Control")


class Fingers:
    """Fingers on a page, each a list of places that it goes through."""

    def __init__(self, page):
        self._page, self._session = page, page.context.new_cdp_session(page)

    def go(self, *ways):
        """Put fingers down, move them along their ways, and lift them when they rest."""
        steps = list(zip(*ways, strict=True))
        now = time.time()  # fingers are as quick on a busy machine
        self._send("touchStart", steps[0], now)
        for i, places in enumerate(steps[1:-1], 1):
            self._send("touchMove", places, now + 0.016 * i)
        if len(steps) > 1:  # lifted while they move, they would throw the page
            self._send("touchMove", [(x + 1, y) for x, y in steps[-1]], now + 0.1)
            self._send("touchMove", steps[-1], now + 0.5)
        self._send("touchEnd", (), now + 0.6)

    def tap_twice(self, x, y):
        """Tap a place twice, a tenth of a second later."""
        now = time.time()
        for at in (now, now + 0.1):
            self._send("touchStart", [(x, y)], at)
            self._send("touchEnd", (), at + 0.02)

    def _send(self, kind, places, at):
        points = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)]
        told = {"type": kind, "touchPoints": points, "timestamp": at}
        self._session.send("Input.dispatchTouchEvent", told)

    def swipe(self, x, y, dx, dy):
        """Draw one finger over the page."""
        self.go([(x + dx * i / 4, y + dy * i / 4) for i in range(5)])

    def scroll(self, x, y, way):
        self.swipe(x, y, 3, -100 * way)

    def zoom(self, x, y):
        steps = (20, 45, 70)
        self.go([(x - i, y - i / 2) for i in steps], [(x + i, y + i / 2) for i in steps])


@pytest.mark.parametrize("figures", [slice(2), slice(None)], ids=["two", "every"])
@pytest.mark.parametrize("view", QUERIES)
@pytest.mark.parametrize(("kind", "hands"), [("desk", Mouse), ("phone", Fingers)])
def test_walk_of_hands_which_scroll_over_every_figure_and_zoom_on_purpose(
    request, kind, hands, view, figures
):
    page = request.getfixturevalue(kind)(view)
    hand, said = hands(page), page.evaluate(SAID, view)
    for name in plots(page, view)[figures]:
        at = brought(page, name)
        whole, lengths = page.evaluate(RANGES, name), page.evaluate(LENGTHS, name)
        before = page.evaluate("scrollY")
        hand.scroll(*at, way(page))
        scrolled(page, before)
        if kind == "phone":
            hand.swipe(*brought(page, name), 100, 4)
            assert page.evaluate("scrollX") == 0
        assert page.evaluate(RANGES, name) == whole, name
        at, before = brought(page, name), page.evaluate("scrollY")
        hand.zoom(*at)
        changed(page, name, whole)
        assert all(np.less(page.evaluate(LENGTHS, name), lengths)), name
        if kind == "desk":
            hand.zoom_out(*at)
            twice = f"([name, whole]) => ({LENGTHS})(name).every((now, i) => now > 1.9 * whole[i])"
            page.wait_for_function(twice, arg=[name, lengths])
            assert page.evaluate(LENGTHS, name) == pytest.approx(np.multiply(2, lengths)), name
        assert page.evaluate("scrollY") == before
        if "trust" in name:  # where a click chooses
            page.focus(f"#plot-{name}")
            page.keyboard.press("0")
        else:
            hand.tap_twice(*brought(page, name))
        shows(page, name, whole)
    if kind == "phone" and view != "measured":
        assert swiped_over_sliders(page, hand, view) == 4
    assert page.evaluate(SAID, view) == said


def swiped_over_sliders(page, fingers, view):
    """Scroll the page by a finger that begins on a slider; return how many there were."""
    page.click(f"#{view} .drawer")
    sliders = page.locator(f"#{view} [type=range]:visible").all()[:4]
    for slider in sliders:
        slider.evaluate("""(each) => each.scrollIntoView({block: "center"})""")
        box, before = slider.bounding_box(), page.evaluate("scrollY")
        x = box["x"] + (0.1 if float(slider.input_value()) > 1 else 0.9) * box["width"]
        fingers.scroll(x, box["y"] + box["height"] / 2, way(page))
        scrolled(page, before)
    page.click(f"#{view} .drawer")
    return len(sliders)


def test_after_its_button_a_finger_draws_once_and_a_touch_on_the_trust_map_chooses(phone):
    page = phone("published")
    fingers = Fingers(page)
    button = page.locator('[data-draw="3D"]')
    x, y = brought(page, "published-stiffness-3D")
    button.tap()
    assert button.get_attribute("aria-pressed") == "true"
    before = page.evaluate(FIT)
    fingers.swipe(x - 60, y, 100, 30)
    page.wait_for_selector('[data-draw="3D"][aria-pressed=false]')
    page.wait_for_function(f"(before) => ({FIT})() !== before", arg=before)
    low, high = (float(page.input_value(f"#published-{key}_3D-text")) for key in ("low", "high"))
    wanted = values(page, "published-stiffness-3D", x - 60, x + 40)
    assert (low, high) == pytest.approx(wanted, rel=0.02)
    page.wait_for_function(KEPT)
    window = page.evaluate(SAID, "published")
    fingers.swipe(*brought(page, "published-stiffness-3D"), 80, 3)
    assert page.evaluate(SAID, "published") == window
    x, y = brought(page, "published-trust-4")  # another than the chosen one
    said = page.inner_text("[data-words=point]")
    page.touchscreen.tap(x - 60, y + 50)
    page.wait_for_function(
        """(before) => document.querySelector("[data-words=point]").innerText !== before""",
        arg=said,
    )
    assert page.is_checked('#published [data-key="roll_off"][value="4"]')


KEPT = """() => ["low_3D", "high_3D"].every((key) => {
    const kept = new URLSearchParams(location.search).get(key);
    return Math.abs(kept / document.querySelector(`#published-${key}-text`).value - 1) < 0.01;
})"""  # in the address, as the last answer has the window
FIT = """() => document.querySelector('[data-table="fit-3D"]').innerText"""


@pytest.mark.parametrize("kind", ["phone", "desk"])
def test_a_dialog_closes_by_its_button_by_escape_and_beside_it(kind, request):
    views = request.getfixturevalue(kind)
    page = views("explore")
    if kind == "phone":
        page.click("#explore .drawer")
    close_its_code_in_every_way(page, "explore")
    if kind == "phone":
        page.click("#explore .drawer")
    close_its_code_in_every_way(views("measured"), "measured")


def test_after_its_button_a_finger_moves_the_load_and_chooses_a_piece(phone):
    page = phone("explore")
    x, y = brought(page, "explore-stiffness")
    page.locator('[data-draw="stiffness"]').tap()
    Fingers(page).swipe(x, y, 60, 8)
    (force,) = values(page, "explore-stiffness", x + 60)
    page.wait_for_selector('[data-draw="stiffness"][aria-pressed=false]')
    assert float(page.input_value("#explore-F-text")) == pytest.approx(force, rel=0.02)
    settled(page, points=64)
    page = phone("measured")
    x, y = brought(page, "measured-before")
    page.locator("#measured [data-draw]").tap()
    Fingers(page).swipe(x - 40, y - 40, 60, 70)
    page.wait_for_selector("#measured [data-draw][aria-pressed=false]")
    wanted = values(page, "measured-before", x - 40, x + 20)
    crop = page.input_value("#measured-crop-text").split(", ")
    assert [float(each.split()[0]) for each in crop[:2]] == pytest.approx(wanted, rel=0.02)


COVERED = """() => [...document.querySelectorAll(".control")]
    .filter((each) => each.checkVisibility()).flatMap((control) => {
        const meaning = control.querySelector(":scope > .meaning");
        if (!meaning) return [];
        control.querySelector("input, select").focus();
        const told = meaning.getBoundingClientRect();
        const around = control.closest(".controls, .block");
        return [...around.querySelectorAll(".control :is(input, select, label, legend)")]
            .filter((other) => other.checkVisibility()).filter((other) => {
                const {left, right, top, bottom} = other.getBoundingClientRect();
                return left < told.right && right > told.left
                    && top < told.bottom && bottom > told.top;
            }).map((other) => `${control.dataset.control} covers ${other.outerHTML}`);
    })"""


@pytest.mark.parametrize("kind", ["phone", "desk"])
@pytest.mark.parametrize("view", list(QUERIES))
def test_what_a_control_means_covers_no_control(pages, file, kind, view):
    page = opened(pages, view, file, **(PHONE if kind == "phone" else {"height": 700}))
    drawer = page.locator(f"#{view} .drawer:visible")
    for opener in drawer.all():
        opener.click()
    page.evaluate(
        "() => document.querySelectorAll('.step').forEach((each) => { each.open = true; })"
    )
    assert page.evaluate(COVERED) == []
    page.context.close()


def close_its_code_in_every_way(page, view):
    openers = [f"#{view} [data-code={name}]" for name in ("python", "command")]
    place = page.locator(f"#{view}-code")
    copying = place.get_by_role("button").first
    ways_out = (
        lambda: place.get_by_text("close").click(),
        lambda: page.keyboard.press("Escape"),
        lambda: page.mouse.click(*below(place)),
        lambda: page.mouse.click(4, 4),
    )
    for opener, way_out in zip([*openers, *openers], ways_out, strict=True):
        page.click(opener)
        place.wait_for()
        place.locator("pre").click()
        assert place.is_visible()
        if way_out is ways_out[0]:
            copying.click()
            copying.filter(has_text="copied").wait_for()
        way_out()
        place.wait_for(state="hidden")
        assert page.evaluate("(opener) => document.activeElement.matches(opener)", opener)


def below(place):
    box = place.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] + 20
