"""The page on the handbooks' correlations: the numbers and tables that its text names."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from roughline.computing.arrays import Real
from roughline.report.page import Table
from roughline.statistics.bootstrap import IntervalEstimate
from studies.correlations.claims import (
    EXPONENT_TOLERANCE,
    LEVEL,
    MIXED,
    TOLERANCES,
    at_all_pressures,
    claims,
    judge,
)
from studies.correlations.figures import conductance_figure, ratio_figure
from studies.correlations.measure import (
    BANDS,
    BOXES,
    DIMENSIONS,
    ELASTIC,
    FULL,
    HARDNESSES,
    HERE,
    PRESSURES,
    WINDOW,
    Sample,
    dimensions_of,
    plan,
    sample,
    version,
)
from studies.correlations.ratios import (
    ELASTIC_BANDS,
    MIDDLE,
    Ratio,
    change_with_band,
    change_with_boundary,
    change_with_box,
    common_law,
    core_seconds,
    elastic_pressure_over_hardness,
    extremes,
    failed_loads,
    grid_shift,
    heights,
    nayak,
    over_bearing_area,
    over_holm,
    over_root_sum,
    slope_spread,
    spots_of_the_correlation,
    worst_grid_shift,
)
from studies.correlations.reduction import reduce_store
from studies.judged import cell, change, spread
from studies.study import Study, claims_table

BETWEEN = 0.3
"""Hardness at which elastic and plastic deformation both count."""
_IN_WINDOW = PRESSURES[1:]
_LIMITS = {"elastic": ELASTIC, "fully plastic": FULL}


def told() -> dict[str, object]:
    """Return what the text names."""
    found, (failed, loads) = heights(), failed_loads()
    narrowest, widest, widest_elastic = min(BANDS), max(BANDS), max(ELASTIC_BANDS)
    plastic_band = change_with_band(FULL, MIDDLE, narrowest, widest)
    elastic_band = change_with_band(ELASTIC, MIDDLE, narrowest, widest_elastic)
    return {
        "window": spread(WINDOW, "g"),
        "lightest": PRESSURES[0],
        "light": WINDOW[0],
        "heavy": WINDOW[1],
        "full": FULL,
        "between": BETWEEN,
        "level": LEVEL,
        "exponent_tolerance": EXPONENT_TOLERANCE,
        "hurst": f"Hurst {3 - MIDDLE:.1f}",
        "main_band": _main(BANDS),
        "main_waves": _main(BOXES),
        "narrowest": narrowest,
        "widest": widest,
        "widest_elastic": widest_elastic,
        "more_waves": sorted(BOXES)[1:],
        "over_mikic": _extremes(_ratio, ELASTIC),
        "over_cmy": _extremes(_ratio, FULL),
        "between_over_cmy": _extremes(lambda one: one.over_yovanovich, BETWEEN),
        "between_over_mikic": _extremes(_to_mikic, BETWEEN),
        "over_root_sum": spread(extremes(over_root_sum, MIXED)),
        "over_bearing_area": spread(extremes(over_bearing_area, (FULL,)), ".3f"),
        "plastic_share": extremes(lambda one: one.plastic, (FULL,))[0],
        "elastic_law": common_law(ELASTIC),
        "plastic_law": common_law(FULL),
        "spots_at_lightest": _spots(PRESSURES[0]),
        "spots_at_light": _spots(WINDOW[0]),
        "plastic_band": plastic_band,
        "by_plastic_band": change(plastic_band, "+.0%"),
        "by_elastic_band": change(elastic_band, "+.0%"),
        "by_box": _changes(change_with_box, 1e-2),
        "by_boundary": {
            name: _changes(change_with_boundary, pressure)
            for name, pressure in zip(("light", "heavy"), WINDOW, strict=True)
        },
        "fine_count": sample("fine", FULL, MIDDLE).count,
        "worst_grid_shift": worst_grid_shift(),
        "slope_spread": slope_spread(),
        "heights": found,
        "gaussian": ", ".join(f"{share:g}" for share, _, _ in found.bearing),
        "bearing": ", ".join(f"{share:.4g} ± {error:.1g}" for _, share, error in found.bearing),
        "solved": "All loads were solved" if not failed else f"{failed} loads were not solved",
        "loads": loads,
        "version": version(),
        "minutes": core_seconds() / 60,
        "seed": plan().ensembles[0].seed,
        **_tables(),
    }


def _extremes(ratio: Ratio, hardness: float) -> str:
    """Write the smallest and the largest mean of a ratio in the window."""
    return spread(extremes(ratio, (hardness,)), ".0%")


def _spots(pressure: float) -> str:
    """Write how many equal spots have the correlation's area and conductance."""
    return spread((spots_of_the_correlation(each, pressure) for each in DIMENSIONS), ".1f")


