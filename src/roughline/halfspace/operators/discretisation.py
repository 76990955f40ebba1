"""A half-space divided into cells: its operator on a grid, and the coarser grids of that."""

from __future__ import annotations

import math

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.convolution import Convolution
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
    transformed = _periodic if half_space.periodic else _free
    spectrum, periods = transformed(half_space, shape, spacing)
    workspace = workspace or Workspace()
    return Convolution(shape, spacing, periods, spectrum, half_space, workspace)


def bytes_on_grid(shape: tuple[int, int], *, periodic: bool) -> int:
    """Return what the operator on a grid holds at work, and a field of pressures in single. [bytes]

    It is asked of an operator that has no memory of its own yet.
    """
    periods = shape if periodic else _padded(shape)
    spectrum = np.broadcast_to(0.0, tuple(period // 2 + 1 for period in periods))
    return Convolution(shape, (1.0, 1.0), periods, spectrum).bytes_at_work + 4 * math.prod(shape)


def coarser_grid(
    shape: tuple[int, int], spacing: tuple[float, float], *, periodic: bool
) -> tuple[tuple[int, int], tuple[float, float]]:
    """Return shape and spacing of a grid with half as many points a side, rounded up.

    A free grid takes cells of double size, of which the last may reach beyond an odd side. A
    periodic grid keeps its sides, which are its periods.
    """
    (nx, ny), (dx, dy) = shape, spacing
    mx, my = -(-nx // 2), -(-ny // 2)
    if periodic:
        return (mx, my), (dx * nx / mx, dy * ny / my)
    return (mx, my), (dx * min(nx, 2), dy * min(ny, 2))


def _padded(shape: tuple[int, int]) -> tuple[int, int]:
    """Return periods of at least twice the sides; long ones can be halved three times."""
    mx, my = (fft.good_size(2 * n, 8 if n >= 64 else 2) for n in shape)
    return mx, my


def _free(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> tuple[Real, tuple[int, int]]:
    """Return the quarter of a spectrum, and periods, of which the grid fills a half at most."""
    mx, my = _padded(shape)
    spectrum = np.empty((mx // 2 + 1, my // 2 + 1))

    def fill(first: int, last: int) -> None:
        rows = spectrum[first:last]
        half_space.kernel(first, spacing, rows)
        rows /= mx * my

    rows, columns = spectrum.shape
    fft.share_out_blocks(fill, rows, 1 + fft.VALUES_AT_A_TIME // columns)
    fft.cosine_spectrum(spectrum)
    if not np.isfinite(spectrum[0, 0]):
        raise InputError(
            f"{type(half_space).__name__}.kernel gives numbers that are not finite; a finite "
            "displacement under unit pressure on one cell is needed at all distances"
        )
    return spectrum, (mx, my)


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
