"""From a file, two materials and loads to answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughline.answers import Answer, answers, elastic_warnings
from roughline.characterisation import ALIKE, isotropy
from roughline.errors import InputError
from roughline.estimates import estimate, memory_for
from roughline.interface import plasticity_index
from roughline.larger_interface import stiffness_of_the_piece
from roughline.line_scan import press_scan
from roughline.materials import Interface, Material
from roughline.memory import refuse_beyond_memory
from roughline.moments import moments
from roughline.preparation import Preparation
from roughline.report.curves import (
    Progress,
    Run,
    filled_otherwise,
    interface_alone,
    solved,
    trimmed,
)
from roughline.report.folder import make_folder
from roughline.report.loading import (
    DEFAULT_LOADS,
    Loading,
    default_forces,
    nominal_area,
    with_curve,
)
from roughline.report.pressed import Pressed
from roughline.report.source import Source, notes_on_facing, notes_on_parts, read_parts, together
from roughline.theories import TheoryCurve, refuse_unknown, theory
from roughline.topography import Body, Line, Surface

Announce = Callable[[str], None]

_LARGE = 2**20  # points from which on the cost is told
_MANY = 1000  # loads from which on the cost is told
_COARSENED_FROM = 64  # points a side from which on a report estimates the grid's error


def press_file(
    source: Source,
    loading: Loading,
    *,
    E_star: float | None = None,
    materials: tuple[Material, Material] | None = None,
    against: Source | None = None,
    preparation: Preparation | None = None,
    periodic: bool = False,
    grid_error: bool = False,
    frequency: float | None = None,
    theories: Sequence[str] = (),
    whole_curve: bool = False,
    out: Path | None = None,
    announce: Announce,
    progress: Progress | None = None,
) -> Pressed:
    """Read a file, prepare it, press it and work out what follows.

    Parameters
    ----------
    source : Source
        The topography.
    loading : Loading
        Loads.
    E_star : float, optional
        Contact modulus, unless materials are given. [Pa]
    materials : tuple of Material, optional
        Of both bodies.
    against : Source, optional
        Topography of the second body; without it, that one is smooth.
    preparation : Preparation, optional
        Of each topography; default: the tilt of measured ones is removed.
    periodic, grid_error
        As for :func:`roughline.press`.
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    theories : sequence of str
        As for :func:`roughline.theories.theory`.
    whole_curve : bool
        Whether loads from a thousandth of the largest one on are added, for figures.
    out : Path, optional
        Folder that will be written to.
    announce : callable
        Told what a large run will cost, before it starts.
    progress : callable, optional
        Called with (loads done, loads in all).

    Raises
    ------
    InputError
        If the question does not fit together.
    """
    if (E_star is None) == (materials is None):
        raise InputError("give either a contact modulus (--modulus) or two materials (--materials)")
    for name in theories:
        refuse_unknown(name)
    pair = Interface(*materials) if materials else None
    modulus = pair.E_star if pair else E_star
    assert modulus is not None
    sources = [each for each in (source, against) if each is not None]
    parts = read_parts(sources, preparation)
    body = together(parts)
    if theories and not _has_spectrum(body):
        raise InputError("theories are evaluated for a rough surface of 8 x 8 points or more")
    if whole_curve and isinstance(body, Surface) and min(body.shape) >= _COARSENED_FROM:
        grid_error, body = True, trimmed(body)
    if out is not None:
        make_folder(out)  # a folder that cannot be written is said before the work, not after
    asked = loading.forces(nominal_area(body)) or []
    larger = None
    of_larger = pair is not None and isinstance(body, Surface) and body.is_cut_out
    if isinstance(body, Line) and body.kind == "profile":
        if periodic or grid_error or loading.depths:
            raise InputError(
                "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
                "loads, through its spectrum"
            )
        forces = asked or default_forces(body, modulus, loading.count or DEFAULT_LOADS)
        forces = with_curve(forces) if whole_curve else forces
        second = parts[1] if len(parts) > 1 else None
        assert second is None or isinstance(second, Line)
        scan = press_scan(body, E_star=modulus, forces=forces, against=second)
        indices = _indices(forces, asked, len(forces))
        result = Pressed(source, parts, body, scan.curve, indices, (scan.low, scan.high))
    else:
        forces = with_curve(asked) if whole_curve and asked else asked
        run = Run(modulus, forces, loading.heights() or [], loading.count, periodic, grid_error)
        if of_larger and not periodic:
            assert isinstance(body, Surface)
            refuse_beyond_memory(
                memory_for(body.shape, True, 0),
                f"pressing {body.shape[0]} x {body.shape[1]} points periodically, for the "
                "interface alone,",
                "take a smaller piece or every other point, or --modulus instead of materials",
            )
        if isinstance(body, Surface) and (body.heights.size >= _LARGE or run.count >= _MANY):
            cost = str(estimate(body.shape, run.count, periodic=periodic))
            if of_larger and not periodic:
                cost += f", then {estimate(body.shape, run.count, periodic=True)} for the interface"
            announce(f"{body.shape[0]} x {body.shape[1]} points, {run.count} loads: {cost}")
        shown = forces.index(asked[-1]) if asked else 3 * run.count // 4
        found = solved(run, body, [shown] if out is not None else False, progress)
        filled = any(part.settings.get("missing_points") for part in parts)
        if filled and isinstance(body, Surface) and not found.interrupted:
            found = filled_otherwise(found, run, body, sources, preparation, progress)
        interrupted = found.interrupted
        if of_larger:
            assert isinstance(body, Surface)
            fillings = (sources, preparation) if filled else None
            larger, interrupted = interface_alone(found, run, body, fillings, progress)
        result = Pressed(
            source,
            parts,
            body,
            found.curve,
            _indices(forces, asked, found.curve.status.size),
            found.stiffness_interval,
            found.area_interval,
            interrupted,
            notes=[found.note] if found.note else [],
        )
    notes = [
        *loading.meaning(body),
        *notes_on_parts(parts),
        *notes_on_facing(body),
        *result.notes,
        *result.curve.warnings,
    ]
    result = replace(result, pair=pair, notes=notes)
    return _answered(result, modulus, periodic, larger, frequency, theories)


def _has_spectrum(body: Body) -> bool:
    """Whether it is a surface with enough points and some roughness."""
    return isinstance(body, Surface) and min(body.shape) >= 8 and body.rms_height > 0


def _indices(forces: list[float], asked: list[float], count: int) -> NDArray[np.intp]:
    """Which of the loads were asked for; all if none was named."""
    return np.flatnonzero(np.isin(forces, asked)) if asked else np.arange(count)


def _answered(
    pressed: Pressed,
    E_star: float,
    periodic: bool,
    of_interface: Answer | None,
    frequency: float | None,
    theories: Sequence[str],
) -> Pressed:
    """Add theories, answers and what the answers warn of."""
    body, curve = pressed.body, pressed.curve
    found = None
    lines: list[TheoryCurve] = []
    notes = pressed.notes
    if isinstance(body, Surface) and _has_spectrum(body):
        alike = isotropy(body)
        if theories and alike < ALIKE:
            notes = [
                *notes,
                f"theories assume equal directions; slopes differ, least {alike:.2f} "
                "of the largest",
            ]
        found = moments(body)
        pressures = curve.force[curve.converged] / body.area
        if pressures.size:
            lines = [theory(name, body, E_star, pressures) for name in theories]
    if pressed.pair is None:
        return replace(pressed, theories=lines, notes=notes)
    if of_interface is None and not periodic:
        of_interface = stiffness_of_the_piece(body, curve, pressed.stiffness_interval)
    given = answers(
        curve,
        pressed.area,
        pressed.pair,
        interface_stiffness=of_interface,
        rms_height=body.rms_height,
        rms_slope=found.rms_slope if found else None,
        frequency=frequency,
        stiffness_interval=pressed.stiffness_interval,
        area_interval=pressed.area_interval,
    )
    index = None
    if found is not None and pressed.pair.hardness is not None:
        index = plasticity_index(
            E_star, pressed.pair.hardness, (found.summit_deviation, found.summit_radius)
        )
    if of_interface is not None:
        notes = [*notes, f"the interface stiffness k_i is {of_interface.validity}"]
    notes = [*notes, *elastic_warnings(given, index)]
    if frequency is not None and pressed.pair.both("impedance") is None:
        notes.append("no reflection: the density of both materials is needed")
    return replace(pressed, answers=given, theories=lines, notes=notes)
