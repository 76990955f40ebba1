"""What the full model gives under one load, in the units of the surface."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.border import border_share
from roughline.contact.fields import Fields, Indentation
from roughline.contact.quantities import QUANTITIES, RESOLVED_FROM
from roughline.contact.quantity import OVER_LOADS
from roughline.contact.scaled_surface import ScaledSurface
from roughline.contact.status import Status
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.search.outline import overstated_cells
from roughline.halfspace.search.problem import Contact, Outcome
from roughline.halfspace.search.tangent import Response


@dataclass(frozen=True, eq=False)
class LoadResult:
    """Quantities of the curve under one load by their names, and more.

    The defaults are those of a load that was not solved.
    """

    status: Status = Status.INTERRUPTED
    residual: float = math.nan
    residual_of: str = ""
    convolutions: int = 0
    resolved: bool = False
    depth: float = math.nan
    force: float = math.nan
    stiffness: float = math.nan
    unloading_stiffness: float = math.nan
    area_fraction: float = math.nan
    area_fraction_corrected: float = math.nan
    area_fraction_most: float = math.nan
    plastic_fraction: float = math.nan
    indentation: float = math.nan
    work: float = math.nan
    dissipated_work: float = math.nan
    border_share: float = math.nan  # of the force
    fields: Fields | None = None  # if they are kept
    dents: Indentation | None = None  # if the surface is indented

    @classmethod
    def of(
        cls,
        contact: Contact,
        response: Response | None,
        scaled: ScaledSurface,
        law: ContactLaw,
        *,
        with_fields: bool,
    ) -> LoadResult:
        """Return what one load gives, by the contact in the units of a scaled, untouched surface.

        There is no response where the contact was not certified.
        """
        worst, of = contact.residuals.worst, contact.residuals.worst_is_of
        if contact.outcome is Outcome.UNKNOWN_SURFACE:
            return cls(Status.UNKNOWN_SURFACE)
        if response is None:
            return cls(Status[contact.outcome.name], worst, of, contact.convolutions)
        if not response.converged:
            return cls(Status.NO_TANGENT, worst, of, contact.convolutions)
        cells, nodes = int(np.count_nonzero(~contact.pulling)), contact.separation.size
        most, overstated = _overstated(contact, scaled, law)
        dents = _dents(contact, scaled) if law.memory == "dents" else None
        dissipated = indented = 0.0
        if dents is not None:
            work = law.bounds(dents.nodes)[1] * dents.depth
            dissipated, indented = scaled.cell_area * float(work.sum()), float(dents.depth.max())
        k = scaled.force / scaled.height
        return cls(
            status=Status.CONVERGED,
            residual=worst,
            residual_of=of,
            convolutions=contact.convolutions,
            resolved=cells >= RESOLVED_FROM,
            depth=contact.depth * scaled.height,
            force=contact.force * scaled.force,
            stiffness=response.loading.stiffness * k,
            unloading_stiffness=response.unloading.stiffness * k,
            area_fraction=cells / nodes,
            area_fraction_corrected=cells / nodes - overstated / nodes,
            area_fraction_most=(cells + most - overstated) / nodes,
            plastic_fraction=float(contact.plastic.sum()) / cells if cells else 0.0,
            indentation=indented,
            work=_elastic_energy(contact) * scaled.force * scaled.height + dissipated,
            dissipated_work=dissipated,
            border_share=border_share(contact),
            fields=_fields(contact, scaled, dents) if with_fields else None,
            dents=dents,
        )


def columns(results: Sequence[LoadResult]) -> dict[str, Any]:
    """Return each quantity of the results as an array over the loads, by its name."""
    return {
        each.name: np.array(
            [getattr(result, each.name) for result in results], QUANTITIES[each.name].dtype
        )
        for each in dataclasses.fields(LoadResult)
        if each.name in QUANTITIES and QUANTITIES[each.name].dims == OVER_LOADS
    }


def _overstated(contact: Contact, scaled: ScaledSurface, law: ContactLaw) -> tuple[float, float]:
    """Return by how many cells the outline overstates the area, at most and as estimated.

    An area that bears at most the hardness does not get below the middle between F / H and that of
    the cells: at F / H itself all of the contact would yield. Where nothing yields, it is that of
    elastic bodies if that is possible.
    """
    most, overstated = overstated_cells(contact, scaled.spacing, scaled.half_space.periodic)
    most_of_cell = float(np.max(law.bounds(None)[1])) * scaled.cell_area
    if math.isfinite(most_of_cell):
        borne = contact.force * scaled.force / most_of_cell
        possible = max(contact.nodes.size - borne, 0.0)
        if overstated >= possible or contact.plastic.any():
            overstated = min(overstated, possible / 2)
    return most, overstated


def _elastic_energy(contact: Contact) -> float:
    """Work that the half-space gives back on unloading, in the units of the contact."""
    separation = contact.separation.flat[contact.nodes]
    displacement = contact.gap_at(contact.nodes) - separation + contact.depth
    cell_area = contact.problem.operator.cell_area
    return 0.5 * cell_area * float(contact.pressure @ displacement)


def _dents(contact: Contact, scaled: ScaledSurface) -> Indentation | None:
    """Return where the surface is lower than it was untouched."""
    lower = contact.separation - scaled.separation()
    nodes = np.flatnonzero(lower)
    return Indentation(nodes, lower.flat[nodes] * scaled.height) if nodes.size else None


def _fields(contact: Contact, scaled: ScaledSurface, dents: Indentation | None) -> Fields:
    shape = contact.gap.shape
    pressure = np.zeros(shape)
    touching, plastic = np.zeros((2, *shape), dtype=bool)
    pressure.flat[contact.nodes] = contact.pressure * scaled.pressure
    touching.flat[contact.nodes] = ~contact.pulling
    plastic.flat[contact.nodes] = contact.plastic
    displacement = contact.gap - contact.separation
    displacement += contact.depth
    displacement *= scaled.height
    indentation: Real = np.zeros(shape)
    if dents is not None:
        indentation.flat[dents.nodes] = dents.depth
    return Fields(
        pressure=pressure,
        displacement=displacement,
        gap=contact.gap * scaled.height,
        contact=touching,
        plastic=plastic,
        indentation=indentation,
    )
