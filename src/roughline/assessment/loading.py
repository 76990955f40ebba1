"""Loads as texts with units, and what they mean for a body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughline.errors import InputError
from roughline.topography.body import Body, Line, Surface
from roughline.units import engineering, in_si, load_in_newtons

DEFAULT_LOADS = 20
_LIGHTEST = 1e-3  # of the largest load, where a whole curve begins
_CURVE_LOADS = 16  # of a whole curve


@dataclass(frozen=True)
class Loading:
    """What a body is pressed with; quantities as texts with units.

    Parameters
    ----------
    loads : sequence of str
        Total forces or mean pressures, such as "10 N" or "2 MPa".
    depths : sequence of str
        Depths, such as "200 nm", instead.
    count : int, optional
        Number of loads from first touch to saturation, instead.
    """

    loads: Sequence[str] = ()
    depths: Sequence[str] = ()
    count: int | None = None

    @property
    def texts(self) -> list[str]:
        """The loads or depths as they were given, in their order; none if they are spaced."""
        return [*self.loads, *self.depths]

    def forces(self, area: float) -> list[float]:
        """Total forces on a nominal area, in the order of the texts. [N]"""
        found = [load_in_newtons(text, area) for text in self.loads]
        for text, force in zip(self.loads, found, strict=True):
            if not 0 < force < np.inf:
                raise InputError(f'load is "{text}"; give positive ones')
        return found

    def heights(self) -> list[float]:
        """Depths, in the order of the texts. [m]"""
        return [in_si(text, "m", "depth") for text in self.depths]

    def meaning(self, body: Body) -> list[str]:
        """Say of each load what it is in all, and over which area."""
        area = nominal_area(body)
        if isinstance(body, Surface):
            nominal = f"the nominal area, {' x '.join(engineering(s, 'm') for s in body.sizes)}"
        else:
            nominal = f"the square of the line's length, {engineering(body.length, 'm')}"
        return [
            f"load {text}: {engineering(load_in_newtons(text, area), 'N')} in all, "
            f"{engineering(load_in_newtons(text, area) / area, 'Pa')} over {nominal}"
            for text in self.loads
        ]


def nominal_area(body: Body) -> float:
    """Nominal area of a body; of a line, the square of its length. [m²]"""
    return body.area if isinstance(body, Surface) else body.length**2


def with_curve(asked: list[float]) -> list[float]:
    """Loads for a whole curve up to the largest, those asked for among them, rising."""
    curve = np.geomspace(_LIGHTEST * max(asked), max(asked), _CURVE_LOADS)
    apart = [f for f in curve if not np.isclose(f, asked, rtol=0.02).any()]
    return sorted({*asked, *apart})


def default_forces(line: Line, E_star: float, count: int) -> list[float]:
    """Forces for a line scan, from light contact to nearly saturated. [N]"""
    scale = E_star * line.rms_height * line.length
    return (scale * np.geomspace(1e-3, 3, count)).tolist()
