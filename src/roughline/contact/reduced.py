"""The reduced model's curve: a reduced line on springs under given loads."""

from __future__ import annotations

import numpy as np

from roughline._version import __version__
from roughline.contact.curve import LineCurve
from roughline.contact.loads import GivenLoads, comes_nearer, line_loads
from roughline.contact.quantities import RESOLVED_FROM
from roughline.errors import InputError
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.reduction.springs import Springs
from roughline.topography.body import Line
from roughline.topography.borders import decided
from roughline.topography.effects import grave_effects
from roughline.topography.settings import as_body


def press_line(line: Line, half_space: Homogeneous, given: GivenLoads) -> LineCurve:
    """Press a reduced line on springs with the modulus of a half-space."""
    if line.kind == "profile":
        raise InputError(
            "this line is a measured profile, a straight cut, and not the reduced line of its "
            "surface (their spectra differ, the paper's eq. 7): press the surface, or build the "
            "reduced line from its spectrum with SelfAffine(...).line(n)"
        )
    springs = Springs.under(line.heights, line.spacing, half_space.E_star)
    loads = line_loads(line, springs, given)
    if loads.control == "forces":
        force, touching = loads.values, springs.under_forces(loads.values)
        depth = touching.depth_under(force)
    else:
        depth, touching = loads.values, springs.at_depths(loads.values)
        force = touching.force_at(depth)
    return LineCurve(
        depth=depth,
        force=force,
        stiffness=touching.stiffness,
        status=np.zeros(depth.size, dtype=np.int8),
        resolved=touching.count >= RESOLVED_FROM,
        residual=np.zeros(depth.size),
        on_approach=comes_nearer(depth),
        half_space=half_space,
        rms_height=line.rms_height,
        length=line.length,
        unit=line.unit,
        settings={
            "roughline_version": __version__,
            "model": "reduced",
            "control": loads.control,
            **as_body(line.settings),
        },
        facts=(*grave_effects(line), *_end_facts(line)),
        control=loads.control,
    )


def _end_facts(line: Line) -> tuple[Fact, ...]:
    """Warn of a line whose ends do not meet, as those of a reduced line do."""
    borders = decided(line)
    if borders is None or not borders.jump:
        return ()
    return (Fact("ends_do_not_meet", steps=borders.step),)
