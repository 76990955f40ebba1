"""What stores keep is declared: quantities of the curve by their names, and two of each body."""

import numpy as np

from roughline.campaign.layout import VARIABLES
from roughline.contact.quantities import OVER_LOADS, QUANTITIES


def test_stores_keep_quantities_of_the_curve_by_their_names():
    of_loads = [each for each in VARIABLES.values() if not each.per_body]
    assert {each.name for each in of_loads} < set(QUANTITIES)
    for variable in of_loads:
        quantity = QUANTITIES[variable.name]
        assert quantity.dims == OVER_LOADS
        assert variable.of_lines == quantity.of_lines


def test_no_finished_case_holds_a_fill_value():
    """Numbers are NaN only where a load failed, and flags are never negative."""
    for variable in VARIABLES.values():
        assert np.isnan(variable.fill) if variable.dtype == "f8" else variable.fill < 0
