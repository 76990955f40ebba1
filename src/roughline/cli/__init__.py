"""The command line: parse, call one function, print."""

from __future__ import annotations

import inspect
import sys
from typing import Annotated

import typer
from typer.exceptions import TyperException

from roughline._version import __version__
from roughline.cli import garbage
from roughline.cli.about import about
from roughline.cli.ball import ball_command
from roughline.cli.campaign import app as campaign_app
from roughline.cli.comparison import compare_command
from roughline.cli.contact import press_command
from roughline.cli.creep import creep_command
from roughline.cli.flags import FLAGS
from roughline.cli.help import PanelsFirst
from roughline.cli.lab import lab
from roughline.cli.paper import paper
from roughline.cli.topography import generate, info
from roughline.cli.usage import NOT_OFFERED, in_one_line, refuse_empty, refuse_repeated
from roughline.errors import ConvergenceError, RoughlineError
from roughline.errors.words import speaking

app = typer.Typer(
    name="roughline",
    help="The contact laboratory for rough surfaces.",
    epilog=f"What it does not do, and what to use: {NOT_OFFERED}",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
)
for _name, _command in (
    ("press", press_command),
    ("ball", ball_command),
    ("creep", creep_command),
):
    _summary, _, _details = (inspect.getdoc(_command) or "").partition("\n\n")
    app.command(_name, cls=PanelsFirst, help=_summary, epilog=_details)(_command)
app.command()(info)
app.command("compare")(compare_command)
app.command()(generate)
app.command()(paper)
app.command()(lab)
app.command()(about)
app.add_typer(campaign_app, name="campaign")


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"roughline {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    pass


def main() -> None:
    """Run the command line; errors are one line, exit code 2 for input and 1 for numerics."""
    garbage.seldom()
    try:
        refuse_empty(sys.argv[1:])
        command = typer.main.get_command(app)
        refuse_repeated(command, sys.argv[1:])
        with speaking(FLAGS):
            sys.exit(command(standalone_mode=False) or 0)
    except TyperException as error:
        if type(error).__name__ == "NoArgsIsHelpError":
            typer.echo(error.format_message(), err=True)
            sys.exit(2)
        sys.exit(_say(in_one_line(error), 2))
    except ConvergenceError as error:
        sys.exit(_say(str(error), 1))
    except RoughlineError as error:
        sys.exit(_say(str(error), 2))


def _say(what: str, code: int) -> int:
    typer.echo(f"roughline: {' '.join(what.split())}", err=True)
    return code
