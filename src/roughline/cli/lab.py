"""The command that starts the lab."""

from __future__ import annotations

from typing import Annotated

import typer

from roughline.cli import garbage


def lab(
    host: Annotated[
        str, typer.Option(help="Address to listen on; others than this let other machines in.")
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="Port to listen on; 0 takes a free one.")] = 5107,
    address: Annotated[
        str,
        typer.Option(
            help="Where browsers find the page if a proxy leads here: https://lab.example.org/",
            show_default=False,
        ),
    ] = "",
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
) -> None:
    """Open the lab: a page in the browser to look at surfaces, press them and read the paper.

    The server runs on this machine until Ctrl-C, needs no network, and answers who has the address
    with its token, which is new at each start. It can be reached from this machine only, unless
    --host or a proxy lets others in.
    """
    from contextlib import ExitStack

    from roughline.lab.server.opening import open_page
    from roughline.lab.server.process import noted_interrupts, start_forking
    from roughline.lab.server.settings import ServerSettings
    from roughline.lab.tasks import warm_up

    garbage.as_usual()
    settings = ServerSettings(host=host, port=port, address=address)

    def ready(page: str) -> None:
        typer.echo(f"The lab is open at {page} - Ctrl-C closes it.")
        if not settings.is_local:
            typer.echo(
                f"It listens on {host}: whoever reaches that port of this machine and has the "
                "token can bring files and compute here. The connection is not encrypted: use it "
                "in a network that you trust, or through a tunnel or a proxy that encrypts."
            )
        if browser and not address:  # people open the proxy's address
            open_page(page, opened)

    with ExitStack() as opened, noted_interrupts() as interrupted:
        # which loads numerics while this process loads the server
        start_forking(warm_up, preloaded="roughline.lab.warm")
        from roughline.lab.server.serve import serve
        from roughline.lab.site import site

        serve(site(), settings, ready, interrupted)
    typer.echo("The lab is closed.")
