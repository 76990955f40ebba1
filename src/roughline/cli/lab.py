"""The command that starts the lab."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roughline.errors.checks import positive

_MB = 1_000_000


def lab(
    host: Annotated[
        str,
        typer.Option(
            help="Address to listen on; an address that other machines can reach needs a password."
        ),
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="Port to listen on; 0 takes a free one.")] = 5107,
    password_file: Annotated[
        Path | None, typer.Option(help="File whose first line is the password for the page.")
    ] = None,
    max_upload: Annotated[
        float, typer.Option(help="Largest file that can be uploaded. [MB]")
    ] = 200,
    max_points: Annotated[
        int, typer.Option(help="Largest number of points along a side of generated surfaces.")
    ] = 1024,
    max_seconds: Annotated[float, typer.Option(help="Longest time of one computation. [s]")] = 600,
    max_memory: Annotated[
        float, typer.Option(help="Largest memory of one computation. [MB]")
    ] = 4000,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
) -> None:
    """Open the lab: a page in the browser to look at surfaces, press them and read the paper.

    The server runs on this machine until Ctrl-C, needs no network, and can be reached from this
    machine only, by who has the address with its token. With --host other machines can reach it;
    it then asks for a password.
    """
    from contextlib import ExitStack

    from roughline.server.interrupts import noted_interrupts
    from roughline.server.opening import open_page
    from roughline.server.process import start_forking
    from roughline.server.settings import ServerSettings, password_in

    for name, megabytes in (("max_upload", max_upload), ("max_memory", max_memory)):
        positive(name, megabytes, "a positive, finite number of MB is needed")
    settings = ServerSettings(
        host=host,
        port=port,
        password=password_in(password_file) if password_file else None,
        max_upload=max_upload * _MB,
        max_points=max_points,
        max_seconds=max_seconds,
        max_memory=max_memory * _MB,
    )

    def ready(address: str) -> None:
        typer.echo(f"The lab is open at {address} - Ctrl-C closes it.")
        if not settings.is_local:
            typer.echo(
                f"It listens on {settings.host}: whoever reaches that port of this machine and has "
                f"the password can upload files up to {max_upload:g} MB and compute here. The "
                "connection is not encrypted: use it in a network that you trust, or behind a "
                "proxy or tunnel that encrypts."
            )
        if browser:
            open_page(address, opened)

    with ExitStack() as opened, noted_interrupts() as interrupted:
        # which loads numerics while this process loads the server
        start_forking("roughline.lab.warm")
        from roughline.lab.site import site
        from roughline.server.serve import serve

        serve(site(), settings, ready, interrupted)
    typer.echo("The lab is closed.")
