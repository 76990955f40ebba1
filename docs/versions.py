"""Write the list that fills the handbook's version switch.

    python docs/versions.py FOLDER ADDRESS

``FOLDER`` holds one folder for each version, and ``ADDRESS`` is where it is served.
"""

import contextlib
import json
import sys
from pathlib import Path

from packaging.version import InvalidVersion, Version


def versions(folder: Path, address: str) -> list[dict[str, str | bool]]:
    """Return the versions that the folder holds, newest first, as the theme wants them."""
    found = {}
    for each in folder.iterdir():
        with contextlib.suppress(InvalidVersion):
            found[Version(each.name)] = each.name
    names = [found[version] for version in sorted(found, reverse=True)]
    return [
        {"version": name, "url": f"{address}/{name}/", "preferred": name == names[0]}
        for name in names
    ]


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    text = json.dumps(versions(folder, sys.argv[2]), indent=1) + "\n"
    (folder / "versions.json").write_text(text, encoding="utf-8")
