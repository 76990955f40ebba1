"""What each constant of the margins bounds, what chose it, and what changes if it is doubled.

``make constants MAPS=...`` solves small cases again with one constant changed at a time, with the
measured maps that are named, in half an hour of a quiet core, and writes
a part of ``docs/intervals_hold.md``, and all numbers beside its table. Rows go to a file as they
are made; what is there is not made again, so remove the folder after a change of the code. A
constant is tried on the cases of its room, and there on the parts that use it.
"""

import argparse
import csv
import json
import math
import os
import subprocess
import sys
import warnings
from collections import Counter
from pathlib import Path

from numbers_of_margins import change, constants, trace
from reasons_of_constants import CHOSEN, GUARDS

DOCS = Path(__file__).parents[1] / "docs"
COLUMNS = (
    *("file", "constant", "value", "bounds", "chosen", "changed", "parts", "values"),
    *("intervals", "wider", "mean_ratio", "largest_ratio", "known", "unknown", "ends"),
    *("facts_come", "facts_go", "facts_reworded", "guards"),
)
_SAME = 1e-9  # relative difference of numbers that are the same, to rounding
_NAMED = 3  # facts that the page names


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("maps", nargs="*", type=Path, help="files of measured maps")
    parser.add_argument("--folder", type=Path, default=Path("out/constants"))
    parser.add_argument("--one", help="change this constant alone, and print what changes")
    parser.add_argument("--base", action="store_true", help="solve the cases as they are")
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    if asked.base:
        return _solve_all(asked.folder / "base.json", asked.maps)
    if asked.one is not None:
        return print(json.dumps(_changed(asked.one, asked.folder / "base.json", asked.maps)))
    if not (asked.folder / "base.json").exists():
        _elsewhere("--base", asked)
    rows = {each["key"]: each for each in _rows(asked.folder / "rows.jsonl")}
    for each in constants():
        known = rows.get(each.key)
        if known is None or known["value"] != each.value:
            row = json.loads(_elsewhere(f"--one={each.key}", asked))
            with (asked.folder / "rows.jsonl").open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
            rows[each.key] = row
            print(each.key, changes_in_words(row), flush=True)
    written([_told(each, rows[each.key]) for each in constants()], asked.maps)


def _rows(path):
    return map(json.loads, path.read_text("utf-8").splitlines()) if path.exists() else ()


def _elsewhere(task, asked):
    """Run a task in a process of its own, which loads the package as the task needs it."""
    command = [sys.executable, __file__, task, "--folder", asked.folder, *asked.maps]
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    return subprocess.run(
        command, check=True, stdout=subprocess.PIPE, text=True, env=environment
    ).stdout


def _solve_all(path, maps):
    """Keep what all parts of cases give, and which constants they use."""
    seen = set()
    trace(seen)
    from cases_of_constants import cases  # here because the package is traced from now on

    at_import, found = set(seen), {}
    for name, case in cases(maps).items():
        for part, ask in case.parts.items():
            _forget()
            seen.clear()
            numbers, facts = _found(ask)
            used = sorted(seen | at_import)
            found[f"{name}: {part}"] = {"uses": used, "numbers": numbers, "facts": facts}
    path.write_text(json.dumps(found), encoding="utf-8")


def _forget():
    """Forget what functions of the package keep, which would hide what they use."""
    for name, module in [*sys.modules.items()]:
        if name.startswith("roughline."):
            for each in vars(module).values():
                if hasattr(each, "cache_clear"):
                    each.cache_clear()


def _found(ask):
    import roughline as rl

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = ask()
        except rl.RoughlineError as error:
            return {}, [["refused", str(error)]]
    return found.numbers, found.facts


def _changed(key, base, maps):
    """Solve the parts of cases that use a constant with another value of it, and compare."""
    (constant,) = (each for each in constants() if each.key == key)
    how = []
    change(constant, how)
    from cases_of_constants import cases  # here because the constant is changed from now on

    before, row = json.loads(base.read_text("utf-8")), _Comparison()
    for name, case in cases(maps).items():
        if constant.file.partition("/")[0] not in case.rooms:
            continue
        for part, ask in case.parts.items():
            known = before[f"{name}: {part}"]
            if key in known["uses"]:
                numbers, facts = _found(ask)
                row.add(known["numbers"], numbers, known["facts"], facts)
    if not row.parts and any(key in each["uses"] for each in before.values()):
        raise SystemExit(f"{key}: cases use it, and none of them is for constants of its room")
    # a module that no case loads
    return {"key": key, "value": constant.value, "changed": how[0] if how else "", **row.told}


