"""Plant mistakes in a copy of the package, one at a time, and tell which the tests do not find."""

import argparse
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import NamedTuple

TESTS = Path(__file__).parent
PACKAGE = TESTS.parent / "src" / "roughline"


class Mutant(NamedTuple):
    """A mistake in one line of the package, and the tests that must find it."""

    file: str
    right: str
    wrong: str
    found_by: str


def mutants() -> list[Mutant]:
    """Read the list."""
    with (TESTS / "mutants.toml").open("rb") as file:
        return [Mutant(**each) for each in tomllib.load(file)["mutant"]]


def survives(mutant: Mutant, copy: Path, tier: str) -> bool:
    """Run the tests of a tier on a copy of the package that has the mistake."""
    file = copy / mutant.file
    whole = file.read_text(encoding="utf-8")
    file.write_text(whole.replace(mutant.right, mutant.wrong), encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "--tier", tier]
    found = subprocess.run(
        [*command, TESTS / mutant.found_by],
        cwd=TESTS.parent,
        env={**os.environ, "PYTHONPATH": str(copy.parent), "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
    )
    file.write_text(whole, encoding="utf-8")
    if found.returncode not in (0, 1):  # 0: all tests pass, 1: one fails
        raise SystemExit(f"{mutant.found_by} does not run:\n{found.stdout}{found.stderr}")
    return found.returncode == 0


def main() -> None:
    """Try all mutants, or those of files whose names hold one of some words."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="for the copy of the package")
    parser.add_argument("words", nargs="*", help="of the names of files; none: all")
    parser.add_argument("--tier", choices=["all", "short", "long"], default="all")
    given = parser.parse_args()
    copy, words = given.folder / "src" / "roughline", given.words
    if copy.resolve() == PACKAGE.resolve():
        parser.error(f"{given.folder} holds the package itself: name another folder for its copy")
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    tried = [each for each in mutants() if not words or any(word in each.file for word in words)]
    survivors = 0
    for mutant in tried:
        survived = survives(mutant, copy.resolve(), given.tier)
        survivors += survived
        verdict = "SURVIVED" if survived else "found"
        print(f"{verdict:8}  {mutant.file}: {mutant.wrong}  ({mutant.found_by})", flush=True)
    print(f"{len(tried) - survivors} of {len(tried)} found")
    sys.exit(survivors > 0)


if __name__ == "__main__":
    main()
