"""What the steps of a preparation did: to the roughness, and beside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from roughline.facts.fact import Fact
from roughline.facts.kinds import UNCHANGED
from roughline.topography.body import Body, BodyType, side_lengths
from roughline.topography.provenance import Left, Step, with_facts

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

    fact: Fact  # grave if it took most of the rms height, which a removed trend may do
    # whether it changed nothing; no spikes are no fault of who lets them be removed
    is_idle: bool = False


def effects(body: Body) -> list[_Effect]:
    """Return what each step did to the rms height and slope, and which steps changed nothing."""
    found, done = [], body.provenance
    if done.cropped_share == 1:
        found.append(_Effect(Fact("crop_keeps_all"), is_idle=True))
    if done.scars_removed == 0:
        found.append(_Effect(Fact("none_found", what="scars")))
    if done.outliers_removed == 0:
        found.append(_Effect(Fact("none_found", what="spikes")))
    for step, how in _HOW.items():
        if left := done.left_by(step):
            found.append(_effect(left, how(body), body.unit))
    if done.low_pass_kept:
        sides = side_lengths(body)
        found.append(_Effect(Fact("low_pass_leaves_border", sides=sides, unit=body.unit)))
    return found


def what_was_prepared(body: Body) -> list[Fact]:
    """Say what was corrected, masked and filled, what spikes there are, and what steps did."""
    known, done = body.provenance, [each.fact for each in effects(body)]
    found = [each for each in done if each.is_grave]
    if known.corrected:
        found.append(Fact("corrected", form=known.format, how=known.corrected))
    if mask := known.masked:
        found.append(Fact("masked", by=mask.by, share=mask.share, are_used=mask.are_used))
    if fill := known.filled:
        found.append(Fact("filled", points=fill.points, share=fill.share, method=fill.method))
    for name in _COUNTED:
        if points := getattr(known, name):
            found.append(Fact(name, points=points))
    return found + [each for each in done if not each.is_grave]


def grave_effects(body: Body) -> tuple[Fact, ...]:
    """Warn of steps that took most of the rms height."""
    return tuple(each.fact for each in effects(body) if each.fact.is_grave)


def _effect(left: Left, how: str | float | None, unit: str | None) -> _Effect:
    """What a step did, from the shares that it left."""
    height, slope = left.height, 1.0 if left.slope is None else left.slope
    is_meant = left.step in ("detrended", "levelled")
    most_is_gone = not is_meant and height < 1 - _LARGEST_LOSS
    numbers = {"step": left.step, "how": how, "unit": unit, "left": (height, slope)}
    fact = Fact("step_changes", **numbers, height=height, most_is_gone=most_is_gone)
    is_idle = max(abs(height - 1), abs(slope - 1)) < UNCHANGED
    return _Effect(fact.grave(most_is_gone), is_idle)


def _share(after: float, before: float) -> float:
    """What is left of a value; all of nothing."""
    return after / before if before else 1.0


_HOW: dict[Step, Callable[[Body], str | float | None]] = {
    "levelled": lambda body: body.provenance.lines_levelled,
    "scars": lambda body: body.provenance.scars_removed,
    "outliers": lambda _body: None,
    "detrended": lambda body: body.removed_trend,
    "low_pass": lambda body: body.provenance.low_pass,
    "resampled": lambda body: body.provenance.resampled_to,
}
"""How each step was done."""

_COUNTED = ("filled_between_levels", "filled_before_crop", "outliers_kept", "outliers_removed")
"""What is told by the number of points."""
