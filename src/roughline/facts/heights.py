"""What was done to heights, what is suspicious in them, and what they show of assumptions."""

from __future__ import annotations

from typing import Literal

from roughline.errors.words import called
from roughline.facts.fact import DATA, INTERVALS, LIMITS, Fact, Wording, kind
from roughline.units import decimal, engineering, in_words

NO_EFFECT = 1e-3
"""Relative change of rms height and slope below which a step did nothing."""


@kind(DATA, "note")
def corrected(form: str, how: str) -> Wording:
    """A reader corrected what the file says."""
    return f"corrected as it was read ({form}): {how}"


@kind(DATA, "note")
def masked(by: str, share: float, are_used: bool) -> Wording:
    """Points that the file masks."""
    rest = "they are left out, and filled like missing points"
    if are_used:
        rest = f"their heights are used ({called('mask', 'leave-out')} leaves them out)"
    short = f"masked in {by}: {share:.1%} of the points"
    return short, f"{short}; {rest}"


@kind(DATA, "note")
def filled(points: int, share: float, method: str) -> Wording:
    """Missing points that were filled."""
    return f"{points} missing points ({share:.2%}) filled: {method}"


@kind(DATA, "note")
def filled_between_levels(points: int) -> Wording:
    """Points that were filled before lines were levelled."""
    return (
        f"{points} missing points were filled before lines were levelled: do both in one step",
        f"{points} missing points were filled before lines were levelled, between the levels of "
        "neighbouring lines, and may stand off: fill and level in one step, by a question about "
        "the file itself (rl.Question) or on the command line",
    )


@kind(DATA, "note")
def filled_before_crop(points: int) -> Wording:
    """Points that were filled in a larger piece."""
    return (
        f"{points} missing points had been filled before this piece was cropped",
        f"{points} missing points had been filled before this piece was cropped, and it is not "
        "known how many of them are in it",
    )


@kind(DATA, "note")
def spikes_kept(points: int) -> Wording:
    """Spikes that are still there."""
    remove = called("remove_outliers", True)
    return (
        f"{points} spikes kept: check whether they are real, or remove them ({remove})",
        f"{points} spikes kept; the highest point decides the depth of first touch, so check "
        f"whether they are real, or remove them ({remove})",
    )


@kind(DATA, "note")
def spikes_removed(points: int) -> Wording:
    """Spikes that were taken out."""
    return f"{points} spikes removed and filled"


@kind(DATA, "note")
def cropped_to_common(which: str, sides: tuple[float, float]) -> Wording:
    """A surface that was laid on a smaller one."""
    sizes = " x ".join(engineering(each, "m") for each in sides)
    return f"{which} body: cropped to what both have in common, {sizes}, from x = y = 0"


@kind(DATA, "note")
def resampled_to_first(pixel: tuple[float, float]) -> Wording:
    """A second surface on the first's points."""
    sizes = " x ".join(engineering(each, "m") for each in pixel)
    return f"second body: resampled by cubic splines to pixels of {sizes}, the first's"


@kind(LIMITS, "grave")
def flat() -> Wording:
    """No heights at all."""
    return "all heights are equal: this is a flat punch, or an empty channel"


@kind(LIMITS, "grave")
def odd_rms_height(rms: float) -> Wording:
    """An rms height that roughness does not have. [m]"""
    height = engineering(rms, "m")
    return (
        f"the rms height is {height}; roughness is mostly between 1 pm and 1 mm: check the unit",
        f"the rms height is {height}; roughness is mostly between 1 pm and 1 mm: check the unit, "
        "the tilt, and whether heights share the unit of the sides",
    )


@kind(LIMITS, "grave")
def odd_slope(slope: float, is_small: bool) -> Wording:
    """An rms slope that surfaces do not have."""
    if is_small:
        return (
            f"the rms slope is {slope:.3g}; polished mirrors reach 1e-5: check the units",
            f"the rms slope is {slope:.3g}; polished mirrors reach 1e-5: check whether heights and "
            "sides have the units that they are read in",
        )
    return (
        f"the rms slope is {slope:.3g}, and instruments do not reach 1: check unit and outliers",
        f"the rms slope is {slope:.3g}; theories and instruments do not reach slopes of 1: check "
        "the unit, and outliers",
    )


