"""How the page is opened in the browser without telling other users its token."""

from __future__ import annotations

import html
import os
import subprocess
import sys
from contextlib import ExitStack, suppress
from pathlib import Path

from roughline.lab.server.files import folder_of_files

_SNAPS = Path("/snap/bin")
_OPEN = "import sys, webbrowser; webbrowser.open(sys.argv[1])"


def open_page(address: str, opened: ExitStack) -> None:
    """Open an address in the browser through a file that only this user may read.

    The command line of a browser, where an address would stand, is seen by all users. Browsers that
    are snaps see no folder but the user's own.
    """
    to, home = html.escape(address), os.environ.get("HOME", "")
    content = (
        '<!doctype html><meta charset="utf-8"><title>roughline</title>'
        f'<meta http-equiv="refresh" content="0;url={to}"><a href="{to}">Open the lab</a>\n'
    )
    parent = Path(home) if _SNAPS.is_dir() and os.access(home, os.W_OK) else None
    with suppress(OSError):  # such as a full disk; the address is printed besides
        page = opened.enter_context(folder_of_files(parent)) / "open.html"
        page.touch(mode=0o600)
        page.write_text(content, encoding="utf-8")
        # it outlives this program, and with it the place where its errors would go
        command = [sys.executable, "-c", _OPEN, page.as_uri()]
        subprocess.run(command, stderr=subprocess.DEVNULL, check=False)
