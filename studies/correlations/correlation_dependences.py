"""The sections of the page on what its conclusions depend on: grid, band, size and boundary."""

from __future__ import annotations

from roughline.report.page import Section
from roughline.statistics.bootstrap import IntervalEstimate
from studies.correlations.conductance import BANDS, BOXES, ELASTIC, FULL, WINDOW, sample
from studies.correlations.correlation_tables import (
    band_table,
    boundary_table,
    box_table,
    grid_table,
)
from studies.correlations.findings import (
    ELASTIC_BANDS,
    MIDDLE,
    change_with_band,
    change_with_boundary,
    change_with_box,
    worst_grid_shift,
)

_HURST = f"Hurst {3 - MIDDLE:.1f}"


def dependences() -> list[Section]:
    """Return the sections."""
    return [_grid_section(), _band_section(), _box_section(), _boundary_section()]


def _grid_section() -> Section:
    return Section(
        "The grid",
        [
            "How much higher the ratio is on twice the points, with the same waves, of the same "
            f"{sample('fine', FULL, MIDDLE).count} surfaces: at most {worst_grid_shift():.1%} in "
            f"the mean from {WINDOW[0]:g} to {WINDOW[1]:g}.",
        ],
        tables=[grid_table()],
    )


def _band_section() -> Section:
    narrow, widest, elastic_widest = min(BANDS), max(BANDS), max(ELASTIC_BANDS)
    elastic = change_with_band(ELASTIC, MIDDLE, narrow, elastic_widest)
    plastic = change_with_band(FULL, MIDDLE, narrow, widest)
    return Section(
        "How wide the band of waves is",
        [
            "The same roll-off with fewer and with more waves below it, eight cells for the "
            f"shortest, at a pressure of 0.01. Elastic conductance hardly depends on short waves: "
            f"from q_high/q_roll = {narrow} to {elastic_widest} its ratio to Mikic's changes by "
            f"{_percents(elastic)} at {_HURST}.",
            "In the plastic limit CMY's conductance grows with the slope m, to which ever shorter "
            "waves contribute, and that of the surface grows less: short waves cut a contact spot "
            "into fragments, which lie close together and conduct almost as one. From "
            f"q_high/q_roll = {narrow} to {widest} the ratio changes by {_percents(plastic)} at "
            f"{_HURST}. So the m to put in depends on the finest scale that was measured, and no "
            "single prefactor serves.",
        ],
        tables=[band_table()],
    )


def _box_section() -> Section:
    waves = sorted(BOXES)[1:]
    elastic, plastic = (change_with_box(hardness, MIDDLE, 1e-2) for hardness in (ELASTIC, FULL))
    return Section(
        "How many long waves there are",
        [
            f"Pieces with {', '.join(map(str, BOXES))} roll-off waves along a side and the same "
            f"band, {_HURST}. From {waves[0]} to {waves[1]} waves the ratio at 0.01 changes by "
            f"{_percents(elastic)} (elastic) and {_percents(plastic)} (fully plastic). At the "
            "lightest loads few summits touch, and more in a larger piece.",
        ],
        tables=[box_table()],
    )


def _boundary_section() -> Section:
    (light_elastic, light_plastic), (heavy_elastic, heavy_plastic) = (
        [change_with_boundary(hardness, MIDDLE, pressure) for hardness in (ELASTIC, FULL)]
        for pressure in WINDOW
    )
    return Section(
        "The boundary",
        [
            "The surfaces are periodic, where the stiffness is that of the interface alone. With "
            "free borders, and the interface stiffness taken from 1/k_i = 1/k - 1/k_s, the ratio "
            f"of the same surfaces differs by {_percents(light_elastic)} (elastic) and "
            f"{_percents(light_plastic)} (fully plastic) at {WINDOW[0]:g}, and by "
            f"{_percents(heavy_elastic)} and {_percents(heavy_plastic)} at {WINDOW[1]:g}. A free "
            "piece is not pressed evenly, and where the interface is stiffer than the block, "
            "1/k - 1/k_s is a small difference of two numbers. The verdicts are for the periodic "
            f"half-space. {_HURST}.",
        ],
        tables=[boundary_table()],
    )


def _percents(number: IntervalEstimate) -> str:
    return f"{number.value:+.0%} ({number.low:+.0%} to {number.high:+.0%})"
