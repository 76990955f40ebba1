"""What the steps of a preparation did to the roughness, in words."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from roughline.topography.body import Body, BodyType, side_lengths
from roughline.topography.provenance import Left, Step, with_facts
from roughline.units import in_words

_NO_EFFECT = 1e-3  # relative change of rms height and slope below which a step did nothing
_LARGEST_LOSS = 0.5  # share of the rms height whose loss is warned of


def with_effect(before: BodyType, after: BodyType, step: Step) -> BodyType:
    """Return a body after a step, with the shares of the roughness that the step left."""
    left = Left(
        step,
        _share(after.rms_height, before.rms_height),
        _share(after.rms_slope, before.rms_slope),
    )
    return replace(after, **with_facts(after, left=after.provenance.also_left(left)))


def effect_of_trend(before: float, after: float) -> Left | None:
    """Return what a trend left that was most of the rms height; None of a smaller one."""
    share = _share(after, before)
    return Left("detrended", share) if share < 1 - _LARGEST_LOSS else None


@dataclass(frozen=True)
class _Effect:
    """What a step did."""

    text: str  # in words
    is_grave: bool = False  # whether it took most of the rms height, which a removed trend may do
    # whether it changed nothing; no spikes are no fault of who lets them be removed
    is_idle: bool = False


def effects(body: Body) -> list[_Effect]:
    """Return what each step did to the rms height and slope, and which steps changed nothing."""
    found, done = [], body.provenance
    if done.cropped_share == 1:
        found.append(_Effect("the crop keeps all points: it changes nothing", is_idle=True))
    if done.scars_removed == 0:
        found.append(_Effect("no scars are found, so none is removed"))
    if done.outliers_removed == 0:
        found.append(_Effect("no spikes are found, so none is removed"))
    for step, name in _NAMES.items():
        if left := done.left_by(step):
            found.append(_effect(left, name(body)))
    if done.low_pass_kept:
        sides = " x ".join(in_words(side, body.unit) for side in side_lengths(body))
        found.append(
            _Effect(
                "half a cutoff of the low pass is left out at each border, beyond which no heights "
                f"are known: {sides} stay, and loads act on them"
            )
        )
    return found


def grave_effects(body: Body) -> tuple[str, ...]:
    """Warn of steps that took most of the rms height."""
    return tuple(each.text for each in effects(body) if each.is_grave)


def _effect(left: Left, name: str) -> _Effect:
    """What a step did, from the shares that it left."""
    height, slope = left.height, 1.0 if left.slope is None else left.slope
    verbs: dict[str, list[str]] = {}
    for share, of in ((height, "height"), (slope, "slope")):
        if abs(share - 1) >= _NO_EFFECT:
            verb = "lowers" if share < 1 else "raises"
            verbs.setdefault(verb, []).append(f"the rms {of} by {_per_cent(abs(share - 1))}")
    if not verbs:
        return _Effect(f"{name} changes neither rms height nor rms slope", is_idle=True)
    changes = [f"{verb} {' and '.join(which)}" for verb, which in verbs.items()]
    text = f"{name} {' and '.join(changes)}"
    if left.step in ("detrended", "levelled") or height >= 1 - _LARGEST_LOSS:
        return _Effect(text)
    return _Effect(
        f"{text}: most of the roughness is gone, and answers are those of what is left",
        is_grave=True,
    )


def _share(after: float, before: float) -> float:
    """What is left of a value; all of nothing."""
    return after / before if before else 1.0


def _per_cent(share: float) -> str:
    if 0.995 <= share < 1:
        return "more than 99%"
    return f"{100 * share:.2g}%" if share < 0.1 else f"{share:.0%}"


_NAMES: dict[Step, Callable[[Body], str]] = {
    "levelled": lambda body: (
        f"levelling line by line ({body.provenance.lines_levelled}), which takes steps between "
        "lines and tilt and waves across them, also where they are the surface's,"
    ),
    "scars": lambda body: f"the removal of scars ({body.provenance.scars_removed} points)",
    "outliers": lambda body: "the removal of spikes",
    "detrended": lambda body: f"the removal of the {body.removed_trend}",
    "low_pass": lambda body: (
        f"the low pass of {in_words(body.provenance.low_pass or 0.0, body.unit)}"
    ),
    "resampled": lambda body: f"resampling to {body.provenance.resampled_to} points",
}
