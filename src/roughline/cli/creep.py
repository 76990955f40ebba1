"""The command that presses a topography into a body that creeps."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roughline.cli import options
from roughline.cli.options import interruptible, print_json, writable_file
from roughline.question.fields import FILE, PREPARATION, FieldValues


@options.with_fields(FILE, PREPARATION)
def creep_command(
    file: Annotated[
        Path,
        typer.Argument(help="A topography: an instrument's file, or one that roughline wrote."),
    ],
    prony: Annotated[
        str,
        options.of_bodies(
            help="How the modulus relaxes: shares of the modulus at once, each with its relaxation "
            'time, such as "0.3 10 ms, 0.4 1 s".'
        ),
    ],
    materials: options.Materials = None,
    modulus: options.Modulus = None,
    periodic: Annotated[
        bool,
        options.of_bodies("--periodic", help="Repeat the surface periodically."),
    ] = False,
    load: Annotated[
        list[str] | None,
        options.of_loads(
            help='A force, such as "10 N", or a mean pressure, such as "0.2 MPa": one is held from '
            "time zero on, several are those at the --times."
        ),
    ] = None,
    depth: Annotated[
        list[str] | None,
        options.of_loads(
            help='A depth, such as "2 um", instead of a load: one is held, several are those at '
            "the --times."
        ),
    ] = None,
    times: Annotated[
        str | None,
        options.of_loads(
            help='When the contact is wanted, such as "0 s, 1 s, 1 min, 1 h" [default: from zero '
            "to long after the last relaxation time]."
        ),
    ] = None,
    out: options.CurveFile = None,
    *,
    values: FieldValues,
    json: options.Json = False,
) -> None:
    """Press a topography into a body that creeps, and print the contact over time.

    Under a held load depth and contact area grow; at a held depth the contact stays, and the force
    falls. Moduli are those at once. The rough body is rigid, or far stiffer than the one that
    creeps, and the bodies neither yield nor stick. Between several loads it is straight; a history
    under which the contact recedes is refused.

    Exit codes: 0; 1 if a contact was not solved to the tolerance; 2 for input that cannot be used;
    130 after Ctrl-C.

    Examples
    --------
    roughline creep scan.x3p --materials "rigid, E=40 MPa nu=0.49" --prony "0.3 10 ms, 0.3 1 s, 0.2
    100 s" --load "0.2 MPa"

    roughline creep scan.x3p --modulus "50 MPa" --prony "0.5 1 s" --times "0 s, 1 min, 1 h"
    --load "0 N" --load "1 N" --load "1 N" --out creep.nc
    """
    from roughline.creep.question import CreepQuestion, press_with_creep
    from roughline.question.from_fields import build_preparation, build_reading
    from roughline.report.creep import creep_json, print_creep

    question = CreepQuestion(
        file,
        prony=prony,
        materials=materials,
        E_star=modulus,
        times=times,
        loads=load,
        depths=depth,
        periodic=periodic,
        reading=build_reading(values),
        preparation=build_preparation(values),
    )
    with interruptible("there is no result"), writable_file(out):
        result = press_with_creep(question)
    files = []
    if out is not None:
        result.curve.write(out)
        files.append(out)
    if json:
        print_json(creep_json(result, files))
    else:
        print_creep(result, files)
