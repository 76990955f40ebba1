"""What a gap lets through, between two opposite sides or as it repeats: entry point and result."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, get_args, overload

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.curve import Curve
from roughline.contact.fields import Fields
from roughline.errors import InputError
from roughline.errors.checks import between, one_of, refuse
from roughline.errors.public import public_names
from roughline.fluid.rarefied import conductance
from roughline.fluid.winding import windings
from roughline.topography.body import Line, Surface
from roughline.topography.heights import checked_sides

if TYPE_CHECKING:
    from roughline.fluid.cell import CellFlow

Along = Literal["x", "y"]
Sides = Literal["periodic", "closed", "x", "y"]

_AGREEMENT = 1e-8  # of inflow, outflow and dissipation, relative to the inflow
_NARROW = 0.25  # of the width: what is wider is no single channel
_BYTES = 130  # that an open cell takes for each doubling of a side
_STEEP = 0.3  # slope of the gap beyond which Reynolds' equation is no longer good
_HIGH = 0.1  # hydraulic aperture over the shorter side beyond which it is not either


_REPEATS: dict[Sides, tuple[bool, bool]] = {
    "periodic": (True, True),
    "closed": (False, False),
    "x": (True, False),
    "y": (False, True),
}
"""Whether a gap repeats along x and along y."""


@dataclass(frozen=True, eq=False)
class Flow:
    """Flow of a fluid through a gap, under a unit difference of pressure.

    Where the gap ends along the flow, the pressure is 1 before it and 0 behind it. Where it
    repeats, the pressure falls by 1 with each repetition.

    Attributes
    ----------
    gap : ndarray, shape (nx, ny)
        Distance of the two bodies, zero where they touch. [length]
    sizes : tuple of float
        Sides of the rectangle, (Lx, Ly). [length]
    along : {"x", "y"}
        Side along which the pressure falls.
    sides : {"periodic", "closed", "x", "y"}
        Along which sides the gap repeats: both, none, or one of them. Across the flow, a side along
        which it does not repeat is closed.
    mean_free_path : float
        Of a gas, at the pressure for which this flow is; zero of a liquid. [length]
    pressure : ndarray, shape (nx, ny)
        Pressure of the fluid; NaN where there is no fluid, or none that is joined to an end. Of a
        gap that repeats along the flow, 1 before it and 0 behind it in the mean of each part. [1]
    rates_x, rates_y : ndarray, shapes (nx + 1, ny) and (nx, ny + 1)
        Flow through the faces between cells, positive in the direction of x and y, times
        12 viscosity / pressure difference. [length³]
    conductances_x, conductances_y : ndarray, of these shapes
        Flow through each face over the fall of the pressure between the cells beside it. [length³]
    inflow, outflow : float
        Flow through the inlet and through the outlet, times 12 viscosity / pressure difference.
        Where the gap repeats along the flow, through the narrowest places, and as far from that as
        through any row of faces. [length³]
    tensor : ndarray, shape (2, 2), or None
        Of a gap that repeats along both sides: permeance along x and y, the rows, under a gradient
        along x and y, the columns; the same wherever the map is cut. [length³]
    """

    gap: Real
    sizes: tuple[float, float]
    along: Along
    sides: Sides
    mean_free_path: float
    pressure: Real
    rates_x: Real = field(repr=False)
    rates_y: Real = field(repr=False)
    conductances_x: Real = field(repr=False)
    conductances_y: Real = field(repr=False)
    inflow: float
    outflow: float
    tensor: Real | None = None

    __repr__ = summary
    _repr_html_ = in_notebook

    @cached_property
    def dissipation(self) -> float:
        """Power lost in the fluid, times 12 viscosity / pressure difference². [length³]

        Pressure times flow is power, so that this is the flow once more.
        """
        x, y = self._lost
        repeats_x, repeats_y = _REPEATS[self.sides]
        return float(x[int(repeats_x) :].sum() + y[:, int(repeats_y) :].sum())

    @property
    def imbalance(self) -> float:
        """Largest difference of inflow, outflow and dissipation, over the inflow; 0 if sealed.

        Of a tensor also that of both permeances across, over the larger one of both along.
        """
        if self.is_sealed:
            return 0.0
        three = self.inflow, self.outflow, self.dissipation
        difference = (max(three) - min(three)) / self.inflow
        if self.tensor is None:
            return difference
        across = abs(self.tensor[0, 1] - self.tensor[1, 0]) / self.tensor.diagonal().max()
        return max(difference, float(across))

    @property
    def converged(self) -> bool:
        """Whether inflow, outflow and dissipation agree to 1e-8."""
        return bool(self.imbalance <= _AGREEMENT)

    @property
    def has_ends(self) -> bool:
        """Whether the gap ends along the flow, at an inlet and an outlet."""
        return not self._repeats(self.along)

    @property
    def is_sealed(self) -> bool:
        """Whether no path leads from the inlet to the outlet, or on from one repetition."""
        return self.inflow == 0

    @property
    def permeance(self) -> float:
        r"""Permeance Λ = 12 η ⟨j⟩ / \|⟨∇P⟩\| along the flow; exactly 0 if sealed. [length³]"""
        length, width = self.sizes if self.along == "x" else self.sizes[::-1]
        return self.inflow * length / width

    @property
    def principal_permeances(self) -> tuple[float, float]:
        """Largest and least permeance of a tensor, along its principal directions. [length³]

        Raises
        ------
        InputError
            If the gap does not repeat along both sides.
        """
        least, largest = np.linalg.eigvalsh(self._checked_tensor)
        return float(largest), max(float(least), 0.0)

    @property
    def easiest_direction(self) -> float:
        """Angle of the direction of the largest permeance, from x towards y. [degrees]

        Raises
        ------
        InputError
            If the gap does not repeat along both sides.
        """
        (xx, xy), (yx, yy) = self._checked_tensor
        return float(np.degrees(np.arctan2(xy + yx, xx - yy)) / 2)

    @property
    def _checked_tensor(self) -> Real:
        if self.tensor is None:
            raise InputError(
                "the permeance has directions where the gap repeats along both sides: this one has "
                f'sides="{self.sides}"'
            )
        return self.tensor

    @property
    def hydraulic_aperture(self) -> float:
        """Gap u_h = Λ^(1/3) of two flat plates that let as much through. [length]"""
        return float(np.cbrt(self.permeance))

    @property
    def flux(self) -> Real:
        """Flow per width at the cells along x and y, times 12 η / ΔP, (2, nx, ny). [length²]"""
        dx, dy = self._spacing
        x = (self.rates_x[:-1] + self.rates_x[1:]) / (2 * dy)
        y = (self.rates_y[:, :-1] + self.rates_y[:, 1:]) / (2 * dx)
        return np.stack([x, y])

    @cached_property
    def constriction(self) -> tuple[int, int] | None:
        """Cell at which most of the pressure's power is lost: the narrowest place; None if sealed.

        It is the critical constriction where the gap is nearly sealed.
        """
        if self.is_sealed:
            return None
        x, y = self._lost
        lost = x[:-1] + x[1:] + y[:, :-1] + y[:, 1:]
        i, j = np.unravel_index(int(lost.argmax()), lost.shape)
        return int(i), int(j)

    @cached_property
    def largest_share(self) -> float:
        """Largest share of the flow that one channel carries; 0 if sealed. [1]

        A channel is what is open between two places of contact on a line across the flow, if it is
        not wider than a quarter of the side.
        """
        if self.is_sealed:
            return 0.0
        rows = self._forward[1:-1] if self.has_ends else self._forward[:-1]
        rows = rows[(rows == 0).any(axis=1)]
        if self._repeats("y" if self.along == "x" else "x"):  # no channel is cut where rows begin
            closed = (rows == 0).argmax(axis=1)[:, np.newaxis]
            rows = np.take_along_axis(rows, (closed + np.arange(rows.shape[1])) % rows.shape[1], 1)
        width = _NARROW * rows.shape[1]
        rates = np.pad(rows, ((0, 0), (0, 1))).ravel()  # a channel ends with its row
        edges = np.flatnonzero(np.diff(rates != 0, prepend=False))
        if edges.size == 0:
            return 0.0
        sums = np.add.reduceat(rates, edges)[::2]
        narrow = edges[1::2] - edges[::2] <= width
        return float(sums[narrow].max(initial=0.0)) / self.inflow

    @cached_property
    def slope(self) -> float:
        """Rms slope of the gap, weighted with the power that is lost there; 0 if sealed. [1]"""
        if self.is_sealed:
            return 0.0
        (dx, dy), (x, y) = self._spacing, self._lost
        x, y = x[:-1], y[:, :-1]  # of the faces before cells; between these and an end, no slope
        repeats_x, repeats_y = _REPEATS[self.sides]
        inside = np.ones(self.gap.shape, bool), np.ones(self.gap.shape, bool)
        inside[0][0], inside[1][:, 0] = repeats_x, repeats_y
        steep = (
            ((self.gap - np.roll(self.gap, 1, axis)) / step) ** 2
            for axis, step in enumerate((dx, dy))
        )
        lost = [np.where(each, power, 0.0) for each, power in zip(inside, (x, y), strict=True)]
        total = sum((power * each).sum() for power, each in zip(lost, steep, strict=True))
        return float(np.sqrt(total / sum(power.sum() for power in lost)))

    @property
    def validity(self) -> str:
        """Says why Reynolds' equation is not good for this gap; empty where it is."""
        if steep := why_too_steep(self.slope):
            return steep
        if self.hydraulic_aperture > _HIGH * min(self.sizes):
            return (
                f"the hydraulic aperture is {self.hydraulic_aperture / min(self.sizes):.2g} of the "
                "shorter side: Reynolds' equation holds for thin gaps"
            )
        return ""

    @property
    def _spacing(self) -> tuple[float, float]:
        """Distances of cells along x and along y. [length]"""
        return self.sizes[0] / self.gap.shape[0], self.sizes[1] / self.gap.shape[1]

    @property
    def _forward(self) -> Real:
        """Flow through the faces from the inlet to the outlet, row by row along the flow."""
        return self.rates_x if self.along == "x" else self.rates_y.T

    def _repeats(self, side: Along) -> bool:
        return _REPEATS[self.sides]["xy".index(side)]

    @cached_property
    def _lost(self) -> tuple[Real, Real]:
        """Power that is lost between neighbours along x and along y. [length³]"""
        rates = self.rates_x, self.rates_y
        lost = []
        for rate, face in zip(rates, (self.conductances_x, self.conductances_y), strict=True):
            lost.append(np.divide(rate**2, face, out=np.zeros_like(rate), where=face > 0))
        return lost[0], lost[1]


