"""Tasks that only tests ask for; processes of a lane import them by their name."""

import os
import signal
import sys
import time
from pathlib import Path

from roughline.computing.memory import refuse_beyond_memory
from roughline.errors import InputError
from roughline.lab.controls import ControlError
from roughline.lab.server import process as processes
from roughline.lab.server.tasks import Place

_serve = processes._serve


def place_of(name):
    """Where a task of this file is."""
    return Place(task_of, name, reads_files=name == "read")


def task_of(name):
    """A task of this file, in a process."""
    return globals()[name]


def serve(connection, memory, warm_up):
    """Do the tasks of this file, in a process."""
    sys.modules.setdefault("lab.server.doings", sys.modules[__name__])
    _serve(connection, memory, None)


def echo(arguments, progress):
    """Say what was said, by which process."""
    return f"{arguments['say']} {os.getpid()}".encode()


def read(arguments, progress):
    """Say the same, after reading what a page has brought."""
    return echo(arguments, progress)


def sleep(arguments, progress):
    """Take some time, and tell of it."""
    if "mark" in arguments:
        Path(arguments["mark"]).touch()
    steps = max(100, round(20 * arguments["seconds"]))
    for step in range(steps):
        time.sleep(arguments["seconds"] / steps)
        progress(step + 1, steps)
    return b"slept"


def last(arguments, progress):
    """Tell that it has begun, and last until a file is there."""
    progress(0, 1)
    while not Path(arguments["until"]).exists():
        time.sleep(0.005)
    return b"lasted"


def compute(arguments, progress):
    """Use a core without end."""
    Path(arguments["mark"]).write_text(str(os.getpid()))
    while True:
        pass


def die(arguments, progress):
    """End as the system ends who takes too much."""
    os.kill(os.getpid(), signal.SIGKILL)


def fail(arguments, progress):
    """Fail for a reason that nobody knows."""
    raise ZeroDivisionError(f"in {__file__}")


def refuse(arguments, progress):
    """Refuse, with the path of a file."""
    raise InputError(f"cannot read {next(iter(arguments['session']['names']))}")


def refuse_at(arguments, progress):
    """Refuse what a control is set to."""
    raise ControlError("too rough", "h")


def take_memory(arguments, progress):
    """Take more memory than allowed."""
    return bytes(arguments["bytes"])


def need_memory(arguments, progress):
    """Refuse what is known to take more memory than allowed, before it is taken."""
    refuse_beyond_memory(int(arguments["bytes"]), "this", "take less")
    return b""


def fail_to_open(arguments, progress):
    """Fail to open a file that is not there."""
    return Path(arguments["session"]["folder"], "none").read_bytes()
