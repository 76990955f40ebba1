"""Controls of Explore and The paper as a person sets them: dragged, typed, refused, returned."""

import re

import pytest

from lab.explore_driven import address, drawn, sentence, settled, typed
from lab.measured_driven import READY, answers, fill
from roughline.lab.explore import physics
from roughline.lab.published import controls as published

POINTS = 128  # 64 carry no waves between the shortest roll-off and the cutoff
OPENED = f"?view=explore&v=1&D_f=2.4&seed=3&n={POINTS}"
SLIDERS = ("D_f", "roll_off", "cutoff", "h", "F")

SAID_AT_EVERY_STEP = """async (view) => {
  const {Controls} = await import("/lab/controls.js");
  const root = document.querySelector(view).cloneNode(true), said = {};
  document.body.append(root);
  const controls = new Controls(root, (key) => { (said[key] ??= []).push(controls.said[key]); });
  for (const slider of root.querySelectorAll('input[type="range"]')) {
    const [low, high, step] = [slider.min, slider.max, slider.step].map(Number);
    for (let value = low; value < high + step / 2; value += step) {
      slider.value = value;
      slider.dispatchEvent(new Event("input"));
    }
  }
  root.remove();
  return said;
}"""


@pytest.fixture(scope="module")
def page_of_explore(pages):
    page = pages.open(OPENED)
    settled(page, points=POINTS)
    return page


def complaints(page, view="explore"):
    """Return the red sentences that are seen."""
    return [text for text in page.locator(f"#{view} .error:visible").all_inner_texts() if text]


def assert_beside(page, view, key, value):
    """Wait until the text beside a slider is a value, in three digits."""
    page.wait_for_function(
        "([text, value]) => Math.abs(document.querySelector(text).value - value) <= 5e-3 * value",
        arg=[f"#{view}-{key}-text", value],
    )


def test_every_text_that_a_slider_writes_is_read(page_of_explore):
    for view, known in {"explore": physics.numbers(), "published": published.NUMBERS}.items():
        for key, texts in page_of_explore.evaluate(SAID_AT_EVERY_STEP, f"#{view}").items():
            control = known[key]
            numbers = [control.read(text) for text in texts]
            assert numbers[0] == control.low
            assert numbers[-1] == control.high
            assert control.default in numbers
            assert numbers == sorted(set(numbers))


def test_fields_show_three_digits_and_keep_what_is_typed(page_of_explore):
    page = page_of_explore
    shown = {"D_f": "2.40", "roll_off": "1.00", "cutoff": "0.0156", "h": "0.00100", "F": "0.100"}
    for key, text in {**shown, "seed": "3"}.items():
        assert page.input_value(f"#explore-{key}-text") == text
    typed(page, "F", "0.2")
    drawn(page, F=0.2)
    assert page.input_value("#explore-F-text") == "0.2"
    page.locator("#explore-F").press("ArrowRight")
    drawn(page, F=0.209)
    assert page.input_value("#explore-F-text") == "0.209"
    page.locator("#explore-F").press("ArrowLeft")
    drawn(page, F=0.2)
    assert page.input_value("#explore-F-text") == "0.200"
    page.wait_for_function("() => new URLSearchParams(location.search).get('F') === '0.2'")
    page.locator("#explore-F").dblclick()
    drawn(page, F=0.1)


def grasped(page, slider):
    """Press the mouse on a slider where it stands; return its box and the middle of its height.

    An answer on its way may move it away from the mouse, which is then pressed again.
    """
    for _ in range(20):
        slider.hover()  # once it stands still
        box = slider.bounding_box()
        low, high, value = slider.evaluate("({min, max, value}) => [min, max, value].map(Number)")
        middle = box["y"] + box["height"] / 2
        at = box["x"] + 8 + (box["width"] - 16) * (value - low) / (high - low)
        page.mouse.move(at, middle)
        page.mouse.down()
        if slider.evaluate("(each) => each.matches(':active')"):
            return box, middle
        page.mouse.up()
    raise AssertionError(f"{slider} never stood still")


def dragged(page, slider, share):
    """Drag a slider with the mouse from where it stands beyond one of its ends."""
    box, middle = grasped(page, slider)
    page.mouse.move(box["x"] + box["width"] * (0.4 + 0.2 * share), middle)
    page.mouse.move(box["x"] + (box["width"] + 30) * share - 15 * (1 - share), middle)
    page.mouse.up()


