"""The page on averages and windows: every number in it comes from the data."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from roughline.paper.results import published_dataset
from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.paper.windows import Window
from roughline.report.page import Section, Table, render_markdown
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import Verdict
from studies.averaging.exponents import (
    BODIES,
    DIMENSIONS,
    HELD_AT_LEVEL,
    PUBLISHED,
    Choice,
    choices,
    count,
    exponent,
    reproductions,
    spread,
    windows,
)
from studies.judged import number_in_words
from studies.reduced_data import version_of

TITLE = "Which exponent? Averages and windows"
FOLDER = "figures/averaging"
FORCE, LEVEL = Choice("force", "arithmetic"), Choice("level", "arithmetic")
GEOMETRIC, DEPTH = Choice("force", "geometric"), Choice("depth", "arithmetic")
USUAL: dict[str, Window] = {"surfaces": (1e-2, 1e-1), "lines": (1e-4, 1e-2)}
"""Windows of the page "The paper, recomputed"."""
_CHOSEN = ("F̄", "averaged at", "mean")
_MODELS = {"surfaces": "Full model, 3D", "lines": "Reduced model, 1D"}


def page() -> str:
    """Return the page as Markdown; its figure lies in a folder beside it."""
    sections = [
        _question(),
        _known(),
        _method(),
        _figure(),
        *(_verdicts(bodies) for bodies in BODIES),
        _recommendation(),
        *(_exponents(bodies) for bodies in BODIES),
        _repeat(),
        _references(),
    ]
    return render_markdown(TITLE, lead(), sections, FOLDER)


def lead() -> str:
    """Return the answer in a few sentences."""
    low, high = spread("surfaces", 2.0)
    apart = max(abs(scaling_exponent(each) - linear_exponent(each)) for each in DIMENSIONS)
    return (
        "The exponent α of k ~ F^α depends on which loads are fitted and on how random surfaces "
        f"are averaged. On the same {count('surfaces')} surfaces of fractal dimension 2 it is "
        f"{low:.2f} to {high:.2f}. The two laws that are argued about, 1/(4 − D_f) and "
        f"0.2567 D_f, differ by {apart:.2f} at most. So an exponent says little without its window "
        "and its average."
    )


def _question() -> Section:
    return Section(
        "What was asked",
        [
            "Which of the published exponents does each window of loads and each average show, on "
            "the data of one study, and which should be reported?",
        ],
    )


def _known() -> Section:
    return Section(
        "What is known",
        notes=[
            "The scaling argument: α = 1/(1 + H) = 1/(4 − D_f) (eq. 14 of the founding paper; "
            "Pohrt, Popov and Filippov 2012).",
            "Read off boundary elements: α = 0.2567 D_f (the founding paper, §7).",
            "Linear, α = 1, where many waves of the roll-off length fit on the surface (Persson "
            "2007; Pastewka and others 2013); α is about 0.9 over decades of such loads in [the "
            "study of finite size](finite_size.md).",
        ],
    )


def _method() -> Section:
    return Section(
        "Method",
        notes=[
            f"The {count('surfaces')} surfaces and {count('lines')} lines for each D_f of "
            "[the paper's study](paper.md): free square, random phases, waves from 2π/L to the "
            "grid's end.",
            "Force and stiffness of every body are averaged under the same force, at the same "
            "depth since first touch, or at the same height of the rigid plane above the mean "
            "of the heights (level).",
            "Arithmetic or geometric means, of both; a geometric mean at fixed level exists only "
            "where all bodies touch.",
            "α is the least-squares slope of ln mean k over ln mean F where the mean force is in "
            "the window; no number is given where the means do not cover it.",
            "Intervals are studentised, from resampled bodies; at fixed level they are too narrow "
            f"and contain a known exponent in {HELD_AT_LEVEL:.0%} of samples of 40 bodies. Below "
            "its smallest load a body follows the power law of its first two loads.",
        ],
    )


def _figure() -> Section:
    return Section(
        "All of them",
        [
            f"![Exponents of every window and mean]({FOLDER}/exponents.png)",
            "Exponents with 95 % intervals, and the three that were published (grey).",
        ],
    )


def verdict_table(bodies: str) -> Table:
    """Return what every window and mean reproduces."""
    return Table(
        (*_CHOSEN, *PUBLISHED),
        _rows(
            bodies,
            lambda window, choice: [_reproduced(bodies, window, choice, law) for law in PUBLISHED],
        ),
    )


def _rows(bodies: str, cells: Callable[[Window, Choice], list[str]]) -> list[tuple[str, ...]]:
    """Return a row for every window and mean."""
    return [
        (_window(window), f"fixed {choice.fixed}", choice.averaging, *cells(window, choice))
        for window in windows(bodies)
        for choice in choices()
    ]


def _verdicts(bodies: str) -> Section:
    return Section(
        f"{_MODELS[bodies]}: what each choice reproduces",
        [
            "The D_f for which the whole 95 % interval lies within "
            f"{EXPONENT_TOLERANCE:g} of the published exponent (confirmed), and those for which it "
            "lies partly within (undecided), with the number of bodies that would decide; "
            "elsewhere it is refuted.",
        ],
        tables=[verdict_table(bodies)],
    )


def _reproduced(bodies: str, window: Window, choice: Choice, law: str) -> str:
    """Say for which fractal dimensions a published exponent is confirmed or left open."""
    found = reproductions(bodies, window, choice, law)
    if not found:
        return "not covered"
    parts = []
    for each in (Verdict.CONFIRMED, Verdict.UNDECIDED):
        cases = {d: judgement for d, judgement in found.items() if judgement.verdict is each}
        if not cases:
            continue
        where = "all D_f" if len(cases) == len(DIMENSIONS) else ", ".join(map(str, cases))
        enough = max(judgement.enough for judgement in cases.values())
        more = f" ({number_in_words(enough)})" if each is Verdict.UNDECIDED else ""
        parts.append(f"{each}: {where}{more}")
    missing = [str(each) for each in DIMENSIONS if each not in found]
    parts = parts or [str(Verdict.REFUTED)]
    return "; ".join([*parts, f"not covered: {', '.join(missing)}"] if missing else parts)


def _recommendation() -> Section:
    means, depth = (_largest(each) for each in (GEOMETRIC, DEPTH))
    usual = USUAL["surfaces"]
    force, level = (exponent("surfaces", usual, each, 2.0) for each in (FORCE, LEVEL))
    low_window = windows("surfaces")[0]
    lowest = [exponent("surfaces", low_window, each, 2.0) for each in (FORCE, LEVEL)]
    return Section(
        "Recommendation",
        [
            "Report the arithmetic mean of the stiffness at fixed force, and the window of loads "
            "beside every exponent. The reasons:",
        ],
        notes=[
            "The force is what an experiment or a design sets, and every body carries it. At fixed "
            "level the few bodies with the highest summits carry the mean, and a geometric mean "
            "does not exist at light loads, as some bodies do not touch.",
            f"{_narrowest()}: at D_f = 2 and F̄ = {_window(usual)} it is "
            f"{force.high - force.low:.3f} wide, and {level.high - level.low:.3f} at fixed level.",
            "What is found at fixed force hardly depends on the kind of mean: geometric instead of "
            f"arithmetic changes α by {means:.3f} at most, fixed depth instead of fixed force by "
            f"{depth:.3f} at most (surfaces, F̄ = {_window(usual)}).",
            f"Fixed level shows another quantity: at D_f = 2 and F̄ = {_window(low_window)} α is "
            f"{lowest[1].value:.2f} ({lowest[1].low:.2f}-{lowest[1].high:.2f}) instead of "
            f"{lowest[0].value:.2f} ({lowest[0].low:.2f}-{lowest[0].high:.2f}), as the mean force "
            "falls there because fewer and fewer bodies touch, not because each is pressed less.",
        ],
    )


def _narrowest() -> str:
    """Say for which surfaces the recommended choice has the narrowest interval of all."""
    excess = {each: _width(FORCE, each) / _least_width(each) - 1 for each in DIMENSIONS}
    narrowest = [str(each) for each, share in excess.items() if share == 0]
    where = f"Its interval is the narrowest of all at D_f = {', '.join(narrowest)}"
    return f"{where}, and at most {max(excess.values()):.0%} wider than the narrowest elsewhere"


def _least_width(fractal_dimension: float) -> float:
    """Return the width of the narrowest interval of all choices."""
    return float(np.nanmin([_width(each, fractal_dimension) for each in choices()]))


def _width(choice: Choice, fractal_dimension: float) -> float:
    """Return the width of the interval of an exponent of surfaces."""
    found = exponent("surfaces", USUAL["surfaces"], choice, fractal_dimension)
    return found.high - found.low


def _largest(other: Choice) -> float:
    """Return by how much an exponent of surfaces differs at most from the recommended one."""
    usual = USUAL["surfaces"]
    return max(
        abs(
            exponent("surfaces", usual, other, each).value
            - exponent("surfaces", usual, FORCE, each).value
        )
        for each in DIMENSIONS
    )


def _exponents(bodies: str) -> Section:
    header = (*_CHOSEN, *(f"D_f = {each}" for each in DIMENSIONS))
    rows = _rows(
        bodies,
        lambda window, choice: [
            _cell(bodies, window, choice, dimension) for dimension in DIMENSIONS
        ],
    )
    return Section(
        f"{_MODELS[bodies]}: the exponents",
        tables=[Table(header, rows, range(3, len(header)))],
    )


def _cell(bodies: str, window: Window, choice: Choice, dimension: float) -> str:
    found = exponent(bodies, window, choice, dimension)
    if np.isnan(found.value):
        return "-"
    return f"{found.value:.2f} ({found.low:.2f}-{found.high:.2f})"


def _window(window: Window) -> str:
    return f"{window[0]:g} to {window[1]:g}"


def _repeat() -> Section:
    version = version_of(map(published_dataset, BODIES))
    return Section(
        "Data, and how to repeat",
        [
            "The plan, the reduction and the exponents lie in `studies/averaging`; the surfaces "
            "and lines come with the package (`studies/paper`). `make averaging` fits everything "
            f"again in a minute. The bodies were computed with roughline {version}.",
        ],
    )


def _references() -> Section:
    return Section(
        "References",
        notes=[
            "R. Pohrt, V. L. Popov and A. E. Filippov, Normal contact stiffness of elastic solids "
            "with fractal rough surfaces for one- and three-dimensional systems, Phys. Rev. E 86, "
            "026710 (2012).",
            "B. N. J. Persson, Relation between interfacial separation and load, Phys. Rev. Lett. "
            "99, 125502 (2007).",
            "L. Pastewka, N. Prodanov, B. Lorenz, M. H. Müser, M. O. Robbins and B. N. J. Persson, "
            "Finite-size scaling in the interfacial stiffness of rough elastic contacts, Phys. "
            "Rev. E 87, 062809 (2013).",
        ],
    )
