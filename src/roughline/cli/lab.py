"""The command that starts the lab."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roughline.cli import garbage
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
    behind_proxy: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS,...",
            help="Addresses or networks of the proxies that lead here, such as 127.0.0.1; they are "
            "believed who comes, and nobody else is let in. Needs a password.",
        ),
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
    max_disk: Annotated[
        float | None,
        typer.Option(
            help="Room for the files of all pages. [MB] Default: half of what is free, at most "
            "20000."
        ),
    ] = None,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
) -> None:
    """Open the lab: a page in the browser to look at surfaces, press them and read the paper.

    The server runs on this machine until Ctrl-C, needs no network, and can be reached from this
    machine only, by who has the address with its token. With --host other machines can reach it;
    it then asks for a password, as it does behind a proxy.
    """
    from contextlib import ExitStack

    from roughline.lab.server.bounded_log import bounded_log
    from roughline.lab.server.budget import largest_task_memory, memory_for_tasks
    from roughline.lab.server.opening import open_page
    from roughline.lab.server.process import noted_interrupts, start_forking
    from roughline.lab.server.settings import ServerSettings, networks_in, password_in
    from roughline.lab.tasks import warm_up

    garbage.as_usual()
    sizes = (("max_upload", max_upload), ("max_memory", max_memory), ("max_disk", max_disk))
    for name, megabytes in sizes:
        if megabytes is not None:
            positive(name, megabytes, "a positive, finite number of MB is needed")
    memory = memory_for_tasks()
    of_one = largest_task_memory(memory, max_memory * _MB)
    settings = ServerSettings(
        host=host,
        port=port,
        password=password_in(password_file) if password_file else None,
        proxies=networks_in(behind_proxy) if behind_proxy is not None else (),
        max_upload=max_upload * _MB,
        max_points=max_points,
        max_seconds=max_seconds,
        max_memory=of_one,
        memory=memory,
        max_disk=None if max_disk is None else max_disk * _MB,
    )

    def ready(address: str) -> None:
        typer.echo(f"The lab is open at {address} - Ctrl-C closes it.")
        may = f"has the password can upload files up to {max_upload:g} MB and compute here."
        if settings.proxies:
            typer.echo(
                f"It answers only what comes through {settings.names_of_proxies}, and "
                "believes from there who asks (X-Forwarded-For) and whether the way is encrypted "
                f"(X-Forwarded-Proto). Whoever reaches that proxy and {may}"
            )
        elif not settings.is_local:
            typer.echo(
                f"It listens on {settings.host}: whoever reaches that port of this machine and "
                f"{may} The connection is not encrypted: use it in a network that you trust, or "
                "behind a proxy that encrypts (--behind-proxy), or a tunnel."
            )
        if of_one < max_memory * _MB:
            typer.echo(
                f"One computation may take {of_one / _MB:.0f} MB of memory here, and not the "
                f"{max_memory:g} MB of --max-memory: no more is free."
            )
        if browser and not settings.proxies:  # people open the proxy's address
            open_page(address, opened)

    with ExitStack() as opened, bounded_log(), noted_interrupts() as interrupted:
        # which loads numerics while this process loads the server
        start_forking(warm_up, preloaded="roughline.lab.warm")
        from roughline.lab.server.serve import serve
        from roughline.lab.site import site

        serve(site(), settings, ready, interrupted)
    typer.echo("The lab is closed.")
