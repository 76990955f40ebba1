"""Answers late or in another order, a page beside another tab, one that is loaded again."""

from dataclasses import replace
from urllib.parse import urlencode

import numpy as np
import pytest

import roughline as rl
from lab.drawn_plots import image, on_screen
from lab.explore_asked import SHEARED, answer
from lab.explore_driven import SMALL, address, drawn, save, settled, strip, table, typed
from lab.measured_driven import CONNECTED, READY
from roughline.lab.explore import pictures

# Answers are kept back while `held` is a list, by the numbers of their questions and their tasks,
# until all are released, or those of some tasks.
HELD = """
window.held = null, window.newest = 0, window.told = [];
const asked = {};
window.release = (...tasks) => {
    const isLet = ([, task]) => tasks.length === 0 || tasks.includes(task);
    const let_go = held.filter(isLet);
    held = held.filter((each) => !isLet(each));
    let_go.forEach(([, , go]) => go());
};
window.WebSocket = class extends WebSocket {
    set onmessage(act) {
        super.onmessage = (event) => {
            const isKept = held && event.data instanceof ArrayBuffer;
            if (!isKept) { act(event); return; }
            const id = Number(new DataView(event.data).getBigUint64(0, true));
            held.push([id, asked[id], () => act(event)]);
        };
    }
    send(data) {
        const {id, task} = JSON.parse(data);
        asked[id] = task;
        if (task === "explore.coarse") newest = id;
        super.send(data);
    }
};
addEventListener("drawn", ({target, detail: {what, numbers}}) => {
    if (target.id === "plot-explore-contact" && what === "contact") told.push(numbers.F);
});
"""


@pytest.fixture(scope="module")
def page(pages):
    """One page, whose answers can be kept back."""
    made = pages.blank()
    made.add_init_script(HELD)
    return made


@pytest.fixture
def opened(page, pages):
    """Return what opens an address of Explore, at rest, from which on answers are kept back."""

    def go(query, **wanted):
        page.goto(pages.address + query)
        settled(page, **wanted)
        page.evaluate("held = []")
        return page

    return go


def came(page, *tasks):
    """Wait until answers of these tasks are kept back, to what was asked last."""
    page.wait_for_function(
        """(tasks) => tasks.every((each) =>
            held.some(([id, task]) => task === each && id >= newest))""",
        arg=list(tasks),
    )


def let_go(page):
    """Release what is kept back, and keep nothing any longer."""
    page.evaluate("release(), held = null")


def test_a_slider_that_moves_faster_than_answers_come_is_followed(opened):
    page = opened(SMALL, points=64)
    for force in ("0.3", "0.4", "0.5"):
        typed(page, "F", force)
        came(page, "explore.coarse")
    page.evaluate("told = []")
    let_go(page)
    settled(page, F=0.5)
    assert page.evaluate("told")[:3] == [0.3, 0.4, 0.5]


def test_walk_past_late_answers_to_another_view_and_back_and_through_a_dialog(opened):
    page = opened(SMALL.replace("n=64", "n=256") + "&shown=gap", points=256)
    for force in ("0.3", "0.4"):
        typed(page, "F", force)
        came(page, "explore.coarse")
    came(page, "explore.full")
    page.evaluate("release('explore.full')")
    page.evaluate("release()")  # what is coarse comes last
    settled(page, points=256, F=0.4)
    assert "coarse" not in page.inner_text("#explore [data-status]")

    typed(page, "F", "0.3")
    came(page, "explore.coarse", "explore.full")
    page.click('nav [data-view="published"]')
    page.evaluate("release()")
    assert address(page)["view"] == "published"
    page.click('nav [data-view="explore"]')
    let_go(page)
    settled(page, F=0.3)
    said = address(page)
    assert (said["view"], said["F"], said["shown"]) == ("explore", "0.3", "gap")

    page.evaluate("held = []")
    page.click("#explore [data-code=python]")
    page.wait_for_function("() => held.some(([, task]) => task === 'explore.code')")
    page.click('nav [data-view="published"]')
    page.evaluate("release('explore.code')")
    assert page.locator("dialog[open]").count() == 0
    page.click('nav [data-view="explore"]')
    let_go(page)
    page.click("#explore [data-code=python]")
    page.wait_for_selector("dialog[open]")
    page.go_back()
    page.wait_for_selector("#published:not([hidden])")
    assert page.locator("dialog[open]").count() == 0