class _Comparison:
    """What differs between two runs of some cases."""

    def __init__(self):
        self.parts = self.intervals = self.wider = 0
        self.known = self.unknown = self.ends = self.reworded = 0
        self.values, self.ratios = 0.0, []
        self.come, self.go = Counter(), Counter()

    def add(self, before, after, facts, others):
        """Compare a part of a case."""
        self.parts += 1
        for name in {*before, *after}:
            self._compare(before.get(name), after.get(name))
        kinds, other_kinds = (Counter(kind for kind, _ in each) for each in (facts, others))
        self.come += other_kinds - kinds
        self.go += kinds - other_kinds
        if kinds == other_kinds:
            self.reworded += sorted(facts) != sorted(others)

    def _compare(self, before, after):
        none = (math.nan,) * 3
        (value, low, high), (other, least, most) = before or none, after or none
        if math.isnan(value) != math.isnan(other):
            self.values = math.inf
        elif value != other and not math.isnan(value):
            scale = max(abs(value), abs(other))
            self.values = max(self.values, abs(other - value) / scale)
        is_known, is_still = not math.isnan(low), not math.isnan(least)
        self.known += is_still and not is_known
        self.unknown += is_known and not is_still
        if not (is_known and is_still):
            return
        self.intervals += 1
        (width, opened), (new, opened_now) = _width(value, low, high), _width(other, least, most)
        if opened != opened_now or bool(width) != bool(new):
            self.ends += 1
        elif width and abs(new / width - 1) > _SAME:
            self.wider += 1
            self.ratios.append(math.log(new / width))

    @property
    def told(self):
        """All of it, as a row."""
        ratios = self.ratios or [0.0]
        return {
            "parts": self.parts,
            "values": 0.0 if self.values < _SAME else self.values,
            "intervals": self.intervals,
            "wider": self.wider,
            "mean_ratio": math.exp(sum(ratios) / len(ratios)),
            "largest_ratio": math.exp(max(ratios, key=abs)),
            "known": self.known,
            "unknown": self.unknown,
            "ends": self.ends,
            "facts_come": dict(self.come),
            "facts_go": dict(self.go),
            "facts_reworded": self.reworded,
        }


def _width(value, low, high):
    """Logarithm of the upper over the lower end, or to the value from the one that is not open.

    And how many ends are open, to nothing or infinity.
    """
    is_open = (not low > 0) + (not high < math.inf)
    low, high = low if low > 0 else value, high if high < math.inf else value
    return (math.log(high / low) if 0 < low < high < math.inf else 0.0), is_open


def _told(constant, row):
    """A row of the table."""
    return {
        **row,
        "file": constant.file,
        "constant": constant.name,
        "value": constant.value,
        "bounds": constant.bounds,
        "chosen": CHOSEN.get(constant.key, "none found"),
        "guards": GUARDS.get(constant.key, ""),
    }


def changes_in_words(row):
    """What changes with a constant."""
    said = []
    if row["values"]:
        size = f" by up to {100 * row['values']:.2g} %" if math.isfinite(row["values"]) else ""
        said.append(f"values{size}")
    if row["wider"]:
        mean, largest = (f"{row[each]:.3g}" for each in ("mean_ratio", "largest_ratio"))
        said.append(f"{row['wider']} of {row['intervals']} widths × {mean}, one × {largest}")
    for name, words in (
        ("ends", "open or shut"),
        ("known", "more intervals"),
        ("unknown", "fewer intervals"),
    ):
        if row[name]:
            said.append(f"{row[name]} {words}")
    for name, sign in (("facts_come", "+"), ("facts_go", "−")):
        kinds = sorted(row[name])
        listed = [f"{sign} {each.replace('_', ' ')}" for each in kinds[:_NAMED]]
        said += [*listed, *([f"{sign} {len(kinds) - _NAMED} other facts"] * (len(kinds) > _NAMED))]
    if row["facts_reworded"]:
        said.append(f"{row['facts_reworded']} facts tell other numbers")
    if said:
        return "; ".join(said)
    return "nothing" if row["parts"] else "nothing: no case uses it"


def written(rows, maps):
    """Write the table and the page."""
    from page import Page  # here because it loads the package

    page = Page("constants", "intervals_hold.md", "constants")
    (DOCS / "data" / "constants").mkdir(parents=True, exist_ok=True)
    with (DOCS / "data" / "constants" / "numbers.csv").open(
        "w", encoding="utf-8", newline=""
    ) as file:
        table = csv.DictWriter(file, COLUMNS, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        for row in rows:
            lists = {name: "; ".join(sorted(row[name])) for name in ("facts_come", "facts_go")}
            numbers = {name: f"{row[name]:.3g}" for name in ("mean_ratio", "largest_ratio")}
            table.writerow(row | lists | numbers | {"values": f"{row['values']:.2g}"})
    named = f" and of {', '.join(each.name for each in maps)}" if maps else ""
    unknown, needless = (
        sum(row["chosen"].startswith(each) for row in rows) for each in ("none found", "needs none")
    )
    page.say(
        f"{len(rows)} numbers decide how wide intervals are and what is said of them. A run, a "
        f"page or a definition gives {len(rows) - unknown - needless} of them. {needless} move "
        "no number: they limit the time of a search, or say from where words are told. What chose "
        f"the other {unknown} was not found; a run that counts intervals with them is named where "
        "there is one."
    )
    page.say(
        f"Each is doubled alone, and small cases are solved again, of made surfaces{named}. A "
        "share that would pass one is halved, of a number within a tenth of one the difference "
        "from one is doubled. Told are values of answers and of fitted laws; widths (logarithms of "
        "upper over lower ends), as the geometric mean of the ratios of those that change, and the "
        "ratio farthest from one; intervals that come, go, or open to nothing or infinity; and "
        "facts that come (+) and go (−). [All numbers](data/constants/numbers.csv)."
    )
    columns = ("what it bounds", "what chose it", "if it is doubled")
    page.table("constant", "value", *columns, at_most=4)
    for row in rows:
        changes = changes_in_words(row)
        if row["guards"]:
            changes += f". Guards: {row['guards']}"
        how = "" if row["changed"] in ("× 2", "") else f"{row['changed']}: "
        page.row(
            f"{row['file']} {row['constant']}",
            row["value"],
            row["bounds"],
            row["chosen"],
            how + changes,
        )
    page.save()


if __name__ == "__main__":
    main()
