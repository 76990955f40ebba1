"""The power laws in the windows that are chosen, beside what the paper states."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from roughline.lab.frames import drawn
from roughline.lab.panels import PanelContent
from roughline.lab.published.controls import MODELS, WINDOWS
from roughline.lab.published.ensembles import normalised_law, stiffness_curve, usable_state
from roughline.lab.published.state import PublishedState
from roughline.lab.server.tasks import Arguments, Progress
from roughline.paper.claim import at
from roughline.paper.contact_area import SATURATED
from roughline.paper.laws import exponent_estimate, prefactor_estimate
from roughline.paper.stated import ModelLabel, StatedExponent, stated_exponents
from roughline.paper.tables import estimate_cell, three_digits
from roughline.paper.windows import ForceWindow
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.power_law import PowerLaw, linear_exponent, scaling_exponent
from roughline.statistics.verdict import ClaimCase, Verdict, in_words, joint_verdict
from roughline.statistics.window import inside_window

_FORMULAS = {"1D": "1 / (4 - D_f)", "3D": "0.2567 D_f"}  # of the paper, that lead
_OTHER_MODEL = {"1D": "0.5 to 0.75 (§6)", "3D": _FORMULAS["3D"]}  # that the paper states, too
_BODIES = {"1D": ("lines", "springs"), "3D": ("surfaces", "cells")}  # and what they carry loads by


@dataclass(frozen=True)
class _Fit:
    """The law of one fractal dimension, and what its curve is like in the window."""

    dimension: float
    law: PowerLaw
    is_saturated: bool  # nearly all is in contact at some load
    is_resolved: bool  # the grid decides at no load

    @classmethod
    def of(cls, state: PublishedState, model: ModelLabel, dimension: float) -> _Fit:
        law, curve = (
            normalised_law(state, model, dimension),
            stiffness_curve(model, dimension, state["mean"]),
        )
        inside = inside_window(curve.force_bar, law.window)
        is_saturated = curve.mean[inside].max() >= SATURATED * curve.mean.max()
        return cls(dimension, law, bool(is_saturated), bool(curve.resolved[inside].all()))

    @property
    def alpha(self) -> IntervalEstimate:
        return exponent_estimate(self.law)

    def verdict(self, stated: StatedExponent) -> Verdict | None:
        """Judge it; there is no power law where the curve is saturated."""
        return None if self.is_saturated else stated.verdict(self.alpha)


def fits(arguments: Arguments, progress: Progress) -> bytes:
    """The power laws of both models in their windows, with what the paper states beside them."""
    state, settled = usable_state(arguments)
    dimensions = sorted(state["D_f"])
    every = {m: [_Fit.of(state, m, d) for d in dimensions] for m in MODELS}
    panels = {"exponents": PanelContent()}
    answer: dict[str, Any] = {"windows": {}, "tables": {}, "words": {}, "strip": []}
    for model, found in every.items():
        keys = {edge.key for edge in WINDOWS[model]}
        refused = (text for key, text in settled["refused"].items() if key in keys)
        edges = [np.array([*each.law.window, np.nan]) for each in found]  # a gap before the next
        laws = [each.law(x) for each, x in zip(found, edges, strict=True)]
        panels[f"stiffness-{model}"] = PanelContent(
            {"fits": {"x": np.concatenate(edges), "y": np.concatenate(laws)}}
        )
        panels["exponents"].series[model] = {
            "x": [each.dimension for each in found],
            "y": [each.alpha.value for each in found],
            "low": [each.alpha.low for each in found],
            "high": [each.alpha.high for each in found],
        }
        answer["windows"][model] = window = state.window(model)
        answer["tables"][f"fit-{model}"] = {
            "header": ["D_f", "α", "ζ", "paper: 1 / (4 - D_f)", f"paper: {_OTHER_MODEL[model]}"],
            "rows": [_row(model, each) for each in found],
        }
        answer["words"][f"error-{model}"] = next(refused, "")
        answer["words"][f"doubt-{model}"] = _doubt(found)
        answer["words"][f"note-{model}"] = _note(state["mean"], window, model, found)
        answer["strip"] += _strip(model, found)
    rows = [answer["tables"][f"fit-{model}"]["rows"] for model in MODELS]
    answer["tables"]["published-exponents"] = {
        "header": ["D_f", *(f"α {model}" for model in MODELS), *_FORMULAS.values()],
        "rows": [
            [*one[:2], three[1], f"{scaling_exponent(d):.3f}", f"{linear_exponent(d):.3f}"]
            for d, one, three in zip(dimensions, *rows, strict=True)
        ],
    }
    return drawn({**settled, **answer}, panels, {})


def _row(model: ModelLabel, fit: _Fit) -> list[str]:
    """A row of the table of exponents: a verdict says against what and within what."""
    stated = [
        f"{each.value:.3f} ± {each.tolerance:g}: {fit.verdict(each) or 'not judged'}"
        for each in stated_exponents(model, fit.dimension)
    ]
    return [
        f"{fit.dimension:.1f}",
        estimate_cell(fit.alpha, " to ") + " *" * (not fit.is_resolved),
        estimate_cell(prefactor_estimate(fit.law), " to "),
        *stated,
        *["not stated"] * (2 - len(stated)),
    ]


def _doubt(found: list[_Fit]) -> str:
    """Say why exponents are not judged, where the curve comes to its end."""
    saturated = ", ".join(f"{each.dimension:.1f}" for each in found if each.is_saturated)
    if not saturated:
        return ""
    return (
        f"At D_f = {saturated} this window reaches into the saturation: k̄ comes to {SATURATED:.0%} "
        "or more of its end. There is no power law there, and α is not judged: end the window at "
        "lighter loads."
    )


def _note(mean: str, window: ForceWindow, model: ModelLabel, found: list[_Fit]) -> str:
    low, high = map(three_digits, window)
    law, (bodies, carriers) = found[0].law, _BODIES[model]
    star = f" *: at some of these loads fewer than ten {carriers} touch, so the grid decides."
    return (
        f"{law.points} loads from F̄ = {low} to {high}, {mean} mean of {law.realisations} {bodies}; "
        "in brackets 95 % intervals from resampled realisations. Confirmed: the interval lies "
        "within ± of what the paper states; refuted: it lies outside. From D_f = 2.8 on the paper "
        "speaks of a small discrepancy from 1 / (4 - D_f), so that more is allowed."
        + star
        * (not all(each.is_resolved for each in found))
    )


def _strip(model: ModelLabel, found: list[_Fit]) -> list[dict[str, str]]:
    """The exponents in large figures, and the paper's formula judged by them."""
    first, last = found[0], found[-1]
    stated = [stated_exponents(model, each.dimension)[model == "3D"] for each in found]
    verdicts = [each.verdict(one) for each, one in zip(found, stated, strict=True)]
    words = in_words([ClaimCase(at(x.dimension), v) for x, v in zip(found, verdicts, strict=True)])
    decided = [each for each in verdicts if each]
    within = " or ".join(f"{x:g}" for x in sorted({each.tolerance for each in stated}))
    alpha, place = estimate_cell(first.alpha, " to "), f"D_f = {first.dimension:.1f}"
    if last is not first:
        alpha = f"{first.alpha.value:.3f} to {last.alpha.value:.3f}"
        place += f" to {last.dimension:.1f}"
    below = f"within ± {within}: {'at every D_f' if words in set(Verdict) else words}"
    together = str(joint_verdict(decided)) if decided else "not judged"
    meaning = f"Exponent of the stiffness over force in the window, of {_BODIES[model][0]}."
    other = "What the paper states; one refuted fractal dimension refutes it."
    items = (
        (f"exponent_{model}", f"α ({model})", alpha, place, meaning),
        (f"stated_{model}", f"paper: {_FORMULAS[model]}", together, below, other),
    )
    names = ("key", "symbol", "value", "below", "meaning")
    return [dict(zip(names, item, strict=True)) for item in items]
