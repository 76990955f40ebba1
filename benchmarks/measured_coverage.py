"""Count how often intervals hold on surfaces as they are made and measured.

``make intervals`` asks what users ask, ``make leak-coverage`` counts what flows, and ``make
seal-coverage`` the pressure that seals; each writes its part of ``docs/intervals_hold.md``. ``make
coverage``, ``make grid-error``, ``make interface-stiffness`` and ``make part-coverage`` each count
one study.
The truth is the full model's answer for the parent, or for the finer surface that an instrument
saw. An interval that is not printed counts as silent. Rows go to a file as they are made; what is
there is not made again. ``--files`` takes measured maps, whose quarters are asked instead.
"""

import argparse
from pathlib import Path

import pandas as pd
from page import Page
from trials import misses, recorded, written
from trials_of_grids import FINER, GRID
from trials_of_joints import LARGER, LEAK, MINE, PART, SEAL, TILED
from trials_of_spectra import FIT, PIECE, SCAN

OF_THE_PAGE = {"grid": GRID, "larger": LARGER, "part": PART, "scan": SCAN, "fit": FIT}
OF_LEAKS = {"leak": LEAK}
OF_SEALS = {"seal": SEAL}
OTHERS = {"finer": FINER, "tiled": TILED, "mine": MINE, "pieces": PIECE}
STUDIES = {**OF_THE_PAGE, **OF_LEAKS, **OF_SEALS, **OTHERS}
PARTS = {
    (*OF_THE_PAGE,): "intervals",
    (*OF_LEAKS,): "leak-coverage",
    (*OF_SEALS,): "seal-coverage",
}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("studies", nargs="*", default=[*OF_THE_PAGE], help=", ".join(STUDIES))
    parser.add_argument("--folder", type=Path, default=Path("out/intervals"))
    parser.add_argument("--share", type=float, default=1.0, help="of all seeds")
    parser.add_argument("--seed", type=int, default=0, help="the first one")
    parser.add_argument("--kinds", nargs="*", help="of the surfaces; all if not told")
    parser.add_argument("--files", nargs="*", default=[])
    arguments = parser.parse_args()
    quarters, tables = [f"quarters of {file}" for file in arguments.files], []
    for name in arguments.studies:
        study = STUDIES[name]
        kinds, share = quarters or arguments.kinds or study.kinds, arguments.share
        trials = study.trials(name, kinds, arguments.seed, 0 if quarters else share)
        tables.append(recorded(arguments.folder / f"{name}.csv", trials, study.rows_of))
    rows = pd.concat(tables, ignore_index=True)
    of_these = tuple(arguments.studies)
    part = PARTS.get(of_these, PARTS[*OF_THE_PAGE,])
    page = Page(part, "intervals_hold.md", part)
    beside = "A map or a scan does not show what lies beside it."
    page.say(f"Fewer than nine in ten hold for: {', '.join(misses(rows))}. {beside}")
    written(rows, STUDIES, page)
    if of_these in PARTS and share == 1.0 and not quarters:
        page.save()


if __name__ == "__main__":
    main()