@kind(LIMITS, "grave")
def odd_sides(sides: tuple[float, ...], are_pixels: bool) -> Wording:
    """Sides, or pixels of an optical instrument, that no instrument has. [m]"""
    lengths = " x ".join(engineering(each, "m") for each in sides)
    if are_pixels:
        return (
            f"the pixels are {lengths}; optical ones are below 1 mm: check the unit",
            f"the pixels are {lengths}; those of optical instruments are below 1 mm: check the "
            "unit of the sides",
        )
    return (
        f"the sides are {lengths}; instruments measure 10 nm to 1 m: check the unit",
        f"the sides are {lengths}; instruments measure 10 nm to 1 m: check the unit of the sides",
    )


@kind(LIMITS, "grave")
def odd_pixels(spacing: tuple[float, float]) -> Wording:
    """Pixels that are far from square. [m]"""
    return f"pixels are {' x '.join(in_words(each, 'm') for each in spacing)}: check the sizes"


@kind(LIMITS, "grave")
def rows_jump(rms: float, by_chance: float, unit: str | None) -> Wording:
    """Lines of a map jump."""
    jump, chance = (in_words(each, unit, 2) for each in (rms, by_chance))
    remedy = called("lines", "median")
    return (
        f"rows jump by {jump} rms, by chance {chance}: level them ({remedy})",
        f"rows jump: medians of neighbouring lines along x differ by {jump} (rms), and their "
        f"points explain {chance}: unless grooves of the surface run along x, level them line by "
        f"line ({remedy}), which also takes tilt and waves across them",
    )


@kind(LIMITS, "grave")
def steep(slope: float, limit: float) -> Wording:
    """Slopes that half-spaces do not allow for."""
    number = decimal(slope, 2)
    return (
        f"the rms slope is {number}: no interval includes the effect of slopes over {limit:g}",
        f"the rms slope is {number}, and half-spaces assume small slopes: no interval includes the "
        f"effect of slopes over {limit:g}",
    )


@kind(INTERVALS)
def heights_in_steps(share: float) -> Wording:
    """Heights in line with their neighbours to the last digit."""
    return (
        f"{share:.0%} of the heights stand in steps: measure finer ones, or a larger range",
        f"{share:.0%} of the heights lie in line with their neighbours to the last digit, which "
        "chance does not do: they are rounded, filled, or at the end of the instrument's "
        "range, so slopes there are not the surface's: measure with finer steps or a larger range",
    )


@kind(INTERVALS)
def many_filled(share: float) -> Wording:
    """Points are missing, and summits with them."""
    crop = called("crop")
    return (
        f"{share:.0%} of the points are missing and were filled: measure again, or {crop}",
        f"{share:.0%} of the points are missing and were filled, so that summits may be "
        f"missing as well: measure again, or crop to where points are known ({crop})",
    )


@kind(INTERVALS)
def heights_on_a_level(share: float) -> Wording:
    """The range of an instrument ends."""
    number = f"{100 * share:.2g}%"
    return (
        f"{number} of the heights are equal: take a larger range, or mark missing points",
        f"{number} of the heights are equal to the last digit: the range of the "
        "instrument ends there, and cuts summits off, or missing points were written as a "
        "number: measure with a larger range, or mark missing points",
    )


@kind(INTERVALS)
def map_jumps(
    height: float, scatter: float, axis: str, at: float, unit: str | None, is_row: bool
) -> Wording:
    """A row that stands off, or all rows from one on."""
    jump, others = (in_words(abs(each), unit, 2) for each in (height, scatter))
    place = f"at {axis} = {in_words(at, unit, 3)}"
    side = "above" if height > 0 else "below"
    if is_row:
        return (
            f"{place} a row stands {jump} {side} others: mark it missing",
            f"{place} a whole row stands {jump} {side} those beside it, and others scatter by "
            f"{others}: one line of the instrument is off: mark it as missing, or measure again",
        )
    crop = called("crop")
    return (
        f"{place} heights jump by {jump}: take either side ({crop})",
        f"{place} all heights beyond stand {jump} {side} those before, and other rows scatter by "
        f"{others}: the instrument jumped, or two faces are seen: take either side "
        f"({crop}), or measure again",
    )


