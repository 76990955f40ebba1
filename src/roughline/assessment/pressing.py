"""From a file, two materials and loads to answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughline.assessment.curves import (
    Progress,
    Run,
    Solved,
    filled_otherwise,
    interface_alone,
    solved,
)
from roughline.assessment.larger_surface import stiffness_of_the_piece
from roughline.assessment.line_scan import press_scan
from roughline.assessment.loading import (
    DEFAULT_LOADS,
    Loading,
    default_forces,
    nominal_area,
    with_curve,
)
from roughline.assessment.pressed import Pressed
from roughline.assessment.source import (
    Source,
    filled_regions,
    notes_on_facing,
    notes_on_parts,
    notes_on_points,
    read_parts,
    together,
)
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.estimates import estimate, memory_for
from roughline.engineering.answers import Answer, answers, elastic_warnings, left_out
from roughline.engineering.formulas import plasticity_index
from roughline.engineering.materials import Material
from roughline.engineering.pair import MaterialPair
from roughline.errors import InputError
from roughline.files.read import suspicions
from roughline.report.folder import make_folder
from roughline.spectra.moments import moments
from roughline.spectra.roughness import ALIKE, isotropy
from roughline.theories.theory import refuse_unknown, theory
from roughline.theories.theory_curve import TheoryCurve
from roughline.topography.body import Body, Line, Surface
from roughline.topography.preparation import Preparation

Announce = Callable[[str], None]

_LARGE = 2**20  # points from which on the cost is told
_MANY = 1000  # loads from which on the cost is told
_COARSENED_FROM = 64  # points a side from which on the grid's error is estimated unasked
_CHEAP = 2**24  # points times loads up to which that takes a few seconds


def press_file(
    source: Source,
    loading: Loading,
    *,
    E_star: float | None = None,
    materials: tuple[Material, Material] | None = None,
    against: Source | None = None,
    preparation: Preparation | None = None,
    periodic: bool = False,
    grid_error: bool | None = None,
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
    periodic : bool
        As for :func:`roughline.press`.
    grid_error : bool, optional
        Whether the grid's error is estimated; default: where that is cheap, and with a whole curve.
        Without it no interval is given.
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    theories : sequence of str
        As for :func:`roughline.theories.theory.theory`.
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
    pair = MaterialPair(*materials) if materials else None
    modulus = pair.E_star if pair else E_star
    assert modulus is not None
    sources = [each for each in (source, against) if each is not None]
    parts = read_parts(sources, preparation)
    body = together(parts)
    if theories and not _has_spectrum(body):
        raise InputError("theories are evaluated for a rough surface of 8 x 8 points or more")
    if out is not None:
        make_folder(out)  # a folder that cannot be written is said before the work, not after
    asked, depths = loading.forces(nominal_area(body)), loading.heights()
    forces = with_curve(asked) if whole_curve and asked else sorted({*asked})
    unknown: list[str] = []
    larger = None
    of_larger = pair is not None and isinstance(body, Surface) and body.is_cut_out
    interrupted = False
    if isinstance(body, Line) and body.kind == "profile":
        if periodic or grid_error or depths:
            raise InputError(
                "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
                "loads, through its spectrum"
            )
        forces = forces or default_forces(body, modulus, loading.count or DEFAULT_LOADS)
        second = parts[1] if len(parts) > 1 else None
        assert second is None or isinstance(second, Line)
        scan = press_scan(body, E_star=modulus, forces=forces, against=second)
        found = Solved(scan.curve, stiffness_interval=(scan.low, scan.high))
    else:
        count = len(forces) or len(depths) or loading.count or 0
        estimated = _grid_error_is_estimated(body, grid_error, count, whole_curve)
        run = Run(modulus, forces, sorted({*depths}), loading.count, periodic, estimated)
        if of_larger and not periodic:
            assert isinstance(body, Surface)
            refuse_beyond_memory(
                memory_for(body.shape, True, 0),
                f"pressing {body.shape[0]} x {body.shape[1]} points periodically, for the "
                "interface alone,",
                "take a smaller piece or every other point, or --modulus instead of materials",
            )
        if isinstance(body, Surface) and (body.heights.size >= _LARGE or count >= _MANY):
            cost = str(estimate(body.shape, count, periodic=periodic))
            if of_larger and not periodic:
                cost += f", then {estimate(body.shape, count, periodic=True)} for the interface"
            announce(f"{body.shape[0]} x {body.shape[1]} points, {count} loads: {cost}")
        shown = forces.index(max(asked)) if asked else 3 * count // 4
        found = solved(run, body, [shown] if out is not None else False, progress)
        filled = any(part.settings.get("missing_points") for part in parts)
        if filled and isinstance(body, Surface) and not found.interrupted:
            found = filled_otherwise(found, run, body, sources, preparation, progress)
        interrupted = found.interrupted
        if of_larger:
            assert isinstance(body, Surface)
            fillings = (sources, preparation) if filled else None
            larger, interrupted = interface_alone(found, run, body, fillings, progress)
        if isinstance(body, Surface) and found.curve.stiffness_error is None:
            unknown.append(_no_grid_error(body, grid_error, found.interrupted))
    result = Pressed(
        source,
        parts,
        body,
        found.curve,
        _indices(forces or sorted({*depths}), asked or depths, found.curve.status.size),
        loading.texts,
        found.stiffness_interval,
        found.area_interval,
        interrupted,
        pair,
        filled=filled_regions(sources, parts, preparation) if out is not None else [],
    )
    result, broken = _answered(result, periodic, larger, frequency, theories)
    notes = [
        *notes_on_parts(parts, suspicions),
        *broken,
        *found.curve.warnings,
        *unknown,
        *_left_out(result, frequency),
        *notes_on_parts(parts, notes_on_points),
        *([found.note] if found.note else []),
        *loading.meaning(body),
        *notes_on_facing(body),
    ]
    return replace(result, notes=notes)


def _grid_error_is_estimated(
    body: Body, wanted: bool | None, count: int, whole_curve: bool
) -> bool:
    """Whether the grid's error is estimated: as it is wanted, or else where that is cheap."""
    if wanted is not None or isinstance(body, Line):
        return bool(wanted)
    cheap = whole_curve or body.heights.size * count <= _CHEAP
    return cheap and min(body.shape) >= _COARSENED_FROM


