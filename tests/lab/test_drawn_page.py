"""What is drawn is what is held: after any moves a page is drawn as one that begins so."""

import pytest

from lab.explore_driven import SMALL, settled

# Points of each series: those that its source holds, column by column, and those that are drawn.
DRAWN = """() => Object.fromEntries(
    Bokeh.documents.flatMap((made) => made.roots()).flatMap((root) =>
    root.renderers.map((renderer) => {
        const {name, data} = renderer.data_source, {glyph} = Bokeh.index.find_one(renderer) ?? {};
        const held = Object.values(data).map((column) => column.length);
        return [`${root.name}: ${name}, ${renderer.glyph.type}`, [held, glyph?.data_size ?? null]];
    })))"""

# Moves by a seed, of those that add a series, take one away or make another surface.
MOVES = """async ([count, seed]) => {
    const find = (selector) => document.querySelector(`#explore ${selector}`);
    const all = (selector) => [...document.querySelectorAll(`#explore ${selector}`)];
    let last = seed;
    const below = (n) => { last = (last * 48271) % 2147483647; return last % n; };
    const one = (some) => some[below(some.length)];
    const write = (key, text) => {
        const field = find(`[data-text="${key}"]`);
        field.value = text;
        field.dispatchEvent(new Event("change", {bubbles: true}));
    };
    const moves = [
        () => one(all("[data-tick]")).click(),
        () => one(all("[data-tick]")).click(),
        () => one(all('[data-key="theories"]')).click(),
        () => one(all('[data-key="boundary"]')).click(),
        () => write("F", one(["0.05", "0.2", "1"])),
        () => write("seed", one(["3", "4"])),
    ];
    for (let i = 0; i < count; i++) {
        one(moves)();
        await new Promise((done) => setTimeout(done, one([0, 20, 300])));
    }
}"""


def drawn_of(page):
    """Return points drawn by series; what is held by a source must all be drawn."""
    found = page.evaluate(DRAWN)
    assert {name: held for name, (held, _) in found.items() if len(set(held)) > 1} == {}
    unlike = {name: (held[0], drawn) for name, (held, drawn) in found.items() if drawn != held[0]}
    assert unlike == {}
    return {name: drawn for name, (_, drawn) in found.items()}


@pytest.mark.parametrize(("moves", "seed"), [(12, 5), (200, 7)])
def test_after_any_moves_all_that_is_held_is_drawn(pages, moves, seed):
    page = pages.open(SMALL)
    settled(page, points=64)
    page.evaluate(MOVES, [moves, seed])
    settled(page, points=64)
    link = page.evaluate(
        "() => new Promise((done) => setTimeout(() => done(location.search), 400))"
    )
    other = pages.open(link)
    settled(other, points=64)
    assert drawn_of(page) == drawn_of(other)
    page.context.close()
    other.context.close()


@pytest.mark.parametrize("key", ["w", "hardness_bar", "fluid", "t"])
def test_what_was_taken_away_comes_back(fresh, key):
    page = fresh
    page.check(f"#explore-adds-{key}")
    settled(page, points=64)
    added = drawn_of(page)
    page.uncheck(f"#explore-adds-{key}")
    settled(page, points=64)
    page.check(f"#explore-adds-{key}")
    settled(page, points=64)
    assert drawn_of(page) == added


def test_a_line_is_drawn_again_after_a_map(tab):
    page = tab("?view=measured")

    def shown(example):
        page.click(f'[data-example="{example}"]')
        page.wait_for_selector("#measured-step-file:not(.dimmed)")
        page.wait_for_selector("#measured .cancel", state="hidden")
        drawn = drawn_of(page)
        panels = ("measured-file-line", "measured-spectrum")
        return {name: count for name, count in drawn.items() if name.startswith(panels)}

    line, surface = (shown(each) for each in ("shaft", "film"))
    assert [shown("shaft"), shown("film")] == [line, surface]
