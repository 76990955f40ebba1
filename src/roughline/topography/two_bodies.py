"""Two rough bodies in contact, as one: the sum of their heights."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.topography.body import Body, Surface
from roughline.topography.provenance import Facing, Provenance, Tilt
from roughline.topography.settings import MEASURED, Settings


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
    cropped = (_is_cropped(first, sizes), _is_cropped(second, sizes))
    both = Facing(first.provenance, second.provenance, cropped, not same_grid)
    tilt = _tilt_of_both(first.provenance.tilt, second.provenance.tilt)
    return Surface(
        heights,
        sizes,
        first.unit,
        {
            "origin": MEASURED if is_measured else "two surfaces",
            **{f"first_{key}": value for key, value in first.settings.items()},
            **{f"second_{key}": value for key, value in second.settings.items()},
            **tilt.record,
            **_record(both, sizes, shape),
        },
        is_cut_out=is_measured or any(cropped),
        provenance=Provenance(tilt=tilt, facing=both),
    )


def _is_cropped(body: Surface, sizes: tuple[float, float]) -> bool:
    """Whether more than half a point of a body is left out along a side."""
    cut_off = (own - size for own, size in zip(body.sizes, sizes, strict=True))
    return any(width > 0.5 * step for width, step in zip(cut_off, body.spacing, strict=True))


def _record(both: Facing, sizes: tuple[float, float], shape: tuple[int, ...]) -> Settings:
    """What the settings record of how two bodies were laid together."""
    settings = {
        f"{name}_cropped_to": f"{sizes[0]:.6g} x {sizes[1]:.6g}"
        for name, is_cropped in zip(("first", "second"), both.cropped, strict=True)
        if is_cropped
    }
    if both.is_resampled:
        settings["second_resampled_to"] = f"{shape[0]} x {shape[1]}"
    return settings


def _tilt_of_both(first: Tilt, second: Tilt) -> Tilt:
    """What is known of the planes that were removed from both; the second is turned over x."""
    if first.is_of_mounting and second.is_of_mounting:
        return Tilt(is_of_mounting=True)
    if not (first.removed or second.removed):
        return Tilt()
    none = (0.0, 0.0)
    pairs = zip((-1, 1), first.removed or none, second.removed or none, strict=True)
    return Tilt(tuple(own + sign * other for sign, own, other in pairs))


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


def facts_on_facing(body: Body) -> Iterator[Fact]:
    """Say what was cropped and resampled when two surfaces were laid together."""
    both = body.provenance.facing
    if both is None or not isinstance(body, Surface):
        return
    for which, is_cropped in zip(("first", "second"), both.cropped, strict=True):
        if is_cropped:
            yield Fact("cropped_to_common", which=which, sides=body.sizes)
    if both.is_resampled:
        yield Fact("resampled_to_first", pixel=body.spacing)