@kind(INTERVALS)
def beyond_chance(fact: Fact, what: str) -> Wording:
    """What chance does not explain in a map or a scan, and what would tell more."""
    if what == "map":
        short, remedy = "press more maps", "several maps of a part show what one does not"
    else:
        short, remedy = "measure a map", "measure a map"
    return f"{fact.in_short}: {short}", f"{fact}: {remedy}"


@kind(INTERVALS)
def differs_between_places(parts: int, factor: float, spread: float, chance: float) -> Wording:
    """The rms slope scatters between places, by factors."""
    return (
        f"slopes scatter by {factor:.3g} between places, by chance {chance:.3g}",
        f"roughness is not alike everywhere: between {parts} parts the rms slope scatters by a "
        f"factor of {factor:.3g}, from least to largest by {spread:.3g}, and chance explains "
        f"{chance:.3g}",
    )


@kind(INTERVALS)
def drifts(along: str, factor: float, chance: float) -> Wording:
    """The rms slope changes along a side, by factors."""
    return (
        f"slopes drift by {factor:.2f} along {along}, by chance {chance:.2f}",
        f"roughness drifts over the map: along {along} the rms slope changes by a factor of "
        f"{factor:.2f}, and chance allows {chance:.2f}, so that the surface beyond is likely to "
        "differ as well",
    )


@kind(INTERVALS)
def slopes_differ_by_direction(
    wave: float, unit: str | None, ratio: float, chance: float
) -> Wording:
    """Slopes have a lay: the least over the largest, of waves over a length."""
    return (
        f"slopes differ by direction, by {ratio:.2f}, by chance {chance:.2f}",
        f"slopes differ by direction: of waves over {in_words(wave, unit, 2)}, the least is "
        f"{ratio:.2f} of the largest, and chance allows {chance:.2f}",
    )


@kind(INTERVALS)
def skewed(of: str, skewness: float, chance: float) -> Wording:
    """Heights of a map, or of one of its coarser selves, are skewed."""
    value, allowed = (in_words(each, None, 2) for each in (skewness, chance))
    return (
        f"not Gaussian, skewness {value}, by chance {allowed}",
        f"heights are not Gaussian: the skewness of {of} is {value}, and chance allows {allowed}",
    )


@kind(INTERVALS)
def long_tailed(of: str, kurtosis: float, chance: float) -> Wording:
    """Heights of a map, or of one of its coarser selves, have other tails."""
    value, allowed = (in_words(each, None, 2) for each in (kurtosis, chance))
    return (
        f"not Gaussian, kurtosis {value}, by chance 3 ± {allowed}",
        f"heights are not Gaussian: the kurtosis of {of} is {value}, and chance allows 3 with "
        f"{allowed} more or less",
    )


@kind(INTERVALS)
def slopes_differ_by_height(places: str, ratio: float, least: float, most: float) -> Wording:
    """High places are steeper, or less steep, than all."""
    value, *ends = (in_words(each, None, 2) for each in (ratio, least, most))
    return (
        f"tops are {value} times as steep, by chance {' to '.join(ends)}",
        f"heights are not Gaussian: the rms slope of {places} is {value} of that of all, and "
        f"chance allows {' to '.join(ends)}",
    )


@kind(INTERVALS)
def no_roll_off(what: str) -> Wording:
    """The longest waves are missing."""
    return (
        f"the {what} shows no roll-off, so longer waves are missing: take a longer {what}",
        f"the {what} shows no roll-off: its spectrum still rises at its longest waves, so longer "
        f"ones are missing: a longer {what} would hold more of them",
    )


@kind(INTERVALS)
def levelled_by_lines(what: str) -> Wording:
    """Waves across lines are gone."""
    return (
        "levelling line by line hides long waves: measure with less drift",
        f"the {what} was levelled line by line, which takes waves across its lines with their "
        "jumps, so its heights do not tell whether it lies on waves longer than itself: measure "
        "with less drift, or along both sides",
    )


@kind(INTERVALS)
def levelled_before(what: str) -> Wording:
    """The tilt is not known."""
    mounting = called("tilt", "mounting")
    return (
        f"its tilt was removed before: give it as measured, or {mounting}",
        f"the {what} was levelled before it was given, so its heights do not tell whether it lies "
        f"on waves longer than itself: give it as it was measured, or {_say_so()}",
    )


