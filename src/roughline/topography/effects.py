"""What the steps of a preparation did to the roughness: recorded in the settings, and said."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from roughline.topography.body import Body, BodyType, sides_of
from roughline.topography.settings import Settings
from roughline.units import in_words

_NOTHING = 1e-3  # relative change of rms height and slope below which a step did nothing
_MOST = 0.5  # share of the rms height whose loss is warned of
_LEFT = "left_of_rms_"  # part of the names in the settings


def with_effect(before: BodyType, after: BodyType, step: str) -> BodyType:
    """Return a body after a step; its settings record the shares that the step left."""
    left = {
        f"{step}_{_LEFT}height": _share(after.rms_height, before.rms_height),
        f"{step}_{_LEFT}slope": _share(after.rms_slope, before.rms_slope),
    }
    return replace(after, settings={**after.settings, **left})


def effect_of_trend(before: float, after: float) -> Settings:
    """Return the record of a trend that was most of the rms height; nothing of a smaller one."""
    share = _share(after, before)
    return {f"detrended_{_LEFT}height": share} if share < 1 - _MOST else {}


@dataclass(frozen=True)
class _Effect:
    """What a step did."""

    text: str  # in words
    is_grave: bool = False  # whether it took most of the rms height, which a removed trend may do
    # whether it changed nothing; no spikes are no fault of who lets them be removed
    is_idle: bool = False


def effects(body: Body) -> list[_Effect]:
    """Return what each step did to the rms height and slope, and which steps changed nothing."""
    found = []
    if body.settings.get("cropped_share") == 1:
        found.append(_Effect("the crop keeps all points: it changes nothing", is_idle=True))
    if body.settings.get("scars_removed") == 0:
        found.append(_Effect("no scars are found, so none is removed"))
    if body.settings.get("outliers_removed") == 0:
        found.append(_Effect("no spikes are found, so none is removed"))
    for step, name in _NAMES.items():
        if f"{step}_{_LEFT}height" in body.settings:
            found.append(_effect(body, step, name(body)))
    if "low_pass_kept" in body.settings:
        sides = " x ".join(in_words(side, body.unit) for side in sides_of(body))
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


def _effect(body: Body, step: str, name: str) -> _Effect:
    """What a step did, from the shares that the settings record."""
    left = [body.settings.get(f"{step}_{_LEFT}{of}", 1.0) for of in ("height", "slope")]
    height, slope = map(float, left)
    verbs: dict[str, list[str]] = {}
    for share, of in ((height, "height"), (slope, "slope")):
        if abs(share - 1) >= _NOTHING:
            verb = "lowers" if share < 1 else "raises"
            verbs.setdefault(verb, []).append(f"the rms {of} by {_per_cent(abs(share - 1))}")
    if not verbs:
        return _Effect(f"{name} changes neither rms height nor rms slope", is_idle=True)
    changes = [f"{verb} {' and '.join(which)}" for verb, which in verbs.items()]
    said = f"{name} {' and '.join(changes)}"
    if step in ("detrended", "levelled") or height >= 1 - _MOST:
        return _Effect(said)
    return _Effect(
        f"{said}: most of the roughness is gone, and answers are those of what is left",
        is_grave=True,
    )


def _share(after: float, before: float) -> float:
    """What is left of a value; all of nothing."""
    return after / before if before else 1.0


def _per_cent(share: float) -> str:
    if 0.995 <= share < 1:
        return "more than 99%"
    return f"{100 * share:.2g}%" if share < 0.1 else f"{share:.0%}"


_NAMES: dict[str, Callable[[Body], str]] = {
    "levelled": lambda body: (
        f"levelling line by line ({body.settings['lines_levelled']}), which takes steps between "
        "lines and tilt and waves across them, also where they are the surface's,"
    ),
    "scars": lambda body: f"the removal of scars ({body.settings['scars_removed']} points)",
    "outliers": lambda body: "the removal of spikes",
    "detrended": lambda body: f"the removal of the {body.settings['detrended']}",
    "low_pass": lambda body: (
        f"the low pass of {in_words(float(body.settings['low_pass']), body.unit)}"
    ),
    "resampled": lambda body: f"resampling to {body.settings['resampled_to']} points",
}
