"""What stores keep is declared: quantities of the curve by their names, and two of each body."""

import numpy as np

from roughline.campaign.layout import VARIABLES
from roughline.contact.quantities import OVER_LOADS, QUANTITIES, SLIDING_QUANTITIES


def test_stores_keep_quantities_of_the_curve_by_their_names():
    of_loads = [each for each in VARIABLES.values() if not (each.per_body or each.of_friction)]
    assert {each.name for each in of_loads} < set(QUANTITIES)
    for variable in of_loads:
        quantity = QUANTITIES[variable.name]
        assert quantity.dims == OVER_LOADS
        assert variable.of_lines == quantity.of_lines


def test_of_friction_they_keep_quantities_by_their_names_along_x():
    sliding = {each.name: each for each in SLIDING_QUANTITIES}
    kept = [each for each in VARIABLES.values() if each.of_friction]
    assert {each.name for each in kept} < set(sliding)
    for variable in kept:
        assert sliding[variable.name].dims[:1] == OVER_LOADS
        shape = (3, *[2] * (len(sliding[variable.name].dims) - 1))
        values = np.arange(np.prod(shape), dtype=float).reshape(shape)
        assert variable.along_x(values).tolist() == values.reshape(3, -1)[:, 0].tolist()


def test_no_finished_case_holds_a_fill_value():
    """Numbers are NaN only where a load failed, and flags are never negative."""
    for variable in VARIABLES.values():
        assert np.isnan(variable.fill) if variable.dtype == "f8" else variable.fill < 0
