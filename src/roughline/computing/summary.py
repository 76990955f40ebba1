"""What a prompt shows of values that hold arrays."""

from __future__ import annotations

import dataclasses
from typing import Any

import attrs
import numpy as np

_LONGEST_PART = 40  # letters of a part that is written as it is


def summary(value: Any) -> str:
    """Describe a dataclass in a line: numbers and short parts, and the shapes of arrays."""
    parts = [
        f"{field.name}={_part(getattr(value, field.name))}"
        for field in dataclasses.fields(value)
        if field.repr and getattr(value, field.name) is not None
    ]
    return f"{type(value).__name__}({', '.join(parts)})"


def _part(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"<{' × '.join(map(str, value.shape))} values>"
    if isinstance(value, float):
        return f"{value:.6g}"
    if dataclasses.is_dataclass(value) or attrs.has(type(value)):
        return f"<{type(value).__name__}>"
    text = repr(value)
    if len(text) <= _LONGEST_PART:
        return text
    return f"{text[:_LONGEST_PART]}…" if isinstance(value, str) else f"<{len(value)} entries>"