def _no_grid_error(body: Surface, wanted: bool | None, interrupted: bool) -> str:
    """Say that values come without an interval, and why."""
    if interrupted:
        why = "interrupted before"
    elif wanted is not None:
        why = "not wanted"
    elif min(body.shape) < _COARSENED_FROM:
        why = f"fewer than {_COARSENED_FROM} points a side; --grid-error does it still"
    else:
        why = "it takes a third longer; --grid-error does it"
    return f"grid error not estimated, so values come without intervals ({why})"


def _has_spectrum(body: Body) -> bool:
    """Whether it is a surface with enough points and some roughness."""
    return isinstance(body, Surface) and min(body.shape) >= 8 and body.rms_height > 0


def _indices(levels: list[float], asked: list[float], count: int) -> NDArray[np.intp]:
    """Which of the loads were asked for, in the order asked; all if none was named."""
    return np.array([levels.index(load) for load in asked]) if asked else np.arange(count)


def _answered(
    pressed: Pressed,
    periodic: bool,
    of_interface: Answer | None,
    frequency: float | None,
    theories: Sequence[str],
) -> tuple[Pressed, list[str]]:
    """Add theories, answers for the loads asked for; gives which assumptions do not hold."""
    body, curve, pair = pressed.body, pressed.curve, pressed.pair
    found = None
    lines: list[TheoryCurve] = []
    broken = []
    if isinstance(body, Surface) and _has_spectrum(body):
        alike = isotropy(body)
        if theories and alike < ALIKE:
            broken.append(
                f"theories assume equal directions; slopes differ, least {alike:.2f} of the largest"
            )
        found = moments(body)
        pressures = curve.force[curve.converged] / body.area
        if pressures.size:
            lines = [theory(name, body, curve.E_star, pressures) for name in theories]
    if pair is None:
        return replace(pressed, theories=lines), broken
    ends = pressed.ends_at_asked(pressed.stiffness_interval)
    if of_interface is not None:
        of_interface = of_interface.at(pressed.asked)
        if ends is None:  # what one piece leaves open is narrower than what is unknown
            of_interface = replace(of_interface, low=None, high=None)
    elif not periodic:
        of_interface = stiffness_of_the_piece(body, pressed.at_asked, ends)
    given = answers(
        pressed.at_asked,
        pressed.area,
        pair,
        interface_stiffness=of_interface,
        rms_height=body.rms_height,
        rms_slope=found.rms_slope if found else None,
        frequency=frequency,
        stiffness_interval=ends,
        area_interval=pressed.ends_at_asked(pressed.area_interval),
    )
    index = None
    if found is not None and pair.hardness is not None:
        summits = found.summit_deviation, found.summit_radius
        index = plasticity_index(curve.E_star, pair.hardness, summits)
    broken = elastic_warnings(given, index) + broken
    if of_interface is not None:
        broken.append(f"the interface stiffness k_i is {of_interface.validity}")
    return replace(pressed, answers=given, theories=lines), broken


def _left_out(pressed: Pressed, frequency: float | None) -> list[str]:
    """Say which answers are not there, and why."""
    if pressed.pair is None:
        return []
    notes = left_out(pressed.pair, frequency)
    if pressed.curve.area_fraction is None:
        notes.append("no contact area: the reduced model of a line does not predict it")
    return notes
