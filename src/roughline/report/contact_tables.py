"""The curve and the answers of one assessment: in large figures, in groups, and as tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from roughline.contact.quantities import QUANTITIES
from roughline.contact.status import Status
from roughline.engineering.symbols import symbols_of
from roughline.report.groups import Group, figures_of, groups_of, headline_of, sentence
from roughline.report.page import Headline
from roughline.report.values import value_and_interval, with_interval
from roughline.units import change_in_words, engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.computing.arrays import Real
    from roughline.engineering.intervals import Ends
    from roughline.engineering.materials import Material
    from roughline.engineering.rule import Answer

_SI = {name: QUANTITIES[name].unit_in("m") or "" for name in ("depth", "force", "stiffness")}

IF_ELASTIC = "if nothing yielded"
"""Heads the answers that elastic bodies would give."""

UNRESOLVED = "fewer than ten points in contact: the grid decides, not the surface"
"""Meaning of the star after a load."""


def curve_table(assessment: Assessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of a curve in SI units; a star marks loads that the grid decides.

    Force and stiffness are the joint's, where its area is given. With a hardness, the stiffness on
    unloading takes the place of the raw area.
    """
    curve, scale, known = assessment.curve_as_asked, assessment.scale, assessment.intervals_as_asked
    loading: Ends | None = None
    unloading: Ends | None = None
    area: Ends | None = None
    if known is not None:
        loading, unloading, area = known.stiffness, known.unloading, known.area
    header = ["load", "depth", "force", "stiffness k"]
    if curve.hardness is not None:
        header += ["unloading k_u", "corrected A/A_0"]
    elif curve.area_fraction is not None:
        header += ["raw area", "corrected A/A_0"]
    rows = []
    for i, heading in enumerate(starred(assessment)):
        if not curve.converged[i]:
            reason = Status(curve.status[i]).reason
            rows.append([heading, "-", "-", reason, "-", "-"][: len(header)])
            continue
        row = [
            heading,
            engineering(curve.depth[i], _SI["depth"]),
            engineering(scale * curve.force[i], _SI["force"]),
            _stiffness(curve.stiffness, loading, i, scale),
        ]
        if curve.hardness is not None and curve.unloading_stiffness is not None:
            row.append(_stiffness(curve.unloading_stiffness, unloading, i, scale))
        elif curve.area_fraction is not None:
            row.append(f"{curve.area_fraction[i]:.3%}")
        if curve.area_fraction_corrected is not None:
            share = float(curve.area_fraction_corrected[i])
            row.append(with_interval(share, _at(area, i), "%"))
        rows.append(row)
    return header, rows


def answer_table(
    assessment: Assessment,
    loads: slice,
    *,
    keys: Sequence[str] | None = None,
    with_elastic: bool = False,
) -> tuple[list[str], list[list[str]]]:
    """Header and rows of the answers, or of some of them, at some of the loads that were asked for.

    `with_elastic` puts the answer of elastic bodies below where yield changes it by more than its
    interval.
    """
    header = ["", *starred(assessment)[loads]]
    numbers = range(assessment.asked.size)[loads]
    rows = []
    for key in assessment.answers if keys is None else keys:
        each = assessment.answers[key]
        rows.append([f"{each.name} {each.symbol}", *(quantity(each, i) for i in numbers)])
        elastic = assessment.elastic.get(key) if with_elastic else None
        if elastic is not None and any(_differs(elastic, each, i) for i in numbers):
            rows.append([IF_ELASTIC, *(quantity(elastic, i) for i in numbers)])
    return header, rows


def load_table(assessment: Assessment, keys: Sequence[str]) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of some answers, with a row for each load that was asked for.

    Answers that a page begins with come first.
    """
    leading = [key for key in leading_keys(assessment) if key in keys]
    shown = [assessment.answers[key] for key in dict.fromkeys((*leading, *keys))]
    header = ["load", *(f"{each.name} {each.symbol}" for each in shown)]
    rows = [
        [heading, *(quantity(each, i) for each in shown)]
        for i, heading in enumerate(starred(assessment))
    ]
    return header, rows


def elastic_in_words(assessment: Assessment) -> str:
    """Say what the leading answers would be of elastic bodies, at the largest load.

    Answers that yield does not change by more than their interval are left out.
    """
    i = assessment.largest
    shown = []
    for key in leading_keys(assessment):
        elastic = assessment.elastic.get(key)
        if elastic is not None and _differs(elastic, assessment.answers[key], i):
            shown.append(f"{elastic.name} {quantity(elastic, i)}")
    return f"for comparison, {IF_ELASTIC}: {', '.join(shown)}" if shown else ""


def _differs(elastic: Answer, yielding: Answer, i: int) -> bool:
    """Whether elastic bodies give something else: beyond the interval, or a per cent without."""
    return differs(float(elastic.values[i]), float(yielding.values[i]), _at(yielding.ends, i))


def differs(other: float, value: float, ends: tuple[float, float] | None) -> bool:
    """Whether another value lies beyond the interval of a value, or a per cent off without one."""
    low, high = ends or (np.nan, np.nan)
    if np.isnan([low, high]).any():
        low, high = 0.99 * value, 1.01 * value
    return bool(other < low or other > high)


def formula_table(assessment: Assessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the answers' formulas, where they hold and their sources.

    Where the hardness scatters, a column says how far that changes each at the largest load.
    """
    header, i = ["", "formula", "validity", "source"], assessment.largest
    rows = [
        [f"{each.name} {each.symbol}", each.formula, each.validity, each.source]
        for each in assessment.answers.values()
    ]
    if assessment.hardness_scatter:
        header.append("change by scatter of hardness")
        for row, ratios in zip(rows, assessment.hardness_scatter.values(), strict=True):
            low, high = (float(end[i]) for end in ratios)
            row.append("not known" if np.isnan(low) else change_in_words(low, high))
    return header, rows


