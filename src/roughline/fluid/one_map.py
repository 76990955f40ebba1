"""What grid and size leave open of a number that one map gives: its half grid and its quarters."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from roughline.contact.grid_error import field_on, halved
from roughline.contact.pieces import cut, laws_on_pieces
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw
from roughline.measurement.fit import fitted
from roughline.statistics.student import student
from roughline.topography.body import Surface

_FEWEST_WAVES = 3.0  # of the roll-off along a side of a piece that tells of its whole
_FEWEST_POINTS = 32  # along a side that is halved, or cut into quarters
_EXTRAPOLATION = 2.0  # times the step from the quarters to a piece, from there to its whole


def can_be_cut(surface: Surface, half_space: HalfSpace) -> bool:
    """Whether a surface has points enough to be halved, and cut into quarters.

    Half as many points along a side have to resolve the half-space, too.
    """
    dx, dy = surface.spacing
    try:
        half_space.refuse((2 * dx, 2 * dy))
    except InputError:
        return False
    return min(surface.shape) >= _FEWEST_POINTS


def on_half(surface: Surface, law: ContactLaw) -> tuple[Surface, ContactLaw]:
    """The surface on half as many points along each side, and the law there."""
    return halved(surface), law.on(partial(field_on, surface, halved))


def quarters(surface: Surface, law: ContactLaw) -> list[tuple[Surface, ContactLaw]]:
    """The four quarters of a surface, and the law on each."""
    return list(zip(cut(surface, 2), laws_on_pieces(surface, law, 2), strict=True))


def tells_of_larger(surface: Surface) -> bool:
    """Whether a piece holds waves enough of its roll-off to tell when the whole of it seals.

    Of wholes four times as long, pieces that hold three waves or more told 28 of 28, with two 5 of
    8, and without a roll-off 2 of 8: pieces seal later than the whole, whose way through is longer.
    """
    if not surface.is_cut_out:
        return True
    try:
        _, fit = fitted(surface)
    except InputError:
        return False
    return bool(fit.q_roll and fit.shows_roll_off and fit.q_roll >= _FEWEST_WAVES * fit.q_low)


def factor_left_open(
    value: float, half: float, of_quarters: Sequence[float], *, tells: bool, of_grid: float = 1.0
) -> float:
    """Factor up and down that grid and size leave open.

    They combine, as independent, by how much the logarithm differs from that on half as many
    points, and how uncertain the mean of the quarters is by their scatter, at 95 %. The grid leaves
    open a factor `of_grid` at least. Where a piece does not tell of its whole
    (:func:`tells_of_larger`), it may differ from that by twice as much as its quarters do from it.
    """
    logs = np.log(of_quarters)
    finer = max(abs(math.log(half / value)), math.log(of_grid))
    of_size = student(logs.size - 1) * float(logs.std(ddof=1)) / math.sqrt(logs.size)
    step = 0.0 if tells else _EXTRAPOLATION * (float(logs.mean()) - math.log(value))
    return math.exp(math.hypot(finer, of_size, step))
