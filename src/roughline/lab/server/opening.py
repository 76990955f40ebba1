"""How the page is opened in the browser without telling other users its token."""

from __future__ import annotations

import html
import os
import sys
import webbrowser
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from roughline.lab.server.files import folder_of_files

_SNAPS = Path("/snap/bin")


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
        with _silent_start():
            webbrowser.open(page.as_uri())


@contextmanager
def _silent_start() -> Iterator[None]:
    """Start programs that outlive this one, such as browsers, without a place for their errors."""
    if sys.stderr is None:
        yield
        return
    before, nothing = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 2)
    try:
        yield
    finally:
        os.dup2(before, 2)
        os.close(before)
        os.close(nothing)
