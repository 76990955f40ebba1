"""Figures 3, 4 and 5: curves, and the power laws in the windows that are chosen."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from roughline.contact import scaling
from roughline.lab.frames import frame
from roughline.lab.published import controls as c
from roughline.lab.published.ensembles import (
    curve_of,
    law_of,
    model_of,
    punch_of,
    table_of,
    unresolved_in_window,
    usable_state,
)
from roughline.lab.published.state import PublishedState
from roughline.lab.server.tasks import Arguments, Progress
from roughline.paper.claim import at
from roughline.paper.laws import exponent_estimate, prefactor_estimate
from roughline.paper.stated import (
    EXPONENT_TOLERANCE,
    SMALL_DISCREPANCY,
    StatedExponent,
    stated_exponents,
)
from roughline.paper.tables import estimate_cell
from roughline.statistics.power_law import PowerLaw
from roughline.statistics.verdict import Case, Verdict, in_words, joint_verdict
from roughline.units import decimal

_DIGITS = 3


def curves(arguments: Arguments, progress: Progress) -> bytes:
    """Mean stiffness over force of both models, for the chosen fractal dimensions."""
    state, settled = usable_state(arguments)
    return frame(
        {
            **settled,
            "models": {model: _curves(state, model_of(model)) for model in c.MODELS},
        }
    )


def fits(arguments: Arguments, progress: Progress) -> bytes:
    """The power laws of one model in its window, with what the paper states beside them."""
    state, settled = usable_state(arguments)
    model = model_of(arguments.get("model"))
    laws = {dimension: law_of(state, model, dimension) for dimension in state.dimensions}
    low, high = state.windows[model]
    header, rows = _rows(state, model, laws)
    return frame(
        {
            **settled,
            "model": model,
            "window": [low, high],
            "laws": [_law(dimension, law) for dimension, law in laws.items()],
            "header": header,
            "rows": rows,
            "note": _note(state, model, laws),
            "strip": _strip(model, laws),
        }
    )


def _curves(state: PublishedState, model: c.ModelLabel) -> dict[str, Any]:
    punch = punch_of(state, model)
    found = {d: curve_of(model, d, punch, state.mean) for d in state.dimensions}
    names = ("force_bar", "mean", "low", "high", "resolved")
    drawn = [
        {
            "index": c.DIMENSIONS.index(dimension),
            "D_f": f"{dimension:.1f}",
            **{name: getattr(curve, name) for name in names},
        }
        for dimension, curve in found.items()
    ]
    return {
        "curves": drawn,
        "saturated": scaling.EXACT_PUNCH / punch if model == "3D" else 1.0,
        "label": f"stiffness k̄ = k / ({'' if punch == 1 else f'{punch:g} '}E* L)",
        **table_of("k̄", drawn),
    }


def _law(dimension: float, law: PowerLaw) -> dict[str, Any]:
    """What is drawn of a law: its line, and its exponent over fractal dimension."""
    edges = np.array(law.window)
    return {
        "index": c.DIMENSIONS.index(dimension),
        "D_f": dimension,
        "exponent": law.exponent,
        "interval": law.exponent_interval,
        "prefactor": law.prefactor,
        "x": edges,
        "y": law(edges),
    }


def _rows(
    state: PublishedState, model: c.ModelLabel, laws: Mapping[float, PowerLaw]
) -> tuple[list[str], list[list[str]]]:
    """The table of exponents: header and rows."""
    rows = []
    for dimension, law in laws.items():
        alpha = exponent_estimate(law)
        star = " *" if unresolved_in_window(model, dimension, state.windows[model]) else ""
        stated = [_stated_cell(each, law) for each in stated_exponents(model, dimension)]
        rows.append(
            [
                f"{dimension:.1f}",
                estimate_cell(alpha) + star,
                estimate_cell(prefactor_estimate(law)),
                *stated,
                *["not stated"] * (2 - len(stated)),
            ]
        )
    other = "paper: 0.2567 D_f" if model == "3D" else "paper: 0.5 to 0.75 (§6)"
    return ["D_f", "α (95 % interval)", "ζ", "paper: 1 / (4 - D_f)", other], rows


def _stated_cell(stated: StatedExponent, law: PowerLaw) -> str:
    verdict = stated.verdict(exponent_estimate(law))
    return f"{stated.value:.3f}, {verdict}"


def _note(state: PublishedState, model: c.ModelLabel, laws: Mapping[float, PowerLaw]) -> str:
    low, high = state.windows[model]
    law = next(iter(laws.values()))
    bodies = "lines" if model == "1D" else "surfaces"
    text = (
        f"{law.points} loads from F̄ = {decimal(low, _DIGITS)} to {decimal(high, _DIGITS)}, "
        f"{state.mean} mean of {law.realisations} {bodies}, intervals from resampled realisations. "
        f"The paper's exponents are judged with ± {EXPONENT_TOLERANCE:g}, and 1 / (4 - D_f) with "
        f"± {SMALL_DISCREPANCY:g} from D_f = 2.8 on, where it speaks of a small discrepancy."
    )
    if any(unresolved_in_window(model, dimension, (low, high)) for dimension in laws):
        carriers = "springs" if model == "1D" else "cells"
        text += f" *: at some of these loads fewer than ten {carriers} touch, so the grid decides."
    return text


def _strip(model: c.ModelLabel, laws: Mapping[float, PowerLaw]) -> list[dict[str, str]]:
    """The exponents in large figures, and the paper's formula judged by them."""
    first, last = (laws[pick(laws)] for pick in (min, max))
    alone = len(laws) == 1
    dimensions = f"D_f = {min(laws):.1f}" if alone else f"D_f = {min(laws):.1f} to {max(laws):.1f}"
    shown = (
        estimate_cell(exponent_estimate(first))
        if alone
        else f"{first.exponent:.3f} to {last.exponent:.3f}"
    )
    place = 1 if model == "3D" else 0
    stated = {dimension: stated_exponents(model, dimension)[place] for dimension in laws}
    formula = "0.2567 D_f" if model == "3D" else "1 / (4 - D_f)"
    verdicts = [each.verdict(exponent_estimate(laws[d])) for d, each in stated.items()]
    return [
        _item(
            f"exponent_{model}",
            f"α ({model})",
            shown,
            dimensions,
            f"Exponent of the stiffness over force, k̄ = ζ F̄^α, of the {_model_name(model)} in "
            "its window.",
        ),
        _item(
            f"stated_{model}",
            f"paper: {formula}",
            str(joint_verdict(verdicts)),
            _case_by_case(stated, laws),
            "The exponent that the paper states, judged by the intervals of this window; one "
            "refuted fractal dimension refutes it.",
        ),
    ]


def _case_by_case(stated: Mapping[float, StatedExponent], laws: Mapping[float, PowerLaw]) -> str:
    """The verdict in words, case by case where the cases differ."""
    words = in_words(
        [Case(at(d), each.verdict(exponent_estimate(laws[d]))) for d, each in stated.items()]
    )
    return "at every D_f" if words in set(Verdict) else words


def _model_name(model: c.ModelLabel) -> str:
    return "reduced model, lines on springs" if model == "1D" else "full model, surfaces"


def _item(key: str, symbol: str, value: str, below: str, meaning: str) -> dict[str, str]:
    return {"key": key, "symbol": symbol, "value": value, "below": below, "meaning": meaning}
