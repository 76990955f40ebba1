"""The displacement along the surface under shear on a grid, as a fast convolution of vectors.

Both components are one complex number each: z = s_x + i s_y, and u likewise. Waves of opposite
wavevectors answer together,

    u(q) = mean z(q) + (part + i skew) z(-q)*,

where mean is half the sum of the displacements along and across a wave, and part + i skew is half
their difference, turned by twice the angle of the wave. Where pressure p displaces along the
surface, and shear into the body, with e = towards_x + i towards_y,

    u(q) = i e p(q),   u_z(q) = -i (e* z(q) + e z(-q)*) / 2.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, Integers, Real
from roughline.computing.compiled import compiled
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.discretisation import grid_periods
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision
from roughline.halfspace.operators.images import Summed, fill_with_images
from roughline.halfspace.operators.workspace import Workspace

_ODD = (False, False), (False, False), (True, True), (True, False), (False, True)
"""Along which axes each of the tables is odd."""
_HALVED_FROM = 2**16
"""Points of a grid whose rows are transformed in halves; on fewer it would take a tenth longer."""


@dataclass(frozen=True, eq=False)
class ShearConvolution:
    """Displacement by shear on a grid, and along the surface by pressure, by Fourier transforms.

    The spectra hold the eigenvalues over the number of modes, as those of
    :class:`~roughline.halfspace.operators.convolution.Convolution` do, and a quarter of each is
    stored: mean and part are even in both wavenumbers, skew is odd in both, and each of the last
    two, which half-spaces without coupling have not, is odd in its own.
    """

    shape: tuple[int, int]
    periods: tuple[int, int]
    mean: Real  # shape (periods[0] // 2 + 1, periods[1] // 2 + 1) [length / pressure]
    part: Real
    skew: Real
    towards: tuple[Real, Real] | None  # along x and along y
    diagonal: float  # displacement of a node by shear on itself, mean of both directions
    workspace: Workspace = field(default_factory=Workspace, repr=False)

    def displacement(
        self,
        shear: Real,
        sources: GridNodes,
        targets: GridNodes,
        precision: Precision = "float64",
    ) -> Real:
        """Return the displacements of nodes under shear; both of shape (nodes, 2)."""

        def weigh(modes: slice, columns: Floats) -> None:
            _weigh(columns, *(each[:, modes] for each in (self.mean, self.part, self.skew)))

        return self._transformed((shear,), sources, targets, precision, weigh)[0]

    def by_pressure(self, pressure: Real, sources: GridNodes, targets: GridNodes) -> Real:
        """Return the displacements of nodes along the surface, shape (targets, 2)."""
        if self.towards is None:
            return np.zeros((targets.indices.size, 2))
        towards = self.towards

        def weigh(modes: slice, columns: Floats) -> None:
            _weigh_pressure(columns, towards[0][:, modes], towards[1][:, modes])

        values = np.stack([pressure, np.zeros_like(pressure)], axis=1)
        return self._transformed((values,), sources, targets, "float64", weigh)[0]

    def into_body(self, shear: Real, sources: GridNodes, targets: GridNodes) -> Real:
        """Return the displacements of nodes into the body under shear, shape (targets,)."""
        if self.towards is None:
            return np.zeros(targets.indices.size)
        towards = self.towards

        def weigh(modes: slice, columns: Floats) -> None:
            _weigh_into_body(columns, towards[0][:, modes], towards[1][:, modes])

        return self._transformed((shear,), sources, targets, "float64", weigh)[0][:, 0].copy()

    def displaced(
        self, pressure: Real, shear: Real, normal: Real, sources: GridNodes, targets: GridNodes
    ) -> tuple[Real, Real]:
        """Return the displacements into the body and along the surface by pressure and shear.

        The normal spectrum is that of pressure that displaces into the body.
        """
        assert self.towards is not None
        spectra = self.mean, self.part, self.skew, *self.towards, normal

        def weigh(modes: slice, sheared: Floats, pressed: Floats) -> None:
            _weigh_both(sheared, pressed, tuple(each[:, modes] for each in spectra))

        values = shear, np.stack([pressure, np.zeros_like(pressure)], axis=1)
        moved, into = self._transformed(values, sources, targets, "float64", weigh)
        return into[:, 0].copy(), moved

    def _transformed(
        self,
        fields: tuple[Real, ...],
        sources: GridNodes,
        targets: GridNodes,
        precision: Precision,
        weigh: Callable[..., None],
    ) -> list[Real]:
        """Return fields of vectors on nodes, transformed, weighed together and transformed back.

        Of long padded rows even modes along y are taken first, then odd ones, for less memory.
        """
        results = [np.zeros((targets.indices.size, 2)) for _ in fields]
        (nx, ny), period = self.shape, self.periods[1]
        parts = 2 if nx * ny >= _HALVED_FROM and period >= 2 * ny and period % 2 == 0 else 1
        for odd in range(parts):
            self._add_transformed(
                fields, (sources, targets), precision, weigh, (odd, parts), results
            )
        return results

    def _add_transformed(
        self,
        fields: tuple[Real, ...],
        nodes: tuple[GridNodes, GridNodes],
        precision: Precision,
        weigh: Callable[..., None],
        part: tuple[int, int],
        results: list[Real],
    ) -> None:
        """Add what all modes along y give, or the even ones, or the odd ones.

        Rows come first, then columns in pairs of opposite wavenumbers, block by block, then rows
        back. Odd modes are those of half the period of the row turned by one mode.
        """
        (sources, targets), (odd, parts) = nodes, part
        (nx, ny), mx, my = self.shape, self.periods[0], self.periods[1] // parts
        kind = np.complex128 if precision == "float64" else np.complex64
        names = ("rows", "shear rows")[: len(fields)]  # the first are those of pressures, too
        rows = [self.workspace.array(name, (nx, my + 8), kind) for name in names]
        turns = np.exp(2j * np.pi / self.periods[1] * np.arange(ny)).astype(kind) if odd else None

        def transform_rows(first: int, last: int) -> None:
            for values, modes in zip(fields, rows, strict=True):
                _scatter(values, *sources.listed[:2], first, last, modes)
                if turns is not None:
                    modes[first:last, :ny] *= turns.conj()
                fft.fft_along(modes[first:last, :my], 1, forward=True)

        def convolve_columns(first: int, last: int) -> None:
            blocks = np.zeros((len(fields), 2, mx, last - first), dtype=kind)
            for columns, modes in zip(blocks, rows, strict=True):
                _load(modes, my, odd, sources.rows, first, columns)
                for each in columns:
                    fft.fft_along(each, 0, forward=True)
            weigh(slice(odd + parts * first, None, parts), *blocks)
            for columns, modes in zip(blocks, rows, strict=True):
                for each in columns:
                    fft.fft_along(each, 0, forward=False)
                _store(columns, targets.rows, first, odd, modes, my)

        def transform_rows_back(first: int, last: int) -> None:
            for modes, result in zip(rows, results, strict=True):
                fft.fft_along(modes[first:last, :my], 1, forward=False)
                if turns is not None:
                    modes[first:last, :ny] *= turns
                _gather(modes, *targets.listed[:2], first, last, result)

        at_a_time = fft.LINES_AT_A_TIME
        fft.share_out_blocks(transform_rows, sources.rows.size, at_a_time)
        fft.share_out_blocks(convolve_columns, (my - odd) // 2 + 1, at_a_time // 2)
        fft.share_out_blocks(transform_rows_back, targets.rows.size, at_a_time)


def shear_on_grid(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    workspace: Workspace | None = None,
) -> ShearConvolution:
    """Return the map from shear to displacements on a grid, and what pressure adds to it.

    Raises
    ------
    InputError
        If it is not known how shear displaces the half-space.
    """
    repeats = half_space.repeats
    made = _periodic if all(repeats) else _strip if any(repeats) else _free
    periods = grid_periods(shape, half_space.repeats)
    xx, yy, xy, towards = made(half_space, shape, spacing, periods)
    diagonal = (at_origin(xx, periods) + at_origin(yy, periods)) / 2
    for x, y in zip(xx, yy, strict=True):  # by rows, as whole tables are large
        x[:], y[:] = (x + y) / 2, (x - y) / 2
    workspace = workspace or Workspace()
    return ShearConvolution(shape, periods, xx, yy, xy, towards, diagonal, workspace)


_Quarters = tuple[Real, Real, Real, tuple[Real, Real] | None]


def _free(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    periods: tuple[int, int],
) -> _Quarters:
    """Return quarters of spectra from tables of the kernels at all distances."""
    rows, columns = periods[0] // 2 + 1, periods[1] // 2 + 1
    coupled = half_space.is_coupled
    tables = [np.empty((rows, columns)) for _ in range(5 if coupled else 3)]

    def fill(first: int, last: int) -> None:
        xx, yy, xy, *towards = (each[first:last] for each in tables)
        half_space.shear_kernel(first, spacing, (xx, yy, xy))
        if coupled:
            half_space.coupling_kernel(first, spacing, (towards[0], towards[1]))

    fft.share_out_blocks(fill, rows, 1 + fft.VALUES_AT_A_TIME // columns)
    return _spectra(half_space, tables, periods)


def _strip(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    periods: tuple[int, int],
) -> _Quarters:
    """Return the same of kernels with all their images along one axis.

    Bodies and kernels may be seen from either side, so that rows are distances along the period.
    """
    along = half_space.repeats.index(True)
    across = 1 - along
    cell, width = (spacing[along], spacing[across]), shape[across] * spacing[across]

    def shear_part(which: int) -> Callable[[int, Real], None]:
        def fill(first: int, rows: Real) -> None:
            parts = [np.empty_like(rows) for _ in range(3)]
            half_space.shear_kernel(first, cell, (parts[0], parts[1], parts[2]))
            rows[:] = parts[which]

        return fill

    def coupling_part(which: int) -> Callable[[int, Real], None]:
        def fill(first: int, rows: Real) -> None:
            parts = [np.empty_like(rows) for _ in range(2)]
            half_space.coupling_kernel(first, cell, (parts[0], parts[1]))
            rows[:] = parts[which]

        return fill

    kernels = [Summed(shear_part(0)), Summed(shear_part(1)), Summed(shear_part(2), True, 3)]
    if half_space.is_coupled:
        kernels += [Summed(coupling_part(0), True, 2), Summed(coupling_part(1), False, 2)]
    tables = []
    for kernel in kernels:
        table = np.empty((periods[along] // 2 + 1, periods[across] // 2 + 1))
        fill_with_images(half_space, shape[along], cell, width, table, kernel)
        tables.append(table)
    if along == 1:
        tables = [np.ascontiguousarray(tables[i].T) for i in (1, 0, 2, 4, 3)[: len(tables)]]
    return _spectra(half_space, tables, periods)


def _spectra(half_space: HalfSpace, tables: list[Real], periods: tuple[int, int]) -> _Quarters:
    """Return the spectra of tables of the kernels, which are overwritten."""
    for each, odd in zip(tables, _ODD, strict=False):
        each /= math.prod(periods)
        fft.sine_spectrum(each, odd, periods)
        if not np.isfinite(each[1, 1]):
            raise InputError(
                f"{type(half_space).__name__} gives numbers that are not finite; finite "
                "displacements under unit shear on one cell are needed at all distances"
            )
    xx, yy, xy = tables[:3]
    np.negative(xy, out=xy)
    # x / r² has the spectrum -i times this, and pressure draws the surface together
    return xx, yy, xy, (tables[3], tables[4]) if half_space.is_coupled else None


def _periodic(
    half_space: HalfSpace,
    shape: tuple[int, int],
    spacing: tuple[float, float],
    periods: tuple[int, int],
) -> _Quarters:
    """Return the same of waves; what is odd is zero where a wave is its own opposite."""
    qx, qy = (
        2 * np.pi / (n * side) * np.arange(n // 2 + 1)
        for n, side in zip(shape, spacing, strict=True)
    )
    qx = qx[:, np.newaxis]
    q = np.hypot(qx, qy)
    with np.errstate(divide="ignore", invalid="ignore"):
        along, across = (each / math.prod(periods) for each in half_space.shear_spectrum(q))
        coupling = half_space.coupling_spectrum(q) / math.prod(periods)
        cosine, sine = qx / q, qy / q
    for each in (along, across, coupling):
        if not np.isfinite(each[0, 0]):
            each[0, 0] = 0.0
    cosine[0, 0], sine[0, 0] = 1.0, 0.0
    xx = along * cosine**2 + across * sine**2
    yy = along * sine**2 + across * cosine**2
    xy = (along - across) * cosine * sine
    towards = coupling * cosine, coupling * sine
    for each in (xy, *towards):
        if shape[0] % 2 == 0:
            each[-1] = 0.0
        if shape[1] % 2 == 0:
            each[:, -1] = 0.0
    towards[0][0], towards[1][:, 0] = 0.0, 0.0
    return xx, yy, xy, towards if half_space.is_coupled else None


def at_origin(quarter: Real, periods: tuple[int, int]) -> float:
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
    """Add to vectors what stands where _scatter would write them."""
    for row in range(first, last):
        for i in range(starts[row], starts[row + 1]):
            values[i, 0] += rows[row, columns[i]].real
            values[i, 1] += rows[row, columns[i]].imag


@compiled
def _load(
    rows: Floats, period: int, odd: int, places: Integers, first: int, columns: Floats
) -> None:
    """Copy a block of modes and their opposites to columns; rows go to their places.

    With `odd` one, mode j stands for the wavenumber 2 j + 1, and period - 1 - j is its opposite.
    """
    for row in range(places.size):
        for j in range(columns.shape[2]):
            mode = first + j
            columns[0, places[row], j] = rows[row, mode]
            columns[1, places[row], j] = rows[row, (period - odd - mode) % period]


@compiled
def _store(
    columns: Floats, places: Integers, first: int, odd: int, rows: Floats, period: int
) -> None:
    """Copy some rows of columns back."""
    for row in range(places.size):
        for j in range(columns.shape[2]):
            mode = first + j
            rows[row, (period - odd - mode) % period] = columns[1, places[row], j]
            rows[row, mode] = columns[0, places[row], j]


@compiled
def _weigh(columns: Floats, mean: Real, part: Real, skew: Real) -> None:
    """Replace the shear of pairs of opposite waves by the displacements."""
    period = columns.shape[1]
    for i in range(period):
        opposite = (period - i) % period
        quarter = min(i, opposite)
        sign = 1.0 if i == quarter else -1.0
        for j in range(columns.shape[2]):
            z, other = columns[0, i, j], columns[1, opposite, j]
            mixed = part[quarter, j] + 1j * sign * skew[quarter, j]
            weight = mean[quarter, j]
            columns[0, i, j] = weight * z + mixed * np.conj(other)
            columns[1, opposite, j] = weight * other + mixed * np.conj(z)


@compiled
def _weigh_pressure(columns: Floats, towards_x: Real, towards_y: Real) -> None:
    """Replace the pressure of pairs of opposite waves by the displacements along the surface."""
    period = columns.shape[1]
    for i in range(period):
        opposite = (period - i) % period
        quarter = min(i, opposite)
        sign = 1.0 if i == quarter else -1.0
        for j in range(columns.shape[2]):
            weight = 1j * (sign * towards_x[quarter, j] + 1j * towards_y[quarter, j])
            columns[0, i, j] *= weight
            columns[1, opposite, j] *= -weight


@compiled
def _weigh_into_body(columns: Floats, towards_x: Real, towards_y: Real) -> None:
    """Replace the shear of pairs of opposite waves by the displacements into the body."""
    period = columns.shape[1]
    for i in range(period):
        opposite = (period - i) % period
        quarter = min(i, opposite)
        sign = 1.0 if i == quarter else -1.0
        for j in range(columns.shape[2]):
            e = sign * towards_x[quarter, j] + 1j * towards_y[quarter, j]
            z, other = columns[0, i, j], columns[1, opposite, j]
            columns[0, i, j] = -0.5j * (np.conj(e) * z + e * np.conj(other))
            columns[1, opposite, j] = 0.5j * (np.conj(e) * other + e * np.conj(z))


@compiled
def _weigh_both(
    sheared: Floats,
    pressed: Floats,
    spectra: tuple[Real, ...],
) -> None:
    """Replace shear and pressure of pairs of opposite waves by what both displace."""
    mean, part, skew, towards_x, towards_y, normal = spectra
    period = sheared.shape[1]
    for i in range(period):
        opposite = (period - i) % period
        quarter = min(i, opposite)
        sign = 1.0 if i == quarter else -1.0
        for j in range(sheared.shape[2]):
            at = quarter, j
            z, other = sheared[0, i, j], sheared[1, opposite, j]
            p, p_other = pressed[0, i, j], pressed[1, opposite, j]
            mixed, e = part[at] + 1j * sign * skew[at], sign * towards_x[at] + 1j * towards_y[at]
            sheared[0, i, j] = mean[at] * z + mixed * np.conj(other) + 1j * e * p
            sheared[1, opposite, j] = mean[at] * other + mixed * np.conj(z) - 1j * e * p_other
            pressed[0, i, j] = normal[at] * p - 0.5j * (np.conj(e) * z + e * np.conj(other))
            pressed[1, opposite, j] = normal[at] * p_other + 0.5j * (
                np.conj(e) * other + e * np.conj(z)
            )