def why_too_steep(slope: float) -> str:
    """Say why Reynolds' equation is not good for a gap of such a slope; empty where it is."""
    if slope <= _STEEP:
        return ""
    return (
        f"the gap has a slope of {slope:.2g} where the flow is throttled: Reynolds' equation holds "
        "for small slopes, and less than it says flows"
    )


@overload
def flow(
    gap: Any,
    sizes: tuple[float, float] | None = None,
    *,
    along: Along = "x",
    sides: Sides | None = None,
    mean_free_path: float = 0.0,
) -> Flow: ...


@overload
def flow(
    gap: Any,
    sizes: tuple[float, float] | None = None,
    *,
    along: Literal["both"],
    sides: Sides | None = None,
    mean_free_path: float = 0.0,
) -> tuple[Flow, Flow]: ...


@public_names
def flow(
    gap: Any,
    sizes: tuple[float, float] | None = None,
    *,
    along: Along | Literal["both"] = "x",
    sides: Sides | None = None,
    mean_free_path: float = 0.0,
) -> Flow | tuple[Flow, Flow]:
    r"""Let a fluid through the gap between two bodies.

    Solves Reynolds' equation ∇·(u³ ∇P) = 0 in the gap u [1]_; where the bodies touch, nothing
    flows. Every cell of the grid is joined to its four neighbours with the harmonic mean of u³.
    Where the gap repeats along the flow, P is a mean fall and a periodic part, and what flows is
    the same wherever the map is cut; where it ends, inlet and outlet are joined to the first and
    the last cells by half a cell. The conductance of this network is found from sums of positive
    terms alone, so that it is as accurate near sealing as in an open gap.

    Parameters
    ----------
    gap : array_like, shape (nx, ny), or Fields
        Distance of the two bodies, 0 where they touch; or the fields of a load,
        ``curve.fields[i]``. [length]
    sizes : tuple of float
        Sides of the rectangle, (Lx, Ly); fields know theirs. [length]
    along : {"x", "y", "both"}, optional
        Side along which the pressure falls.
    sides : {"periodic", "closed", "x", "y"}, optional
        Along which sides the gap repeats: both, none, or one of them. Where it does not, the two
        borders are inlet and outlet if they are across the flow, and closed if not. Default: as the
        body of the fields repeats; of an array, both.
    mean_free_path : float, optional
        Of a gas, at its pressure there. Every cell lets through what kinetic theory lets through
        plates as far apart [2]_, and where the path is short u³ + 6 λ u², as the gas slips.
        Default: 0, a liquid. [length]

    Returns
    -------
    Flow
        Permeance, hydraulic aperture, pressure and flux; exactly zero where no path is open. Two of
        them, along x and along y, if both are asked for.

    Raises
    ------
    InputError
        If the gap or the sizes cannot be used, or more memory is needed than is free.

    References
    ----------
    .. [1] Reynolds, O. On the theory of lubrication and its application. Phil. Trans. R. Soc. Lond.
       177, 157-234 (1886).
    .. [2] Cercignani, C., Daneri, A. Flow of a rarefied gas between two parallel plates. J. Appl.
       Phys. 34, 3509-3513 (1963).

    Examples
    --------
    >>> import roughline as rl
    >>> round(rl.flow([[2.0, 2.0], [2.0, 2.0]], sizes=(1.0, 1.0)).hydraulic_aperture, 12)
    2.0

    The gap of a contact:

    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> curve = rl.press(surface, E_star=1.0, forces=[0.05], periodic=True, fields=True)
    >>> print(round(rl.flow(curve.fields[0]).hydraulic_aperture, 5))
    0.00162
    """
    one_of("along", along, (*get_args(Along), "both"))
    repeats = gap.repeats if isinstance(gap, Fields) else (True, True)
    known = next(name for name, each in _REPEATS.items() if each == repeats)
    sides = known if sides is None else one_of("sides", sides, get_args(Sides))
    sizes = sizes or (gap.sizes if isinstance(gap, Fields) else None)
    gap = _checked_gap(gap)
    if sizes is None:
        raise InputError("is not given; give the sides of the rectangle, (Lx, Ly)", "sizes")
    sizes, path = checked_sides(sizes), checked_free_path(mean_free_path)
    wanted = get_args(Along) if along == "both" else (along,)
    cell = None
    if any(_REPEATS[sides]["xy".index(each)] for each in wanted):
        cell = _cell(gap, sizes, sides, path)
    given = gap, sizes, sides, path
    found = [
        _through_cell(each, *given, cell)
        if cell is not None and _REPEATS[sides]["xy".index(each)]
        else _between_ends(each, *given)
        for each in wanted
    ]
    return found[0] if len(found) == 1 else (found[0], found[1])


