"""Partial slip of bodies that are pressed together and loaded tangentially."""

from __future__ import annotations

from dataclasses import dataclass

from roughline.computing.arrays import Real


@dataclass(frozen=True, eq=False)
class PartialSlip:
    """Tangential loading at the largest normal load, from no load to full sliding."""

    friction: float  # coefficient [1]
    displacement: Real  # [m]
    force: Real  # [N]
