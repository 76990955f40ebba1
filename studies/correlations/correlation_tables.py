"""The tables of the page."""

from __future__ import annotations

from collections.abc import Sequence

from roughline.computing.arrays import Real
from roughline.report.page import Table
from roughline.statistics.bootstrap import IntervalEstimate
from studies.correlations.conductance import (
    BANDS,
    BOXES,
    DIMENSIONS,
    ELASTIC,
    FULL,
    HARDNESSES,
    PRESSURES,
    Sample,
    dimensions_of,
    plan,
    sample,
)
from studies.correlations.correlation_claims import MIXED
from studies.correlations.findings import (
    ELASTIC_BANDS,
    MIDDLE,
    elastic_pressure_over_hardness,
    nayak,
    over_bearing_area,
    over_holm,
    over_root_sum,
)
from studies.correlations.judgement import TOLERANCES, grid_shift, judge

IN_WINDOW = PRESSURES[1:]


def handbook_table(hardness_bar: float) -> Table:
    """Return ratios to the handbook's correlation, and the power law that fits."""
    variable = "p/(E*∇h)" if hardness_bar == ELASTIC else "p/H"
    header = (
        *("Hurst", *(f"{variable} = {pressure:g}" for pressure in PRESSURES)),
        *("prefactor", "exponent", *(f"within {tolerance:.0%}" for tolerance in TOLERANCES)),
    )
    rows = []
    for one in _main(hardness_bar):
        law = one.fit()
        prefactor = IntervalEstimate(law.prefactor, *law.prefactor_interval)
        exponent = IntervalEstimate(law.exponent, *law.exponent_interval)
        verdicts = [judge(one, _ratio, tolerance).verdict for tolerance in TOLERANCES]
        rows.append(
            [_hurst(one), *_cells(one, one.ratio, PRESSURES), _cell(prefactor), _cell(exponent, 3)]
            + [str(each) for each in verdicts]
        )
    return _numeric(header, rows, words=len(TOLERANCES))


def between_table() -> Table:
    """Return ratios to both handbooks, from weak to full plasticity."""
    header = (
        *("H/(E*∇h)", "Hurst", "elastic p_c/H", "plastic share"),
        *(f"over CMY's, p/H = {pressure:g}" for pressure in IN_WINDOW),
        *(f"over Mikic's, p/H = {pressure:g}" for pressure in IN_WINDOW),
        f"CMY within {TOLERANCES[1]:.0%}",
        f"Mikic within {TOLERANCES[1]:.0%}",
    )
    rows = []
    for hardness in HARDNESSES:
        for one in _main(hardness):
            share = one.mean_at(one.plastic, 1e-2).mean[0]
            judged = (judge(one, each, TOLERANCES[1]) for each in (_ratio, _to_mikic))
            rows.append(
                [
                    *(f"{hardness:g}", _hurst(one)),
                    *(f"{elastic_pressure_over_hardness(one):.1f}", f"{share:.0%}"),
                    *_cells(one, one.over_yovanovich, IN_WINDOW),
                    *_cells(one, one.over_mikic, IN_WINDOW),
                    *(str(each.verdict) for each in judged),
                ]
            )
    return _numeric(header, rows, words=2)


def root_sum_table() -> Table:
    """Return ratios to the root sum of squares of the elastic and the plastic conductance."""
    header = ("H/(E*∇h)", "Hurst", *(f"p/H = {pressure:g}" for pressure in IN_WINDOW))
    rows = [
        [f"{hardness:g}", _hurst(one), *_cells(one, over_root_sum(one), IN_WINDOW)]
        for hardness in MIXED
        for one in _main(hardness)
    ]
    return _numeric(header, rows)


def area_table() -> Table:
    """Return the real area over p / H, and the conductance over that of Holm's spot."""
    header = (
        "H/(E*∇h)",
        *(f"(A/A_0)/(p/H), p/H = {pressure:g}" for pressure in PRESSURES),
        *(f"over Holm's, p/H = {pressure:g}" for pressure in PRESSURES),
    )
    rows = []
    for hardness in HARDNESSES:
        one = sample("main", hardness, MIDDLE)
        rows.append(
            [
                f"{hardness:g}",
                *_cells(one, over_bearing_area(one), PRESSURES),
                *_cells(one, over_holm(one), PRESSURES, 1),
            ]
        )
    return _numeric(header, rows)


