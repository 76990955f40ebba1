"""How a contact answers a change of load while its sets of nodes stay."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real


@dataclass(frozen=True, eq=False)
class Tangent:
    """Linear response of a contact to a change of load.

    Its stiffness is infinite in full contact of the periodic half-space, zero where no node is
    elastic, and NaN where the linear equations were not solved.
    """

    stiffness: float  # k = dF/dd [force / length]
    pressure_per_force: Real  # dp/dF on the contact nodes; zero where they are not elastic [1/area]
    convolutions: int = 0  # spent


@dataclass(frozen=True, eq=False)
class Response:
    """How a contact answers a change of load; without yield both tangents are the same."""

    loading: Tangent  # under more load; nodes at the upper bound bear no more
    unloading: Tangent  # under less load; all nodes spring back

    @property
    def convolutions(self) -> int:
        """Convolutions spent on both."""
        again = 0 if self.unloading is self.loading else self.unloading.convolutions
        return self.loading.convolutions + again

    @property
    def converged(self) -> bool:
        """Whether both were solved."""
        return not np.isnan([self.loading.stiffness, self.unloading.stiffness]).any()
