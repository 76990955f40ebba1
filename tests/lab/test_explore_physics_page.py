"""Each physics of Explore, ticked, dragged, refused, linked and taken away as a person would."""

from dataclasses import dataclass
from urllib.parse import urlencode

import numpy as np
import pytest

from lab.drawn_plots import held, image, source
from lab.explore_asked import LAW, SCALE, STICKS
from lab.explore_driven import (
    SMALL,
    address,
    assert_link_shows_the_same,
    drawn,
    put,
    save,
    sentence,
    settled,
    strip,
    table,
    typed,
)
from lab.looks import texts_stand_out
from roughline import press
from roughline.lab.explore.reading import read_state

WITHOUT = "?" + urlencode({"view": "explore", "v": "1", **STICKS, "w": ""})
WITH = WITHOUT.replace("w=&", "w=1&")


@dataclass(frozen=True)
class Added:
    """What a tick adds to a page: a panel, figures of the strip, a map, with these marks."""

    tick: str
    panel: str
    strip: set[str]
    rows: set[str]
    map: str
    link: str = SMALL
    cursor: tuple[str, float, float] | None = None  # its control, where it is, and is dragged to


PHYSICS = [
    Added(
        tick="mu",
        panel="loop",
        strip={"slide", "tangential", "lost", "stuck"},
        rows={"from no shear", "a cycle"},
        map="stick",
        cursor=("Q", 0.15, 0.1),
    ),
    Added(
        tick="w",
        panel="cycle",
        strip={"retreat", "pull_off", "pulling", "zone"},
        rows={"there", "back"},
        map="retreat",
        link=WITHOUT,
        cursor=("F", 0.08, 0.04),
    ),
    Added(
        tick="fluid",
        panel="aperture",
        strip={"aperture", "channel"},
        rows={"3D", "critical junction", "Bruggeman"},
        map="flux",
    ),
]
KINDS = pytest.mark.parametrize("added", PHYSICS, ids=[each.panel for each in PHYSICS])


def at_rest(page, tick, panel, **wanted):
    """Wait until everything at rest is drawn, with what a physics adds."""
    settled(page, **wanted)
    drawn(page, panel, what=tick)
    page.wait_for_selector("#explore .cancel", state="hidden")


def show(page, shown):
    page.select_option('#explore [data-key="shown"]', shown)


@KINDS
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_walk_over_a_physics_which_is_ticked_linked_and_taken_away(pages, added, theme, tmp_path):
    page, tick, panel = pages.open(added.link, theme=theme), added.tick, added.panel
    settled(page, points=64)
    before = strip(page)
    page.focus("#tab-spectrum")
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => document.activeElement.id") == "tab-area"  # there is no other
    assert not page.is_visible(f"#tab-{panel}")
    page.focus(f"#explore-adds-{tick}")
    page.keyboard.press("Space")
    at_rest(page, tick, panel, points=64)
    page.focus("#tab-spectrum")
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => document.activeElement.id") == f"tab-{panel}"
    said = strip(page)
    assert said.keys() - before.keys() == added.strip
    assert tick in address(page)
    assert {row[-1] for row in table(page, panel)} >= added.rows
    show(page, added.map)
    texts_stand_out(page, "explore")
    if theme == "dark":
        save(page, "curve.png", tmp_path)
        other = assert_link_shows_the_same(page, pages, at_rest, tick=tick, panel=panel, points=64)
        assert table(other, panel) == table(page, panel)
        assert other.is_checked(f"#explore-adds-{tick}")
        assert other.is_visible(f"#plot-explore-{panel}")
        other.context.close()
    page.uncheck(f"#explore-adds-{tick}")
    settled(page, points=64)
    page.wait_for_function(f"() => !document.querySelector('[data-answer={min(added.strip)}]')")
    assert strip(page) == before
    assert not page.is_visible(f"#tab-{panel}")
    assert page.is_visible("#plot-explore-area")
    assert page.input_value('#explore [data-key="shown"]') == "area"
    assert set(image(page, "contact")) == {0, 1}
    assert source(page, "contact rings") == [[], []]
    assert page.inner_text(f'[data-remarks="{panel}"]') == ""
    assert tick not in address(page)
    page.context.close()


