"""What the type checker refuses: mypy tells of an "ignore" that it does not need."""

from __future__ import annotations

import roughline as rl
from roughline.computing.arrays import InGrid, InPatch, InRegion, InWindow, among
from roughline.halfspace.operators.corrected import CorrectedOperator
from roughline.halfspace.search.carriers import Carriers, merged
from roughline.halfspace.search.problem import Problem
from roughline.halfspace.search.window import GridWindow


def nodes_of_four_lists(
    grid: InGrid, window: InWindow, region: InRegion, patch: InPatch, bodies: Problem
) -> None:
    """Places in one list are none in another."""
    bodies.bounds_at(grid)
    bodies.bounds_at(window)  # type: ignore[arg-type]
    bodies.bounds_at(region)  # type: ignore[arg-type]
    bodies.bounds_at(patch)  # type: ignore[arg-type]
    bodies.bounds_at(among(grid, region))
    bodies.bounds_at(among(region, grid))  # type: ignore[arg-type]
    merged(grid, grid)[0].sort()


def through_the_doors(
    grid: InGrid,
    region: InRegion,
    window: GridWindow,
    operator: CorrectedOperator,
    carriers: Carriers,
) -> None:
    """Windows and regions lead from one list to another."""
    window.on_grid(window.inside(grid))
    window.inside(window.inside(grid))  # type: ignore[arg-type]
    window.on_grid(grid)  # type: ignore[arg-type]
    operator.on_grid(region)
    operator.on_grid(grid)  # type: ignore[arg-type]
    carriers.joined_by(grid)  # type: ignore[arg-type]


def kinds_of_curves(surface: rl.Surface, line: rl.Line) -> tuple[object, ...]:
    """The body tells which curve it gives."""
    return (
        rl.press(surface, E_star=1.0, n_loads=2).fields[0],
        rl.press(line, E_star=1.0, n_loads=2).fields,  # type: ignore[attr-defined]
        rl.press(line, E_star=1.0, load=2),  # type: ignore[call-overload]
    )