def _changes(
    of: Callable[[float, float, float], IntervalEstimate], pressure: float
) -> dict[str, str]:
    """Write changes of elastic and of plastic surfaces."""
    limits = {"elastic": ELASTIC, "plastic": FULL}
    return {name: change(of(each, MIDDLE, pressure), "+.0%") for name, each in limits.items()}


def _main(prefixes: dict[int, str]) -> int:
    """Return the band, or the number of waves, of the main surfaces."""
    return next(number for number, prefix in prefixes.items() if prefix == "main")


def _tables() -> dict[str, Table]:
    return {
        "elastic": _handbook_table(ELASTIC),
        "plastic": _handbook_table(FULL),
        "from_weak_to_full": _between_table(),
        "root_sums": _root_sum_table(),
        "areas": _area_table(),
        "scatter": _scatter_table(),
        "grid": _grid_table(),
        "bands": _band_table(),
        "boxes": _box_table(),
        "boundaries": _boundary_table(),
        "ensembles": _ensembles_table(),
    }


def _handbook_table(hardness_bar: float) -> Table:
    """Return ratios to the handbook's correlation, and the power law that fits."""
    variable = "p/(E*∇h)" if hardness_bar == ELASTIC else "p/H"
    rows = []
    for one in _samples(hardness_bar):
        law, found = one.fit(), at_all_pressures(one, _ratio)
        rows.append(
            [
                _hurst(one),
                *_cells(one, one.ratio, PRESSURES),
                cell(IntervalEstimate(law.prefactor, *law.prefactor_interval)),
                cell(IntervalEstimate(law.exponent, *law.exponent_interval), ".3f"),
                *(str(judge("", found, tolerance).verdict) for tolerance in TOLERANCES),
            ]
        )
    within = (f"within {tolerance:.0%}" for tolerance in TOLERANCES)
    header = ("Hurst", *_at(PRESSURES, f"{variable} ="), "prefactor", "exponent", *within)
    return _numeric(header, rows, words=len(TOLERANCES))


def _between_table() -> Table:
    """Return ratios to both handbooks, from weak to full plasticity."""
    tolerance = TOLERANCES[1]
    rows = []
    for hardness in HARDNESSES:
        for one in _samples(hardness):
            found = [at_all_pressures(one, each) for each in (_ratio, _to_mikic)]
            rows.append(
                [
                    *(f"{hardness:g}", _hurst(one)),
                    f"{elastic_pressure_over_hardness(one):.1f}",
                    f"{one.mean_at(one.plastic, 1e-2).mean[0]:.0%}",
                    *_cells(one, one.over_yovanovich, _IN_WINDOW),
                    *_cells(one, one.over_mikic, _IN_WINDOW),
                    *(str(judge("", each, tolerance).verdict) for each in found),
                ]
            )
    header = (
        *("H/(E*∇h)", "Hurst", "elastic p_c/H", "plastic share"),
        *_at(_IN_WINDOW, "over CMY's, p/H ="),
        *_at(_IN_WINDOW, "over Mikic's, p/H ="),
        *(f"CMY within {tolerance:.0%}", f"Mikic within {tolerance:.0%}"),
    )
    return _numeric(header, rows, words=2)


def _root_sum_table() -> Table:
    """Return ratios to the root sum of squares of the elastic and the plastic conductance."""
    rows = [
        [f"{hardness:g}", _hurst(one), *_cells(one, over_root_sum(one), _IN_WINDOW)]
        for hardness in MIXED
        for one in _samples(hardness)
    ]
    return _numeric(("H/(E*∇h)", "Hurst", *_at(_IN_WINDOW, "p/H =")), rows)


def _area_table() -> Table:
    """Return the real area over p / H, and the conductance over that of Holm's spot."""
    rows = []
    for hardness in HARDNESSES:
        one = sample("main", hardness, MIDDLE)
        areas = _cells(one, over_bearing_area(one), PRESSURES)
        rows.append([f"{hardness:g}", *areas, *_cells(one, over_holm(one), PRESSURES, ".1f")])
    ratios = ("(A/A_0)/(p/H), p/H =", "over Holm's, p/H =")
    return _numeric(("H/(E*∇h)", *(x for each in ratios for x in _at(PRESSURES, each))), rows)


def _scatter_table() -> Table:
    """Return how far single surfaces differ from the mean."""
    rows = []
    for name, hardness in _LIMITS.items():
        for one in _samples(hardness):
            mean = one.mean_at(one.ratio, *PRESSURES)
            rows.append([name, _hurst(one), *(f"{x:.0%}" for x in mean.scatter / mean.mean)])
    return _numeric(("bodies", "Hurst", *_at(PRESSURES, "pressure")), rows)


