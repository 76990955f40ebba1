"""The exact tangents of bodies in which pressure displaces along the surface, and shear into it.

Where a node slips its shear follows the pressure, so that the equations are not symmetric.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.computing.krylov import least_residual
from roughline.halfspace.friction.rates import Going, Rates, Rim, rate_rounding, slip_on
from roughline.halfspace.friction.sheared_nodes import ShearedNodes
from roughline.halfspace.friction.tangents import ENERGY_MARGIN, is_rigid
from roughline.halfspace.friction.unit_ways import ShearTangents, UnitWays, ways_under
from roughline.halfspace.friction.vectors import on_nodes
from roughline.halfspace.inverse.approximate_inverse import preconditioner
from roughline.halfspace.search.problem import Contact, Method

_NOTHING_RESISTS = 1e-9  # of the largest stiffness along the surface
_COUPLED_SHARE = 1e-3  # of what rough operators correct, and what they err by
_MOST_TURNS = 10  # of corrections


def coupled_tangents(
    maps: ShearedNodes,
    contact: Contact,
    rim: Rim,
    going: Going,
    method: Method,
    last: ShearTangents | None = None,
) -> tuple[ShearTangents, tuple[float, float]]:
    """Solve for both tangents of bodies that are coupled, and for dF/dd on both.

    Where a node slips its shear follows the pressure, so that the equations are not symmetric. The
    tangents are those under a constant force, and dF/dd is that under a constant shear force. They
    are begun with those of the last load.
    """
    nobody = np.zeros_like(rim.full)
    if is_rigid(contact):  # how it goes on where some of it slips is not known
        stuck = np.diag([np.inf, np.inf])
        going_on = np.full((2, 2), np.nan) if rim.full.any() else stuck
        return ShearTangents(~rim.full, going_on, stuck), (np.inf, np.inf)
    begun = (None, None) if last is None or last.coupled is None else last.coupled
    rates = _CoupledRates(maps, contact, rim, going, method.rtol)
    back = rates.ways(nobody, begun[1])
    rates.start = back if begun[0] is None else begun[0].moved(begun[1], back)
    slips = rates.slips_on()
    on = rates.ways(slips) if slips.any() or rates.yielding.any() else back
    (along_on, normal_on), (along_back, normal_back) = (
        _condensed(on.totals),
        _condensed(back.totals),
    )
    if rates.yielding.sum() < contact.plastic.sum():  # under more load all of them yield on
        rates.yielding = contact.plastic
        _, normal_on = _condensed(rates.ways(slips).totals)
    both = (on, back) if np.isfinite([on.totals, back.totals]).all() else None
    tangents = ShearTangents(~slips, along_on, along_back, rates.spent, coupled=both)
    return tangents, (normal_on, normal_back)


class _CoupledRates:
    """How pressures and shear go on where both move each other."""

    def __init__(
        self, maps: ShearedNodes, contact: Contact, rim: Rim, going: Going, rtol: float
    ) -> None:
        self._maps, self._contact, self._rim, self._going = maps, contact, rim, going
        self._rtol, self.spent = rtol, 0
        self.start: UnitWays | None = None
        self.yielding = np.zeros_like(rim.full)  # nodes at the hardness that bear no more
        self._known: tuple[Real, Real, UnitWays] | None = None
        self._goes_on_wrong = np.zeros_like(rim.full)

    def ways(self, slips: Mask, start: UnitWays | None = None) -> UnitWays:
        """Return pressures and shear by unit slides and a unit approach where some nodes slip."""
        sets = np.array([slips, self.yielding])
        if self._known is None or (self._known[0] != sets).any():
            stuck = _CoupledStuck(self._maps, self._contact, self._rim, slips, self.yielding)
            form, tractions = stuck.stiffness(self._rtol, start or self.start)
            self.spent += 7 * stuck.products
            totals = self._contact.problem.grid.cell_area * form
            ways = UnitWays(self._contact.nodes, tractions.astype(np.float32), totals)
            self._known, self.start = (sets, tractions, ways), ways
        return self._known[2]

    def slips_on(self) -> Mask:
        """Return which nodes slip on, and find those that yield on: the dents of these grow.

        A node at the hardness that yields no more must bear less.
        """
        self.yielding, slips = self._contact.plastic.copy(), self._rim.full & False
        for _ in range(_MOST_TURNS):
            self._goes_on_wrong[:] = False
            if self._rim.may_slip.any():
                slips = slip_on(self._rim, self.of)
            elif self.yielding.any():
                self.of(slips)
            if not self._goes_on_wrong.any():
                break
            self.yielding = self.yielding ^ self._goes_on_wrong
        return slips

    def of(self, slips: Mask) -> Rates | None:
        """Return how nodes go on where some slip; None if nothing goes on, or it is not solved."""
        totals = self.ways(slips).totals
        if self._going.stands or np.isnan(totals).any():
            return None
        assert self._known is not None
        moved = ways_under(totals, self._going)
        both = self._known[1] @ moved
        shear, pressure = np.ascontiguousarray(both[:, :2]), both[:, 2].copy()
        self.spent += 7
        into, there = self._maps.displaced(pressure, shear)
        dents, plastic = moved[2] - into, self._contact.plastic
        self._goes_on_wrong = np.where(
            self.yielding,
            dents < -rate_rounding(dents),
            plastic & (pressure > rate_rounding(pressure)),
        )
        slip = self._rim.along(moved[:2] - there)
        return Rates(slip, self._rim.along(shear) - self._rim.slope * pressure)


def _condensed(matrix: Real) -> tuple[Real, float]:
    """Return dQ/d(slide) under a constant force, and dF/dd under a constant shear force.

    Where nothing resists a slide, as where the bodies slide, dF/dd is that without it.
    """
    along, normal = matrix[:2, :2], float(matrix[2, 2])
    of_depth, of_slide = matrix[:2, 2], matrix[2, :2]
    held = along
    if normal:  # else all nodes yield on, and bear no more in any case
        held = along - np.outer(of_depth, of_slide) / normal
    if not np.isfinite(matrix).all():
        return held, np.nan
    slide = np.linalg.lstsq(along, of_depth, rcond=_NOTHING_RESISTS)[0]
    return held, normal - float(of_slide @ slide)


class _CoupledStuck:
    """A contact of coupled bodies, of which some nodes slip on, and some yield on."""

    def __init__(
        self, maps: ShearedNodes, contact: Contact, rim: Rim, slips: Mask, yielding: Mask
    ) -> None:
        self._maps, self._contact, self._slips = maps, contact, slips
        self._yielding = yielding
        self._outward = np.where(slips[:, np.newaxis], rim.outward, 0.0)
        self._slope, self.products = rim.slope, 0
        self._normal = preconditioner(contact.problem.grid.inverse, maps.nodes)

    def _radial(self, vectors: Real) -> Real:
        """Return what of vectors nodes that slip cannot follow."""
        along = np.einsum("ij,ij->i", self._outward, vectors)
        return self._outward * along[:, np.newaxis]

    def _exactly(self, unknown: Real) -> Real:
        self.products += 1
        return self._product(unknown, self._maps.displaced)

    def _roughly(self, unknown: Real) -> Real:
        return self._product(unknown, self._maps.roughly_displaced)

    def _product(self, unknown: Real, moved: Callable[[Real, Real], tuple[Real, Real]]) -> Real:
        """Return the displacements by pressure and shear, and what is left of the radial shear.

        Of a node that yields on it is what is left of its pressure.
        """
        given, free = self._apart(unknown)
        pressure = np.where(self._yielding, 0.0, given)
        radial = self._radial(free)
        shear = free - radial + self._outward * (self._slope * pressure)[:, np.newaxis]
        into, along = moved(pressure, shear)
        along = along + self._maps.diagonal * radial - self._radial(along)
        into = np.where(self._yielding, self._maps.diagonal * given, into)
        return np.concatenate([into, along.ravel()])

    def _preconditioned(self, moved: Real) -> Real:
        into, along = self._apart(moved)
        radial = self._radial(along)
        shear = self._maps.inverse(along - radial)
        shear += radial / self._maps.diagonal - self._radial(shear)
        pressure = self._normal(np.where(self._yielding, 0.0, into))
        pressure = np.where(self._yielding, into / self._maps.diagonal, pressure)
        return np.concatenate([pressure, shear.ravel()])

    def _apart(self, both: Real) -> tuple[Real, Real]:
        count = self._slips.size
        return np.ascontiguousarray(both[:count]), both[count:].reshape(-1, 2)

    def stiffness(self, rtol: float, start: UnitWays | None) -> tuple[Real, Real]:
        """Return the totals by unit slides and a unit approach, and the tractions.

        Where all nodes stick the equations are symmetric, and the totals are the energy form.
        """
        count = self._slips.size
        matrix, tractions = np.full((3, 3), np.nan), np.zeros((count, 3, 3))
        begun = self._begun(start)
        solved = []
        for axis in range(3):
            target = np.zeros(3 * count)
            if axis == 2:
                target[:count] = ~self._yielding
            else:
                even = np.zeros((count, 2)) + np.eye(2)[axis]
                target[count:] = (even - self._radial(even)).ravel()
            solved.append((target, self._solved(target, begun[axis], rtol)))
        for axis, (_, found) in enumerate(solved):
            if found is None:
                continue
            pressure, free = self._apart(found[0])
            pressure = np.where(self._yielding, 0.0, pressure)
            shear = free - self._radial(free)
            shear += self._outward * (self._slope * pressure)[:, np.newaxis]
            tractions[:, :2, axis], tractions[:, 2, axis] = shear, pressure
            matrix[:, axis] = *shear.sum(axis=0), pressure.sum()
            if not self._slips.any():
                for other, (_, whole) in enumerate(solved):
                    if whole is not None:
                        matrix[other, axis] += np.einsum("i,i->", whole[0], found[1])
        return matrix, tractions

    def _begun(self, start: UnitWays | None) -> list[Real]:
        """Return the unknowns to begin with: as they were, or as the bodies are pressed."""
        count = self._slips.size
        tractions = np.zeros((count, 3, 3))
        if start is not None:
            tractions = on_nodes(self._contact.nodes, start.nodes, start.tractions)
        begun = []
        for axis in range(3):
            shear = tractions[:, :2, axis].astype(np.float64)
            free = shear - self._radial(shear)
            begun.append(np.concatenate([tractions[:, 2, axis], free.ravel()]))
        return begun

    def _solved(self, target: Real, start: Real, rtol: float) -> tuple[Real, Real] | None:
        """Solve with rough operators, and correct what they miss; None without convergence.

        What is left is returned, too. Where all nodes stick, the totals err by its energy.
        """
        if not target.any():  # all nodes yield on: none is pressed by an approach
            return np.zeros_like(target), target
        symmetric, rough = not self._slips.any(), self._maps.rough is not None
        enough = math.sqrt(ENERGY_MARGIN * rtol) if symmetric else rtol
        found, whole, left = start, float(np.abs(target).max()), math.inf
        for _ in range(_MOST_TURNS):
            residual = target - self._exactly(found) if found.any() else target
            before, left = left, float(np.abs(residual).max()) / whole
            if left <= rtol:
                return found, residual
            if symmetric and found.any():
                energy = float(np.einsum("i,i->", residual, self._preconditioned(residual)))
                if energy <= ENERGY_MARGIN * rtol * float(np.einsum("i,i->", target, found)):
                    return found, residual
            rough &= left <= 0.5 * before
            aim = max(_COUPLED_SHARE if rough else 0.0, 0.3 * enough / left)
            product = self._roughly if rough else self._exactly
            found = found + least_residual(product, self._preconditioned, residual, aim)[0]
        return None
