"""The ranges of dimensionless force F̄ that the paper's numbers are taken from."""

from __future__ import annotations

Window = tuple[float, float]
"""Smallest and largest F̄, both included."""

WINDOW_REDUCED: Window = (1e-4, 1e-2)
"""Range of the exponent of the reduced model."""
WINDOW_FULL: Window = (1e-2, 1e-1)
"""Range of the exponent of the full model, whose grid does not resolve lighter loads."""
WINDOW_SAME_WAVES: Window = (1e-2, 1e-1)
"""Range in which the exponents of both models with the same waves are compared."""
WINDOW_AGREEMENT: Window = (1e-2, 0.3)
"""Range in which the stiffness of both models with the same waves is compared."""
WINDOW_AREA: Window = (10**-1.5, 10**-0.5)
"""Range of the area law."""

OTHER_WINDOWS_REDUCED: tuple[Window, ...] = ((1e-3, 1e-1), (1e-2, 0.3))
"""Further ranges, which show how much the exponent of the reduced model depends on its window."""
WINDOWS_REDUCED: tuple[Window, ...] = (WINDOW_REDUCED, *OTHER_WINDOWS_REDUCED)
WINDOWS_FULL: tuple[Window, ...] = ((1e-3, 1e-2), WINDOW_FULL, (1e-2, 0.3))

MEDIUM_FORCE = 0.1
"""Largest F̄ that counts as a medium force."""