def _grid_table() -> Table:
    """Return how much higher the ratios are on twice the points."""
    rows = []
    for name, hardness in {
        "elastic": ELASTIC,
        "H/(E*∇h) = 0.1": 0.1,
        "fully plastic": FULL,
    }.items():
        for one in _samples(hardness):
            shifts = grid_shift(one, _ratio)
            shown = (change(shifts[place]) for place in one.places(*PRESSURES))
            rows.append([name, _hurst(one), *shown])
    return _numeric(("bodies", "Hurst", *_at(PRESSURES, "pressure")), rows)


def _band_table() -> Table:
    """Return the ratios over the band of waves, at a pressure of 0.01."""
    rows = []
    for width, prefix in BANDS.items():
        for dimension in dimensions_of(prefix):
            plastic, elastic = sample(prefix, FULL, dimension), ["-"]
            if width in ELASTIC_BANDS:
                body = sample(prefix, ELASTIC, dimension)
                elastic = _cells(body, body.ratio, (1e-2,))
            alpha = f"{nayak(prefix, dimension):.1f}"
            shown = _cells(plastic, plastic.ratio, (0.01, 0.1))
            rows.append([f"{width}", _hurst(plastic), alpha, *elastic, *shown])
    header = (
        *("q_high/q_roll", "Hurst", "Nayak's α", "elastic, over Mikic's"),
        *("fully plastic, over CMY's", "the same at 0.1"),
    )
    return _numeric(header, rows)


def _box_table() -> Table:
    """Return the ratios, and the scatter, over the number of roll-off waves along a side."""
    rows = []
    for name, hardness in _LIMITS.items():
        for waves, prefix in BOXES.items():
            one = sample(prefix, hardness, MIDDLE)
            mean = one.mean_at(one.ratio, 1e-2)
            scatter = f"{mean.scatter[0] / mean.mean[0]:.0%}"
            rows.append([name, f"{waves}", *_cells(one, one.ratio, PRESSURES), scatter])
    header = ("bodies", "roll-off waves", *_at(PRESSURES, "pressure"), "scatter at 0.01")
    return _numeric(header, rows)


def _boundary_table() -> Table:
    """Return the ratios of periodic surfaces and of the same surfaces with free borders."""
    rows = []
    for name, hardness in _LIMITS.items():
        for prefix, boundary in (("main", "periodic"), ("free", "free")):
            one = sample(prefix, hardness, MIDDLE)
            rows.append([name, boundary, *_cells(one, one.ratio, _IN_WINDOW)])
    return _numeric(("bodies", "boundary", *_at(_IN_WINDOW, "pressure")), rows)


def _ensembles_table() -> Table:
    """Return what was computed: an ensemble in each row."""
    header = (
        *("Ensemble", "Points", "q_roll/q_0", "q_high/q_0", "Boundary", "H/(E*∇h)", "Hurst"),
        *("Surfaces each", "Loads"),
    )
    rows = [
        [
            each.name,
            f"{each.n}²",
            f"{each.roll_off_ratio:g}",
            f"{each.cutoff_ratio:g}",
            each.boundary,
            "elastic" if each.hardness_bar is None else f"{each.hardness_bar:g}",
            ", ".join(f"{3 - dimension:.1f}" for dimension in each.fractal_dimensions),
            f"{each.realisations}",
            f"{len(each.force_bars)}",
        ]
        for each in plan().ensembles
    ]
    return Table(header, rows, numbers=(1, 2, 3, 7, 8))


def _samples(hardness_bar: float) -> list[Sample]:
    return [sample("main", hardness_bar, dimension) for dimension in DIMENSIONS]


def _ratio(one: Sample) -> Real:
    return one.ratio


def _to_mikic(one: Sample) -> Real:
    return one.over_mikic


def _hurst(one: Sample) -> str:
    return f"{3 - one.fractal_dimension:.1f}"


def _at(pressures: Sequence[float], said: str) -> list[str]:
    return [f"{said} {pressure:g}" for pressure in pressures]


def _cells(one: Sample, values: Real, pressures: Sequence[float], form: str = ".2f") -> list[str]:
    """Write means with their intervals at some pressures."""
    mean = one.mean_at(values, *pressures)
    ends = zip(mean.mean.tolist(), mean.low.tolist(), mean.high.tolist(), strict=True)
    return [cell(IntervalEstimate(*each), form) for each in ends]


def _numeric(header: Sequence[str], rows: Sequence[Sequence[str]], words: int = 0) -> Table:
    """Return a table of numbers, but for some columns of words at its end."""
    return Table(tuple(header), rows, numbers=range(len(header) - words))


STUDY = Study(
    HERE,
    verdicts=lambda: claims_table({f"Within {each:.0%}": claims(each) for each in TOLERANCES}),
    told=told,
    figures={"conductance": conductance_figure, "ratios": ratio_figure},
)
publish, reduce = STUDY.publish, reduce_store
