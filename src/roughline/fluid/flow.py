"""What a gap lets through between two opposite sides: the entry point, and what it returns."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, get_args, overload

import numpy as np

from roughline.computing.arrays import Integers, Mask, Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.curve import Curve
from roughline.contact.fields import Fields
from roughline.errors import InputError
from roughline.errors.checks import between, one_of, refuse
from roughline.errors.public import public_names
from roughline.topography.body import Line, Surface
from roughline.topography.heights import checked_sides

if TYPE_CHECKING:
    from roughline.fluid.network import Network

Along = Literal["x", "y"]
Sides = Literal["periodic", "closed"]

_AGREEMENT = 1e-8  # of inflow, outflow and dissipation, relative to the inflow
_NARROW = 0.25  # of the width: what is wider is no single channel
_BYTES = 110  # that an open cell takes for each doubling of a side
_STEEP = 0.3  # slope of the gap beyond which Reynolds' equation is no longer good
_HIGH = 0.1  # hydraulic aperture over the shorter side beyond which it is not either


@dataclass(frozen=True, eq=False)
class Flow:
    """Flow of a fluid through a gap, under a unit difference of pressure.

    Attributes
    ----------
    gap : ndarray, shape (nx, ny)
        Distance of the two bodies, zero where they touch. [length]
    sizes : tuple of float
        Sides of the rectangle, (Lx, Ly). [length]
    along : {"x", "y"}
        Side along which the fluid flows; inlet and outlet are its two ends.
    sides : {"periodic", "closed"}
        Whether fluid that leaves at one of the other two borders enters at the opposite one.
    mean_free_path : float
        Of a gas, at the pressure for which this flow is; zero without slip. [length]
    pressure : ndarray, shape (nx, ny)
        Pressure of the fluid: 1 at the inlet, 0 at the outlet; NaN where there is no fluid, or none
        that is joined to either. [1]
    rates_x, rates_y : ndarray, shapes (nx + 1, ny) and (nx, ny + 1)
        Flow through the faces between cells, positive in the direction of x and y, times
        12 viscosity / pressure difference. [length³]
    network : Network
        The cells through which fluid flows, and their conductances.
    """

    gap: Real
    sizes: tuple[float, float]
    along: Along
    sides: Sides
    mean_free_path: float
    pressure: Real
    rates_x: Real
    rates_y: Real
    network: Network = field(repr=False)

    __repr__ = summary
    _repr_html_ = in_notebook

    @property
    def inflow(self) -> float:
        """Flow through the inlet, times 12 viscosity / pressure difference. [length³]"""
        return float(self._forward[0].sum())

    @property
    def outflow(self) -> float:
        """Flow through the outlet, times 12 viscosity / pressure difference. [length³]"""
        return float(self._forward[-1].sum())

    @cached_property
    def dissipation(self) -> float:
        """Power lost in the fluid, times 12 viscosity / pressure difference². [length³]

        Pressure times flow is power, so that this is the flow once more.
        """
        along, across = self._lost
        return float(along.sum() + across[:, 1:].sum())

    @property
    def imbalance(self) -> float:
        """Largest difference of inflow, outflow and dissipation, over the inflow; 0 if sealed."""
        if self.is_sealed:
            return 0.0
        three = self.inflow, self.outflow, self.dissipation
        return (max(three) - min(three)) / self.inflow

    @property
    def converged(self) -> bool:
        """Whether inflow, outflow and dissipation agree to 1e-8."""
        return bool(self.imbalance <= _AGREEMENT)

    @property
    def is_sealed(self) -> bool:
        """Whether no path leads from the inlet to the outlet."""
        return not self._forward[0].any()

    @property
    def permeance(self) -> float:
        r"""Permeance Λ = 12 η ⟨j⟩ / \|⟨∇P⟩\| of the interface; exactly 0 if sealed. [length³]"""
        length, width = self.sizes if self.along == "x" else self.sizes[::-1]
        return self.inflow * length / width

    @property
    def hydraulic_aperture(self) -> float:
        """Gap u_h = Λ^(1/3) of two flat plates that let as much through. [length]"""
        return float(np.cbrt(self.permeance))

    @property
    def flux(self) -> Real:
        """Flow per width at the cells along x and y, times 12 η / ΔP, (2, nx, ny). [length²]"""
        dx, dy = (side / n for side, n in zip(self.sizes, self.gap.shape, strict=True))
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
        along, across = self._lost
        lost = along[:-1] + along[1:] + across[:, :-1] + across[:, 1:]
        i, j = np.unravel_index(int(lost.argmax()), lost.shape)
        return (int(i), int(j)) if self.along == "x" else (int(j), int(i))

    @cached_property
    def largest_share(self) -> float:
        """Largest share of the flow that one channel carries; 0 if sealed. [1]

        A channel is what is open between two places of contact on a line across the flow, if it is
        not wider than a quarter of the side.
        """
        if self.is_sealed:
            return 0.0
        return max(map(self._largest_share_of_row, self._forward[1:-1])) / self.inflow

    @cached_property
    def slope(self) -> float:
        """Rms slope of the gap, weighted with the power that is lost there; 0 if sealed. [1]"""
        if self.is_sealed:
            return 0.0
        gap = self.gap if self.along == "x" else self.gap.T
        length, width = self.sizes if self.along == "x" else self.sizes[::-1]
        along, across = self._lost
        steep = (np.diff(gap, axis=0) * gap.shape[0] / length) ** 2
        aside = (np.diff(gap, axis=1, prepend=gap[:, -1:]) * gap.shape[1] / width) ** 2
        inside, beside = along[1:-1], across[:, :-1]  # nothing flows around where sides are closed
        total = (inside * steep).sum() + (beside * aside).sum()
        return float(np.sqrt(total / (inside.sum() + beside.sum())))

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
    def _forward(self) -> Real:
        """Flow through the faces from the inlet to the outlet, row by row along the flow."""
        return self.rates_x if self.along == "x" else self.rates_y.T

    @cached_property
    def _lost(self) -> tuple[Real, Real]:
        """Power that is lost between neighbours along the flow and across it. [length³]"""
        across = self.rates_y if self.along == "x" else self.rates_x.T
        rates, conductances = (self._forward, across), self.network.conductances()
        lost = []
        for rate, conductance in zip(rates, conductances, strict=True):
            is_open = conductance > 0
            lost.append(np.divide(rate**2, conductance, out=np.zeros_like(rate), where=is_open))
        return lost[0], lost[1]

    def _largest_share_of_row(self, rates: Real) -> float:
        """Largest flow of one channel through a row of faces."""
        flows = rates != 0
        if flows.all():
            return 0.0
        if self.sides == "periodic":  # begin where nothing flows, so that no channel is cut
            rates = np.roll(rates, -int(np.flatnonzero(~flows)[0]))
            flows = rates != 0
        edges = np.flatnonzero(np.diff(flows, prepend=False, append=False))
        firsts, ends = edges[::2], edges[1::2]
        narrow = ends - firsts <= _NARROW * rates.size
        sums = np.concatenate([[0.0], np.cumsum(rates)])
        return float((sums[ends] - sums[firsts])[narrow].max(initial=0.0))


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
    r"""Let a fluid through the gap between two bodies, from one side to the opposite one.

    Solves Reynolds' equation ∇·(u³ ∇P) = 0 in the gap u [1]_; where the bodies touch, nothing
    flows. Every cell of the grid is joined to its four neighbours with the harmonic mean of u³, to
    inlet and outlet by half a cell. The conductance of this network is found from sums of positive
    terms alone, so that it is as accurate near sealing as in an open gap.

    Parameters
    ----------
    gap : array_like, shape (nx, ny), or Fields
        Distance of the two bodies, 0 where they touch; or the fields of a load,
        ``curve.fields[i]``. [length]
    sizes : tuple of float
        Sides of the rectangle, (Lx, Ly); fields know theirs. [length]
    along : {"x", "y", "both"}, optional
        Side along which the fluid flows.
    sides : {"periodic", "closed"}, optional
        Whether fluid that leaves at one of the other two borders enters at the opposite one.
        Default: periodic; closed for fields of a body that is not repeated along them.
    mean_free_path : float, optional
        Of a gas, at its mean pressure. It slips along the walls: u³ becomes u³ + 6 λ u². Default:
        0, a liquid. [length]

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

    Examples
    --------
    >>> import roughline as rl
    >>> round(rl.flow([[2.0, 2.0], [2.0, 2.0]], sizes=(1.0, 1.0)).hydraulic_aperture, 12)
    2.0

    The gap of a contact:

    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> curve = rl.press(surface, E_star=1.0, forces=[0.05], periodic=True, fields=True)
    >>> print(round(rl.flow(curve.fields[0]).hydraulic_aperture, 5))
    0.00163
    """
    one_of("along", along, (*get_args(Along), "both"))
    one_of("sides", sides or "periodic", get_args(Sides))
    repeats = gap.repeats if isinstance(gap, Fields) else (True, True)
    sizes = sizes or (gap.sizes if isinstance(gap, Fields) else None)
    gap = _checked_gap(gap)
    if sizes is None:
        raise InputError("is not given; give the sides of the rectangle, (Lx, Ly)", "sizes")
    given = gap, checked_sides(sizes), checked_free_path(mean_free_path)
    of_x, of_y = (sides or ("periodic" if each else "closed") for each in repeats)
    if along == "both":  # beside a flow along x are the sides of y
        return _solved("x", of_y, *given), _solved("y", of_x, *given)
    return _solved(along, of_y if along == "x" else of_x, *given)


def checked_free_path(given: Any) -> float:
    """A mean free path; refused where it is negative or not finite."""
    needed = "a finite number of at least 0 is needed"
    return between("mean_free_path", given, 0.0, sys.float_info.max, needed)


def _solved(along: Along, sides: Sides, gap: Real, sizes: tuple[float, float], path: float) -> Flow:
    """The flow along one side."""
    from roughline.fluid.network import Network  # here because compiled loops load slowly

    turned, length, width = (gap, *sizes) if along == "x" else (gap.T, *sizes[::-1])
    periodic = sides == "periodic"
    from_inlet, from_outlet = components(turned > 0, periodic)
    through = from_inlet & from_outlet
    points = int(through.sum())
    refuse_beyond_memory(
        int(_BYTES * points * np.log2(max(gap.shape))),
        f"a flow through {gap.shape[0]} x {gap.shape[1]} cells",
        "coarsen the gap",
    )
    cells = np.where(through, turned**2 * (turned + 6 * path), 0.0)
    ratio = (length / turned.shape[0]) / (width / turned.shape[1])
    network = Network(cells, 1 / ratio, ratio, periodic)
    pressures = network.pressures() if points else np.zeros((2, *cells.shape))
    forward, across = _rates(network, pressures)
    pressure = np.where(through, pressures[0], np.where(from_inlet, 1.0, np.nan))
    pressure[from_outlet & ~through] = 0.0
    if along == "y":
        forward, across, pressure = across.T, forward.T, pressure.T
    return Flow(gap, sizes, along, sides, path, pressure, forward, across, network)


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


def components(open_cells: Mask, periodic: bool) -> tuple[Mask, Mask]:
    """Cells from which a path leads to the inlet, and cells from which one leads to the outlet."""
    # here because it loads slowly
    from scipy.ndimage import label

    parts: Integers
    parts, count = label(open_cells)
    if periodic:
        parts = _joined_across(parts, count)
    inlet, outlet = (np.isin(parts, border[border > 0]) for border in (parts[0], parts[-1]))
    return inlet, outlet


def _joined_across(parts: Integers, count: int) -> Integers:
    """Give parts that meet across the periodic border one number."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    first, last = parts[:, 0], parts[:, -1]
    meet = (first > 0) & (last > 0)
    links = coo_matrix(
        (np.ones(meet.sum()), (first[meet], last[meet])), shape=(count + 1, count + 1)
    )
    numbers = connected_components(links, directed=False)[1] + 1
    return np.where(parts > 0, numbers[parts], 0)


def _rates(network: Network, pressures: Real) -> tuple[Real, Real]:
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
    conductances = network.conductances()
    return along * conductances[0], across * conductances[1]


def _falls(down: Real, down_next: Real, up: Real, up_next: Real) -> Real:
    """Fall of the pressure from cells to their neighbours."""
    return np.where(down + down_next < up + up_next, down - down_next, up_next - up)
