"""A pressed ball on the terminal and as JSON."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console

from roughline.contact.status import Status
from roughline.report.contact_tables import modulus_of_pair
from roughline.report.terminal import print_files, print_remarks, print_table
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.ball import PressedBall


def print_ball(ball: PressedBall, files: Iterable[Path] = ()) -> None:
    """Print what was pressed, the contact under each load, and what draws the bodies apart."""
    console = Console(markup=False)
    asked = ball.question
    shape = "sphere" if asked.is_sphere else "parabola"
    modulus = modulus_of_pair(asked.pair, engineering(ball.curve.E_star, "Pa"))
    text = f"ball of radius {engineering(asked.radius, 'm')} ({shape}) on a flat; {modulus}"
    console.print(text, highlight=False, soft_wrap=True)
    print_remarks(console, "warning", ball.warnings)
    print_table(console, *ball_table(ball))
    for heading, status in zip(asked.headings, ball.curve.status, strict=True):
        if status != Status.CONVERGED:
            text = f"{heading}: {Status(status).reason}"
            console.print(text, highlight=False, soft_wrap=True)
    if ball.pull_off is not None:
        text = f"pull-off force under a falling load: {engineering(ball.pull_off, 'N')}"
        console.print(text, highlight=False, soft_wrap=True)
    print_remarks(console, "note", ball.notes)
    print_files(files)


def ball_table(ball: PressedBall) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the contact under each load."""
    curve = ball.curve
    columns = {
        "force F": (curve.force, "N"),
        "depth d": (curve.depth, "m"),
        "radius a": (ball.contact_radius, "m"),
        "area A": (ball.contact_area, "m²"),
        "stiffness k": (curve.stiffness, "N/m"),
        "mean p": (ball.mean_pressure, "Pa"),
        "largest p": (ball.largest_pressure, "Pa"),
    }
    del columns["force F" if ball.question.loads else "depth d"]  # the load itself
    rows = [
        [heading, *(_written(float(values[i]), unit) for values, unit in columns.values())]
        for i, heading in enumerate(ball.question.headings)
    ]
    return ["load", *columns], rows


def ball_json(ball: PressedBall, files: Sequence[Path] = ()) -> dict[str, Any]:
    """What pressing a ball gave, in SI units, over the loads in their order."""
    asked, curve, pair = ball.question, ball.curve, ball.question.pair
    return {
        "radius": asked.radius,
        "shape": "sphere" if asked.is_sphere else "parabola",
        "materials": pair and [pair.first.name, pair.second.name],
        "E_star": curve.E_star,
        "hardness": asked.softer_hardness,
        "work_of_adhesion": asked.adhesion and asked.adhesion.work,
        "loads": asked.headings,
        "force": curve.force,
        "depth": curve.depth,
        "contact_radius": ball.contact_radius,
        "contact_area": ball.contact_area,
        "stiffness": curve.stiffness,
        "mean_pressure": ball.mean_pressure,
        "largest_pressure": ball.largest_pressure,
        "status": [Status(value).name.lower() for value in curve.status],
        "pull_off_force": ball.pull_off,
        "notes": [*ball.warnings, *ball.notes],
        "files": list(files),
    }


def _written(value: float, unit: str) -> str:
    return "-" if math.isnan(value) else engineering(value, unit)
