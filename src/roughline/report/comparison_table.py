"""The comparison of both models as a table, and its verdict in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.statistics.verdict import Verdict

if TYPE_CHECKING:
    from roughline.assessment.comparison import ModelComparison


def comparison_table(compared: ModelComparison) -> tuple[list[str], list[list[str]]]:
    """Return header and rows; a star marks loads that the grid decides."""
    result = compared.comparison
    within = f"within {compared.tolerance:.0%}"
    header = ["F / (E* h L)", "k 1D", "k 3D", "k 3D / k 1D - 1", within]
    shows_map = any(entry is not None for entry in compared.from_map)
    rows = []
    for i, difference in enumerate(result.differences()):
        sure = "" if difference.resolved else " *"
        interval = f"{difference.value:+.1%} ({difference.low:+.1%} to {difference.high:+.1%})"
        row = [
            f"{result.force_bar[i]:.3g}",
            f"{result.reduced.mean[i]:.4f}",
            f"{result.full.mean[i]:.4f}",
            interval + sure,
            difference.verdict(compared.tolerance),
        ]
        entry = compared.from_map[i]
        rows.append([*row, str(entry) if entry else "-"] if shows_map else row)
    return ([*header, "the map says"] if shows_map else header), rows


def verdict_in_words(compared: ModelComparison) -> str:
    """Say in a few sentences where the reduced model may be trusted, and for which surfaces."""
    result, share = compared.comparison, f"{compared.tolerance:.0%}"
    window = result.trusted(compared.tolerance)
    verdicts = compared.verdicts
    undecided = verdicts.count(Verdict.UNDECIDED)
    text = f"agreement within {share} is confirmed "
    text += (
        f"from F / (E* h L) = {window[0]:.3g} to {window[1]:.3g}"
        if window
        else "at no load that the grid resolves"
    )
    text += (
        f", refuted at {verdicts.count(Verdict.REFUTED)} and undecided at {undecided} of "
        f"{len(verdicts)} loads"
    )
    if result.surfaces == 1:
        return (
            f"{text}. This verdict is for all surfaces with this spectrum, of which this is one: "
            f"single surfaces scatter by {result.scatter.max():.0%} or less, and the interval "
            "includes that scatter"
        )
    return f"{text}; more surfaces would decide more of them" if undecided else text