@pytest.mark.parametrize("key", [*SLIDERS, "slope", "hardness_bar"])
def test_every_slider_of_explore_reaches_both_ends_and_its_default(page_of_explore, key):
    page, control = page_of_explore, physics.numbers()[key]
    rms = "height" if key in SLIDERS else "slope"
    page.check(f'#explore [data-key="rms"][value="{rms}"]')
    page.set_checked("#explore-adds-hardness_bar", rms == "slope")
    slider = page.locator(f"#explore-{key}")
    low = 2 / POINTS if key == "cutoff" else control.low  # the grid carries no shorter waves
    default = max(control.default, low)
    for share, end in ((0, low), (1, control.high)):
        dragged(page, slider, share)
        drawn(page, **{key: end})
        assert complaints(page) == []
        assert_beside(page, "explore", key, end)
    slider.dblclick()
    drawn(page, **{key: default})
    for press, end in (("End", control.high), ("Home", low)):
        slider.press(press)
        drawn(page, **{key: end})
    page.locator(f'#explore [data-control="{key}"] label').dblclick()
    said = drawn(page, **{key: default})
    assert said[key] == default
    assert complaints(page) == []
    settled(page, points=POINTS)
    if rms == "height":  # what is at its default needs no place in the address
        assert set(address(page)) <= {"view", "v", "D_f", "seed", "n", "F"}


def test_walk_over_controls_of_which_some_are_refused(page_of_explore, pages):
    page = page_of_explore
    page.goto(pages.address + OPENED)
    settled(page, points=POINTS)
    wrong = {"D_f": "H = 7", "roll_off": "wide", "cutoff": "1,5", "h": "3 GPa", "seed": "<b>1</b>"}
    wrong |= {"L": "3", "E": "-1 GPa", "F": "😀" * 20}
    for key, text in wrong.items():
        typed(page, key, text)
    for key, text in wrong.items():
        sentence(page, key).filter(has_text="is used meanwhile").wait_for()
        assert len(sentence(page, key).inner_text().splitlines()) == 1
        assert page.input_value(f"#explore-{key}-text") == text
        assert page.get_attribute(f"#explore-{key}-text", "aria-invalid") == "true"
    typed(page, "D_f", "2.6")
    drawn(page, D_f=2.6, F=0.1, cutoff=2 / POINTS)
    assert address(page)["D_f"] == "2.6"
    assert len(complaints(page)) == len(wrong) - 1
    for key, text in {"h": "1e-6", "F": "0.3", "roll_off": "0.125", "cutoff": "0.2"}.items():
        typed(page, key, text)
    sentence(page, "cutoff").filter(has_text="is not shorter than the roll-off").wait_for()
    assert sentence(page, "roll_off").inner_text() == ""
    drawn(page, F=0.3, h=1e-6, roll_off=0.125)
    typed(page, "roll_off", "0.5")  # now the cutoff goes with it
    drawn(page, cutoff=0.2, roll_off=0.5)
    assert {key for key in wrong if sentence(page, key).inner_text()} == {"seed", "L", "E"}


@pytest.mark.parametrize(
    ("link", "control", "default"),
    [
        ("view=explore&v=1&colour=red&L=5+mm", "L", "1 mm"),
        ("view=published&v=9&tolerance=0.2", "tolerance", "0.100"),
        ("view=measured&v=7&first=gold", "first", "steel"),
    ],
)
def test_a_link_that_cannot_be_read_is_refused_in_one_sentence(tab, link, control, default):
    page, view = tab(f"?{link}"), re.search("view=(.*?)&", link)[1]
    refused = sentence(page, "", view).filter(has_text="set the controls by hand")
    refused.wait_for()
    assert page.input_value(f"#{view}-{control}-text") == default
    if view == "explore":
        drawn(page, D_f=2.2)
        assert refused.is_visible()
        page.check('#explore [data-key="n"][value="64"]')
        settled(page, points=64)
        assert not refused.is_visible()
    else:
        assert refused.is_visible()


@pytest.fixture(scope="module")
def page_of_the_paper(pages):
    """Return a page of the view, whose address has a text that cannot be used."""
    page = pages.open("?view=published&tolerance=abc")
    page.wait_for_selector('[data-table="fit-3D"] tbody tr')
    return page


