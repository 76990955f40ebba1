"""The page on finite size: every number in it comes from the data."""

from __future__ import annotations

import math

import numpy as np

from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.report.page import Section, render_markdown
from studies.finite_size.crossover import BETWEEN_THEM
from studies.finite_size.findings import BETWEEN, MANY, findings
from studies.finite_size.measures import (
    SEVERAL,
    crossing,
    decades_of_linear_law,
    exponent_in,
    exponents_beside_gamma,
    most_by_size,
    pressures_near_one,
)
from studies.finite_size.samples import (
    BAND,
    HURSTS,
    RESOLVED,
    SIZES,
    WIDE,
    Geometry,
    data,
    plan,
    sample,
    unsolved_loads,
)
from studies.finite_size.tables import crossing_table, grid_table, others_table
from studies.judged import findings_table
from studies.reduced_data import version_of

TITLE = "Where the power law ends, and whether a linear law follows"
FOLDER = "figures/finite_size"
_LEAD_HURST = 0.8


def page() -> str:
    """Return the page as Markdown; its figure lies in a folder beside it."""
    sections = [
        _question(),
        _known(),
        _method(),
        _figure(),
        _inflection(),
        _verdicts(),
        *(_crossings(geometry) for geometry in ("periodic", "free")),
        _wide(),
        _others(),
        _grid(),
        _repeat(),
        _references(),
    ]
    return render_markdown(TITLE, lead(), sections, FOLDER)


def lead() -> str:
    """Return the answer in a few sentences."""
    gammas = [crossing("periodic", BAND, size, hurst).gamma.value for size, hurst in _cases(1)]
    middle = [
        exponent_in(sample("periodic", BAND, size, hurst), BETWEEN).value
        for size, hurst in _cases(MANY)
    ]
    halves = [
        crossing("periodic", BAND, size, _LEAD_HURST).halfway.force.value
        for size in SIZES[BAND]
        if size == 1 or size >= MANY
    ]
    by_hurst = ", ".join(
        f"{_ends(pressures_near_one(BAND, SEVERAL, hurst))} at Hurst {hurst:g}" for hurst in HURSTS
    )
    return (
        "The stiffness of a rough contact is said to follow a power law, k ~ F^(1/(1+H)), while a "
        "single wave of the roll-off length carries the load, and to be proportional to it, "
        "k = p/(γ h), when many do. The end of the power law depends on the force on a single "
        f"wave: at Hurst {_LEAD_HURST:g} the exponent is half way to {BETWEEN_THEM:g} at "
        f"F/(E* h λ_r) = {halves[0]:.2g} on surfaces of one wave and {min(halves[1:]):.2g} to "
        f"{max(halves[1:]):.2g} on those of {MANY} to {max(SIZES[BAND])}, so at ever lower "
        f"mean pressures. Then k ~ F^{min(middle):.2f} to F^{max(middle):.2f}, over more "
        "decades the larger the surface is. A linear law was not found beyond: under heavier "
        "loads the exponent rises on, passes 1 and exceeds it as full contact nears. "
        f"On periodic surfaces it comes within {EXPONENT_TOLERANCE:g} of 1 at p λ_r/(E* h) = "
        f"{_ends(pressures_near_one(BAND, (1,)))} on surfaces of one wave, "
        f"{_ends(pressures_near_one(BAND, (2,)))} on those of two, and on larger ones at a "
        f"pressure that depends on the Hurst exponent and hardly on the size: {by_hurst}. The "
        "largest F/(k h), where the exponent is 1 by construction, is "
        f"γ = {np.nanmin(gammas):.3f} to {np.nanmax(gammas):.3f}."
    )


def _ends(values: list[float]) -> str:
    """Write the smallest and the largest of some values."""
    return f"{min(values):.2f} to {max(values):.2f}"


def _cases(least: int) -> list[tuple[int, float]]:
    """Return the sizes from some number of waves on, with every Hurst exponent."""
    return [(size, hurst) for size in SIZES[BAND] if size >= least for hurst in HURSTS]


def _question() -> Section:
    return Section(
        "What was asked",
        [
            "Is the sub-linear power law of the founding paper a property of rough surfaces, or of "
            "surfaces on which a single roll-off wave fits? Where does it end, does a linear law "
            "follow, and what is γ?",
        ],
    )


