"""Write the list that fills the handbook's version switch.

    python docs/versions.py FOLDER ADDRESS

``FOLDER`` holds one folder for each version, and ``ADDRESS`` is where it is served.
"""

import json
import re
import sys
from pathlib import Path

VERSION = re.compile(r"\d+\.\d+\.\d+")


def versions(folder: Path, address: str) -> list[dict[str, str | bool]]:
    """Return the versions that the folder holds, newest first, as the theme wants them."""
    found = [each.name for each in folder.iterdir() if VERSION.fullmatch(each.name)]
    found.sort(key=lambda name: tuple(map(int, name.split("."))), reverse=True)
    return [
        {"version": name, "url": f"{address}/{name}/", "preferred": name == found[0]}
        for name in found
    ]


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    text = json.dumps(versions(folder, sys.argv[2]), indent=1) + "\n"
    (folder / "versions.json").write_text(text, encoding="utf-8")
