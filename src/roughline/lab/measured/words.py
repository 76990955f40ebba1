"""What the view "My surface" calls arguments of the library: its controls."""

from __future__ import annotations

from roughline.errors.words import Words

_CONTROLS = {
    "E_star": "the contact modulus",
    "materials": "two materials",
    "loads": "loads",
    "grid_error": 'grid error "estimate"',
    "unit": "unit",
    "channel": "channel",
    "sizes": "size",
    "missing": "filling",
    "most_missing": "most missing",
    "tilt": "tilt is of",
    "pixels": "heights are",
    "blur": "blur",
    "tip_radius": "tip radius",
    "trend": "trend",
    "crop": "crop",
    "hardness": "hardness",
    "elastic": '"elastic"',
    "joint_area": "joint area",
    "low_pass": "low pass",
    "points": "points",
    "frequency": "frequency",
    "theories": "theories",
    "depths": "depths",
    "friction": "friction",
}

CONTROLS = Words(_CONTROLS, lambda text: f'"{text}"')
