"""How the solution under one load ended."""

from __future__ import annotations

import enum


class Status(enum.IntEnum):
    """How the solution under one load ended."""

    CONVERGED = 0
    STALLED = 1
    MAX_ITERATIONS = 2
    NO_TANGENT = 3
    INTERRUPTED = 4
    UNKNOWN_SURFACE = 5
    PULLED_OFF = 6
    LIFTED = 7
    SLIDES = 8

    @property
    def reason(self) -> str:
        """What it means, for messages."""
        return {
            Status.CONVERGED: "converged: all residuals are within the tolerance",
            Status.STALLED: "stalled: a residual no longer falls and is above the tolerance",
            Status.MAX_ITERATIONS: "max_iterations reached above the tolerance",
            Status.NO_TANGENT: "the stiffness equations did not converge",
            Status.INTERRUPTED: "not solved: interrupted before",
            Status.UNKNOWN_SURFACE: "not solved: the surface as a larger load before "
            "them left it is not known",
            Status.PULLED_OFF: "pulled off: no contact bears so large a pull",
            Status.LIFTED: "open: the fluid between the bodies lifts them apart",
            Status.SLIDES: "slides: friction bears less than the shear force",
        }[self]
