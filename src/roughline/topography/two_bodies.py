"""Two rough bodies in contact, as one: the sum of their heights."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.topography.body import Surface
from roughline.topography.settings import MEASURED, MOUNTING, TILT, TILT_REMOVED


@public
def facing(first: Surface, second: Surface) -> Surface:
    """Return the surface that stands for two that face each other.

    The second is turned over about its y axis, so its x runs backwards. Both are cropped to the
    smaller sides, from the corner x = y = 0, and the second is resampled to the spacing of the
    first. Gap and elastic contact depend on the sum of the heights alone. The settings record what
    was cropped and resampled.

    Parameters
    ----------
    first, second : Surface
        Both in one unit; heights of each point away from its body. [length]

    Raises
    ------
    InputError
        If their units differ, or what they have in common is less than 2 x 2 points.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0)
    >>> both = rl.facing(spectrum.surface(64, rng=1), spectrum.surface(64, rng=2))
    >>> print(round(both.rms_height / 0.01, 1))  # two independent bodies: the root of 2
    1.4
    """
    if first.unit != second.unit:
        raise InputError(
            f"the surfaces are in {first.unit or 'no unit'} and {second.unit or 'no unit'}: give "
            "both in one unit"
        )
    turned = second.heights[::-1]
    shape = tuple(
        int(min(a, b) / spacing * (1 + 1e-12) + 1e-9)
        for a, b, spacing in zip(first.sizes, second.sizes, first.spacing, strict=True)
    )
    if min(shape) < 2:
        raise InputError(
            f"the surfaces have {shape[0]} x {shape[1]} points in common; at least 2 x 2 are needed"
        )
    sizes = (first.spacing[0] * shape[0], first.spacing[1] * shape[1])
    same_grid = np.allclose(first.spacing, second.spacing, rtol=1e-9)
    other = (
        turned[: shape[0], : shape[1]]
        if same_grid
        else _on_grid_of_first(turned, shape, first, second)
    )
    heights = first.heights[: shape[0], : shape[1]] + other
    is_measured = first.is_cut_out or second.is_cut_out
    settings: dict[str, str | int | float] = {
        "origin": MEASURED if is_measured else "two surfaces",
        **{f"first_{key}": value for key, value in first.settings.items()},
        **{f"second_{key}": value for key, value in second.settings.items()},
        **_record_of_tilts(first, second),
    }
    is_cropped = False
    for name, body in (("first", first), ("second", second)):
        cut_off = [
            size - n * step for size, n, step in zip(body.sizes, shape, first.spacing, strict=True)
        ]
        if any(width > 0.5 * step for width, step in zip(cut_off, body.spacing, strict=True)):
            settings[f"{name}_cropped_to"] = f"{sizes[0]:.6g} x {sizes[1]:.6g}"
            is_cropped = True
    if not same_grid:
        settings["second_resampled_to"] = f"{shape[0]} x {shape[1]}"
    return Surface(heights, sizes, first.unit, settings, is_cut_out=is_measured or is_cropped)


def _record_of_tilts(first: Surface, second: Surface) -> dict[str, str | int | float]:
    """What is known of the planes that were removed from both; the second is turned over x."""
    bodies = (first, second)
    if all(body.settings.get(TILT) == MOUNTING for body in bodies):
        return {TILT: MOUNTING}
    if not any(name in body.settings for body in bodies for name in TILT_REMOVED):
        return {}
    return {
        name: float(first.settings.get(name, 0.0)) + sign * float(second.settings.get(name, 0.0))
        for name, sign in zip(TILT_REMOVED, (-1, 1), strict=True)
    }


def _on_grid_of_first(
    heights: Real, shape: tuple[int, ...], first: Surface, second: Surface
) -> Real:
    """Heights of the second, by cubic splines on the grid of the first."""
    from scipy import ndimage  # here because it loads slowly

    x, y = (
        (np.arange(n) + 0.5) * step / other_step - 0.5
        for n, step, other_step in zip(shape, first.spacing, second.spacing, strict=True)
    )
    grid = np.meshgrid(x, y, indexing="ij")
    return np.asarray(ndimage.map_coordinates(heights, grid, order=3, mode="nearest"))