def _known() -> Section:
    return Section(
        "What is known",
        notes=[
            "The founding paper, and Pohrt, Popov and Filippov (2012): k ~ F^(1/(1+H)) from "
            "F/(E* h L) = 1e-4 to 0.1, on surfaces without a roll-off.",
            "Persson (2007): k = p/(γ h), from the exponential tail of the mean gap.",
            "Akarapu, Sharp and Robbins (2011), from molecular dynamics and continuum mechanics: "
            "the normal stiffness rises linearly with the load, and collapses on Persson's theory. "
            "Found here: with many waves the exponent is about 0.9 over decades, and near 1 only "
            "towards full contact; over one decade of loads the two differ by a quarter.",
            "Campañá, Persson and Müser (2011): the normal stiffness of simulations agrees with "
            "Persson's theory. Found here: to 20 % at the load of γ, and not a decade below.",
            "Paggi and Barber (2011): the exponent of the conductance, which is that of the "
            "stiffness, depends on the longest wave, and less on the fractal dimension; "
            "interaction between summits changes it. Found here: on one wave it follows the "
            "Hurst exponent, on many it does not.",
            "Pastewka and others (2013): the power law is an effect of finite size, and its end "
            "falls as the system grows; γ is 0.4 to 0.5.",
        ],
    )


def _method() -> Section:
    counts = ", ".join(f"{sample('periodic', BAND, size, 0.5).count}" for size in SIZES[BAND])
    unsolved, loads = unsolved_loads()
    return Section(
        "Method",
        notes=[
            f"Gaussian isotropic surfaces with L/λ_r = {', '.join(map(str, SIZES[BAND]))} roll-off "
            f"waves along a side and waves down to λ_r/{BAND}, four cells for the shortest; Hurst "
            f"exponents {', '.join(f'{hurst:g}' for hurst in HURSTS)}. {counts} surfaces for each; "
            f"further ones have waves down to λ_r/{WIDE}, for up to {max(SIZES[WIDE])} roll-off "
            "waves.",
            "Periodic half-space; free half-space, of whose stiffness that of the interface is "
            "shown, 1/(1/k − 1/k_s); and lines on springs with the same waves (reduced model).",
            "The local exponent is the slope of ln mean k over ln F at three neighbouring loads, "
            "half a decade. The power law ends where this exponent stays more than "
            f"{EXPONENT_TOLERANCE:g} above 1/(1+H), the exponent is half way where it stays "
            f"above the middle of 1/(1+H) and {BETWEEN_THEM:g}, and it is near 1 from where it "
            f"stays less than {EXPONENT_TOLERANCE:g} below 1 on.",
            "γ is the largest F/(k h). At a maximum of F/k the exponent is 1, whether or not k is "
            "proportional to F over any range. If it is found at the heaviest load, γ is larger "
            "than that. Intervals are studentised, from resampled "
            "surfaces; that of a load reaches from the last load at which the interval of the "
            "exponent lies below the threshold to the first from which on all lie above it.",
            f"{loads - unsolved:,} of {loads:,} loads are certified to 1e-6. Loads are used where "
            f"{RESOLVED:.0%} of the surfaces have ten cells in contact.",
        ],
    )


def _figure() -> Section:
    return Section(
        "The cross-over",
        [
            f"![Local exponents, and F/(k h) over the pressure]({FOLDER}/crossover.png)",
            "Above: the local exponent over the force in units of one roll-off wave, in which the "
            "end of the power law collapses; grey: 1/(1+H) and 1. Below: F/(k h) over the mean "
            "pressure, over which surfaces of four waves or more and of one Hurst exponent "
            "agree near the maximum; grey: 0.4 to 0.5. Bands are 95 % intervals of periodic "
            f"surfaces. The wider band is of periodic surfaces with waves down to λ_r/{WIDE}.",
        ],
    )


def _inflection() -> Section:
    sure, perhaps = zip(
        *(
            decades_of_linear_law(sample("periodic", BAND, size, hurst))
            for size, hurst in _cases(1)
        ),
        strict=True,
    )
    before, after = zip(*exponents_beside_gamma(), strict=True)
    return Section(
        "An inflection, no law",
        [
            "k rises more slowly than F where the exponent is below 1, and faster where it is "
            "above. Between "
            f"two loads half a decade apart, with that of γ between them, the exponent of periodic "
            f"surfaces rises from {min(before):.2f} to {max(before):.2f} on the lighter one to "
            f"{min(after):.2f} to {max(after):.2f} on the heavier one, in the {len(after)} cases "
            f"in which the loads go on that far. At 95 % each it is surely 1 within "
            f"{EXPONENT_TOLERANCE:g} over {min(sure):.2g} to {max(sure):.2g} decades of the load, "
            f"and perhaps over {max(perhaps):.2g} at most. So k = p/(γ h) touches the curve at one "
            "load, and is near it around that load; it is no law that holds from some load on.",
            "In units of E* h/λ_r the pressure from which on the exponent is near 1 is higher on "
            f"surfaces of one wave ({_ends(pressures_near_one(BAND, (1,)))}) and of two "
            f"({_ends(pressures_near_one(BAND, (2,)))}). From {min(SEVERAL)} waves on it changes "
            f"by {most_by_size():.0%} at most from size to size, and from "
            f"{_ends(pressures_near_one(BAND, SEVERAL, max(HURSTS)))} at Hurst {max(HURSTS):g} to "
            f"{_ends(pressures_near_one(BAND, SEVERAL, min(HURSTS)))} at Hurst {min(HURSTS):g}. "
            "That is no scatter: the smaller the Hurst exponent, the higher the pressure.",
        ],
    )


