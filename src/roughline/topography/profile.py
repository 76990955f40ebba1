"""Heights of a body of revolution over its radius: Profile."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.topography.heights import checked_heights, checked_radii, checked_unit
from roughline.units import in_words


@public
@dataclass(frozen=True, eq=False, init=False)
class Profile:
    """Heights of a body of revolution, such as a ball, a tip or a lens, over its radius.

    Between the radii the slope changes evenly, as it does on that side where it changes less. So
    cones and paraboloids are what they are, and an edge stays an edge. At the last radius the body
    ends, as a cylinder does. A line scan across a rough surface is none of these: it is a
    :class:`~roughline.Line`.

    Parameters
    ----------
    radii : array_like, shape (n,)
        Distances from the axis, rising from zero. [length]
    heights : array_like, shape (n,)
        Heights there, pointing towards the other body: those of a ball fall with the radius.
        [length]
    unit : str, optional
        Unit of all lengths, where it is known, such as "m" or "um".

    Raises
    ------
    InputError
        For radii or heights that are not real, finite numbers, or not as many of both, for radii
        that do not rise from zero, for heights that are largest beside the axis, and for a unit
        that is none of length.

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> r = np.linspace(0, 1, 101)
    >>> ball = rl.Profile(r, -(r**2) / 2)  # of radius of curvature 1
    >>> curve = rl.press(ball, E_star=1.0, depths=[0.1])
    >>> print(round(float(curve.force[0]), 6))  # Hertz: 4/3 d^(3/2)
    0.042164
    """

    radii: Real
    heights: Real
    unit: str | None

    def __init__(self, radii: Any, heights: Any, unit: str | None = None) -> None:
        heights = checked_heights(heights, dimensions=1, body="a Profile")
        radii = checked_radii(radii)
        if radii.size != heights.size:
            raise InputError(
                f"there are {radii.size} radii and {heights.size} heights; give a height for each "
                "radius"
            )
        if heights.max() > heights[0]:
            raise InputError(
                f"heights are largest at radius {radii[heights.argmax()]:.3g}; a Profile is "
                "highest on its axis: heights point towards the other body, so those of a ball "
                "fall with the radius"
            )
        object.__setattr__(self, "radii", radii)
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "unit", checked_unit(unit))

    def __repr__(self) -> str:
        largest = in_words(self.largest_radius, self.unit)
        return f"<Profile: {self.radii.size} radii, largest {largest}>"

    @property
    def largest_radius(self) -> float:
        """Radius at which the body ends. [length]"""
        return float(self.radii[-1])

    @property
    def area(self) -> float:
        """Nominal area A_0, that of the disc up to the largest radius. [length²]"""
        return float(np.pi * self.largest_radius**2)

    @property
    def rms_height(self) -> float:
        """Root-mean-square deviation from the mean height over the nominal area. [length]"""
        r, h = self.radii / self.largest_radius, self.heights - self.heights[0]
        # Simpson's rule between neighbours, exact for heights that are straight there
        between, middle = (h[1:] + h[:-1]) / 2, (r[1:] + r[:-1]) / 2
        ends = r * np.diff(r, prepend=0.0) + r * np.diff(r, append=1.0)
        weights = np.append(ends, 4 * middle * np.diff(r)) / 3
        values = np.append(h, between)
        return float(np.sqrt(weights @ (values - weights @ values) ** 2))
