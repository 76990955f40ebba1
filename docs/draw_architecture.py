"""Draw the rooms of roughline and count what changes open: `make architecture`.

The picture carries the facts that it was drawn from, so that a test can compare them with the code.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl
import numpy as np
from architecture import PICTURE, ROOT, Room, arrows, facts, figures, import_graph, layers, rooms
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch, Rectangle
from matplotlib.path import Path as Curve
from seams import FILE, PAGE, changes, written

# Where a room stands in its row.
PLACES = {
    "cli": 4.0,
    "lab": 6.0,
    "paper": 7.6,
    "report": 4.0,
    "assessment": 4.0,
    "margins": 4.0,
    "question": 4.0,
    "campaign": 7.2,
    "plot": 1.1,
    "comparison": 6.2,
    "ball": 1.1,
    "creep": 6.3,
    "engineering": 1.1,
    "theories": 7.9,
    "fluid": 6.6,
    "contact": 4.0,
    "halfspace": 3.1,
    "reduction": 4.9,
    "texture": 1.1,
    "measurement": 7.2,
    "statistics": 8.2,
    "spectra": 6.6,
    "topography": 4.0,
    "facts": 4.0,
    "computing": 3.1,
    "units": 4.9,
    "errors": 3.1,
    "exact": 7.6,
}
WIDTH, HEIGHT = 1.5, 0.5
GROUND = 3  # layers that all others build on, whose imports are not drawn
APART = 0.2  # between arrows that run side by side


@dataclass(frozen=True)
class Step:
    """What one room hands to another, and the room whose code hands it over."""

    giver: str
    taker: str
    by: str
    value: str = ""


ONE_BODY = (
    Step("spectra", "topography", "spectra", "Surface, Line"),
    Step("topography", "halfspace", "contact"),
    Step("topography", "reduction", "contact"),
    Step("halfspace", "contact", "contact"),
    Step("reduction", "contact", "contact"),
    Step("contact", "margins", "margins", "Curve"),
    Step("margins", "assessment", "assessment", "Spread"),
    Step("engineering", "assessment", "assessment", "Answer"),
    Step("question", "margins", "margins", "Case"),
    Step("assessment", "report", "report", "Assessment"),
    Step("report", "cli", "cli", "page, JSON"),
)
HUNDREDS = (
    Step("contact", "campaign", "campaign", "Curve"),
    Step("campaign", "paper", "paper", "Dataset"),
    Step("statistics", "paper", "paper", "PowerLaw"),
    Step("paper", "cli", "cli", "the study"),
)
ORANGE, BLUE, GREY = "#c2410c", "#1d4e89", "#b0b0ac"


@dataclass(frozen=True)
class Stroke:
    """An arrow to draw, between two rooms by name."""

    start: str
    end: str
    colour: str = GREY
    label: str = ""

    @property
    def ends(self) -> tuple[str, str]:
        """Both rooms."""
        return self.start, self.end


def strokes(found: dict[str, Room], ground: set[str]) -> list[Stroke]:
    """Return the arrows of the picture: imports that matter, then the walk.

    An import is left out where a detour over other rooms has it too, where the walk shows it, and
    where it leads to the ground floor.
    """
    shown = {
        (step.by, room) for step in (*ONE_BODY, *HUNDREDS) for room in (step.giver, step.taker)
    }
    imports = [
        Stroke(*pair)
        for pair in arrows(found)
        if pair[1] not in ground and pair not in shown and not _has_detour(*pair, found)
    ]
    one = [Stroke(step.giver, step.taker, ORANGE, step.value) for step in ONE_BODY]
    many = [Stroke(step.giver, step.taker, BLUE, step.value) for step in HUNDREDS]
    return [*imports, *many, *one]


def draw(path: Path) -> None:
    """Draw the rooms on their layers, and write the facts into the picture."""
    graph = import_graph()
    found, rows = rooms(graph), layers()
    if unplaced := set(found) - set(PLACES):
        sys.exit(f"PLACES in {Path(__file__).name} lacks {', '.join(sorted(unplaced))}")
    level = {name: len(rows) - 1 - i for i, row in enumerate(rows) for name in row}
    drawn = strokes(found, {name for name, height in level.items() if height < GROUND})
    with mpl.rc_context({"font.family": "DejaVu Sans", "svg.hashsalt": "roughline"}):
        figure = Figure(figsize=(9.6, 9.8))
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set(xlim=(-0.1, 9.5), ylim=(-1.1, len(rows) - 0.6))
        axes.axis("off")
        for height in range(GROUND, len(rows), 2):
            axes.axhspan(height - 0.5, height + 0.5, color="#f7f7f5", zorder=0)
        axes.add_patch(Rectangle((-0.1, -0.5), 9.6, GROUND, color="#ececea", zorder=0))
        for stroke, points in zip(drawn, _routes(drawn, level), strict=True):
            _arrow(axes, stroke, points)
        most = max(room.lines for room in found.values())
        for name, room in found.items():
            _box(axes, (PLACES[name], level[name]), name, room.lines, most)
        _legend(axes)
        described = json.dumps(facts(graph), indent=1)
        figure.savefig(path, metadata={"Date": None, "Creator": None, "Description": described})


def _has_detour(importer: str, imported: str, found: dict[str, Room]) -> bool:
    ahead = [other for other in found[importer].imports if other != imported]
    seen = {importer, *ahead}
    while ahead:
        below = set(found[ahead.pop()].imports) - seen
        seen |= below
        ahead += below
    return imported in seen


def _routes(drawn: list[Stroke], level: dict[str, int]) -> list[list[tuple[float, float]]]:
    """Return the points of each arrow: along a lane that is free of boxes and of other arrows."""
    lanes: list[tuple[float, range]] = []
    chosen = []
    for stroke in drawn:
        low, high = sorted(level[name] for name in stroke.ends)
        between = range(low + 1, high)
        boxes = [PLACES[name] for name, height in level.items() if height in between]
        taken = [x for x, rows in lanes if set(rows) & set(between)]
        lane = _free_lane([PLACES[name] for name in stroke.ends], boxes, taken) if between else None
        if lane is not None:
            lanes.append((lane, between))
        chosen.append(lane)
    ports = _ports(drawn, chosen, level)
    routes = []
    for i, (stroke, lane) in enumerate(zip(drawn, chosen, strict=True)):
        start, end = level[stroke.start], level[stroke.end]
        up = 1 if end > start else -1
        points = [(ports[i, 0], start + up * HEIGHT / 2)]
        if lane is not None:
            points += [(lane, start + up * (1 - HEIGHT / 2)), (lane, end - up * (1 - HEIGHT / 2))]
        routes.append([*points, (ports[i, 1], end - up * (HEIGHT / 2 + 0.03))])
    return routes


def _free_lane(ends: list[float], boxes: list[float], taken: list[float]) -> float:
    places = np.arange(0.0, 9.5, 0.05)
    for lane in taken:
        places = places[abs(places - lane) > APART - 0.01]
    room = np.min([abs(places - box) for box in boxes], axis=0) - WIDTH / 2
    way = np.sum([abs(places - end) for end in ends], axis=0) + 0.1 * abs(places - np.mean(ends))
    return float(places[np.argmin(np.where(room > 0.1, way - np.minimum(room, 0.4), np.inf))])


def _ports(
    drawn: list[Stroke], lanes: list[float | None], level: dict[str, int]
) -> dict[tuple[int, int], float]:
    """Return where arrows leave and reach their boxes, in the order of where they come from."""
    sides: dict[tuple[str, bool], list[tuple[float, int, int]]] = {}
    for i, (stroke, lane) in enumerate(zip(drawn, lanes, strict=True)):
        for end, (here, there) in enumerate((stroke.ends, stroke.ends[::-1])):
            aim = PLACES[there] if lane is None else lane
            sides.setdefault((here, level[there] > level[here]), []).append((aim, i, end))
    ports = {}
    for (room, _), coming in sides.items():
        apart = min(APART + 0.05, (WIDTH - 0.2) / len(coming))
        for place, (_, i, end) in enumerate(sorted(coming)):
            ports[i, end] = PLACES[room] + apart * (place - (len(coming) - 1) / 2)
    return ports


def _arrow(axes: Axes, stroke: Stroke, points: list[tuple[float, float]]) -> None:
    corners, codes = [points[0]], [Curve.MOVETO]
    for i, (x, y) in enumerate(points[1:]):
        from_x, from_y = corners[-1]
        if i % 2:  # along the lane
            corners, codes = [*corners, (x, y)], [*codes, Curve.LINETO]
        else:
            corners += [(from_x, (from_y + y) / 2), (x, (from_y + y) / 2), (x, y)]
            codes += [Curve.CURVE4] * 3
    walk = stroke.colour != GREY
    axes.add_patch(
        FancyArrowPatch(
            path=Curve(corners, codes),
            arrowstyle="-|>,head_length=4,head_width=2.4"
            if walk
            else "-|>,head_length=3,head_width=1.5",
            color=stroke.colour,
            linewidth=2.4 if walk else 0.9,
            zorder=2 if walk else 1,
        )
    )
    if stroke.label:
        (x, y), (to_x, to_y) = points[1:3] if len(points) == 4 else points
        axes.text(
            (x + to_x) / 2,
            (y + to_y) / 2,
            stroke.label,
            ha="center",
            va="center",
            fontsize=8.5,
            style="italic",
            color=stroke.colour,
            zorder=5,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.2, "alpha": 0.92},
        )


def _box(axes: Axes, centre: tuple[float, float], name: str, lines: int, most: int) -> None:
    x, y = centre[0] - WIDTH / 2, centre[1] - HEIGHT / 2
    outline = FancyBboxPatch(
        (x, y),
        WIDTH,
        HEIGHT,
        boxstyle="round,pad=0,rounding_size=0.07",
        facecolor="white",
        edgecolor="#3c3c3a",
        linewidth=1.0,
        zorder=3,
    )
    axes.add_patch(outline)
    bar = Rectangle((x, y), WIDTH * lines / most, 0.055, color="#8d8d88", zorder=3.5, linewidth=0)
    axes.add_patch(bar)
    bar.set_clip_path(outline)
    axes.text(*centre, name, ha="center", va="center", fontsize=11, weight="bold", zorder=4)


def _legend(axes: Axes) -> None:
    notes = {
        (0.0, 1.0): "Every room may stand\non the ground floor;\narrows to it are left out.",
        (8.5, 0.0): "judges both\nmodels in tests",
    }
    for place, note in notes.items():
        axes.text(*place, note, va="center", fontsize=8, color="#6b6b68", linespacing=1.4)
    axes.legend(
        [
            Line2D([], [], color=ORANGE, linewidth=2.4),
            Line2D([], [], color=BLUE, linewidth=2.4),
            Line2D([], [], color=GREY, linewidth=0.9),
            Rectangle((0, 0), 1, 1, color="#8d8d88"),
        ],
        ["one body", "hundreds of bodies", "imports", "lines of code"],
        loc="lower center",
        ncols=4,
        frameon=False,
        fontsize=9,
    )


if __name__ == "__main__":
    draw(PICTURE)
    print(figures())
    PAGE.write_text(written(PAGE.read_text("utf-8")), "utf-8")
    FILE.write_text(changes(), "utf-8")
    print(f"wrote {PICTURE.relative_to(ROOT)} and the counts of {PAGE.relative_to(ROOT)}")
