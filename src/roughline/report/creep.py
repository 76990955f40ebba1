"""Contacts over time, of a body on one that creeps, on the terminal and as JSON."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console

from roughline.report.contact_tables import modulus_of_pair
from roughline.report.terminal import described, print_files, print_remarks, print_table
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.creep.question import PressedCreep


def print_creep(pressed: PressedCreep, files: Iterable[Path] = ()) -> None:
    """Print what was pressed, how the modulus relaxes, and the contact over time."""
    console = Console(markup=False)
    console.print(described(pressed.body), highlight=False, soft_wrap=True)
    curve, pair = pressed.curve, pressed.question.pair
    modulus = modulus_of_pair(pair, engineering(curve.elastic.E_star, "Pa"))
    text = f"{modulus} at once; {curve.creep.relaxed_share:.3g} of it remains in the end"
    console.print(text, highlight=False, soft_wrap=True)
    print_remarks(console, "warning", pressed.warnings)
    print_table(console, *creep_table(pressed))
    print_remarks(console, "note", pressed.notes)
    print_files(files)


def creep_table(pressed: PressedCreep) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the contact at each time."""
    curve = pressed.curve
    header = ["time", "force F", "depth d", "k of a fast load"]
    columns = [
        [engineering(float(value), unit) for value in values]
        for values, unit in (
            (curve.force, "N"),
            (curve.depth, "m"),
            (curve.instantaneous_stiffness, "N/m"),
        )
    ]
    if curve.area_fraction_corrected is not None:
        header.append("corrected A/A_0")
        columns.append([f"{value:.3%}" for value in curve.area_fraction_corrected])
    if curve.force_error.any():
        header.append("error of F")
        columns.append([engineering(float(value), "N", 1) for value in curve.force_error])
    rows = zip(pressed.question.headings, *columns, strict=True)
    return header, [list(row) for row in rows]


def creep_json(pressed: PressedCreep, files: Sequence[Path] = ()) -> dict[str, Any]:
    """What pressing into a body that creeps gave, in SI units, over the times."""
    asked, curve, pair = pressed.question, pressed.curve, pressed.question.pair
    return {
        "file": asked.reading.name or asked.body if isinstance(asked.body, Path) else None,
        "materials": pair and [pair.first.name, pair.second.name],
        "E_star": curve.elastic.E_star,
        "prony": {"shares": curve.creep.shares, "times": curve.creep.times},
        "relaxed_share": curve.creep.relaxed_share,
        "time": curve.time,
        "force": curve.force,
        "depth": curve.depth,
        "instantaneous_stiffness": curve.instantaneous_stiffness,
        "area_fraction": curve.area_fraction,
        "area_fraction_corrected": curve.area_fraction_corrected,
        "elastic_force": curve.elastic_force,
        "force_error": curve.force_error,
        "notes": [*pressed.warnings, *pressed.notes],
        "files": list(files),
    }
