"""Of which kind a body is, where answers depend on that."""

from __future__ import annotations

from typing import TypeGuard

from roughline.topography.body import Body, Surface


def is_map(body: Body) -> TypeGuard[Surface]:
    """Whether it is a surface that was cut out of a larger one."""
    return isinstance(body, Surface) and body.is_cut_out


def has_spectrum(body: Body) -> TypeGuard[Surface]:
    """Whether it is a surface with enough points and some roughness."""
    return isinstance(body, Surface) and min(body.shape) >= 8 and body.rms_height > 0
