"""The nodes of a grid among which a contact is sought, and what pressures on them leave."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Floats, InGrid, InRegion, Mask, Real, among
from roughline.computing.compiled import compiled
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.corrected import CorrectedOperator
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision
from roughline.halfspace.operators.restricted import RestrictedOperator
from roughline.halfspace.search.carriers import Carriers, merged
from roughline.halfspace.search.problem import (
    Contact,
    ContactSet,
    Load,
    Outcome,
    Problem,
    Residuals,
)

# Nodes of a gap below so many times the error on contact may come into contact.
REACH_OF_ERROR = 2.0
_LARGEST_REGION = 0.4  # part of the grid that is a region by itself


@dataclass(frozen=True, eq=False)
class Region:
    """Nodes among which a contact is sought; each is given by its place among them.

    All nodes are here where the bodies, as they are now, are nearer than its reach at first touch.
    """

    problem: Problem
    operator: CorrectedOperator  # for the displacements of the nodes
    separation: Real  # distance of the bodies there [length]
    bounds: Bounds  # of the pressures there
    reach: float  # [length]

    @classmethod
    def everywhere(cls, problem: Problem) -> Region:
        """All nodes of the grid, with the exact operator."""
        operator, separation = CorrectedOperator(problem.operator), problem.separation.ravel()
        return cls(problem, operator, separation, problem.bounds, math.inf)

    @classmethod
    def possible(cls, problem: Problem, contact: InGrid, reach: float) -> Region:
        """All nodes that lie nearer than a reach, with the exact operator.

        The nodes of a contact and their neighbours are among them, too.
        """
        if math.isinf(reach) or problem.operator.small_grid:
            return cls.everywhere(problem)
        is_near = problem.separation <= problem.touch + reach
        x, y = np.divmod(contact, is_near.shape[1])
        for step in (-1, 0, 1):
            is_near[(x + step) % is_near.shape[0], y] = True
            is_near[x, (y + step) % is_near.shape[1]] = True
        places = InGrid(np.flatnonzero(is_near))
        if places.size > _LARGEST_REGION * is_near.size:
            return cls.everywhere(problem)
        nodes = GridNodes.of(places, is_near.shape)
        bounds, separation = problem.bounds.at(places), problem.separation.flat[places]
        return cls(
            problem, CorrectedOperator(problem.operator, nodes=nodes), separation, bounds, reach
        )

    def carriers(self, contact_set: ContactSet) -> Carriers:
        """Return the nodes of a contact set as carriers, within their bounds.

        Nodes whose bounds allow no zero pressure are among them.
        """
        places = InRegion(contact_set.nodes)  # all of the grid, unless there are fewer nodes
        if self.operator.nodes is not None:
            places = InRegion(np.searchsorted(self.operator.nodes.indices, contact_set.nodes))
        found = Carriers(places, self.bounds.at(places).nearest(contact_set.pressure))
        if not self.bounds.pulled.size:
            return found
        pulled = InRegion(np.setdiff1d(self.bounds.pulled, places, assume_unique=True))
        return found.joined_by(pulled, self.bounds.at(pulled).low)

    def touching_among(self, carriers: Carriers) -> Carriers:
        """Return the carriers that are between their bounds."""
        return carriers.without(~self.bounds.at(carriers.places).touching(carriers.pressure))

    def bearing(self, touching: Carriers) -> Carriers:
        """Return touching nodes, within their bounds, and with them all others that are pulled."""
        pressure = np.broadcast_to(self.bounds.low, self.separation.shape).copy()
        bears = pressure != 0
        places = touching.places
        pressure[places] = np.maximum(touching.pressure, pressure[places])
        bears[places] = True
        bearing = InRegion(np.flatnonzero(bears))
        return Carriers(bearing, pressure if bears.all() else pressure[bearing])

    def around(self, trial: Trial, nodes: InGrid) -> tuple[Region, Load, Carriers]:
        """Return nodes of the grid as a region, with its load and its touching nodes.

        The trial is one of all of the grid, and pressures on other nodes stay as they are there.
        """
        here = np.zeros(trial.gap.size, dtype=bool)
        here[nodes] = True
        carriers, within = trial.carriers, here[trial.carriers.places]
        places = InRegion(np.searchsorted(nodes, carriers.places[within]))
        found = Carriers(places, carriers.pressure[within])
        moved = trial.gap[nodes]
        moved += trial.approach
        problem = replace(self.problem)  # without the bounds of all nodes
        listed, bounds = problem.grid.nodes(nodes), self.bounds.at(nodes)
        linear = problem.inverse.restricted.on(listed) or problem.operator
        region = _centred(problem, linear, listed, bounds, found, moved)
        load = trial.load
        if load.force is not None:
            beyond = self.problem.grid.cell_area * float(carriers.pressure[~within].sum())
            load = Load(force=load.force - beyond)
        return region, load, found.without(~trial.touching[within])

    def near(self, trial: Trial, reach: float) -> tuple[Region, Carriers] | None:
        """Return the nodes near the contact of a trial as a region; None if that costs more.

        The trial is one in this region with the exact operator. Nodes off the contact are near
        whose gap is below so many times the error on contact.
        """
        carriers, grid = trial.carriers, self.problem.grid.shape
        most = max(0, int(_LARGEST_REGION * math.prod(grid)) - carriers.places.size)
        places, order = merged(carriers.places, trial.close(reach, most))
        found = Carriers(InRegion(np.flatnonzero(order < carriers.places.size)), carriers.pressure)
        moved = trial.gap[places]
        moved[found.places[trial.plastic]] -= trial.overlap
        moved += trial.approach
        nodes = self.operator.grid_nodes(places)
        region = _restricted(self.problem, nodes, self.bounds.at(places), found, moved)
        return (region, found) if region else None

    def recentred(self, carriers: Carriers, precision: Precision) -> Region:
        """Return the region with the operator that is exact for the pressures of carriers."""
        operator = self.operator.recentred(carriers.pressure, carriers.places, precision)
        return replace(self, operator=operator)

    def trial(
        self,
        load: Load,
        carriers: Carriers,
        precision: Precision,
        *,
        rescale: bool = False,
    ) -> Trial:
        """Compute the gaps that pressures leave, and their residuals.

        Under a given force the pressures are scaled to it. With `rescale` they are scaled under a
        given depth, too, to those of least energy.
        """
        places, pressure = carriers.places, carriers.pressure
        bounds, touch = self.bounds.at(places), self.problem.touch
        cell_area = self.problem.grid.cell_area
        if load.force is None:
            pressure = bounds.lowered(pressure)
        else:
            pressure = bounds.with_total(pressure, load.force / cell_area)
        touching = bounds.touching(pressure)
        moved = self.operator.displacement(pressure, places, precision)
        # dents put touch deep: from there on, differences of lengths lose least to rounding
        above = self.separation[places] - touch
        approach = None if load.depth is None else load.depth - touch
        if approach is not None and rescale and touching.all() and self.problem.law.only_pushes:
            factor = _best_factor(approach - above, pressure, moved[places])
            below = np.nextafter(bounds.high, 0.0)  # so that none reaches its bound
            with np.errstate(divide="ignore", over="ignore"):
                factor = min(factor, float((below / pressure).min()))
            pressure = np.minimum(factor * pressure, below)  # the product may be rounded up
            moved *= factor
        if approach is None:
            approach = _level(moved[places] + above, pressure, touching)
        del above
        _leave_gaps(moved, self.separation, touch, approach)
        return Trial.of(self, load, Carriers(places, pressure), approach, moved)


@dataclass(frozen=True, eq=False)
class Trial:
    """Pressures in a region under a load, and what follows from them."""

    region: Region
    load: Load
    carriers: Carriers  # the nodes under pressure
    touching: Mask  # those between their bounds
    plastic: Mask  # those at the upper one
    approach: float  # since the surfaces, as they are now, touch [length]
    force: float
    gap: Real  # of all nodes of the region, on the surface as the load indents it [length]
    overlap: Real  # by which it indents the plastic ones [length]
    length_scale: float  # with which gaps are compared [length]
    residuals: Residuals

    @classmethod
    def of(
        cls,
        region: Region,
        load: Load,
        carriers: Carriers,
        approach: float,
        gap: Real,
    ) -> Trial:
        """Compute the residuals of pressures with the gap that they leave."""
        problem, places, pressure = region.problem, carriers.places, carriers.pressure
        bounds, cell_area = region.bounds.at(places), problem.grid.cell_area
        touching, plastic = bounds.touching(pressure), bounds.yielding(pressure)
        force, absolute_force = (
            cell_area * float(each.sum()) for each in (pressure, np.abs(pressure))
        )
        # 1. The scales. Where a flat body bears evenly hardly anything moves: there a gap is
        # compared with what rounding leaves of displacements, over the tolerance.
        pressure_scale, length_scale = 1.0, abs(approach) or 1.0
        compared = absolute_force
        if absolute_force > 0:
            displacement = gap[places]
            displacement += approach
            displacement -= region.separation[places] - problem.touch
            pressure_scale, length_scale = problem.scales(pressure, displacement)
            del displacement
            compared = max(absolute_force, pressure_scale * cell_area)
        # which keeps what is no number
        length_scale = float(np.maximum(length_scale, problem.resolution * absolute_force))
        if problem.rms_height:
            length_scale = float(np.minimum(problem.rms_height, length_scale))
        # 2. Overlaps of plastic nodes are dents, and pulling nodes may be apart. Gaps of carriers
        # count whatever their sign, so they may stay in the minimum.
        overlap = np.maximum(-gap[places[plastic]], 0.0)
        gap[places[plastic]] += overlap
        on_contact = gap[places]
        np.minimum(on_contact, 0.0, out=on_contact, where=~(touching | plastic))
        least_on_contact = float(on_contact.min(initial=0.0))
        least_gap = float(gap.min(initial=0.0))
        below, above = bounds.violations(pressure)
        residuals = Residuals(
            gap=max(-least_on_contact, float(on_contact.max(initial=0.0))) / length_scale,
            penetration=-least_gap / length_scale if least_gap < least_on_contact else 0.0,
            tension=below / pressure_scale,
            excess=above / pressure_scale,
            load=0.0 if load.force is None else _part(abs(force - load.force), compared),
            rounding=float(np.spacing(abs(approach))) / length_scale,
        )
        return cls(
            region,
            load,
            carriers,
            touching,
            plastic,
            approach,
            force,
            gap,
            overlap,
            length_scale,
            residuals,
        )

    @property
    def depth(self) -> float:
        """Approach since the untouched surfaces touch. [length]"""
        return self.region.problem.touch + self.approach

    def certified(self, rtol: float) -> bool:
        """Whether the residuals are within a tolerance, and no node overlaps that was left out."""
        return self.residuals.worst <= rtol and not self.residuals.penetration

    @property
    def contact_set(self) -> ContactSet:
        """The carriers as nodes of the grid, and the depth."""
        nodes = self.region.operator.on_grid(self.carriers.places)
        return ContactSet(nodes, self.carriers.pressure, self.depth)

    @property
    def watched(self) -> InRegion:
        """The nodes without pressure that may come into contact, about as many as carriers."""
        others, most = self.close(REACH_OF_ERROR, self.gap.size), self.carriers.places.size
        if others.size <= most:
            return others
        gaps = self.gap[others]
        return among(others, gaps <= np.partition(gaps, most)[most])

    def close(self, reach: float, most: int) -> InRegion:
        """Return the nodes without pressure whose gap is small, at most so many.

        Small is less than `reach` times the error where the bodies touch.
        """
        places = self.carriers.places
        on_contact = self.gap[places[self.touching | self.plastic]]
        error = float(np.sqrt(np.mean(on_contact**2))) if on_contact.size else 0.0
        close = self.gap < (reach if math.isinf(reach) else reach * error)
        close[places] = False
        others = InRegion(np.flatnonzero(close))
        if others.size <= most:
            return others
        return among(others, np.sort(np.argpartition(self.gap[others], most)[:most]))

    def contact(self, outcome: Outcome, convolutions: int) -> Contact:
        """Return the trial as the contact with which a search ended."""
        problem, operator = self.region.problem, self.region.operator
        nodes, pressure = operator.on_grid(self.carriers.places), self.carriers.pressure
        separation = problem.separation
        if self.overlap.any():
            separation = separation.copy()
            separation.flat[nodes[self.plastic]] += self.overlap
        # a node that touches but bears nothing counts neither in the area nor in the stiffness
        loaded = pressure != 0
        return Contact(
            problem=replace(problem, separation=separation),
            depth=self.depth,
            force=self.force,
            nodes=among(nodes, loaded),
            pressure=pressure[loaded],
            plastic=self.plastic[loaded],
            pulling=~(self.touching | self.plastic)[loaded],
            looked_at=operator.nodes,
            gaps=self.gap,
            length_scale=self.length_scale,
            residuals=self.residuals,
            outcome=outcome,
            convolutions=convolutions,
            load=self.load,
        )


def _restricted(
    problem: Problem, nodes: GridNodes, bounds: Bounds, carriers: Carriers, moved: Real
) -> Region | None:
    """Return some nodes as a region; None if a restricted operator costs more."""
    restricted = problem.inverse.restricted.on(nodes)
    return _centred(problem, restricted, nodes, bounds, carriers, moved) if restricted else None


def _centred(
    problem: Problem,
    linear: RestrictedOperator | Convolution,
    nodes: GridNodes,
    bounds: Bounds,
    carriers: Carriers,
    moved: Real,
) -> Region:
    """Return some nodes as a region, whose operator is exact for the carriers among them.

    These move the surface by so much more than the bodies are apart there at first touch. The array
    is overwritten. [length]
    """
    before = np.zeros(nodes.indices.size)
    before[carriers.places] = carriers.pressure
    separation = problem.separation.flat[nodes.indices]
    moved -= separation - problem.touch
    operator = CorrectedOperator(problem.operator, linear, nodes, before, moved)
    return Region(problem, operator, separation, bounds, 0.0)


def _part(error: float, absolute_force: float) -> float:
    """Return an error over the sum of all forces; infinite where there are none."""
    return error / absolute_force if absolute_force else math.inf if error else 0.0


def _level(displaced: Real, pressure: Real, touching: Mask) -> float:
    """Return the depth that goes with pressures, from where they put the nodes under them."""
    weights = pressure[touching]
    total = float(weights.sum())
    if total > 0 and not (weights < 0).any():  # the work of the pressures
        return float(weights @ displaced[touching]) / total
    # nodes that have just come into contact, or else all of them overlap
    return float(displaced[touching].mean() if touching.any() else displaced.max())


def _best_factor(target: Real, pressure: Real, displacement: Real) -> float:
    """Return the factor by which the pressures come closest to the target, in energy."""
    energy = float(pressure @ displacement)
    return max(float(pressure @ target) / energy, 0.0) if energy > 0 else 1.0


@compiled
def _leave_gaps(field: Floats, separation: Floats, touch: float, approach: float) -> None:
    """Turn displacements into gaps, for a separation, its least value, and an approach from it."""
    for i in range(field.size):
        field[i] = field[i] + (separation[i] - touch) - approach