def test_what_is_of_the_contact_before_is_not_taken_for_what_is_of_this_one(opened, tmp_path):
    page = opened(f"?view=explore&v=1&shown=stick&{urlencode(SHEARED)}", points=64)
    remark = "belong to the contact before"
    stick = image(page, "contact")
    typed(page, "F", "0.6")
    came(page, "explore.coarse")
    page.evaluate("release('explore.coarse')")
    drawn(page, F=0.6)
    _, arrays = answer(pictures.coarse, {**SHEARED, "F": "0.6"})
    np.testing.assert_array_equal(image(page, "contact"), arrays["area"].ravel())
    before = page.locator("#explore .strip .before")
    assert set(before.evaluate_all("(all) => all.map((each) => each.dataset.answer)")) == {
        *("slide", "tangential", "lost", "stuck")
    }
    assert remark in save(page, "curve.csv", tmp_path).read_text()
    let_go(page)
    settled(page, points=64, F=0.6)
    assert before.count() == 0
    assert max(image(page, "contact")) == max(stick) == 2
    assert remark not in save(page, "curve.csv", tmp_path).read_text()


def test_what_is_told_of_a_point_is_of_the_contact_that_is_drawn(opened):
    page = opened(SMALL, points=64)
    let_go(page)
    ((x, y),) = on_screen(page, "explore-contact", (0.4, 0.6))
    told, said = page.locator("#explore-contact .point"), []
    page.mouse.move(x, y)
    said.append(told.inner_text())
    typed(page, "F", "1")
    settled(page, points=64, F=1)
    said.append(told.inner_text())
    page.mouse.move(x + 1, y)
    page.mouse.move(x, y)
    said.append(told.inner_text())
    assert said[0] != said[1] == said[2]


def test_a_table_that_is_opened_again_has_the_rows_of_the_last_answer(opened):
    page = opened(SMALL, points=64)
    let_go(page)
    table(page, "contact")
    fold = page.locator("#explore-contact > details")
    typed(page, "F", "0.5")
    settled(page, points=64, F=0.5)
    rows = table(page, "contact")
    for is_open in (False, True):
        fold.evaluate(
            """(fold, isOpen) => new Promise((told) => {
                fold.addEventListener("toggle", told, {once: true});
                fold.open = isOpen;
            })""",
            is_open,
        )
    assert table(page, "contact") == rows


def test_of_two_answers_of_the_paper_the_newest_question_has_the_address(page, pages):
    page.goto(pages.address + "?view=published")
    page.wait_for_selector('[data-table="fit-3D"] tbody tr')
    place = on_screen(page, "published-trust-4", (0.01, 2.6))[0]
    page.evaluate("held = []")
    page.evaluate("document.querySelector('#published [data-key=mean][value=geometric]').click()")
    page.mouse.click(*place)
    came(page, "published.fits", "published.point")
    page.evaluate("release('published.point')")
    let_go(page)
    page.wait_for_function("() => location.search.includes('mean=geometric')")
    assert address(page)["roll_off"] == "4"


def test_a_file_that_is_forgotten_is_not_shown_by_an_answer_on_its_way(page, pages, tmp_path):
    surface = rl.SelfAffine(hurst=0.7, length=2e-4, rms_height=2e-7).surface(16, 3)
    rl.write(replace(surface, unit="m"), tmp_path / "few.nc")
    page.goto(pages.address + "?view=measured")
    page.wait_for_selector(CONNECTED)
    page.evaluate("held = []")
    page.set_input_files("#measured [data-file]", tmp_path / "few.nc")
    came(page, "measured.look")
    page.click("[data-forget-file]")
    let_go(page)
    page.locator('[data-note="file"]', has_text="are deleted").wait_for()
    assert not page.is_visible('[data-result="file"]')
    assert page.locator(READY).count() == 0


def test_a_page_on_which_something_fails_says_so(page, pages):
    page.goto(pages.address + SMALL)
    settled(page, points=64)
    assert not page.is_visible("#connection")
    with pages.expecting("on purpose"):
        page.evaluate("() => { setTimeout(() => { throw new Error('on purpose'); }); }")
        page.locator("#connection", has_text="load it again").wait_for()


@pytest.fixture(scope="module")
def two_tabs(pages):
    """Return two tabs of one browser, of which each has its own surface."""
    one = pages.open(SMALL)
    other = one.context.new_page()
    other.goto(pages.address + SMALL.replace("seed=3", "seed=4"))
    return one, other


def test_two_tabs_at_once_have_each_their_own(two_tabs):
    alone = []
    for page in two_tabs:
        settled(page, F=0.2)
        alone.append(strip(page)["stiffness_3d"])
    assert alone[0] != alone[1]
    for force in ("0.3", "0.5", "0.2"):
        for page in two_tabs:
            typed(page, "F", force)
    for page in two_tabs:
        settled(page, F=0.2)
    assert [strip(page)["stiffness_3d"] for page in two_tabs] == alone
    assert [address(page)["seed"] for page in two_tabs] == ["3", "4"]


def test_a_page_that_is_loaded_again_in_the_middle_of_a_press_goes_on(two_tabs):
    page, _ = two_tabs
    settled(page)
    typed(page, "D_f", "2.7")
    page.wait_for_function("() => location.search.includes('D_f=2.7')")
    page.reload()
    page.reload()  # before anything is drawn
    said = drawn(page, D_f=2.7)
    assert said["F"] == float(address(page)["F"])
    settled(page, D_f=2.7, points=64)