def symbol_table(assessment: Assessment) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the symbols of the formulas that are no answers."""
    question, pair = assessment.question, assessment.question.pair
    header = ["symbol", "meaning", "value"]
    if pair is None:
        return header, []
    rows = [
        [each.symbol, each.meaning, "" if each.value is None else _number(each.value, each.unit)]
        for each in symbols_of(
            [each.formula for each in assessment.answers.values()],
            pair,
            E_star=assessment.curve.E_star,
            hardness=assessment.curve.hardness or pair.hardness,
            area=question.joint or assessment.area,
            rms_height=assessment.body.rms_height,
        )
    ]
    return header, rows


def keys_at_many_loads(assessment: Assessment) -> list[str]:
    """Keys of the answers that are shown where there are too many loads for all of them."""
    return [
        key
        for key, each in assessment.answers.items()
        if each.leads or each.rule.is_shown_at_many_loads
    ]


def leading_keys(assessment: Assessment) -> list[str]:
    """Keys of the answers that a page begins with."""
    return [key for key, each in assessment.answers.items() if each.leads]


def told(assessment: Assessment, key: str) -> str:
    """Name and value of an answer at the largest load."""
    answer = assessment.answers[key]
    return f"{answer.name} {answer.symbol} {quantity(answer, assessment.largest)}"


def lead_of(assessment: Assessment) -> str:
    """What was asked: both materials, and the largest load with its nominal area."""
    pair, curve = assessment.question.pair, assessment.curve_as_asked
    if pair is None:
        return ""
    largest = assessment.largest
    force, pressure = (
        quantity(assessment.answers[key], largest) for key in ("normal_force", "mean_pressure")
    )
    joint = assessment.question.joint
    over = "the nominal area" if joint is None else f"a joint of {engineering(joint, 'm²')}"
    unsure = curve.converged[largest] and not curve.resolved[largest]
    count = assessment.asked.size
    which = f", the largest of {count} loads" if count > 1 else ""
    return sentence(
        f"{pair.first.name} on {pair.second.name} under {force}, {pressure} over {over}{which}"
        + (f" ({UNRESOLVED})" if unsure else "")
    )


def headline(assessment: Assessment) -> Headline:
    """The answers at the largest load, by the names that they have in the tables."""
    leading = leading_keys(assessment)
    shown = [assessment.answers[key] for key in figures_of(groups(assessment), leading)]
    return headline_of(
        [(each.name, quantity(each, assessment.largest)) for each in shown],
        assessment.warnings,
        [elastic_in_words(assessment)],
    )


def groups(assessment: Assessment) -> list[Group]:
    """The groups of its answers."""
    return groups_of(assessment.answers, leading_keys(assessment))


def star_is_shown(assessment: Assessment) -> bool:
    """Whether the grid decides one of the loads that were asked for."""
    return any(_decided_by_grid(assessment))


def quantity(answer: Answer, i: int) -> str:
    """Write one value of an answer, with its interval where that is known."""
    return with_interval(float(answer.values[i]), _at(answer.ends, i), unit_shown(answer))


def area_in_words(assessment: Assessment, load: int) -> str:
    """Write the corrected area fraction under a load of the curve, with the digits known of it."""
    share = assessment.curve.area_fraction_corrected
    if share is None:
        return "an area that is not known"
    written = with_interval(float(share[load]), _at(assessment.area_interval, load), "%")
    return value_and_interval(written)[0]


def unit_shown(answer: Answer) -> str:
    """Unit in which an answer is written: its own, or per cent."""
    return "%" if answer.rule.in_per_cent else answer.unit


def material_in_words(material: Material) -> str:
    """Name, moduli and hardness of a material, and where they are from."""
    parts = [f"E = {engineering(material.E, 'Pa')}", f"nu = {material.nu:g}"]
    if material.hardness:
        factor = material.hardness_factor
        known = f" to a factor of {factor:g}" if factor > 1 else ""
        parts.append(f"H = {engineering(material.hardness, 'Pa')}{known}")
    return f"{material.name} ({', '.join(parts)}; {material.source})"


def starred(assessment: Assessment) -> list[str]:
    """What each load is called, with a star where the grid decides."""
    stars = _decided_by_grid(assessment)
    return [
        f"{name} *" if star else name for name, star in zip(assessment.headings, stars, strict=True)
    ]


def _decided_by_grid(assessment: Assessment) -> list[bool]:
    """Which of the loads that were asked for have too few points in contact."""
    curve = assessment.curve_as_asked
    return list(curve.converged & ~curve.resolved & (curve.force > 0))


def _stiffness(values: Real, ends: Ends | None, i: int, scale: float) -> str:
    """Write a stiffness of the curve, times the scale of a joint, with its interval."""
    if ends is not None:
        ends = ends[0] * scale, ends[1] * scale
    return with_interval(scale * float(values[i]), _at(ends, i), _SI["stiffness"])


def _number(value: float, unit: str) -> str:
    return with_interval(value, None, unit)


def _at(ends: Ends | None, i: int) -> tuple[float, float] | None:
    return None if ends is None else (float(ends[0][i]), float(ends[1][i]))
