"""The displacement of a grid under pressures, as a fast convolution."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, InGrid, Integers, Real
from roughline.computing.compiled import compiled
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision, unit_in_single
from roughline.halfspace.operators.small_grid import SmallGrid
from roughline.halfspace.operators.workspace import Workspace

_PAIRS_PER_MODE = 4.0  # of nodes, up to which sums over pairs take less time ...
_MANY_MODES = 2**20  # ... where there are so many modes
FEW_MODES = 2**16
"""Modes up to which a grid is transformed at once, by one thread and in double precision.

Single precision gains nothing there, and a thread does it before another has begun.
"""
_ROWS_AT_A_TIME = 32  # of the kernel, over which pairs are summed before others
_LARGE_GRID_POINTS = 2**22  # of the padded rows, from which on memory counts


@dataclass(frozen=True, eq=False)
class Convolution:
    """Displacement of the surface under the pressures on a grid, computed by Fourier transforms.

    Along each axis the period of the transform is twice the grid or more (free), or the grid itself
    (periodic).
    The spectrum holds the eigenvalues over their product, the normalisation of the two transforms.
    The kernel is even in x and y, so the spectrum is real and even, and a quarter of it is stored.
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]  # sides of a cell [length]
    periods: tuple[int, int]
    spectrum: Real  # shape (periods[0] // 2 + 1, periods[1] // 2 + 1) [length / pressure]
    half_space: HalfSpace | None = None  # None: another kernel, of which there is the spectrum only
    workspace: Workspace = field(default_factory=Workspace, repr=False)

    @property
    def cell_area(self) -> float:
        """Area of one cell. [length²]"""
        return self.spacing[0] * self.spacing[1]

    @property
    def repeats(self) -> tuple[bool, bool]:
        """Whether the grid is a period along x, and along y."""
        return self.periods[0] == self.shape[0], self.periods[1] == self.shape[1]

    @property
    def mean_is_free(self) -> bool:
        """Whether displacements count from their mean, so that even pressure displaces nothing."""
        return bool(self.spectrum[0, 0] == 0)

    def displacement(
        self,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes | None = None,
        precision: Precision = "float64",
        out: Real | None = None,
    ) -> Real:
        """Return the displacement of some nodes, or of all, under the pressure on some nodes.

        Small grids are transformed in double precision. Of larger ones, pairs of few nodes are
        summed over; other displacements are transformed. Single precision errs by some 1e-7 of the
        largest displacement. The result may be written to `out`, which is not the memory of the
        pressures.
        """
        if self.small_grid:
            return self._transformed_at_once(self.small_grid, pressure, sources, targets, out)
        if precision == "float32" and (unit := unit_in_single(pressure)) != 1:
            result = self.displacement(pressure / unit, sources, targets, precision, out)
            result *= unit
            return result
        if out is None:
            out = np.empty(self.shape if targets is None else targets.indices.size)
        out[:] = 0
        if targets is not None and self._sums_are_cheap(sources.indices.size, targets.indices.size):
            return self._summed(pressure, sources, targets, out)
        for odd in range(self._parts(precision)):
            self._transform(pressure, sources, targets, precision, out, odd)
        return out

    @cached_property
    def small_grid(self) -> SmallGrid | None:
        """Transforms of the whole grid, whatever the precision; None unless it has few modes."""
        few = math.prod(self.periods) <= FEW_MODES
        return SmallGrid(self.shape, self.periods) if few else None

    def _transformed_at_once(
        self,
        grid: SmallGrid,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes | None,
        out: Real | None,
    ) -> Real:
        """Return what :meth:`displacement` does, on a small grid."""
        fields = grid.fields()
        fields.put(pressure, fields.places(sources.indices))
        fields.convolve(self.spectrum)
        if out is None:
            out = np.empty(self.shape if targets is None else targets.indices.size)
        if targets is None:
            out[:] = fields.result.reshape(-1, fields.width)[:, : self.shape[1]]
        else:
            out[:] = fields.at(fields.places(targets.indices))
        return out

    def _sums_are_cheap(self, sources: int, targets: int) -> bool:
        """Whether sums over pairs take less time than transforms, and no more memory than rows."""
        modes = self.periods[0] * self.periods[1]
        fit = targets <= _ROWS_AT_A_TIME * self.shape[1]
        few = sources * targets <= _PAIRS_PER_MODE * modes
        free = self.half_space is not None and not any(self.repeats)
        return free and modes >= _MANY_MODES and fit and few

    def _summed(self, pressure: Real, sources: GridNodes, targets: GridNodes, result: Real) -> Real:
        """Sum over pairs of nodes. Rows of the kernel are made for all pairs so far apart."""
        assert self.half_space is not None
        kernel_rows, (nx, ny) = self.half_space.kernel, self.shape
        loaded = sources.starts, sources.columns, sources.place_of_rows
        parts = np.zeros((-(-nx // _ROWS_AT_A_TIME), result.size))

        def add(first: int, last: int) -> None:
            table = np.empty((last - first, ny))
            kernel_rows(first, self.spacing, table)
            part = parts[first // _ROWS_AT_A_TIME]
            _add_pairs(table, first, pressure, loaded, targets.listed, part)

        fft.share_out_blocks(add, nx, _ROWS_AT_A_TIME)
        return parts.sum(axis=0, out=result)

    def _parts(self, precision: Precision) -> int:
        """Return in how many parts modes along y are taken: all, or even ones, then odd ones.

        Double precision needs no more memory than single precision so, where rows are padded.
        """
        padded = self.periods[1] >= 2 * self.shape[1] and self.periods[1] % 2 == 0
        large = self.shape[0] * self.periods[1] > _LARGE_GRID_POINTS
        return 2 if padded and large and precision == "float64" else 1

    def _rows(self, precision: Precision) -> tuple[int, int]:
        """Return how many complex rows are transformed, two of the grid in each, and their length.

        They are longer than needed, as caches hold few rows that are a power of two apart.
        """
        return (self.shape[0] + 1) // 2, self.periods[1] // self._parts(precision) + 8

    @property
    def bytes_at_work(self) -> int:
        """Memory of the spectrum, and of what a product in double precision works in. [bytes]"""
        if math.prod(self.periods) <= FEW_MODES:
            modes = self.periods[0] * self.spectrum.shape[1]
            return self.spectrum.nbytes + 16 * modes + 4 * 8 * self.shape[0] * self.periods[1]
        return self.spectrum.nbytes + 16 * math.prod(self._rows("float64"))

    def _transform(
        self,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes | None,
        precision: Precision,
        result: Real,
        odd: int,
    ) -> None:
        """Add to `result` what all modes along y displace, or the even ones, or the odd ones.

        Rows without pressure or targets are not transformed. Two real rows make one complex row.
        Rows come first, then columns block by block (separate, pad, transform, multiply, transform
        back, crop, join), then rows back. Of long padded rows, even modes are taken first: the
        transform of half the period. Odd ones are that of the row turned by one mode.
        """
        (nx, ny), (mx, my), parts = self.shape, self.periods, self._parts(precision)
        period, spectrum = my // parts, self.spectrum[:, odd::parts]
        kind = np.complex128 if precision == "float64" else np.complex64
        modes = self.workspace.array("rows", self._rows(precision), kind)
        real_modes = modes.view(modes.real.dtype).reshape(*modes.shape, 2)
        rows_out = np.arange(nx) if targets is None else targets.rows
        turns = np.exp(2j * np.pi / my * np.arange(ny)).astype(modes.dtype) if odd else None

        def transform_rows(first: int, last: int) -> None:
            _scatter_pairs(pressure, *sources.listed[:2], first, last, real_modes)
            if turns is not None:
                modes[first:last, :ny] *= turns.conj()
            fft.fft_along(modes[first:last, :period], 1, forward=True)

        def convolve_columns(first: int, last: int) -> None:
            columns = np.empty((mx, last - first), dtype=modes.dtype)
            real_columns = columns.view(real_modes.dtype).reshape(mx, last - first, 2)
            _load_columns(real_modes, period, sources.rows, first, odd, real_columns)
            fft.fft_along(columns, 0, forward=True)
            _weigh_columns(real_columns, spectrum, first)
            fft.fft_along(columns, 0, forward=False)
            _store_columns(real_columns, rows_out, first, odd, real_modes, period)

        def transform_rows_back(first: int, last: int) -> None:
            fft.fft_along(modes[first:last, :period], 1, forward=False)
            if turns is not None:
                modes[first:last, :ny] *= turns
            if targets is None:
                _gather_rows(real_modes, first, last, result)
            else:
                _gather_pairs(real_modes, *targets.listed[:2], first, last, result)

        at_a_time = fft.LINES_AT_A_TIME
        pairs, pairs_out = (sources.rows.size + 1) // 2, (rows_out.size + 1) // 2
        fft.share_out_blocks(transform_rows, pairs, at_a_time)
        fft.share_out_blocks(convolve_columns, spectrum.shape[1], at_a_time)
        fft.share_out_blocks(transform_rows_back, pairs_out, at_a_time)


def displacement_field(operator: Convolution, pressure: Real) -> Real:
    """Return the displacement everywhere under the pressure on each cell, shape (nx, ny)."""
    nodes = InGrid(np.flatnonzero(pressure))
    return operator.displacement(pressure.flat[nodes], GridNodes.of(nodes, operator.shape))


@compiled
def _scatter_pairs(
    values: Floats, starts: Integers, columns: Integers, first: int, last: int, pairs: Floats
) -> None:
    """Write the values of two rows each into the real and imaginary parts of one complex row.

    The real rows begin at `starts` in `values`, with a column for each value. The complex rows from
    first to last, of shape (columns, 2), are zero where there are no values.
    """
    for pair in range(first, last):
        pairs[pair] = 0
        for part in range(2):
            row = 2 * pair + part
            if row + 1 < starts.size:
                for i in range(starts[row], starts[row + 1]):
                    pairs[pair, columns[i], part] = values[i]


@compiled
def _gather_pairs(
    pairs: Floats, starts: Integers, columns: Integers, first: int, last: int, values: Floats
) -> None:
    """Add to values what stands where _scatter_pairs would write them."""
    for row in range(2 * first, min(2 * last, starts.size - 1)):
        for i in range(starts[row], starts[row + 1]):
            values[i] += pairs[row // 2, columns[i], row % 2]


@compiled
def _gather_rows(pairs: Floats, first: int, last: int, field: Floats) -> None:
    """Add to a field whole rows, cropped to its columns."""
    for row in range(2 * first, min(2 * last, field.shape[0])):
        for column in range(field.shape[1]):
            field[row, column] += pairs[row // 2, column, row % 2]


@compiled
def _load_columns(
    pairs: Floats, period: int, rows: Integers, first: int, odd: int, columns: Floats
) -> None:
    """Separate two real rows from each complex one, for a block of modes, and pad with zeros.

    A = (Z(k) + Z(-k)*) / 2 and B = (Z(k) - Z(-k)*) / 2i are the spectra of the real and imaginary
    parts of z. All complex numbers come as two real ones. The real rows go to `rows` of the
    columns, which are modes from `first` on. With `odd` one, mode j stands for the wavenumber
    2 j + 1, so that period - 1 - j is its opposite; with zero that is period - j.
    """
    half, none = pairs.dtype.type(0.5), np.empty_like(columns[0])
    columns[:] = 0
    for pair in range((rows.size + 1) // 2):
        z = pairs[pair]
        a = columns[rows[2 * pair]]
        b = columns[rows[2 * pair + 1]] if 2 * pair + 1 < rows.size else none
        for j in range(columns.shape[1]):
            mirror = period - odd - first - j if first + j + odd else 0
            a[j, 0] = half * (z[first + j, 0] + z[mirror, 0])
            a[j, 1] = half * (z[first + j, 1] - z[mirror, 1])
            b[j, 0] = half * (z[first + j, 1] + z[mirror, 1])
            b[j, 1] = half * (z[mirror, 0] - z[first + j, 0])


@compiled
def _weigh_columns(columns: Floats, quarter: Floats, first: int) -> None:
    """Multiply a block of modes by an even spectrum of which a quarter is given.

    The spectrum is rounded to the precision of the modes.
    """
    period, modes = columns.shape[0], columns.shape[1]
    for i in range(period // 2 + 1):
        row, mirror = columns[i], columns[(period - i) % period]
        is_its_own_mirror = 2 * i % period == 0
        for j in range(modes):
            weight = columns.dtype.type(quarter[i, first + j])
            row[j, 0] *= weight
            row[j, 1] *= weight
            if not is_its_own_mirror:
                mirror[j, 0] *= weight
                mirror[j, 1] *= weight


@compiled
def _store_columns(
    columns: Floats, rows: Integers, first: int, odd: int, pairs: Floats, period: int
) -> None:
    """Join two real rows into each complex one: the inverse of _load_columns, for some rows."""
    none = np.zeros_like(columns[0])
    for pair in range((rows.size + 1) // 2):
        z = pairs[pair]
        a = columns[rows[2 * pair]]
        b = columns[rows[2 * pair + 1]] if 2 * pair + 1 < rows.size else none
        for j in range(columns.shape[1]):
            mirror = period - odd - first - j if first + j + odd else 0
            z[mirror, 0] = a[j, 0] + b[j, 1]
            z[mirror, 1] = b[j, 0] - a[j, 1]
            z[first + j, 0] = a[j, 0] - b[j, 1]
            z[first + j, 1] = a[j, 1] + b[j, 0]


@compiled
def _add_pairs(
    table: Floats,
    first: int,
    pressure: Floats,
    sources: tuple[Integers, Integers, Integers],
    targets: tuple[Integers, Integers, Integers],
    result: Floats,
) -> None:
    """Add what pressures displace at some distances of rows, for which there is a table.

    Sources are starts, columns and the places of all rows; targets starts, columns and rows.
    """
    source_starts, source_columns, place = sources
    target_starts, target_columns, target_rows = targets
    for k in range(target_rows.size):
        for distance in range(first, first + table.shape[0]):
            kernel = table[distance - first]
            for side in range(2 if distance else 1):
                row = target_rows[k] + (distance if side else -distance)
                if 0 <= row < place.size and place[row] >= 0:
                    source = place[row]
                    for i in range(target_starts[k], target_starts[k + 1]):
                        total = 0.0
                        for j in range(source_starts[source], source_starts[source + 1]):
                            lag = abs(target_columns[i] - source_columns[j])
                            total += kernel[lag] * pressure[j]
                        result[i] += total
