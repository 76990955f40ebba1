"""Draw the figures of what is measured from its data: ``make measured-figures``."""

import csv
import re
from pathlib import Path

from matplotlib.figure import Figure

from roughline.plot.style import MARKERS, PAGE, colours, ink, new_figure, save, styled

DOCS = Path(__file__).parent
NAMES = {
    ("the-grid", "k"): "the grid, stiffness",
    ("the-grid", "A"): "the grid, area",
    ("the-larger-surface-behind-one-map", "interface_stiffness"): "the surface behind one map",
    ("a-part-from-several-maps", "interface_stiffness of 5 maps"): "a part, five maps",
    ("a-line-scan", "k of a scan"): "a line scan",
}


def main() -> None:
    """Draw all of them."""
    folder = DOCS / "figures" / "measured"
    folder.mkdir(parents=True, exist_ok=True)
    with styled():
        for name, figure in (("peers", peers()), ("memory", memory()), ("intervals", intervals())):
            _, pdf = save(figure, folder, name)
            pdf.unlink()


def rows(file: str) -> list[dict[str, str]]:
    """Return the rows of a file of data."""
    with (DOCS / "data" / f"{file}.csv").open(encoding="utf-8") as opened:
        return list(csv.DictReader(opened))


def number(cell: str) -> float:
    """Return the first number of a cell."""
    found = re.search(r"[\d.]+", cell)
    if found is None:
        raise ValueError(f"{cell!r} holds no number")
    return float(found[0])


def seconds(cell: str) -> float | None:
    """Return a time [s], or none where a program was not run."""
    if "–" in cell:
        return None
    return number(cell) * (1e-3 if " ms" in cell else 1.0)


def peers() -> Figure:
    """Times of one cold load over the grid."""
    figure = new_figure(PAGE, 3.0)
    axes = figure.add_subplot()
    files = ("small-peers/one-cold-load-on-a-small-grid", "peers/one-cold-load")
    found = [row for file in files for row in rows(file) if row["H"] == "0.8"]
    programs = ("roughline", "ASPHER", "Tamaas", "ContactMechanics")
    for i, (name, colour) in enumerate(zip(programs, colours(len(programs)), strict=True)):
        times = [(int(number(row["grid"])), seconds(row[name])) for row in found]
        known = [(n * 1.06 ** (i - 1.5), time) for n, time in times if time is not None]
        axes.plot(*zip(*known, strict=True), MARKERS[i], color=colour, label=name)
    grids = sorted({int(number(row["grid"])) for row in found})
    axes.set(xscale="log", yscale="log", xlabel="points along a side", ylabel="one cold load [s]")
    axes.set_xticks(grids, map(str, grids))
    axes.minorticks_off()
    axes.legend(loc="upper left")
    return figure


def memory() -> Figure:
    """Bytes a point over the contact, measured and estimated."""
    figure = new_figure(PAGE, 2.8)
    axes = figure.add_subplot()
    for i, (name, colour) in enumerate(zip(("free", "periodic"), colours(2), strict=True)):
        found = [row for row in rows("memory") if row["half-space"] == name]
        share = [number(row["in contact"]) for row in found]
        for column, look in (("bytes a point", "full"), ("estimated", "none")):
            axes.plot(
                share,
                [number(row[column]) for row in found],
                MARKERS[i],
                color=colour,
                fillstyle=look,
                label=f"{name}, {'measured' if look == 'full' else 'estimated'}",
            )
    axes.set(xlabel="largest share in contact [%]", ylabel="bytes a point", ylim=(0, None))
    axes.legend(ncols=2)
    return figure


def intervals() -> Figure:
    """Shares of intervals that hold, by kind of surface."""
    figure = new_figure(PAGE, 3.6)
    axes = figure.add_subplot()
    kinds = [
        row["surfaces"]
        for row in rows("intervals/the-larger-surface-behind-one-map")
        if row["quantity"] == "interface_stiffness" and row["surfaces"] != "all"
    ]
    shades = colours(len(NAMES))
    for i, ((file, quantity), name) in enumerate(NAMES.items()):
        held = {
            row["surfaces"]: number(row["held"])
            for row in rows(f"intervals/{file}")
            if row["quantity"] == quantity and row["held"] != "–"
        }
        there = [kind for kind in kinds if kind in held]
        places = [kinds.index(kind) + 0.12 * (i - 2) for kind in there]
        values = [held[kind] for kind in there]
        axes.plot(places, values, MARKERS[i], color=shades[i], label=name)
    axes.axhline(95, color=ink(), linewidth=0.7)
    axes.set_xticks(range(len(kinds)), kinds, rotation=55, ha="right", rotation_mode="anchor")
    axes.tick_params(axis="x", top=False)
    axes.set(ylabel="held [%]", ylim=(55, 102))
    axes.legend(loc="lower left", ncols=2)
    return figure


if __name__ == "__main__":
    main()