@pytest.mark.parametrize("added", [each for each in PHYSICS if each.cursor])
def test_the_line_of_a_panel_stands_at_its_control_and_can_be_dragged(tab, added):
    page = tab(added.link)
    page.check(f"#explore-adds-{added.tick}")
    key, at, to = added.cursor
    cursor = f"{added.panel} cursor"
    at_rest(page, added.tick, added.panel, points=64)
    assert held(page, cursor, "location") == [pytest.approx(at)]
    assert source(page, f"{added.panel} here")[1][0] == pytest.approx(at)
    put(page, cursor, location=to)
    at_rest(page, added.tick, added.panel, **{key: to})
    page.wait_for_function(
        """([name, to]) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            return Math.abs(made.get_model_by_name(name).data.y[0] - to) < 1e-9;
        }""",
        arg=[f"{added.panel} here", to],
    )


def test_the_loop_is_closed_and_what_sticks_has_its_marks(tab):
    page = tab(SMALL + "&mu=0.3")
    at_rest(page, "mu", "loop", points=64)
    slides, shares = (np.array(each) for each in source(page, "loop loop"))
    assert (shares.min(), shares.max()) == pytest.approx((-0.15, 0.15))
    assert slides[0] == pytest.approx(slides[-1], rel=1e-4)  # 16 loads, each solved to 1e-6
    show(page, "stick")
    assert set(image(page, "contact")) == {0, 1, 2}
    typed(page, "Q", "0.4")
    refused = sentence(page, "Q").filter(has_text="under which the bodies slide")
    refused.filter(has_text="0.15 is used meanwhile").wait_for()
    typed(page, "mu", "0.5")  # now the shear goes with it
    at_rest(page, "mu", "loop", points=64, mu=0.5, Q=0.4)
    assert sentence(page, "Q").inner_text() == ""


def test_both_ways_are_shown_with_the_pull_and_what_cannot_be_is_refused_at_its_tick(tab):
    page = tab(WITH)
    at_rest(page, "w", "cycle", points=64)
    depths, forces = source(page, "cycle here")
    assert depths[0] < depths[1]
    assert forces == pytest.approx([0.08, 0.08])
    [_], [pull] = source(page, "cycle pull-off")
    assert pull == pytest.approx(min(source(page, "cycle back")[1]), rel=0.1)
    assert float(strip(page)["pull_off"][0]) == pytest.approx(pull, rel=0.01)
    assert set(image(page, "contact")) == {0, 1, 2}
    show(page, "retreat")
    wider = np.count_nonzero(np.array(image(page, "contact")) == 1)
    asked = {"law": LAW, "forces": [0.08 * SCALE], "fields": True}
    there = press(read_state(STICKS).surface(64), E_star=110e9, **asked)
    assert wider > there.fields[0].contact.sum()
    page.check("#explore-adds-hardness_bar")
    sentence(page, "hardness_bar").filter(has_text="stick and yield").wait_for()
    page.uncheck("#explore-adds-hardness_bar")
    at_rest(page, "w", "cycle", points=64)
    assert sentence(page, "hardness_bar").inner_text() == ""
    assert "pull_off" in strip(page)


def test_sealed_loads_stand_at_the_foot(tab):
    page = tab(SMALL + "&fluid=x&shown=flux")
    typed(page, "F", "9")
    at_rest(page, "fluid", "aperture", points=64, F=9)
    assert strip(page)["aperture"][0] == "sealed"
    assert "sealed" in page.inner_text('[data-caption="shown"]')
    assert "seals between F̄ = " in page.inner_text('[data-caption="aperture"]')
    assert "Bruggeman" in page.inner_text('[data-remarks="aperture"]')
    start, end = held(page, "explore-aperture", "y_range.start", "y_range.end")
    _, feet = source(page, "aperture sealed")
    [force], [here] = source(page, "aperture here")
    assert force == pytest.approx(9)
    assert {here, *feet} == {here}
    assert start < here < start * (end / start) ** 0.1
    assert min(source(page, "aperture curve")[1]) > here
    assert [row for row in table(page, "aperture") if row[1] == "sealed" and row[2] == "3D"]