def checked_free_path(given: Any) -> float:
    """A mean free path; refused where it is negative or not finite."""
    needed = "a finite number of at least 0 is needed"
    return between("mean_free_path", given, 0.0, sys.float_info.max, needed)


def _cell(gap: Real, sizes: tuple[float, float], sides: Sides, path: float) -> CellFlow:
    """The flow through a gap that repeats, along both sides at once."""
    from roughline.fluid.cell import cell_flow  # here because compiled loops load slowly
    from roughline.fluid.network import Network

    if sides == "y":  # a gap that ends is closed at its borders across the flow
        return _cell(gap.T, (sizes[1], sizes[0]), "x", path).turned()
    found = windings(gap > 0, _REPEATS[sides])
    _refuse_beyond_memory(found.through)
    ratio = sizes[0] / gap.shape[0] / (sizes[1] / gap.shape[1])
    network = Network(_conducting(gap, found.through, path), 1 / ratio, ratio, *_REPEATS[sides])
    return cell_flow(network, found)


def _through_cell(
    along: Along, gap: Real, sizes: tuple[float, float], sides: Sides, path: float, cell: CellFlow
) -> Flow:
    """The flow along a side along which the gap repeats."""
    k = "xy".index(along)
    rates = cell.rates[0][k], cell.rates[1][k]
    inflow = float(cell.crossing[k, k])
    tensor = None
    if sides == "periodic":
        ratio = sizes[0] / sizes[1]
        tensor = cell.crossing * np.array([[ratio, 1.0], [1.0, 1 / ratio]])
    found = gap, sizes, along, sides, path, cell.pressures[k], *rates, *cell.conductances
    return Flow(*found, inflow, float(cell.sections[k]), tensor)


