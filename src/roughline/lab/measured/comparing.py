"""Both models of the surface in a file, and where the reduced one may be trusted."""

from __future__ import annotations

from roughline.assessment.comparison import compare_models
from roughline.errors.words import speaking
from roughline.lab.frames import frame
from roughline.lab.measured.kept import kept
from roughline.lab.measured.state import CONTROLS, at, reading_of, said_of, source_of
from roughline.lab.server.tasks import Arguments, Progress
from roughline.report.comparison import comparison_table, verdict_in_words


@speaking(CONTROLS)
def compare(arguments: Arguments, progress: Progress) -> bytes:
    """Compare the models on the surface as the file has it, without its tilt."""
    said = said_of(arguments)
    source = source_of(said, arguments["session"])
    reading = reading_of(said, source.name)
    with at("compare"):
        found = kept(
            arguments["session"],
            "comparison",
            (source.key, reading),
            lambda: compare_models(source.path, reading=reading, progress=progress),
        )
    result = found.comparison
    header, rows = comparison_table(found)
    star = "" if result.resolved.all() else "* fewer than ten cells in contact: the grid decides"
    return frame(
        {
            "what": found.what,
            "verdict": verdict_in_words(found),
            "verdicts": [str(each) for each in found.verdicts],
            "table": [header, rows],
            "star": star,
            "notes": list(result.warnings),
            "force_bar": result.force_bar,
            "full": result.full.mean,
            "reduced": {
                "mean": result.reduced.mean,
                "low": result.reduced.low,
                "high": result.reduced.high,
            },
        }
    )