@kind(INTERVALS)
def tilted(what: str, rms: float, explained: float, unit: str | None) -> Wording:
    """A tilt that the body's own waves do not explain."""
    tilt, own = (in_words(each, unit, 2) for each in (rms, explained))
    mounting = called("tilt", "mounting")
    return (
        f"tilt of {tilt} rms, by its own waves {own}: {_more(what)}, or {mounting}",
        f"the tilt of the {what} has an rms height of {tilt}, and its own waves explain {own}: the "
        f"rest is the mounting's, or of waves longer than the {what}: {_larger(what)}, or "
        f"{_say_so()}",
    )


@kind(INTERVALS)
def bowed(what: str, shape: str, rms: float, explained: float, unit: str | None) -> Wording:
    """A bow, or the longest shape, that the body's own waves do not explain."""
    height, own = (in_words(each, unit, 2) for each in (rms, explained))
    return (
        f"{shape} of {height} rms, by its own waves {own}: {_more(what)}",
        f"the {what} lies on waves longer than itself: its {shape} has an rms height of {height}, "
        f"and its own waves explain {own}: {_larger(what)}",
    )


def _larger(what: str) -> str:
    return "map a larger area, or several places" if what == "map" else "scan a longer line"


def _more(what: str) -> str:
    return "map more" if what == "map" else "scan more"


def _say_so() -> str:
    return f"say that the tilt is the mounting's ({called('tilt', 'mounting')})"


@kind(DATA, "note")
def crop_keeps_all() -> Wording:
    """A crop that crops nothing."""
    return "the crop keeps all points: it changes nothing"


@kind(DATA, "note")
def none_found(what: Literal["scars", "spikes"]) -> Wording:
    """A step that found nothing to remove."""
    return f"no {what} are found, so none is removed"


@kind(DATA, "note")
def low_pass_leaves_border(sides: tuple[float, ...], unit: str | None) -> Wording:
    """What a low pass leaves of a piece."""
    stay = " x ".join(in_words(side, unit) for side in sides)
    return (
        f"half a cutoff of the low pass is left out at each border: {stay} stay",
        "half a cutoff of the low pass is left out at each border, beyond which no heights are "
        f"known: {stay} stay, and loads act on them",
    )


@kind(DATA, "note")
def step_changes(
    step: Literal["levelled", "scars", "outliers", "detrended", "low_pass", "resampled"],
    how: str | float | None,
    unit: str | None,
    height: float,
    slope: float,
    most_is_gone: bool,
) -> Wording:
    """Which shares of rms height and slope a step left; `how` says how it was done.

    That is the way in which lines were levelled, the trend, the points of scars or of a grid, or
    the cutoff of a low pass.
    """
    name = {
        "levelled": f"levelling line by line ({how})",
        "scars": f"the removal of scars ({how} points)",
        "outliers": "the removal of spikes",
        "detrended": f"the removal of the {how}",
        "low_pass": f"the low pass of {in_words(how, unit) if isinstance(how, float) else how}",
        "resampled": f"resampling to {how} points",
    }[step]
    subject = name
    if step == "levelled":
        subject += (
            ", which takes steps between lines and tilt and waves across them, also where they are "
            "the surface's,"
        )
    verbs: dict[str, list[str]] = {}
    for share, of in ((height, "height"), (slope, "slope")):
        if abs(share - 1) >= NO_EFFECT:
            verb = "lowers" if share < 1 else "raises"
            verbs.setdefault(verb, []).append(f"the rms {of} by {_per_cent(abs(share - 1))}")
    changes = " and ".join(f"{verb} {' and '.join(which)}" for verb, which in verbs.items())
    changes = changes or "changes neither rms height nor rms slope"
    if not most_is_gone:
        by = _per_cent(abs(height - 1))
        return f"{name} changes the rms height by {by}", f"{subject} {changes}"
    return (
        f"{name} lowers the rms height by {_per_cent(1 - height)}: most is gone",
        f"{subject} {changes}: most of the roughness is gone, and answers are those of what is "
        "left",
    )


def _per_cent(share: float) -> str:
    if 0.995 <= share < 1:
        return "more than 99%"
    return f"{100 * share:.2g}%" if share < 0.1 else f"{share:.0%}"
