"""The exceptions that a caller may want to catch."""

from __future__ import annotations

from typing import Any

from roughline.errors.words import named


class RoughlineError(Exception):
    """Base class of every error that roughline raises on purpose."""


class InputError(RoughlineError, ValueError):
    """The input is not usable; the message says what came, what is allowed and what to do.

    Parameters
    ----------
    message : str
        The message; with `argument`, what follows its name. Other arguments in it are named by
        :func:`roughline.errors.words.called`.
    argument : str, optional
        Name of the argument that cannot be used; the message begins with what the caller calls it.

    *others : str
        Names of arguments that do not go together, where none of them is wrong alone.

    Attributes
    ----------
    argument : str or None
        That name.
    others : tuple of str
        Those names.
    statement : str
        The message without that name.
    """

    def __init__(self, message: str, argument: str | None = None, *others: str) -> None:
        super().__init__(message if argument is None else f"{named(argument)} {message}")
        self.argument, self.others = argument, others
        self.statement = message


class UnitError(InputError):
    """A quantity or a file states no unit, or one of the wrong dimension."""


class StoreError(RoughlineError):
    """A folder or a store of results cannot be used as asked."""


class ClusterError(RoughlineError):
    """A cluster of workers cannot be reached or used, or was lost."""


class ContinuumWarning(UserWarning):
    """A quantity of the continuum differs by more than 5 % from that of the generated bodies."""


class PreparationWarning(UserWarning):
    """A step of a preparation changed nothing, or took most of the rms height."""


class LostCasesWarning(UserWarning):
    """Values that a campaign has computed are lost or damaged on disk, and are left out."""


class UnitWarning(UserWarning):
    """A number is so small or large that another unit may be meant."""


class ConvergenceError(RoughlineError):
    """A load was not solved to the tolerance.

    Attributes
    ----------
    curve : roughline.Curve or None
        The curve; loads that were not solved are NaN, and ``curve.status`` says why.
    """

    def __init__(self, message: str, curve: Any = None) -> None:
        super().__init__(message)
        self.curve = curve


class Interrupted(KeyboardInterrupt):
    """The computation was interrupted (Ctrl-C) while loads were being solved.

    Attributes
    ----------
    curve : roughline.Curve
        The loads that were solved before it. The others are NaN and marked in ``curve.status``.
    """

    def __init__(self, curve: Any) -> None:
        super().__init__(curve)
        self.curve = curve

    def __str__(self) -> str:
        """Say how many of the loads were solved."""
        solved, loads = int(self.curve.converged.sum()), self.curve.status.size
        return f"interrupted: {solved} of {loads} loads were solved"
