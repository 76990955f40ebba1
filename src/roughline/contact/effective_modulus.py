"""Which contact modulus the contact of a layered body feels."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import InGrid
from roughline.contact.fields import Fields
from roughline.halfspace.elasticity.homogeneous import Homogeneous


def effective_modulus(fields: Fields, E_star: float) -> float:
    """Contact modulus of one material that stores as much energy under the same pressures.

    The energy is half the sum of pressures times displacements; of a periodic contact that of even
    pressure is left out. In waves it is the mean of the displacement over the pressure, weighted
    with the spectrum of the pressures. So light contacts, whose spots are small beside the top
    layer, feel that layer, and contacts that are wide beside all layers feel the base. Where
    nothing presses it is that of the top layer.

    Parameters
    ----------
    fields : Fields
        Of the layered contact.
    E_star : float
        Contact modulus of what lies at the surfaces. [pressure]

    Returns
    -------
    float
        [pressure]
    """
    from roughline.halfspace.operators.discretisation import on_grid  # here: it loads slowly
    from roughline.halfspace.operators.grid_nodes import GridNodes

    pressure = fields.pressure
    spacing = fields.sizes[0] / pressure.shape[0], fields.sizes[1] / pressure.shape[1]
    operator = on_grid(Homogeneous(E_star, fields.periodic), pressure.shape, spacing)
    nodes = InGrid(np.flatnonzero(pressure))
    if not nodes.size:
        return E_star
    on_top = operator.displacement(pressure.flat[nodes], GridNodes.of(nodes, pressure.shape))
    uneven = pressure - pressure.mean() if fields.is_periodic else pressure
    stored, of_top = float(np.vdot(uneven, fields.displacement)), float(np.vdot(uneven, on_top))
    return E_star * of_top / stored if stored > 0 and of_top > 0 else E_star
