"""Record what the package answers, to compare it with what another state of it answers.

    python benchmarks/recorder.py record DIR [--only curves,store,json,paper]
    python benchmarks/recorder.py compare DIR DIR [--only ...] [--rtol 1e-6]

Curves and other answers from Python, stores of campaigns, answers of the command line and the
paper's study are compared bit for bit; times, dates, addresses, paths and versions are left out.
With ``--rtol``, sets, counts of loads and texts must be equal, and values agree to the tolerance,
or to the one that was asked for; what differs in bits only is listed, and so are convolutions.
"""

import argparse
import os
import shutil
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

import recorded_campaigns
import recorded_commands
from recorded_questions import questions
from recorded_values import differences, flat, keep, kept, masked

import roughline as rl

ROOT = Path(__file__).resolve().parents[1]
CLASSES = ("curves", "json", "store", "paper")


def items(kind, topographies):
    """Give what is recorded of a class, as (name, function)."""
    if kind == "curves":
        return questions(topographies)
    if kind == "json":
        return recorded_commands.commands(topographies)
    return recorded_campaigns.store() if kind == "store" else recorded_campaigns.paper()


def answer(ask):
    """What a function returns, or how it refuses, with its warnings; by name."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            found = flat({"answer": ask()})
        except rl.RoughlineError as error:
            found = flat({"refused": f"{type(error).__name__}: {error}"})
            if hasattr(error, "curve"):
                found |= flat({"curve": error.curve})
    kinds = (RuntimeWarning, rl.ContinuumWarning)
    kept_of = [each for each in told if issubclass(each.category, kinds)]
    return found | flat(
        {"warnings": [f"{each.category.__name__}: {each.message}" for each in kept_of]}
    )


def record(out, kinds, topographies):
    """Record classes of answers in a folder; what it held of them is replaced."""
    if not topographies.is_dir():
        sys.exit(f"{topographies} is no folder; give one with measured files: --topographies")
    source = f"roughline {rl.__version__} from {Path(rl.__file__).parent}"
    print(source)
    out.mkdir(parents=True, exist_ok=True)
    (out / "source.txt").write_text(f"{source}\n", encoding="utf-8")
    threads = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    paths = ((topographies, "TOPOGRAPHIES"), (ROOT, "REPOSITORY"))
    for kind in kinds:
        shutil.rmtree(out / kind, ignore_errors=True)
        started, count = time.perf_counter(), 0
        for name, ask in items(kind, topographies):
            before, file = time.perf_counter(), out / kind / f"{name.replace('/', ' ')}.npz"
            if file.exists():
                sys.exit(f"{kind}: two items are called {name}: rename one")
            found = masked(answer(ask), paths)
            rl.set_threads(threads)
            keep(found, file)
            count += 1
            print(f"{kind} {count:3d}  {time.perf_counter() - before:6.2f} s  {name}", flush=True)
        print(f"{kind}: {count} items in {time.perf_counter() - started:.0f} s")


def compare(first, second, kinds, rtol):
    """Print how two recordings differ; whether they do, beyond a tolerance if one is given."""
    count, found = 0, Counter()
    for kind in kinds:
        names = [{path.stem for path in (each / kind).glob("*.npz")} for each in (first, second)]
        for name in sorted(names[0] | names[1]):
            count += 1
            files = [each / kind / f"{name}.npz" for each in (first, second)]
            if not all(file.exists() for file in files):
                differing = [("lost" if files[0].exists() else "new", "", "the whole item")]
            else:
                differing = differences(*map(kept, files), rtol)
            for what, place, how in differing:
                found[what] += 1
                print(f"{kind}: {name}: {place}: {what}: {how}")
        if not names[0] | names[1]:
            found["lost"] += 1
            print(f"{kind}: recorded in neither folder")
    told = ", ".join(f"{number} {what}" for what, number in sorted(found.items()))
    print(f"{count} items compared: {told or 'no difference'}")
    return bool(set(found) - {"bits", "work"})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("action", choices=("record", "compare"))
    parser.add_argument("folders", type=Path, nargs="+", metavar="DIR")
    parser.add_argument("--only", default=",".join(CLASSES), help="classes, with commas between")
    parser.add_argument("--topographies", type=Path, default=ROOT.parent / "shared/topographies")
    parser.add_argument("--rtol", nargs="?", type=float, const=1e-6, help="1e-6 if not told")
    arguments = parser.parse_args()
    kinds = [kind for kind in arguments.only.split(",") if kind]
    if not set(kinds) <= set(CLASSES):
        parser.error(f"--only is {arguments.only}; allowed are {', '.join(CLASSES)}")
    if len(arguments.folders) != (1 if arguments.action == "record" else 2):
        parser.error("record takes one folder, compare two")
    folders = [folder.resolve() for folder in arguments.folders]
    if arguments.action == "compare":
        sys.exit(compare(*folders, kinds, arguments.rtol))
    record(folders[0], kinds, arguments.topographies.resolve())


if __name__ == "__main__":
    main()
