"""The displacement along the surface under shear on a grid, as a fast convolution of vectors.

Both components are one complex number each: z = s_x + i s_y, and u likewise. Waves of opposite
wavevectors answer together,

    u(q) = mean z(q) + (part + i skew) z(-q)*,

where mean is half the sum of the displacements along and across a wave, and part + i skew is half
their difference, turned by twice the angle of the wave.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, Integers, Real
from roughline.computing.compiled import compiled
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.discretisation import grid_periods
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision
from roughline.halfspace.operators.workspace import Workspace


@dataclass(frozen=True, eq=False)
class ShearConvolution:
    """Displacement along the surface under shear on a grid, computed by Fourier transforms.

    The spectra hold the eigenvalues over the number of modes, as those of
    :class:`~roughline.halfspace.operators.convolution.Convolution` do, and a quarter of each is
    stored: mean and part are even in both wavenumbers, and skew is odd in both.
    """

    shape: tuple[int, int]
    periods: tuple[int, int]
    mean: Real  # shape (periods[0] // 2 + 1, periods[1] // 2 + 1) [length / pressure]
    part: Real
    skew: Real
    diagonal: float  # displacement of a node by shear on itself, mean of both directions
    workspace: Workspace = field(default_factory=Workspace, repr=False)

    def displacement(
        self,
        shear: Real,
        sources: GridNodes,
        targets: GridNodes,
        precision: Precision = "float64",
    ) -> Real:
        """Return the displacements of nodes, shape (targets, 2), under shear, shape (sources, 2).

        Rows come first, then columns in pairs of opposite wavenumbers, block by block, then rows
        back.
        """
        (nx, _), (mx, my) = self.shape, self.periods
        kind = np.complex128 if precision == "float64" else np.complex64
        modes = self.workspace.array("shear rows", (nx, my + 8), kind)
        result = np.empty((targets.indices.size, 2))

        def transform_rows(first: int, last: int) -> None:
            _scatter(shear, *sources.listed[:2], first, last, modes)
            fft.fft_along(modes[first:last, :my], 1, forward=True)

        def convolve_columns(first: int, last: int) -> None:
            columns = np.zeros((2, mx, last - first), dtype=kind)
            _load(modes, my, sources.rows, first, columns)
            for each in columns:
                fft.fft_along(each, 0, forward=True)
            _weigh(columns, self.mean, self.part, self.skew, first)
            for each in columns:
                fft.fft_along(each, 0, forward=False)
            _store(columns, targets.rows, first, modes, my)

        def transform_rows_back(first: int, last: int) -> None:
            fft.fft_along(modes[first:last, :my], 1, forward=False)
            _gather(modes, *targets.listed[:2], first, last, result)

        at_a_time = fft.LINES_AT_A_TIME
        fft.share_out_blocks(transform_rows, sources.rows.size, at_a_time)
        fft.share_out_blocks(convolve_columns, my // 2 + 1, at_a_time // 2)
        fft.share_out_blocks(transform_rows_back, targets.rows.size, at_a_time)
        return result


def shear_on_grid(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    workspace: Workspace | None = None,
) -> ShearConvolution:
    """Return the map from shear to displacements along the surface, on a grid.

    Raises
    ------
    InputError
        On a strip, or where it is not known how shear displaces the half-space.
    """
    if any(half_space.repeats) and not all(half_space.repeats):
        raise InputError(
            f"half_space is {half_space.boundary}, and friction is solved on one that is free or "
            "periodic along both axes: give periodic=True or False"
        )
    made = _periodic if all(half_space.repeats) else _free
    periods = grid_periods(shape, half_space.repeats)
    xx, yy, xy = made(half_space, shape, spacing, periods)
    diagonal = float(_at_origin(xx, periods) + _at_origin(yy, periods)) / 2
    mean, part = (xx + yy) / 2, (xx - yy) / 2
    return ShearConvolution(shape, periods, mean, part, xy, diagonal, workspace or Workspace())


def _free(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    periods: tuple[int, int],
) -> tuple[Real, Real, Real]:
    """Return quarters of spectra from tables of the kernels at all distances."""
    rows, columns = periods[0] // 2 + 1, periods[1] // 2 + 1
    xx, yy, xy = tables = tuple(np.empty((rows, columns)) for _ in range(3))

    def fill(first: int, last: int) -> None:
        some = xx[first:last], yy[first:last], xy[first:last]
        half_space.shear_kernel(first, spacing, some)
        for each in some:
            each /= math.prod(periods)

    fft.share_out_blocks(fill, rows, 1 + fft.VALUES_AT_A_TIME // columns)
    fft.cosine_spectrum(xx)
    fft.cosine_spectrum(yy)
    fft.sine_spectrum(xy)
    if not all(np.isfinite(each[0, 0]) for each in tables):
        raise InputError(
            f"{type(half_space).__name__}.shear_kernel gives numbers that are not finite; finite "
            "displacements under unit shear on one cell are needed at all distances"
        )
    return xx, yy, xy


def _periodic(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    periods: tuple[int, int],
) -> tuple[Real, Real, Real]:
    """Return the same of waves; the odd one is zero where a wave is its own opposite."""
    qx, qy = (
        2 * np.pi / (n * side) * np.arange(n // 2 + 1)
        for n, side in zip(shape, spacing, strict=True)
    )
    qx = qx[:, np.newaxis]
    q = np.hypot(qx, qy)
    with np.errstate(divide="ignore", invalid="ignore"):
        along, across = (each / math.prod(periods) for each in half_space.shear_spectrum(q))
        cosine, sine = qx / q, qy / q
    for each in (along, across):
        if np.isinf(each[0, 0]):
            each[0, 0] = 0.0
    cosine[0, 0], sine[0, 0] = 1.0, 0.0
    xx = along * cosine**2 + across * sine**2
    yy = along * sine**2 + across * cosine**2
    xy = (along - across) * cosine * sine
    if shape[0] % 2 == 0:
        xy[-1] = 0.0
    if shape[1] % 2 == 0:
        xy[:, -1] = 0.0
    return xx, yy, xy


def _at_origin(quarter: Real, periods: tuple[int, int]) -> float:
    """Return the sum over all modes of an even spectrum."""
    times_x, times_y = (
        np.where((np.arange(n // 2 + 1) == 0) | (2 * np.arange(n // 2 + 1) == n), 1.0, 2.0)
        for n in periods
    )
    return float(times_x @ quarter @ times_y)


@compiled
def _scatter(
    values: Floats, starts: Integers, columns: Integers, first: int, last: int, rows: Floats
) -> None:
    """Write vectors as complex numbers into rows, which are zero elsewhere."""
    for row in range(first, last):
        rows[row] = 0
        for i in range(starts[row], starts[row + 1]):
            rows[row, columns[i]] = values[i, 0] + 1j * values[i, 1]


@compiled
def _gather(
    rows: Floats, starts: Integers, columns: Integers, first: int, last: int, values: Floats
) -> None:
    """Write into vectors what stands where _scatter would write them."""
    for row in range(first, last):
        for i in range(starts[row], starts[row + 1]):
            values[i, 0] = rows[row, columns[i]].real
            values[i, 1] = rows[row, columns[i]].imag


@compiled
def _load(rows: Floats, period: int, places: Integers, first: int, columns: Floats) -> None:
    """Copy a block of modes and their opposites to columns; rows go to their places."""
    for row in range(places.size):
        for j in range(columns.shape[2]):
            mode = first + j
            columns[0, places[row], j] = rows[row, mode]
            columns[1, places[row], j] = rows[row, (period - mode) % period]


@compiled
def _store(columns: Floats, places: Integers, first: int, rows: Floats, period: int) -> None:
    """Copy some rows of columns back."""
    for row in range(places.size):
        for j in range(columns.shape[2]):
            mode = first + j
            rows[row, (period - mode) % period] = columns[1, places[row], j]
            rows[row, mode] = columns[0, places[row], j]


@compiled
def _weigh(columns: Floats, mean: Real, part: Real, skew: Real, first: int) -> None:
    """Replace the shear of pairs of opposite waves by the displacements."""
    period = columns.shape[1]
    for i in range(period):
        opposite = (period - i) % period
        quarter = min(i, opposite)
        sign = 1.0 if i == quarter else -1.0
        for j in range(columns.shape[2]):
            z, other = columns[0, i, j], columns[1, opposite, j]
            mixed = part[quarter, first + j] + 1j * sign * skew[quarter, first + j]
            weight = mean[quarter, first + j]
            columns[0, i, j] = weight * z + mixed * np.conj(other)
            columns[1, opposite, j] = weight * other + mixed * np.conj(z)
