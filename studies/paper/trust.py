"""The page about the map: where the reduced model may be trusted."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from roughline.comparison.trust import TrustMap
from roughline.paper.tables import trust_cell
from roughline.plot.models import add_bar, draw_trust
from roughline.plot.style import PAGE, new_figure
from roughline.report.page import Table
from roughline.statistics.verdict import Verdict, verdict
from studies.study import filled

_TOLERANCE = 0.1
_FORCES = (1e-3, 1e-2, 1e-1, 1.0)
_DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)


def trust_page(told: Mapping[str, object]) -> str:
    """Return the page about the map."""
    text = (Path(__file__).parent / "trust.md").read_text(encoding="utf-8")
    return filled(text, told, "trust")


def told_of_map(trust: TrustMap, fine: TrustMap) -> dict[str, object]:
    """Return what the page names; ``fine`` has twice the waves and points at some places."""
    return {
        "by_roll_off": _roll_off_table(trust),
        "by_cutoff": _cutoff_table(trust, fine),
        "verdicts": _counts_of_verdicts(trust),
    }


def _roll_off_table(trust: TrustMap) -> Table:
    header = ("q_roll / q_0", "D_f", *(f"F̄ = {force:g}" for force in _FORCES))
    rows = [
        (
            f"{roll_off:g}",
            f"{d:.1f}",
            *(trust_cell(trust.at(d, force, roll_off)) for force in _FORCES),
        )
        for roll_off in map(float, trust.roll_off_ratios)
        for d in _DIMENSIONS
    ]
    return Table(header, rows, numbers=range(len(header)))


def _cutoff_table(trust: TrustMap, fine: TrustMap) -> Table:
    header = ["q_roll / q_0", "D_f"]
    header += [f"F̄ = {force:g}, {end} q_0" for force in _FORCES[1:] for end in (32, 64)]
    rows = []
    for roll_off in map(float, fine.roll_off_ratios):
        for d in map(float, fine.fractal_dimensions):
            cells = [
                trust_cell(of.at(d, force, roll_off))
                for force in _FORCES[1:]
                for of in (trust, fine)
            ]
            rows.append([f"{roll_off:g}", f"{d:.1f}", *cells])
    return Table(header, rows, numbers=range(len(header)))


def _counts_of_verdicts(trust: TrustMap) -> str:
    """Say at how many places of the map each verdict stands."""
    ends = zip(trust.low[trust.resolved], trust.high[trust.resolved], strict=True)
    verdicts = [verdict(low, high, -_TOLERANCE, _TOLERANCE) for low, high in ends]
    counts = ", ".join(f"{verdicts.count(each)} {each}" for each in Verdict)
    return f"the {len(verdicts)} places of the map are {counts}"


def trust_map_figure(trust: TrustMap) -> Figure:
    """Draw the relative difference of the two models, a panel for each roll-off ratio."""
    figure = new_figure(PAGE, 2.7)
    panels = figure.subplots(1, trust.roll_off_ratios.size, sharey=True)
    for i, panel in enumerate(panels):
        shown = draw_trust(panel, trust, i)
        panel.set(xlabel=r"$\bar F$")
    panels[0].set(ylabel="fractal dimension $D_f$")
    add_bar(panels, shown)
    return figure
