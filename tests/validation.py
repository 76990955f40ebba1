"""Errors against exact solutions: what tests find, held to what the handbook tells.

The handbook's page is made of ``docs/validation.json``; ``make validation`` writes it anew.
"""

import json
import os
from pathlib import Path

import pytest

TOLD = Path(__file__).parents[1] / "docs" / "validation.json"
WRITES = "ROUGHLINE_VALIDATION" in os.environ

# Loads are solved to 1e-6, which leaves some 1e-6 in each quantity; machines differ in rounding.
SOLVED, ROUNDING = 5e-6, 0.05


def hold(test: str, solution: str, quantity: str, grid: object, error: float) -> None:
    """Hold the relative error of a quantity on a grid to what is told, or write it."""
    told = json.loads(TOLD.read_text("utf-8")) if TOLD.exists() else []
    keys = {"solution": solution, "quantity": quantity, "test": test}
    row = next((each for each in told if keys.items() <= each.items()), None)
    if not WRITES:
        assert row is not None, f"docs/validation.json lacks {keys}: make validation"
        expected = pytest.approx(row["errors"][str(grid)], rel=ROUNDING, abs=SOLVED)
        assert error == expected, "docs/validation.json is stale: make validation"
        return
    if row is None:
        row = {**keys, "errors": {}}
        told.append(row)
    row["errors"][str(grid)] = float(f"{error:.3g}")
    TOLD.write_text(json.dumps(told, indent=1, ensure_ascii=False) + "\n", "utf-8")
