"""What a campaign did, on the terminal and as JSON."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console

from roughline.report.terminal import print_table

if TYPE_CHECKING:
    from roughline.campaign.dispatch import Summary
    from roughline.campaign.store import Store


def print_summary(summary: Summary, store: Path) -> None:
    """Print what a campaign did, equal reasons of failures together."""
    console = Console(markup=False)
    done, failed = sum(summary.done.values()), sum(summary.failed.values())
    console.print(f"{done} cases computed, {failed} failed; results in {store}", soft_wrap=True)
    if summary.unconverged:
        console.print(f"{summary.unconverged} loads did not converge: they are NaN")
    for reason, count in summary.reasons.most_common():
        console.print(f"{count} failed: {reason}", highlight=False, soft_wrap=True)


def print_status(store: Store) -> None:
    """Print what is done of a campaign, and why cases failed."""
    console = Console(markup=False)
    rows = [[name, *map(str, store.counts(name))] for name in store.names]
    print_table(console, ["ensemble", "done", "failed", "in all"], rows)
    reasons = Counter(why for name in store.names for why in store.failures(name).values())
    for reason, count in reasons.most_common():
        console.print(f"{count} failed: {reason}", highlight=False, soft_wrap=True)


def of_summary(summary: Summary, store: Path) -> dict[str, Any]:
    """What a run of a campaign did."""
    return {
        "store": store,
        "done": summary.done,
        "failed": summary.failed,
        "core_seconds": summary.core_seconds,
        "reasons": summary.reasons,
        "unconverged": summary.unconverged,
    }


def of_status(store: Store) -> dict[str, Any]:
    """What is done of a campaign."""
    names = ("done", "failed", "cases")
    return {
        "store": store.path,
        "ensembles": {
            name: dict(zip(names, store.counts(name), strict=True))
            | {"failures": store.failures(name)}
            for name in store.names
        },
    }
