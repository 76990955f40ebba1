"""How the page is opened in the browser without telling other users its token."""

from __future__ import annotations

import html
import webbrowser
from contextlib import ExitStack
from pathlib import Path

from roughline.server.leftovers import folder_of_files

_SNAPS = Path("/snap/bin")


def open_page(address: str, opened: ExitStack) -> None:
    """Open an address in the browser through a file that only this user may read.

    The command line of a browser, where an address would stand, is seen by all users.

    Parameters
    ----------
    address : str
        Of the page, with its token.
    opened : ExitStack
        Deletes the file when it is closed.
    """
    # browsers that are snaps have a temporary folder of their own, and see only the user's files
    parent = Path.home() if _SNAPS.is_dir() else None
    page = opened.enter_context(folder_of_files(parent)) / "open.html"
    page.touch(mode=0o600)
    to = html.escape(address)
    page.write_text(
        '<!doctype html><meta charset="utf-8"><title>roughline</title>'
        f'<meta http-equiv="refresh" content="0;url={to}"><a href="{to}">Open the lab</a>\n',
        encoding="utf-8",
    )
    webbrowser.open(page.as_uri())
