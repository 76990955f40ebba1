"""A half-space divided into cells: its operator on a grid, and the coarser grids of that."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic, repeated_axes
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.images import fill_with_images
from roughline.halfspace.operators.workspace import Workspace


def on_grid(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    workspace: Workspace | None = None,
) -> Convolution:
    """Return the map from pressures to displacements on a grid.

    It works in memory of its own, unless it is given some.
    """
    repeats = half_space.repeats
    transformed = _periodic if all(repeats) else _strip if any(repeats) else _free
    spectrum, periods = transformed(half_space, shape, spacing)
    workspace = workspace or Workspace()
    return Convolution(shape, spacing, periods, spectrum, half_space, workspace)


def bytes_on_grid(shape: tuple[int, int], *, periodic: Periodic) -> int:
    """Return what the operator on a grid holds at work, and a field of pressures in single. [bytes]

    It is asked of an operator that has no memory of its own yet.
    """
    return _empty(shape, (1.0, 1.0), periodic=periodic).bytes_at_work + 4 * math.prod(shape)


def empty_on_grid(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> Convolution:
    """Return a map of the same grid and periods that displaces nothing, and takes no memory."""
    empty = _empty(shape, spacing, periodic=half_space.periodic)
    return replace(empty, half_space=half_space)


def _empty(
    shape: tuple[int, int], spacing: tuple[float, float], *, periodic: Periodic
) -> Convolution:
    periods = grid_periods(shape, repeated_axes(periodic))
    spectrum = np.broadcast_to(0.0, tuple(period // 2 + 1 for period in periods))
    return Convolution(shape, spacing, periods, spectrum)


def coarser_grid(
    shape: tuple[int, int], spacing: tuple[float, float], *, periodic: Periodic
) -> tuple[tuple[int, int], tuple[float, float]]:
    """Return shape and spacing of a grid with half as many points a side, rounded up.

    Along a free side it takes cells of double size, of which the last may reach beyond an odd side.
    It keeps sides that are periods.
    """
    coarse = -(-shape[0] // 2), -(-shape[1] // 2)
    dx, dy = (
        side * n / m if repeated else side * min(n, 2)
        for n, m, side, repeated in zip(
            shape, coarse, spacing, repeated_axes(periodic), strict=True
        )
    )
    return coarse, (dx, dy)


def grid_periods(shape: tuple[int, int], repeats: tuple[bool, bool]) -> tuple[int, int]:
    """Return sides that repeat, and at least twice the others; long ones can be halved thrice."""
    px, py = (
        n if repeated else fft.good_size(2 * n, 8 if n >= 64 else 2)
        for n, repeated in zip(shape, repeats, strict=True)
    )
    return px, py


def _free(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> tuple[Real, tuple[int, int]]:
    """Return the quarter of a spectrum, and periods, of which the grid fills a half at most."""
    mx, my = grid_periods(shape, half_space.repeats)
    spectrum = np.empty((mx // 2 + 1, my // 2 + 1))

    def fill(first: int, last: int) -> None:
        rows = spectrum[first:last]
        half_space.kernel(first, spacing, rows)
        rows /= mx * my

    rows, columns = spectrum.shape
    fft.share_out_blocks(fill, rows, 1 + fft.VALUES_AT_A_TIME // columns)
    fft.cosine_spectrum(spectrum)
    _refuse_infinite(half_space, spectrum)
    return spectrum, (mx, my)


def _strip(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> tuple[Real, tuple[int, int]]:
    """Return the same for one side that is a period, and one of which the grid fills a half.

    The kernel depends on the distance alone, so its rows may be lags along either side.
    """
    along = half_space.repeats.index(True)
    across, periods = 1 - along, grid_periods(shape, half_space.repeats)
    lags = np.empty((periods[along] // 2 + 1, periods[across] // 2 + 1))
    cell, width = (spacing[along], spacing[across]), shape[across] * spacing[across]
    fill_with_images(half_space, shape[along], cell, width, lags)
    spectrum = np.ascontiguousarray(lags if along == 0 else lags.T)
    spectrum /= math.prod(periods)
    fft.cosine_spectrum(spectrum, periods)
    _refuse_infinite(half_space, spectrum)
    return spectrum, periods


def _refuse_infinite(half_space: HalfSpace, spectrum: Real) -> None:
    """Refuse a kernel that is somewhere not finite."""
    if not np.isfinite(spectrum[0, 0]):
        raise InputError(
            f"{type(half_space).__name__}.kernel gives numbers that are not finite; a finite "
            "displacement under unit pressure on one cell is needed at all distances"
        )


def _periodic(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> tuple[Real, tuple[int, int]]:
    """Return the same for sides that are periods; without a mean that has no bound."""
    qx, qy = (
        2 * np.pi / (n * side) * np.arange(n // 2 + 1)
        for n, side in zip(shape, spacing, strict=True)
    )
    q = np.hypot(qx[:, np.newaxis], qy)
    with np.errstate(divide="ignore", invalid="ignore"):
        spectrum = half_space.spectrum(q) / (shape[0] * shape[1])
    if np.isinf(spectrum[0, 0]):
        spectrum[0, 0] = 0.0
    wrong = ~((spectrum > 0) & np.isfinite(spectrum))
    wrong[0, 0] = not spectrum[0, 0] >= 0
    if wrong.any():
        raise InputError(
            f"{type(half_space).__name__}.spectrum gives {spectrum[wrong][0]:g} at q = "
            f"{q[wrong][0]:g}; a positive, finite displacement over pressure is needed for each "
            "wave, and may be infinite at q = 0 alone"
        )
    return spectrum, shape
