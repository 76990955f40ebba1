"""A page beside another tab, loaded again in the middle, moved faster than it is answered."""

import pytest

from lab.explore_driven import SMALL, address, drawn, settled, strip, typed

# Answers are kept back while `held` is a list, by the numbers of their questions, until they are
# released.
HELD = """
window.held = null, window.newest = 0, window.told = [];
window.release = () => held.splice(0).forEach(([, go]) => go());
window.WebSocket = class extends WebSocket {
    set onmessage(act) {
        super.onmessage = (event) => {
            const isKept = held && event.data instanceof ArrayBuffer;
            if (!isKept) { act(event); return; }
            held.push([Number(new DataView(event.data).getBigUint64(0, true)), () => act(event)]);
        };
    }
    send(data) {
        const {id, task} = JSON.parse(data);
        if (task === "explore.coarse") newest = id;
        super.send(data);
    }
};
addEventListener("drawn", ({target, detail: {what, numbers}}) => {
    if (target.id === "plot-explore-contact" && what === "contact") told.push(numbers.F);
});
"""


def test_a_slider_that_moves_faster_than_answers_come_is_followed(pages):
    page = pages.blank()
    page.add_init_script(HELD)
    page.goto(pages.address + SMALL)
    settled(page, points=64)
    page.evaluate("held = []")
    for force in ("0.3", "0.4", "0.5"):
        typed(page, "F", force)
        page.wait_for_function("() => held.some(([id]) => id === newest)")
    page.evaluate("told = [], release(), held = null")
    settled(page, F=0.5)
    assert page.evaluate("told")[:3] == [0.3, 0.4, 0.5]


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
