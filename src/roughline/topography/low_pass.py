"""A Gaussian low pass: waves shorter than a cutoff are removed."""

from __future__ import annotations

import math

from roughline.errors import InputError
from roughline.topography.body import (
    Body,
    BodyType,
    after_step,
    point_spacings,
    side_lengths,
    within,
)
from roughline.topography.crop import ranges_in_words
from roughline.topography.effects import with_effect
from roughline.units import in_words

_ISO_ALPHA = math.sqrt(math.log(2) / math.pi)
_FEWEST_POINTS = 2  # points along a side


def low_passed(body: BodyType, cutoff: float) -> BodyType:
    """Return a body without its short waves; its settings record what the filter did.

    The filter is that of ISO 16610-61 (-21 of a line). Nothing is known beyond the border of a
    piece, and the points near it would be those of a guess: half a cutoff is left out at each, as
    profiles are measured with a run-up and an overrun. A body that is periodic has no borders.
    `benchmarks/low_pass.py` compares this with other ways.
    """
    from scipy import ndimage  # here because it loads slowly

    deviations = [
        _ISO_ALPHA * cutoff / math.sqrt(2 * math.pi) / each for each in point_spacings(body)
    ]
    mode = "nearest" if body.is_cut_out else "wrap"
    heights = ndimage.gaussian_filter(body.heights, deviations, mode=mode)
    low = after_step(body, heights, low_pass=cutoff)
    points = inner_points(body, cutoff)
    if not any(each.start for each in points):
        return with_effect(body, low, "low_pass")
    inner = after_step(low, low.heights, low_pass_kept=ranges_in_words(points))
    return with_effect(within(body, points), within(inner, points), "low_pass")


def inner_points(body: Body, cutoff: float) -> tuple[slice, ...]:
    """Return the points along each side that a low pass keeps."""
    shape = body.heights.shape
    if not body.is_cut_out:
        return tuple(slice(0, n) for n in shape)
    margins = [
        round(cutoff / 2 / step) if n > 1 else 0
        for step, n in zip(point_spacings(body), shape, strict=True)
    ]
    return tuple(slice(left, n - left) for left, n in zip(margins, shape, strict=True))


def refuse_long(body: Body, cutoff: float) -> None:
    """Refuse a low pass that leaves nothing of a body."""
    sides = side_lengths(body)
    inner = inner_points(body, cutoff)
    if cutoff > max(sides):
        raise InputError(
            f"is {in_words(cutoff, body.unit)}, longer than the topography, "
            f"{in_words(max(sides), body.unit)}: no wave of it would be left; give a shorter "
            "wavelength, or remove a trend",
            "low_pass",
        )
    for side, each, n in zip(sides, inner, body.heights.shape, strict=True):
        if n > 1 and each.stop - each.start < _FEWEST_POINTS:
            raise InputError(
                f"is {in_words(cutoff, body.unit)}: half of it is left out at each border, and of "
                f"a side of {in_words(side, body.unit)} nothing would stay; give a shorter "
                "wavelength, or remove a trend",
                "low_pass",
            )