def _verdicts() -> Section:
    return Section(
        "Verdicts",
        [
            "Confirmed: the whole interval lies within the tolerance in every case. Refuted: it "
            "lies outside in some. Undecided: otherwise; how many surfaces would decide is "
            "estimated from the scatter, for an unchanged mean. The intervals hold at 95 % for all "
            "cases of a row together; those of the tables below hold at 95 % each.",
        ],
        tables=[findings_table(findings())],
    )


def _crossings(geometry: Geometry) -> Section:
    names = {"periodic": "Periodic surfaces", "free": "Free surfaces, the interface alone"}
    return Section(
        names[geometry],
        [
            f"The end of the power law, the load half way to exponent {BETWEEN_THEM:g} over "
            f"E* h λ_r and over E* h L, the exponent from F/(E* h λ_r) = {BETWEEN[0]:g} to "
            f"{BETWEEN[1]:g}, the load from which on the exponent is near 1, γ and the pressure "
            "where it is found. A dash: not within the loads. At Hurst 0.2 the exponents of the "
            "two ranges are so close to each other that the end is poorly determined.",
        ],
        tables=[crossing_table(geometry, BAND)],
    )


def _wide() -> Section:
    shifts = [
        wide / crossing("periodic", BAND, size, hurst).reaches.force.value - 1
        for size in SIZES[WIDE]
        for hurst in HURSTS
        if not math.isnan(wide := crossing("periodic", WIDE, size, hurst).reaches.force.value)
    ]
    return Section(
        "Four times as wide a band of waves",
        [
            f"The same with waves down to λ_r/{WIDE}, periodic: lighter loads are resolved. The "
            "pressures from which on the exponent is near 1 are "
            f"{_ends(pressures_near_one(WIDE, SIZES[WIDE]))}, and differ from those of the "
            f"narrower band by {min(shifts):+.0%} to {max(shifts):+.0%}.",
        ],
        tables=[crossing_table("periodic", WIDE)],
    )


def _others() -> Section:
    return Section(
        "Persson's theory and the reduced model",
        [
            "The stiffness of periodic surfaces over that of Persson's theory, under the load of γ "
            "and one and two decades lighter ones; and that of lines on springs over that of free "
            "surfaces as they are pressed, less 1. A line saturates at E* L, and has no linear "
            "law.",
        ],
        tables=[others_table()],
    )


def _grid() -> Section:
    return Section(
        "The grid",
        [
            "How much higher the stiffness is with eight cells for the shortest wave than with "
            "four, of the same periodic surfaces; γ is lower by as much as k is higher.",
        ],
        tables=[grid_table()],
    )


def _repeat() -> Section:
    return Section(
        "Data, and how to repeat",
        [
            "The plan, the reduction and the data lie in `studies/finite_size`: stiffnesses and "
            "statuses of every body and load as NetCDF, in single precision. Body i has the seed "
            f"`SeedSequence({plan().ensembles[0].seed}, spawn_key=(i,))`. `make finite-size` "
            "computes everything again and goes on where it stopped. The data were computed with "
            f"roughline {version_of(data().values())}.",
        ],
    )


def _references() -> Section:
    return Section(
        "References",
        notes=[
            "R. Pohrt, V. L. Popov and A. E. Filippov, Normal contact stiffness of elastic solids "
            "with fractal rough surfaces for one- and three-dimensional systems, Phys. Rev. E 86, "
            "026710 (2012).",
            "B. N. J. Persson, Relation between interfacial separation and load: a general theory "
            "of contact mechanics, Phys. Rev. Lett. 99, 125502 (2007).",
            "S. Akarapu, T. Sharp and M. O. Robbins, Stiffness of contacts between rough surfaces, "
            "Phys. Rev. Lett. 106, 204301 (2011).",
            "C. Campañá, B. N. J. Persson and M. H. Müser, Transverse and normal interfacial "
            "stiffness of solids with randomly rough surfaces, J. Phys.: Condens. Matter 23, "
            "085001 (2011).",
            "M. Paggi and J. R. Barber, Contact conductance of rough surfaces composed of modified "
            "RMD patches, Int. J. Heat Mass Transfer 54, 4664-4672 (2011).",
            "L. Pastewka, N. Prodanov, B. Lorenz, M. H. Müser, M. O. Robbins and B. N. J. Persson, "
            "Finite-size scaling in the interfacial stiffness of rough elastic contacts, Phys. "
            "Rev. E 87, 062809 (2013).",
        ],
    )