def _between_ends(
    along: Along, gap: Real, sizes: tuple[float, float], sides: Sides, path: float
) -> Flow:
    """The flow along a side at whose ends the gap ends."""
    from roughline.fluid.network import Network  # here because compiled loops load slowly

    turned, length, width = (gap, *sizes) if along == "x" else (gap.T, *sizes[::-1])
    periodic = _REPEATS[sides][1 if along == "x" else 0]
    from_inlet, from_outlet = joined_to_ends(turned > 0, periodic)
    through = from_inlet & from_outlet
    _refuse_beyond_memory(through)
    ratio = (length / turned.shape[0]) / (width / turned.shape[1])
    network = Network(_conducting(turned, through, path), 1 / ratio, ratio, False, periodic)
    pressures = network.pressures() if through.any() else np.zeros((2, *turned.shape))
    conductances = network.conductances()
    forward, across = _rates(conductances, pressures)
    pressure = np.where(through, pressures[0], np.where(from_inlet, 1.0, np.nan))
    pressure[from_outlet & ~through] = 0.0
    ends = float(forward[0].sum()), float(forward[-1].sum())
    arrays = [pressure, forward, across, *conductances]
    if along == "y":
        pressure, forward, across, *conductances = (each.T for each in arrays)
        arrays = [pressure, across, forward, *conductances[::-1]]
    return Flow(gap, sizes, along, sides, path, *arrays, *ends)


