"""Bodies that stick in the limit of a short range: bodies of revolution, by Heß's rule."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NoReturn

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.errors.checks import as_number
from roughline.errors.public import public_making
from roughline.halfspace.laws.law import ContactLaw


@public_making
@dataclass(frozen=True)
class JKR(ContactLaw):
    """Bodies of revolution that stick as Johnson, Kendall and Roberts have it [1]_.

    In the reduction method the springs at the edge of the contact let go when they are pulled by
    sqrt(2 pi a w / E*) [2]_. This holds where the contact radius a is the only length of the
    contact: for a :class:`~roughline.Profile` on a free, homogeneous half-space. The pull has no
    range and no bound, so no grid resolves it, and bodies that come nearer jump together where they
    first touch.

    Attributes
    ----------
    work_of_adhesion : float
        Work to separate a unit of area, w. [pressure * length]

    Raises
    ------
    InputError
        If the work is not positive and finite.

    References
    ----------
    .. [1] K. L. Johnson, K. Kendall and A. D. Roberts, "Surface energy and the contact of elastic
       solids", Proc. R. Soc. A 324, 301-313 (1971).
    .. [2] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
       Friction*, Springer (2015), §4.2 and 4.3.

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> r = np.linspace(0, 1, 101)
    >>> ball, law = rl.Profile(r, -(r**2) / 2), rl.JKR(work_of_adhesion=0.01)
    >>> curve = rl.press(ball, E_star=1.0, law=law, n_loads=40)
    >>> print(round(curve.pull_off_force / (np.pi * 0.01), 6))
    -1.5
    """

    work_of_adhesion: float
    assumption: ClassVar[str] = "linear elastic, and pull each other where they touch alone"

    def __post_init__(self) -> None:
        work = as_number(self.work_of_adhesion)
        if work is None or not 0 < work < math.inf:
            raise InputError(
                f"is {self.work_of_adhesion!r}; a positive, finite work of an area is needed: "
                "leave law out for bodies that do not stick",
                "work_of_adhesion",
            )
        object.__setattr__(self, "work_of_adhesion", work)

    @property
    def cutoff(self) -> float:  # type: ignore[override]
        """Zero, as bodies pull where they touch alone. [length]"""
        return 0.0

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return that the pull has no bound, as it has no range, and pressures have none."""
        return -math.inf, math.inf

    def scaled(self, pressure: float, length: float) -> JKR:
        """Return the law in other units."""
        return JKR(self.work_of_adhesion / (pressure * length))

    def refuse_grid(self, compliance: float) -> NoReturn:
        """Refuse all grids: none resolves a pull without a range."""
        raise InputError(
            "is rl.JKR, which holds where the contact radius is the only length, of a Profile; a "
            "Surface sticks by rl.Dugdale(work_of_adhesion, range) or rl.Exponential: press with "
            "two short ranges, the second half as long, and extrapolate as their square",
            "law",
        )
