"""The command that prints versions and hardware, for questions and reports of errors."""

from __future__ import annotations

import platform
import re
from importlib import metadata
from typing import Any

import typer

from roughline._version import __version__
from roughline.cli.options import Json, print_json


def about(json: Json = False) -> None:
    """Print the versions, the processor and the number of threads that this program runs with."""
    facts = _facts()
    if json:
        print_json(facts)
        return
    packages = facts.pop("packages")
    width = max(map(len, (*facts, *packages)))
    for name, value in (facts | packages).items():
        typer.echo(f"{name:{width}}  {value}")


def _facts() -> dict[str, Any]:
    """What a report of an error needs, by name; the packages are those that roughline requires."""
    import psutil  # here because it loads slowly

    from roughline.computing import fft
    from roughline.computing.cores import available_cores, processor_name

    needed = metadata.requires("roughline") or []
    names = [re.split(r"[^\w.-]", each)[0] for each in needed if "extra ==" not in each]
    return {
        "roughline": __version__,
        "python": platform.python_version(),
        "system": platform.platform(),
        "processor": processor_name(),
        "cores": available_cores(),
        "threads": fft.threads(),
        "memory": f"{psutil.virtual_memory().total / 1e9:.3g} GB",
        "FFT": f"ducc0 {metadata.version('ducc0')}",
        "packages": {name: metadata.version(name) for name in names},
    }
