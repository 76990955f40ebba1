"""The ranges of dimensionless force F̄ that the paper's numbers are taken from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    from roughline.computing.arrays import Real

ForceWindow = tuple[float, float]
"""Smallest and largest F̄, both included."""

WINDOW_AGREEMENT: ForceWindow = (1e-2, 0.3)
"""Range in which the stiffness of both models with the same waves is compared."""
WINDOW_AREA: ForceWindow = (10**-1.5, 10**-0.5)
"""Range of the area law."""

OTHER_WINDOWS_REDUCED: tuple[ForceWindow, ...] = ((1e-3, 1e-1), (1e-2, 0.3))
"""Further ranges, which show how much the exponent of the reduced model depends on its window."""
MEDIUM_FORCE = 0.1
"""Largest F̄ that counts as a medium force."""


@dataclass(frozen=True)
class Windows:
    """The ranges of F̄ in which the exponents of a study are fitted."""

    reduced: ForceWindow = (1e-4, 1e-2)
    # whose grid does not resolve lighter loads; here both models with the same waves are compared
    full: ForceWindow = (1e-2, 1e-1)

    @property
    def all_reduced(self) -> tuple[ForceWindow, ...]:
        """The range of the reduced model, and further ones."""
        return (self.reduced, *OTHER_WINDOWS_REDUCED)

    @property
    def all_full(self) -> tuple[ForceWindow, ...]:
        """The range of the full model between a lower and a higher one."""
        return ((1e-3, 1e-2), self.full, (1e-2, 0.3))

    def within(self, reduced: Real, full: Real) -> Windows:
        """Return the windows as far as the loads of both models reach."""
        return Windows(_overlap(self.reduced, reduced), _overlap(self.full, full))


def _overlap(window: ForceWindow, force_bar: Real) -> ForceWindow:
    low, high = max(window[0], float(force_bar[0])), min(window[1], float(force_bar[-1]))
    return (low, high) if low < high else window


def covers(force_bar: Real, window: ForceWindow) -> bool:
    """Whether loads reach both ends of a window, and three of them or more lie in it."""
    inside = np.count_nonzero(inside_window(force_bar, window))
    reached = inside_window(np.array(window), (float(force_bar[0]), float(force_bar[-1])))
    return bool(inside >= 3 and reached.all())
