"""How soon the lab answers in a browser: ``make lab-benchmark`` writes its part of the handbook.

A headless Chromium opens the page of a fresh server and drags sliders with the mouse. A move counts
from the time stamp of the slider's event until the frame after Bokeh has painted the picture that
belongs to this very value. In long drags pictures are counted alone, as a frame more for each would
slow them. The machine should have nothing else to do.
"""

import argparse
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from page import Page, percentiles
from playwright.sync_api import sync_playwright

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from lab_in_browser import Pages, RunningLab, launched

SERVERS = 5
SURFACES = ((2.05, 1), (2.2, 7), (2.5, 3), (2.8, 4))  # fractal dimension and seed
MOVES = 12  # of each slider for each surface
DRAG, SWEEP, MOUSE = 4.0, 2.0, 1 / 125  # a long drag, from end to end, between moves of a mouse [s]
FEWEST_PICTURES = 20  # of the reduced curve in a second of a long drag
TARGETS = {  # [ms]
    "server started, page can be opened": 3000,
    "page opened, first contact drawn": 2000,
    "slider moved, reduced curve drawn": 60,
    "slider moved, contact on 128² points drawn": 120,
    "last move, contact on 512² points drawn": 2000,
    "last move, contact on 1024² points drawn": None,
}
RECORDER = """
window.recorder = {
  move: null, drawn: [], told: [], pictures: null,
  // Return how long after the last move its pictures were drawn [ms].
  async after(wanted) {
    for (const began = performance.now(); ; ) {
      if (performance.now() - began > 3e4) throw new Error(`not drawn: ${JSON.stringify(this)}`);
      const own = this.drawn.filter(({numbers}) => numbers[this.move.key] === this.move.value);
      const found = wanted.map((name) => own.find((each) => each.name === name));
      if (found.every((each) => each)) return found.map(({at}) => at - this.move.at);
      await new Promise((drawn) => { this.told.push(drawn); setTimeout(drawn, 1e3); });
    }
  },
};
addEventListener("input", ({target, timeStamp}) => {
  const {key} = target.dataset, value = Number(target.getAttribute("aria-valuetext"));
  Object.assign(recorder, {move: {key, value, at: timeStamp}, drawn: []});
});
addEventListener("drawn", ({target, detail: {what, points, numbers}}) => {
  if (what === "curve" || target.id === "plot-explore-topography") return;
  const name = points ? `${points}` : what;
  if (recorder.pictures) { recorder.pictures[name] = (recorder.pictures[name] ?? 0) + 1; return; }
  requestAnimationFrame(() => {
    recorder.drawn.push({name, numbers, at: performance.now()});
    recorder.told.splice(0).forEach((tell) => tell());
  });
});
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--short", action="store_true", help="a few moves only; write nothing")
    short = parser.parse_args().short
    surfaces, moves = (SURFACES[:1], 4) if short else (SURFACES, MOVES)
    times, rates = {name: [] for name in TARGETS}, {}
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = launched(playwright)
        for _ in range(1 if short else SERVERS):
            measure_start(browser, Path(folder) / "log", times)
        running = RunningLab(Path(folder) / "log")
        try:
            for points in (512, 1024):
                for dimension, seed in surfaces:
                    measure_moves(browser, running, times, moves, points, dimension, seed)
            for key in ("F", "D_f", "cutoff"):
                for points in (128, 512):
                    rates[key, points] = [
                        pictures_in_long_drag(browser, running, key, points, dimension, seed)
                        for dimension, seed in surfaces
                    ]
        finally:
            running.close()
        write(times, rates, browser.version, save=not short)
        browser.close()


def measure_start(browser, log, times):
    running = RunningLab(log)
    pages = Pages(browser, running.address)
    try:
        times["server started, page can be opened"].append(1e3 * running.seconds_to_open)
        page = opened(pages, "")
        first = page.wait_for_function("() => recorder.drawn.find(({name}) => name > 0)?.at")
        times["page opened, first contact drawn"].append(first.json_value())
    finally:
        pages.close()
        running.close()


def measure_moves(browser, running, times, moves, points, dimension, seed):
    """Time the moves of three sliders over one surface, going on and at rest."""
    pages = Pages(browser, running.address)
    page = opened(pages, f"?view=explore&v=1&D_f={dimension}&seed={seed}&n={points}&F=0.1")
    page.wait_for_selector("#plot-explore-area[data-shown]")
    for key, at_rest in (("F", False), ("D_f", False), ("cutoff", False), ("F", True)):
        if points > 512 and not at_rest:
            continue
        for _ in drag(page, key, moves):
            line, coarse = page.evaluate("() => recorder.after(['line', '128'])")
            if points == 512:
                times["slider moved, reduced curve drawn"].append(line)
                times["slider moved, contact on 128² points drawn"].append(coarse)
            if at_rest:
                times[f"last move, contact on {points}² points drawn"] += page.evaluate(
                    f"() => recorder.after(['{points}'])"
                )
    assert not pages.complaints, pages.complaints
    pages.close()


def pictures_in_long_drag(browser, running, key, points, dimension, seed):
    """Drag a slider to and fro for seconds: pictures of the line and of 128² in a second.

    And how long the main thread of the page works for one of 128². [ms]
    """
    pages = Pages(browser, running.address)
    page = opened(pages, f"?view=explore&v=1&D_f={dimension}&seed={seed}&n={points}&F=0.1")
    page.wait_for_selector("#plot-explore-area[data-shown]")
    slider = page.locator(f'#explore input[type="range"][data-key="{key}"]')
    box = slider.bounding_box()
    y, inner = box["y"] + box["height"] / 2, 10
    page.mouse.move(box["x"] + inner, y)
    page.mouse.down()
    page.evaluate("() => { recorder.pictures = {}; }")
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    worked = -seconds_of_work(session)
    began = time.perf_counter()
    while (now := time.perf_counter() - began) < DRAG:
        share = abs((now / SWEEP) % 2 - 1)
        page.mouse.move(box["x"] + inner + share * (box["width"] - 2 * inner), y)
        time.sleep(max(0.0, began + now + MOUSE - time.perf_counter()))
    counts = page.evaluate("() => recorder.pictures")
    worked += seconds_of_work(session)
    page.mouse.up()
    assert not pages.complaints, pages.complaints
    pages.close()
    rates = [counts.get(name, 0) / now for name in ("line", "128")]
    return [*rates, 1e3 * worked / max(counts.get("128", 0), 1)]


def seconds_of_work(session):
    """How long the main thread of a page has worked until now. [s]"""
    metrics = session.send("Performance.getMetrics")["metrics"]
    return next(each["value"] for each in metrics if each["name"] == "TaskDuration")


def opened(pages, query):
    """Open a page that records what it draws, and wait for its first contact."""
    page = pages.blank()
    page.add_init_script(RECORDER)
    page.goto(pages.address + query)
    page.wait_for_selector("#plot-explore-contact[data-shown]")
    return page


def drag(page, key, moves):
    """Drag a slider along its whole length; yields after every move."""
    slider = page.locator(f'#explore input[type="range"][data-key="{key}"]')
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    y = box["y"] + box["height"] / 2
    inner = 10  # the middle of the knob does not reach the ends [pixels]
    page.mouse.move(box["x"] + inner, y)
    page.mouse.down()
    page.evaluate("() => recorder.after(['line', '128'])")
    for share in np.linspace(0, 1, moves + 1)[1:]:
        page.mouse.move(box["x"] + inner + share * (box["width"] - 2 * inner), y)
        yield
    page.mouse.up()
    time.sleep(0.5)


def write(times, rates, browser, save):
    """Write the medians and percentiles, or print them alone."""
    page = Page("lab", "measured.md", "lab-benchmark")
    page.say(f"Headless Chromium {browser} without a graphics card, on the same machine.")
    measures = ("median", "95th percentile", "longest", "measured", "wanted (median)")
    page.table("from, to", *measures)
    for name, target in TARGETS.items():
        parts = (shown(part) for part in percentiles(times[name]))
        page.row(name, *parts, len(times[name]), shown(target))
    page.heading("Long drags")
    page.say(
        f"{DRAG:g} s from end to end and back with a mouse that moves every "
        f"{1e3 * MOUSE:.0f} ms; pictures per second, of all surfaces:"
    )
    columns = ("reduced curve: least, median", "contact on 128²", "work for one", "wanted")
    page.table("slider, full grid", *columns, at_most=3)
    for (key, points), found in rates.items():
        lines, contacts, work = (sorted(column) for column in zip(*found, strict=True))
        page.row(
            f"{key}, {points}²",
            f"{lines[0]:.0f}, {np.median(lines):.0f}",
            f"{contacts[0]:.0f}, {np.median(contacts):.0f}",
            shown(np.median(work)),
            f"{FEWEST_PICTURES} of the curve" if points == 128 else "-",
        )
    page.say(
        "Work is that of the page's main thread, as processor time, for each picture of 128². "
        "A move counts from the event of the slider until the frame in which the picture of this "
        "value is on the screen. Sliders are dragged with the mouse over the loads, fractal "
        f"dimensions and cutoffs of {len(SURFACES)} surfaces; the times of 512² and 1024² points "
        "hold the 250 ms without a move after which a slider counts as at rest."
    )
    if save:
        page.save()


def shown(milliseconds):
    if milliseconds is None:
        return "-"
    return f"{milliseconds:.0f} ms" if milliseconds < 1000 else f"{milliseconds / 1e3:.2f} s"


if __name__ == "__main__":
    main()