def _conducting(gap: Real, through: Mask, path: float) -> Real:
    """Conductances of the cells through which a fluid flows, were they square. [length³]"""
    found = np.zeros(gap.shape)
    found[through] = conductance(gap[through], path)
    return found


def _refuse_beyond_memory(through: Mask) -> None:
    """Refuse a flow through so many cells that memory cannot hold it."""
    refuse_beyond_memory(
        int(_BYTES * through.sum() * np.log2(max(through.shape))),
        f"a flow through {through.shape[0]} x {through.shape[1]} cells",
        "coarsen the gap",
    )


def _checked_gap(given: Any) -> Real:
    """The gap that is given, as an array of its own."""
    if given is None or isinstance(given, Curve):
        needed = "give the fields of a load, curve.fields[i], which rl.press keeps with fields=True"
        refuse("gap", given, needed)
    if isinstance(given, Line):
        raise InputError(
            "is a Line; along a line, in one dimension, any contact stops the flow: give "
            "the gap under a surface",
            "gap",
        )
    if isinstance(given, Surface):
        raise InputError(
            "is a Surface; press it, with fields=True, and give curve.fields[i]", "gap"
        )
    if isinstance(given, Fields):  # rounding leaves neither gaps in contact nor overlaps beside it
        return np.where(given.contact, 0.0, np.maximum(given.gap, 0.0))
    try:
        gap = np.array(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        refuse("gap", given, "an array of numbers, shape (nx, ny), is needed")
    if gap.ndim != 2 or min(gap.shape) < 2:
        refuse(
            "gap",
            given,
            "two dimensions of at least 2 cells are needed: in one, any contact stops the flow",
        )
    wrong = ~((gap >= 0) & (gap < np.inf))
    if wrong.any():
        i, j = np.argwhere(wrong)[0]
        raise InputError(
            f"has {int(wrong.sum())} negative or not finite values, the first {gap[i, j]} at "
            f"({i}, {j}); a distance is at least 0, and 0 where the bodies touch",
            "gap",
        )
    return gap


def leads_through(open_cells: Mask, along: Along, repeats: tuple[bool, bool]) -> bool:
    """Whether a path of open cells, each beside the next, leads through along a side."""
    k = "xy".index(along)
    if repeats[k]:
        return windings(open_cells, repeats).leads(k)
    from_inlet, from_outlet = joined_to_ends(open_cells if k == 0 else open_cells.T, repeats[1 - k])
    return bool((from_inlet & from_outlet).any())


def joined_to_ends(open_cells: Mask, periodic: bool) -> tuple[Mask, Mask]:
    """Cells from which a path leads to the inlet, and cells from which one leads to the outlet."""
    parts = windings(open_cells, (False, periodic)).parts
    inlet, outlet = (np.isin(parts, border[border >= 0]) for border in (parts[0], parts[-1]))
    return inlet, outlet


def _rates(conductances: tuple[Real, Real], pressures: Real) -> tuple[Real, Real]:
    """Flow through the faces along and across, from pressures that are 1 at either end.

    Where one of them is small, its differences are accurate, and it is used.
    """
    down, up = pressures
    nx, ny = down.shape
    along = np.empty((nx + 1, ny))
    along[0], along[-1] = up[0], down[-1]
    along[1:-1] = _falls(down[:-1], down[1:], up[:-1], up[1:])
    across = np.empty((nx, ny + 1))
    across[:, 1:] = _falls(down, np.roll(down, -1, axis=1), up, np.roll(up, -1, axis=1))
    across[:, 0] = across[:, -1]
    return along * conductances[0], across * conductances[1]


def _falls(down: Real, down_next: Real, up: Real, up_next: Real) -> Real:
    """Fall of the pressure from cells to their neighbours."""
    return np.where(down + down_next < up + up_next, down - down_next, up_next - up)
