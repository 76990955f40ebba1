"""Intervals of measures, from what tiles and grids leave open of them."""

from roughline.margins.spread import Spread, measures_together


def held(measure, extrapolation, own=None):
    """Both ends of a measure of a larger surface, combined with those that its grid leaves open."""
    of_place = Spread((), (), (), {"": measure.ends(extrapolation)}, {"": measure.floor})
    of_grid = [] if own is None else [Spread((), (), (), {"": own})]
    return measures_together({"": measure.values}, [of_place, *of_grid])[""]