def scatter_table() -> Table:
    """Return how far single surfaces differ from the mean."""
    header = ("bodies", "Hurst", *(f"pressure {pressure:g}" for pressure in PRESSURES))
    rows = []
    for hardness, name in ((ELASTIC, "elastic"), (FULL, "fully plastic")):
        for one in _main(hardness):
            mean = one.mean_at(one.ratio, *PRESSURES)
            rows.append([name, _hurst(one), *(f"{x:.0%}" for x in mean.scatter / mean.mean)])
    return _numeric(header, rows)


def grid_table() -> Table:
    """Return how much higher the ratios are on twice the points."""
    header = ("bodies", "Hurst", *(f"pressure {pressure:g}" for pressure in PRESSURES))
    rows = []
    for hardness, name in ((ELASTIC, "elastic"), (0.1, "H/(E*∇h) = 0.1"), (FULL, "fully plastic")):
        for one in _main(hardness):
            shifts = grid_shift(one, _ratio)
            shown = (_percents(shifts[place]) for place in one.places(*PRESSURES))
            rows.append([name, _hurst(one), *shown])
    return _numeric(header, rows)


def band_table() -> Table:
    """Return the ratios over the band of waves, at a pressure of 0.01."""
    header = (
        *("q_high/q_roll", "Hurst", "Nayak's α", "elastic, over Mikic's"),
        *("fully plastic, over CMY's", "the same at 0.1"),
    )
    rows = []
    for width, prefix in BANDS.items():
        for dimension in dimensions_of(prefix):
            plastic = sample(prefix, FULL, dimension)
            elastic = "-"
            if width in ELASTIC_BANDS:
                body = sample(prefix, ELASTIC, dimension)
                elastic = _cells(body, body.ratio, (1e-2,))[0]
            rows.append(
                [
                    f"{width}",
                    _hurst(plastic),
                    f"{nayak(prefix, dimension):.1f}",
                    elastic,
                    *_cells(plastic, plastic.ratio, (0.01, 0.1)),
                ]
            )
    return _numeric(header, rows)


def box_table() -> Table:
    """Return the ratios, and the scatter, over the number of roll-off waves along a side."""
    header = (
        *("bodies", "roll-off waves"),
        *(f"pressure {pressure:g}" for pressure in PRESSURES),
        "scatter at 0.01",
    )
    rows = []
    for hardness, name in ((ELASTIC, "elastic"), (FULL, "fully plastic")):
        for waves, prefix in BOXES.items():
            one = sample(prefix, hardness, MIDDLE)
            mean = one.mean_at(one.ratio, 1e-2)
            rows.append(
                [
                    name,
                    f"{waves}",
                    *_cells(one, one.ratio, PRESSURES),
                    f"{mean.scatter[0] / mean.mean[0]:.0%}",
                ]
            )
    return _numeric(header, rows)


def boundary_table() -> Table:
    """Return the ratios of periodic surfaces and of the same surfaces with free borders."""
    header = ("bodies", "boundary", *(f"pressure {pressure:g}" for pressure in IN_WINDOW))
    rows = []
    for hardness, name in ((ELASTIC, "elastic"), (FULL, "fully plastic")):
        for prefix, boundary in (("main", "periodic"), ("free", "free")):
            one = sample(prefix, hardness, MIDDLE)
            rows.append([name, boundary, *_cells(one, one.ratio, IN_WINDOW)])
    return _numeric(header, rows)


def ensembles_table() -> Table:
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


def _main(hardness_bar: float) -> list[Sample]:
    return [sample("main", hardness_bar, dimension) for dimension in DIMENSIONS]


def _ratio(one: Sample) -> Real:
    return one.ratio


def _to_mikic(one: Sample) -> Real:
    return one.over_mikic


def _hurst(one: Sample) -> str:
    return f"{3 - one.fractal_dimension:.1f}"


def _cells(one: Sample, values: Real, pressures: Sequence[float], digits: int = 2) -> list[str]:
    """Write means with their intervals at some pressures."""
    mean = one.mean_at(values, *pressures)
    ends = zip(mean.mean.tolist(), mean.low.tolist(), mean.high.tolist(), strict=True)
    return [_cell(IntervalEstimate(*each), digits) for each in ends]


def _cell(number: IntervalEstimate, digits: int = 2) -> str:
    form = f".{digits}f"
    return f"{number.value:{form}} ({number.low:{form}}-{number.high:{form}})"


def _percents(number: IntervalEstimate) -> str:
    return f"{number.value:+.1%} ({number.low:+.1%} to {number.high:+.1%})"


def _numeric(header: Sequence[str], rows: Sequence[Sequence[str]], words: int = 0) -> Table:
    """Return a table of numbers, but for some columns of words at its end."""
    return Table(tuple(header), rows, numbers=range(len(header) - words))
