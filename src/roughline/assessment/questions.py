"""What a user asks of a topography, from texts with units to files."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from roughline.assessment.curves import Progress
from roughline.assessment.loading import DEFAULT_LOADS, Loading
from roughline.assessment.pressed import Pressed
from roughline.assessment.pressing import Announce, press_file
from roughline.assessment.source import Source
from roughline.engineering.materials import Material, material
from roughline.errors import InputError
from roughline.topography.preparation import Preparation
from roughline.units import in_si, refuse_decimal_comma


def ask(
    source: Source,
    *,
    loads: Sequence[str],
    depths: Sequence[str],
    count: int | None,
    modulus: str | None,
    materials: str | None,
    against: Path | None,
    preparation: Preparation | None,
    periodic: bool,
    grid_error: bool | None,
    friction: float | None,
    frequency: str | None,
    theories: Sequence[str],
    report: Path | None,
    out: Path | None,
    command: str,
    announce: Announce,
    progress: Progress | None,
) -> Pressed:
    """Press a file as it is asked, and write what is wanted.

    Parameters
    ----------
    source, against, preparation, periodic, grid_error, theories, announce, progress
        As for :func:`roughline.assessment.pressing.press_file`; `against` is read like `source`.
    loads, depths, count
        As for :class:`roughline.assessment.loading.Loading`; 20 loads if there is none of them.
    modulus, frequency : str or None
        With units.
    materials : str or None
        Two, with a comma between.
    friction : float or None
        Coefficient of friction. [1]
    report : Path or None
        Folder for a report; the largest load is its own. Interrupted, it gets the curve alone.
    out : Path or None
        Folder for curve and figures.
    command : str
        That does it again, for the report.

    Raises
    ------
    InputError
        If the question does not fit together.
    """
    if count is None and not loads and not depths:
        count = DEFAULT_LOADS
    if sum(given is not None for given in (count, loads or None, depths or None)) > 1:
        raise InputError("give one of --load, --depth and --loads")
    pair = _pair(materials) if materials is not None else None
    if pair is None and (report or frequency or friction is not None):
        raise InputError("a report, reflection and partial slip need two --materials")
    if report is not None and not loads:
        raise InputError('a report needs a --load, such as "10 N"')
    if friction is not None and report is None:
        raise InputError("partial slip is drawn in a report: give --report too")
    hertz = in_si(frequency, "Hz", "frequency") if frequency is not None else None
    if hertz is not None and not 0 < hertz < math.inf:
        raise InputError(f'frequency is "{frequency}"; a positive one is needed')
    if friction is not None and not 0 < friction < math.inf:
        raise InputError(f"the coefficient of friction is {friction}; a positive one is needed")
    result = press_file(
        source,
        Loading(loads, depths, count),
        E_star=in_si(modulus, "Pa", "modulus") if modulus is not None else None,
        materials=pair,
        against=replace(source, file=against) if against is not None else None,
        preparation=preparation,
        periodic=periodic,
        grid_error=grid_error,
        frequency=hertz,
        theories=theories,
        whole_curve=report is not None,
        out=report or out,
        announce=announce,
        progress=progress,
    )
    if report is None and out is None:
        return result
    from roughline.report.contact_figures import write_pressed  # here, as to draw loads slowly
    from roughline.report.contact_report import write_report

    files: list[Path] = []
    if report is not None and result.interrupted:
        files += write_pressed(result, report)  # a curve, but no answers to report yet
    elif report is not None:
        files += write_report(result, report, command, friction)
    if out is not None:
        files += write_pressed(result, out)
    return replace(result, files=files)


def _pair(text: str) -> tuple[Material, Material]:
    """Read two materials."""
    refuse_decimal_comma(text, "materials")
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2:
        raise InputError(
            f'materials is "{text}"; give two with a comma between, such as "steel,copper", or '
            '"steel,rigid"'
        )
    return material(parts[0]), material(parts[1])
