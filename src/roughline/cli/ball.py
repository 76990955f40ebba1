"""The command that presses a ball."""

from __future__ import annotations

from typing import Annotated

import typer

from roughline.cli import options
from roughline.cli.options import print_json, writable_file


def ball_command(
    radius: Annotated[
        str,
        options.of_bodies(
            help='Radius of the ball, such as "10 mm"; of two balls 1 / (1 / R1 + 1 / R2).'
        ),
    ],
    materials: options.Materials = None,
    modulus: options.Modulus = None,
    hardness: Annotated[
        str | None,
        options.of_bodies(
            help='Hardness of the softer body, such as "2 GPa" [default: of the materials].'
        ),
    ] = None,
    adhesion: Annotated[
        str | None,
        options.of_bodies(
            help='Work of adhesion, such as "50 mJ/m^2": the ball sticks as Johnson, Kendall and '
            "Roberts have it [default: it only pushes]."
        ),
    ] = None,
    sphere: Annotated[
        bool,
        options.of_bodies(
            "--sphere",
            help="Take the ball as the sphere that it is [default: as Hertz's parabola].",
        ),
    ] = False,
    load: Annotated[
        list[str] | None,
        options.of_loads(
            help='A force, such as "10 N"; of a ball that sticks, a pull is negative; may be '
            "repeated."
        ),
    ] = None,
    depth: Annotated[
        list[str] | None,
        options.of_loads(help='A depth since first touch, such as "200 nm"; may be repeated.'),
    ] = None,
    out: options.CurveFile = None,
    json: options.Json = False,
) -> None:
    """Press a ball against a flat: contact radius, depth, stiffness and pressures.

    Both bodies are half-spaces of one material each, without friction. The contact is Hertz's, and
    with --adhesion that of Johnson, Kendall and Roberts; the force that draws the ball off is then
    given as well. Loads are applied in the order given. Where the largest pressure exceeds 0.6 of
    the hardness, a warning says that the body yields below the contact.

    Exit codes: 0; 1 if a pull drew the bodies apart; 2 for input that cannot be used.

    Examples
    --------
    roughline ball --radius "10 mm" --materials steel,steel --load "10 N"

    roughline ball --radius "20 um" --materials "E=5 MPa nu=0.49, rigid" --adhesion "50 mJ/m^2"
    --load "1 uN" --load "0 N" --load "-2 uN"
    """
    from roughline.ball import BallQuestion, press_ball
    from roughline.report.ball import ball_json, print_ball

    question = BallQuestion(
        radius=radius,
        materials=materials,
        E_star=modulus,
        hardness=hardness,
        adhesion=adhesion,
        loads=load,
        depths=depth,
        is_sphere=sphere,
    )
    with writable_file(out):
        result = press_ball(question)
    files = []
    if out is not None:
        result.curve.write(out)
        files.append(out)
    if json:
        print_json(ball_json(result, files))
    else:
        print_ball(result, files)
    if not result.curve.converged.all():
        raise typer.Exit(1)
