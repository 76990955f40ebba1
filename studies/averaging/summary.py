"""The study in short, for the lab."""

from __future__ import annotations

from roughline.paper.studies import StudyCurve, StudyPanel, StudySummary
from roughline.paper.windows import Window
from studies.averaging.exponents import DIMENSIONS, PUBLISHED, choices, exponent, windows
from studies.averaging.page import TITLE, lead, verdict_table

_DIMENSIONS, _EXPONENTS = (1.95, 3.05), (0.38, 1.04)
_DASHES = {"arithmetic": "solid", "geometric": "dashed"}


def summary() -> StudySummary:
    """Return what the lab shows of the study: its surfaces."""
    table = verdict_table("surfaces")
    panels = [_panel(window) for window in windows("surfaces")[:2]]
    return StudySummary("averaging", TITLE, lead(), table.header, table.rows, panels)


def _panel(window: Window) -> StudyPanel:
    curves = []
    for i, choice in enumerate(choices()):
        found = {each: exponent("surfaces", window, choice, each) for each in DIMENSIONS}
        covered = {each: one for each, one in found.items() if one.value == one.value}
        if not covered:
            continue
        curves.append(
            StudyCurve(
                f"fixed {choice.fixed}, {choice.averaging}",
                list(covered),
                [each.value for each in covered.values()],
                [each.low for each in covered.values()],
                [each.high for each in covered.values()],
                2 * (i // 2),
                _DASHES[choice.averaging],
            )
        )
    laws = [
        StudyCurve(name, DIMENSIONS, [law(each) for each in DIMENSIONS], dash=dash)
        for (name, law), dash in zip(PUBLISHED.items(), ("dashed", "dotted", "solid"), strict=True)
    ]
    return StudyPanel(
        f"Exponents of 3D surfaces, F̄ = {window[0]:g} to {window[1]:g}",
        "fractal dimension D_f",
        "exponent α",
        _DIMENSIONS,
        _EXPONENTS,
        [*curves, *laws],
        is_log=False,
    )
