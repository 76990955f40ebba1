"""Messages of the library in the words of the view "My surface"."""

from __future__ import annotations

from roughline.report.arguments import with_arguments_called

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


def in_controls(message: str | Exception) -> str:
    """Return a message with the names of controls in the places of arguments."""
    return with_arguments_called(message, _CONTROLS, lambda text: f'"{text}"')
