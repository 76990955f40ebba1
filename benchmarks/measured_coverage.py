"""Count how often intervals hold on surfaces as they are made and measured.

``make intervals`` asks what users ask, and writes ``docs/intervals-table.md``; ``make coverage``,
``make grid-error``, ``make interface-stiffness`` and ``make part-coverage`` each count one study;
``make leak-coverage`` counts what flows, and writes ``docs/leak-coverage-table.md``, and ``make
seal-coverage`` the pressure that seals, in ``docs/seal-coverage-table.md``.
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
PAGES = {
    (*OF_THE_PAGE,): (
        "intervals-table.md",
        "Intervals on surfaces as they are measured",
        "intervals",
    ),
    (*OF_LEAKS,): ("leak-coverage-table.md", "Intervals of what flows", "leak-coverage"),
    (*OF_SEALS,): ("seal-coverage-table.md", "Intervals of what seals", "seal-coverage"),
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
    page = Page(*PAGES.get(of_these, PAGES[*OF_THE_PAGE,]))
    page.say(
        "Held: share of the printed intervals that hold the truth. Silent: share for which no "
        "interval is printed, because the data break an assumption. Half width: median factor from "
        "the middle to the ends. Too wide: by how much the logarithms of all intervals of a row "
        "could be divided so that 95 of 100 still hold."
    )
    beside = "A map or a scan does not show what lies beside it."
    page.say(f"\nFewer than nine in ten hold for: {', '.join(misses(rows))}. {beside}")
    written(rows, STUDIES, page)
    if of_these in PAGES and share == 1.0 and not quarters:
        page.save()


if __name__ == "__main__":
    main()
