"""The study in short, for the lab."""

from __future__ import annotations

from roughline.paper.studies import StudyCurve, StudyPanel, StudySummary
from studies.finite_size.crossover import local_exponents, scaling_exponent_of
from studies.finite_size.findings import GAMMAS, findings
from studies.finite_size.measures import crossing
from studies.finite_size.page import TITLE, lead
from studies.finite_size.samples import BAND, SIZES, sample
from studies.judged import findings_table

_HURST = 0.8
_FORCES, _PRESSURES = (0.02, 700.0), (3e-5, 10.0)


def summary() -> StudySummary:
    """Return what the lab shows of the study: periodic surfaces of Hurst exponent 0.8."""
    table = findings_table(findings())
    return StudySummary(
        "finite_size", TITLE, lead(), table.header, table.rows, [_exponents(), _gammas()]
    )


def _exponents() -> StudyPanel:
    curves = []
    for i, size in enumerate(SIZES[BAND]):
        one = sample("periodic", BAND, size, _HURST)
        top = crossing("periodic", BAND, size, _HURST).gamma_force
        local = local_exponents(one.force, one.stiffness).up_to(top)
        x, y, low, high = (
            each.tolist() for each in (local.force, local.value, local.low, local.high)
        )
        curves.append(StudyCurve(f"L/λ_r = {size}", x, y, low, high, i))
    law = scaling_exponent_of(_HURST)
    curves.append(StudyCurve("1/(1+H)", _FORCES, (law, law), dash="dashed"))
    curves.append(StudyCurve("1", _FORCES, (1.0, 1.0), dash="dotted"))
    return StudyPanel(
        f"Local exponent over the force, Hurst {_HURST:g}",
        "force F / (E* h λ_r)",
        "d ln k / d ln F",
        _FORCES,
        (0.4, 1.2),
        curves,
    )


def _gammas() -> StudyPanel:
    curves = []
    for i, size in enumerate(SIZES[BAND]):
        one = sample("periodic", BAND, size, _HURST)
        x, y = one.pressure.tolist(), one.gamma.tolist()
        curves.append(StudyCurve(f"L/λ_r = {size}", x, y, colour=i))
    for value, dash in zip(GAMMAS, ("dashed", "dotted"), strict=True):
        curves.append(StudyCurve(f"{value:g}", _PRESSURES, (value, value), dash=dash))
    return StudyPanel(
        f"F / (k h) over the pressure, Hurst {_HURST:g}",
        "pressure p λ_r / (E* h)",
        "F / (k h)",
        _PRESSURES,
        (0.0, 0.6),
        curves,
    )
