"""Reduce or publish studies, by the names of their folders.

    python -m studies reduce NAME [STORE]
    python -m studies publish NAME...

reduces the store of a campaign to what the page of a study needs, or writes the pages, figures and
tables of studies from what was reduced. Errors are one line each.
"""

import sys
from importlib import import_module
from pathlib import Path

from roughline.errors import RoughlineError

HERE = Path(__file__).parent


def main(arguments: list[str]) -> None:
    """Do what the command line says."""
    action, *names = arguments or [""]
    count = len(names) if action == "publish" else 1
    if action not in ("publish", "reduce") or not names or not all(map(_is_study, names[:count])):
        sys.exit(__doc__)
    try:
        for name in names[:count]:
            study = import_module(f"studies.{name}.study")
            getattr(study, action)(*map(Path, names[count:]))
    except RoughlineError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)


def _is_study(name: str) -> bool:
    return (HERE / name / "study.py").is_file()


if __name__ == "__main__":
    main(sys.argv[1:])
