"""What is found of parameters: a value, or why there is none."""

from __future__ import annotations

Found = dict[str, float | str]
"""Values by the names of parameters; a text says why one is not defined."""
