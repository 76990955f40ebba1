"""Figure 5's published exponents, the area law, and the claims."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from roughline.lab.frames import frame
from roughline.lab.published import controls as c
from roughline.lab.published.ensembles import one_dimension, table_of, usable_state
from roughline.lab.server.tasks import Arguments, Progress
from roughline.paper.claims import claims_section, judge_claims
from roughline.paper.contact_area import AreaLaw, area_law, mean_area
from roughline.paper.results import published_dataset, published_results
from roughline.paper.studies import study_summaries
from roughline.paper.tables import estimate_cell
from roughline.paper.windows import WINDOW_AREA
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import Verdict
from roughline.theories import bush_gibson_thomas, persson


def exponents(arguments: Arguments, progress: Progress) -> bytes:
    """The published exponents of the reduced model in three windows, and the two predictions."""
    data = published_dataset("exponents")
    windows = [data.isel(window=i) for i in range(data.sizes["window"])]
    fine = np.linspace(2, 3, 101)
    labels = [f"F̄ = {float(one.window_low):g} to {float(one.window_high):g}" for one in windows]
    return frame(
        {
            "windows": [
                {
                    "label": label,
                    "D_f": one.fractal_dimension.values,
                    **{name: one[name].values for name in ("exponent", "low", "high")},
                }
                for label, one in zip(labels, windows, strict=True)
            ],
            "D_f": fine,
            "scaling": scaling_exponent(fine),
            "linear": linear_exponent(fine),
        }
    )


def area(arguments: Arguments, progress: Progress) -> bytes:
    """The real area over force, and κ of eq. 4 with its intervals and two theories."""
    state, settled = usable_state(arguments)
    curves = [_area_curve(dimension) for dimension in state.dimensions]
    kappas = [_kappas(dimension) for dimension in c.DIMENSIONS]
    header = ["D_f", "κ", "A ~ F^", "κ in cells", "A in cells ~ F^"]
    rows = [
        [
            f"{dimension:.1f}",
            *(estimate_cell(each) for law in laws for each in (law.kappa, law.exponent)),
        ]
        for dimension, laws in zip(c.DIMENSIONS, kappas, strict=True)
    ]
    named = dict(zip(("corrected", "cells"), zip(*kappas, strict=True), strict=True))
    return frame(
        {
            **settled,
            "curves": curves,
            "window": WINDOW_AREA,
            "kappas": {name: _kappa_columns(laws) for name, laws in named.items()},
            "theories": [
                {"name": name, "kappa": kappa, "label": f"{name} {kappa:.2f}"}
                for name, kappa in (
                    ("Bush, Gibson, Thomas", bush_gibson_thomas.KAPPA),
                    ("Persson", persson.KAPPA),
                )
            ],
            "header": header,
            "rows": rows,
            "area_table": table_of("A/A_0", curves),
        }
    )


def claims(arguments: Arguments, progress: Progress) -> bytes:
    """The table of the paper's claims, with the verdict on each as a whole."""
    judged = judge_claims(published_results())
    section = claims_section(judged)
    table = section.tables[0]
    verdicts = [str(claim.verdict) for claim in judged]
    return frame(
        {
            "header": table.header,
            "rows": table.rows,
            "verdicts": verdicts,
            "counts": {str(each): verdicts.count(each) for each in Verdict},
            "note": section.note,
        }
    )


def studies(arguments: Arguments, progress: Progress) -> bytes:
    """The panels of the studies beside the paper's with their data, in the order of the page."""
    panels = [asdict(panel) for study in study_summaries() for panel in study.panels]
    return frame({"panels": panels})


def _kappas(dimension: float) -> tuple[AreaLaw, AreaLaw]:
    """The law of the corrected area, and of that in cells."""
    one = one_dimension("3D", dimension)
    return area_law(one, "area_fraction_corrected"), area_law(one, "area_fraction")


def _kappa_columns(laws: tuple[AreaLaw, ...]) -> dict[str, list[float]]:
    return {
        "x": list(c.DIMENSIONS),
        "y": [law.kappa.value for law in laws],
        "low": [law.kappa.low for law in laws],
        "high": [law.kappa.high for law in laws],
    }


def _area_curve(dimension: float) -> dict[str, Any]:
    one = one_dimension("3D", dimension)
    mean, resolved = mean_area(one)
    return {
        "index": c.DIMENSIONS.index(dimension),
        "D_f": f"{dimension:.1f}",
        "force_bar": one.force_bar.values,
        "mean": mean,
        "resolved": resolved,
    }
