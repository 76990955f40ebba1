"""A surface whose full contact with a homogeneous half-space has the pressures of another's."""

from __future__ import annotations

import numpy as np

from roughline.computing.fft import half_spectrum, synthesise
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.topography.body import Surface, with_heights


def in_full_contact(surface: Surface, half_space: HalfSpace) -> Surface:
    """Return the surface whose full contact with a homogeneous half-space has the same pressures.

    A wave that reaches deeper than what is near the surface is as much higher or lower as that is
    stiffer or softer there.
    """
    some = np.geomspace(2 * np.pi / max(surface.sizes), np.pi / min(surface.spacing))
    if np.allclose(half_space.modulus(some), half_space.E_star, rtol=1e-14, atol=0):
        return surface
    nx, ny = surface.shape
    dx, dy = surface.spacing
    q = np.hypot(np.fft.fftfreq(nx, dx)[:, np.newaxis], np.fft.rfftfreq(ny, dy)) * 2 * np.pi
    q[0, 0] = 1.0  # the mean has no slope
    waves = half_spectrum(surface.heights)
    waves *= half_space.modulus(q) / half_space.E_star
    return with_heights(surface, synthesise(waves, ny) / surface.heights.size)
