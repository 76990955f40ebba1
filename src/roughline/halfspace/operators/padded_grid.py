"""Memory for values on a grid with a margin, on which stencils work."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Single
from roughline.halfspace.operators.workspace import Workspace


@dataclass(frozen=True, eq=False)
class PaddedGrid:
    """Memory for values on a grid with a margin; zero when not in use.

    Attributes
    ----------
    values : ndarray, shape (nx + 2 margins[0], ny + 2 margins[1])
        The values.
    margins : tuple of int
        Cells of the margin along x and y.
    """

    values: Single
    margins: tuple[int, int]

    @classmethod
    def of(
        cls, shape: tuple[int, int], margins: tuple[int, int], workspace: Workspace
    ) -> PaddedGrid:
        """Put a margin around a grid."""
        padded = shape[0] + 2 * margins[0], shape[1] + 2 * margins[1]
        return cls(workspace.zeros("padded grid", padded, np.float32), margins)

    @property
    def parts(self) -> tuple[Single, tuple[int, int]]:
        """The values and the margins, for compiled loops."""
        return self.values, self.margins

    def wrap(self) -> None:
        """Fill the margin with what lies a period away."""
        for values, margin in zip((self.values, self.values.T), self.margins, strict=True):
            values[:margin] = values[-2 * margin : -margin]
            values[-margin:] = values[margin : 2 * margin]

    def clear_margin(self) -> None:
        """Set the margin to zero."""
        for values, margin in zip((self.values, self.values.T), self.margins, strict=True):
            values[:margin] = 0
            values[-margin:] = 0
