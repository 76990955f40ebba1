"""The command line run in this process, in a folder of its own, and what it printed and wrote."""

import io
import json
import os
import shutil
import sys
import tempfile
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path

from recorded_values import contents

WIDTH = 100  # columns of the screen


@contextmanager
def folder_with(fill):
    """Work in a temporary folder, once it is filled; gives the folder."""
    _let_workers_find_the_package()
    os.environ |= {"COLUMNS": str(WIDTH), "LINES": "50", "TERMINAL_WIDTH": str(WIDTH)}
    with tempfile.TemporaryDirectory(prefix="recorder-") as name, chdir(name):
        fill(Path(name))
        yield Path(name)


def _let_workers_find_the_package():
    """Make the paths to the package absolute, as the folder changes."""
    given = os.environ.get("PYTHONPATH", "")
    if given:
        paths = given.split(os.pathsep)
        os.environ["PYTHONPATH"] = os.pathsep.join(str(Path(path).resolve()) for path in paths)
    sys.path[:] = [str(Path(path).resolve()) if path else path for path in sys.path]


def run(arguments):
    """Run a command; exit code, what it printed, and the files in "out", which is removed."""
    from roughline.cli import main

    printed, errors, kept = io.StringIO(), io.StringIO(), sys.argv
    sys.argv = ["roughline", *arguments]
    if any(name.startswith("out/") for name in arguments):
        Path("out").mkdir(exist_ok=True)
    code = "returned"
    try:
        with redirect_stdout(printed), redirect_stderr(errors):
            main()
    except SystemExit as end:
        code = end.code or 0
    finally:
        sys.argv = kept
    shown = printed.getvalue()
    found = {
        "command": " ".join(arguments),
        "code": str(code),
        "printed": _parsed(shown) if "--json" in arguments else shown,
        "errors": errors.getvalue(),
        "files": contents("out") if Path("out").is_dir() else "none",
    }
    shutil.rmtree("out", ignore_errors=True)
    return found


def _parsed(text):
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return text