def test_texts_of_the_paper_are_refused_and_mended(page_of_the_paper):
    page = page_of_the_paper
    sentence(page, "tolerance", "published").filter(has_text="0.1 is used meanwhile").wait_for()
    typed(page, "tolerance", "0.2", view="published")
    page.wait_for_selector('#published [data-error="tolerance"]:empty', state="attached")
    typed(page, "low_3D", "9", view="published")
    sentence(page, "low_3D", "published").filter(has_text="0.01 is used").wait_for()
    page.locator('#published [data-words="error-3D"]:not(:empty)').wait_for()
    assert complaints(page, "published") == [
        page.inner_text('#published [data-error="low_3D"]'),
        page.inner_text('#published [data-words="error-3D"]'),
    ]
    page.click("#published-windows")  # all four edges as they were
    page.wait_for_function("() => !document.querySelector('#published .error:not(:empty)')")


EDGES = {
    edge.key: share for window in published.WINDOWS.values() for share, edge in enumerate(window)
}


@pytest.mark.parametrize("key", ["tolerance", "map_D_f", "map_F", *EDGES])
def test_sliders_of_the_paper_reach_both_ends_and_are_refused_beyond_the_other_edge(
    page_of_the_paper, key
):
    page, control = page_of_the_paper, published.NUMBERS[key]
    point, slider = page.locator("[data-words=point]"), page.locator(f"#published-{key}")
    beyond = (control.high, control.low)[EDGES.get(key, 0)]
    for move, end in (
        (lambda: dragged(page, slider, 0), control.low),
        (lambda: dragged(page, slider, 1), control.high),
        (lambda: slider.press("Home"), control.low),
    ):
        before = point.inner_text()
        move()
        assert_beside(page, "published", key, end)
        page.wait_for_function(
            """([key, isEdge, isBeyond, before]) => {
                const find = (selector) => document.querySelector(`#published ${selector}`);
                return isEdge
                    ? isBeyond === find(`[data-error=${key}]`).textContent.includes("meanwhile")
                    : find("[data-words=point]").innerText !== before;
            }""",
            arg=[key, key in EDGES, end == beyond, before],
        )
    slider.dblclick()
    assert float(page.input_value(f"#published-{key}-text")) == control.default
    # but for the text of the address, which another test mends
    others = "#published .error:not(:empty, [data-error=tolerance])"
    page.wait_for_function(f"() => !document.querySelector('{others}')")


WRONG = {"crop": "1 m", "second": "3 GPa", "loads": "1,5", "low_pass": "1 km", "resample": "100000"}
WRONG |= {"most_missing": "<b>x</b>", "blur": "-1 um", "tip_radius": "2", "joint_area": "1 nm^2"}
WRONG |= {"hardness": "😀", "friction": "30", "frequency": "nan"}


@pytest.mark.parametrize("keys", [list(WRONG)[:3], list(WRONG)], ids=["few", "all"])
def test_refused_controls_of_my_surface_leave_the_others_alive(pages, rough, keys):
    page = pages.open("?view=measured")
    page.set_input_files("#measured [data-file]", rough)
    page.click(READY, trial=True)

    wrong = {key: WRONG[key] for key in keys}
    fill(page, **wrong)
    for key, text in wrong.items():
        sentence(page, key, "measured").filter(has_text="is used meanwhile").wait_for()
        assert page.input_value(f"#measured-{key}-text") == text
        assert page.get_attribute(f"#measured-{key}-text", "aria-invalid") == "true"
    fill(page, first="gold")
    page.locator('[data-table="measured-bodies"]', has_text="gold").wait_for()
    page.check('#measured [data-key="trend"][value="curvature"]')
    page.locator('[data-list="prepared-remarks"]', has_text="curvature").wait_for()
    page.check('#measured [data-key="pixels"][value="points"]')
    page.click("[data-press]")
    sentence(page, "answers", "measured").filter(has_text="3 GPa").wait_for()
    assert len(complaints(page, "measured")) == len(wrong) + 1
    mended = {"second": "copper", "loads": "2 MPa", "resample": "32"}
    fill(page, **{key: mended.get(key, "") for key in wrong})
    page.wait_for_function("() => !document.querySelector('#measured .error:not(:empty)')")
    page.click("[data-press]")
    assert answers(page)
    page.context.close()
