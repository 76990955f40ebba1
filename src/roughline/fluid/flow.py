"""What a gap lets through, between two opposite sides or as it repeats: entry point and result."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, get_args, overload

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice
from roughline.errors.public import public_names
from roughline.facts.fact import Fact
from roughline.fluid.gap import REPEATS, Along, Gap, Sides

_FLOW_AGREEMENT = 1e-8  # of inflow, outflow and dissipation, relative to the inflow
_LARGEST_CHANNEL = 0.25  # of the width: what is wider is no single channel
_STEEPEST_GAP = 0.3  # slope of the gap beyond which Reynolds' equation is no longer good
_HIGHEST_APERTURE = 0.1  # hydraulic aperture over the shorter side beyond which it is not either


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
        repeats_x, repeats_y = REPEATS[self.sides]
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
        return bool(self.imbalance <= _FLOW_AGREEMENT)

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
        (xx, xy), (yx, yy) = self._checked_tensor
        across = xy if xx < yy else yx  # what flows along the tighter side, which is accurate
        largest = (xx + yy) / 2 + np.hypot((xx - yy) / 2, across)
        least = max(xx * yy - across**2, 0.0) / largest if largest > 0 else 0.0
        return float(largest), float(least)

    @property
    def easiest_direction(self) -> float:
        """Angle of the direction of the largest permeance, from x towards y. [degrees]

        NaN of a gap that is sealed along both sides.

        Raises
        ------
        InputError
            If the gap does not repeat along both sides.
        """
        (xx, xy), (yx, yy) = self._checked_tensor
        if xx == yy == 0:
            return float("nan")
        return float(np.degrees(np.arctan2(xy + yx, xx - yy)) / 2)

    @property
    def _checked_tensor(self) -> Real:
        if self.tensor is None:
            raise InputError(
                "the permeance has directions where the gap repeats along both sides: this one has "
                f'sides="{self.sides}"'
            )
        return self.tensor

    @cached_property
    def border_permeances(self) -> tuple[float, float]:
        """Permeances with the flow given along the border across it, and with the pressure held.

        They are of a map that is cut out of a larger surface, of which the gap beyond the border is
        not known. The flow is given there as flat plates share it. With the pressure held even,
        more flows than if the map repeats. With the flow given, less does, as a rule: more may,
        where both borders do not fit together. Both are zero where no path leads from one of them
        to the other. [length³]

        Raises
        ------
        InputError
            If the gap does not repeat along the flow.
        """
        if self.has_ends:
            raise InputError(
                "what the border does is known of a gap that repeats along the flow: along "
                f'{self.along} this one ends, sides="{self.sides}"'
            )
        from roughline.fluid.border import permeances_of_border  # here because it loads slowly

        gap = Gap(self.gap, self.sizes, self.sides, self.mean_free_path)
        return permeances_of_border(gap, self.along)

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
        width = _LARGEST_CHANNEL * rows.shape[1]
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
        repeats_x, repeats_y = REPEATS[self.sides]
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
        if steep := too_steep(self.slope):
            return str(steep)
        if self.hydraulic_aperture > _HIGHEST_APERTURE * min(self.sizes):
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
        return REPEATS[self.sides]["xy".index(side)]

    @cached_property
    def _lost(self) -> tuple[Real, Real]:
        """Power that is lost between neighbours along x and along y. [length³]"""
        rates = self.rates_x, self.rates_y
        lost = []
        for rate, face in zip(rates, (self.conductances_x, self.conductances_y), strict=True):
            lost.append(np.divide(rate**2, face, out=np.zeros_like(rate), where=face > 0))
        return lost[0], lost[1]


def too_steep(slope: float) -> Fact | None:
    """Say why Reynolds' equation is not good for a gap of such a slope; None where it is."""
    return Fact("gap_is_steep", slope=slope) if slope > _STEEPEST_GAP else None


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
    allowed_choice("along", along, (*get_args(Along), "both"))
    checked = Gap.of(gap, sizes, sides, mean_free_path)
    if along == "both":
        return _flow_along_both(checked)
    return (
        _through_cell(checked)[along] if checked.repeats(along) else _between_ends(checked, along)
    )


def _flow_along_both(gap: Gap) -> tuple[Flow, Flow]:
    """The flow along x, and along y."""
    found = _through_cell(gap) if gap.sides != "closed" else {}
    x, y = (found.get(along) or _between_ends(gap, along) for along in get_args(Along))
    return x, y


def _through_cell(gap: Gap) -> dict[Along, Flow]:
    """The flow along each side along which a gap repeats, all from one factorisation."""
    from roughline.fluid.cell import CellFlow, cell_flow  # here because compiled loops load slowly
    from roughline.fluid.network import Network
    from roughline.fluid.winding import windings

    def solved(turned: Gap) -> CellFlow:
        if turned.sides == "y":  # a gap that ends is closed at its borders across the flow
            return solved(turned.turned()).turned()
        found = windings(turned.distances > 0, REPEATS[turned.sides])
        ratio, cells = turned.ratio, turned.conducting(found.through)
        return cell_flow(Network(cells, 1 / ratio, ratio, *REPEATS[turned.sides]), found)

    cell, tensor = solved(gap), None
    if gap.sides == "periodic":
        shape = gap.sizes[0] / gap.sizes[1]
        tensor = cell.crossing * np.array([[shape, 1.0], [1.0, 1 / shape]])
    return {
        along: Flow(
            gap=gap.distances,
            sizes=gap.sizes,
            along=along,
            sides=gap.sides,
            mean_free_path=gap.path,
            pressure=cell.pressures[k],
            rates_x=cell.rates[0][k],
            rates_y=cell.rates[1][k],
            conductances_x=cell.conductances[0],
            conductances_y=cell.conductances[1],
            inflow=float(cell.crossing[k, k]),
            outflow=float(cell.sections[k]),
            tensor=tensor,
        )
        for k, along in enumerate(get_args(Along))
        if gap.repeats(along)
    }


def _between_ends(gap: Gap, along: Along) -> Flow:
    """The flow along a side at whose ends the gap ends."""
    from roughline.fluid.ends import ended_flow  # here because compiled loops load slowly

    found = ended_flow(gap) if along == "x" else ended_flow(gap.turned()).turned()
    forward = found.rates[0] if along == "x" else found.rates[1].T
    return Flow(
        gap=gap.distances,
        sizes=gap.sizes,
        along=along,
        sides=gap.sides,
        mean_free_path=gap.path,
        pressure=found.pressure,
        rates_x=found.rates[0],
        rates_y=found.rates[1],
        conductances_x=found.conductances[0],
        conductances_y=found.conductances[1],
        inflow=float(forward[0].sum()),
        outflow=float(forward[-1].sum()),
    )
