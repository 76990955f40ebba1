"""The exceptions that a caller may want to catch."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roughline.contact.curve import Curve


class RoughlineError(Exception):
    """Base class of every error that roughline raises on purpose."""


class InputError(RoughlineError, ValueError):
    """The input is not usable; the message says what came, what is allowed and what to do.

    Attributes
    ----------
    argument : str or None
        Name of the Python argument that would mend it, for those to whom it goes by another name.
    """

    def __init__(self, *message: object, argument: str | None = None) -> None:
        super().__init__(*message)
        self.argument = argument


class UnitError(InputError):
    """A quantity or a file states no unit, or one of the wrong dimension."""


class StoreError(RoughlineError):
    """A folder or a store of results cannot be used as asked."""


class ClusterError(RoughlineError):
    """A cluster of workers cannot be reached or used, or was lost."""


class ContinuumWarning(UserWarning):
    """A quantity of the continuum is more than 5 % off that of the bodies which belong to it."""


class ConvergenceError(RoughlineError):
    """A load was not solved to the tolerance.

    Attributes
    ----------
    curve : Curve or None
        What was solved; the loads that were not are NaN and say why in ``curve.status``.
    """

    def __init__(self, message: str, curve: Curve | None = None) -> None:
        super().__init__(message)
        self.curve = curve


class Interrupted(KeyboardInterrupt):
    """Ctrl-C came while loads were being solved.

    Attributes
    ----------
    curve : Curve
        The loads that were solved before; the others are NaN and marked in ``curve.status``.
    """

    def __init__(self, curve: Curve) -> None:
        super().__init__(curve)
        self.curve = curve

    def __str__(self) -> str:
        """Say how far it came."""
        solved, loads = int(self.curve.converged.sum()), self.curve.status.size
        return f"interrupted: {solved} of {loads} loads were solved"
