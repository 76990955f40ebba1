"""The study in short, for the lab."""

from __future__ import annotations

from roughline.paper.studies import StudyCurve, StudyPanel, StudySummary
from roughline.theories import bush_gibson_thomas, persson
from studies.area.figures import over_loads
from studies.area.findings import MIDDLE, common_law
from studies.area.kappa import BANDS, HURSTS, kappa, sample
from studies.area.page import TITLE, lead, verdict_table

_LABEL = "κ = A E* ∇h / F"
_AREAS, _NAYAKS, _KAPPAS = (4e-3, 0.2), (2.8, 200.0), (1.5, 2.7)


def summary() -> StudySummary:
    """Return what the lab shows of the study."""
    table = verdict_table()
    return StudySummary(
        "area", TITLE, lead(), table.header, table.rows, [_over_area(), _over_nayak()]
    )


def _over_area() -> StudyPanel:
    curves = []
    for i, band in enumerate(BANDS):
        area, mean, low, high = (each.tolist() for each in over_loads(sample("main", band, 0.8)))
        curves.append(StudyCurve(f"q_high/q_roll = {band}", area, mean, low, high, i))
    return StudyPanel(
        "κ over the area in contact, Hurst 0.8",
        "real contact area A / A_0",
        _LABEL,
        _AREAS,
        _KAPPAS,
        [*curves, *_theories(_AREAS)],
    )


def _over_nayak() -> StudyPanel:
    law = common_law(MIDDLE)
    curves = [StudyCurve("one law for all", _NAYAKS, [law(each) for each in _NAYAKS], dash="solid")]
    for i, hurst in enumerate(HURSTS):
        of_bands = [sample("main", band, hurst) for band in BANDS]
        found = [kappa(one, MIDDLE) for one in of_bands]
        curves.append(
            StudyCurve(
                f"Hurst {hurst:g}",
                [one.nayak for one in of_bands],
                [each.value for each in found],
                [each.low for each in found],
                [each.high for each in found],
                2 * i,
                marks=True,
            )
        )
    return StudyPanel(
        f"κ at {MIDDLE:.0%} in contact over Nayak's parameter",
        "Nayak's parameter α = m_0 m_4 / m_2²",
        _LABEL,
        _NAYAKS,
        _KAPPAS,
        [*curves, *_theories(_NAYAKS)],
    )


def _theories(ends: tuple[float, float]) -> list[StudyCurve]:
    return [
        StudyCurve(f"{name} {value:.3f}", ends, (value, value), dash=dash)
        for name, value, dash in (
            ("Bush, Gibson, Thomas", bush_gibson_thomas.KAPPA, "dashed"),
            ("Persson", persson.KAPPA, "dotted"),
        )
    ]
