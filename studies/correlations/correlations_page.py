"""The page on the handbooks' correlations: every number in it comes from the data."""

from __future__ import annotations

from roughline.report.page import Section, render_markdown
from studies.correlations.conductance import (
    BANDS,
    BOXES,
    DIMENSIONS,
    ELASTIC,
    FULL,
    PRESSURES,
    WINDOW,
    plan,
    version,
)
from studies.correlations.correlation_claims import EXPONENT_TOLERANCE, MIXED, claims, claims_table
from studies.correlations.correlation_dependences import dependences
from studies.correlations.correlation_tables import (
    area_table,
    between_table,
    ensembles_table,
    handbook_table,
    root_sum_table,
    scatter_table,
)
from studies.correlations.findings import (
    MIDDLE,
    change_with_band,
    common_law,
    core_seconds,
    extremes,
    failed_loads,
    heights,
    over_bearing_area,
    over_root_sum,
    slope_spread,
    spots_of_the_correlation,
)
from studies.correlations.judgement import LEVEL

TITLE = "The handbooks' conductance of joints, put to the test"
FOLDER = "figures/correlations"
BETWEEN = 0.3
"""Hardness at which elastic and plastic deformation both count."""
_FROM_TO = f"{WINDOW[0]:g} to {WINDOW[1]:g}"


def page() -> str:
    """Return the page as Markdown; its figures lie in a folder beside it."""
    sections = [
        _claims_section(),
        _elastic_section(),
        _plastic_section(),
        _between_section(),
        _area_section(),
        _scatter_section(),
        *dependences(),
        _methods_section(),
        _references_section(),
    ]
    return render_markdown(TITLE, _lead(), sections, FOLDER)


def _lead() -> str:
    elastic, plastic = (extremes(lambda one: one.ratio, (each,)) for each in (ELASTIC, FULL))
    band = change_with_band(FULL, MIDDLE, min(BANDS), max(BANDS))
    return (
        "Handbooks give the conductance of a joint by a correlation: Mikic's for elastic contact, "
        "Cooper, Mikic and Yovanovich's (CMY) for plastic contact, Holm's for a single spot. Here "
        "they are compared with contact computed with every interaction, on Gaussian isotropic "
        f"surfaces with a hardness, at pressures from {_FROM_TO} of E*∇h or of H. Elastic surfaces "
        f"conduct {_spread(elastic)} of what Mikic's correlation says, and fully plastic ones "
        f"{_spread(plastic)} of what CMY's says, where the roll-off waves are {_main_band()} "
        f"times as long as the shortest. From {min(BANDS)} to {max(BANDS)} times, the ratio to "
        f"CMY's changes by {band.value:+.0%}. Paggi and Barber (2011) computed the conductance "
        "of elastic surfaces with interaction, and found that its exponent depends on the longest "
        "waves and on the interaction; here σ and m are the handbooks', many of the longest waves "
        "lie along a side, and bodies yield too. To our knowledge the plastic correlation had "
        "not been tested in this way."
    )


def _claims_section() -> Section:
    return Section(
        "Verdicts",
        [
            "A statement is confirmed where the whole interval lies within the tolerance, refuted "
            "where it lies outside at some pressure, and undecided otherwise. The intervals hold "
            f"at {LEVEL:.0%} for all pressures together, and are widened to one side by twice the "
            "difference of two grids, which is the error if it halves with the spacing. "
            f"Exponents are judged to ±{EXPONENT_TOLERANCE:g}. How many surfaces would decide is "
            "estimated from the scatter, for an unchanged mean.",
        ],
        tables=[claims_table(claims())],
    )


def _elastic_section() -> Section:
    law = common_law(ELASTIC)
    return Section(
        "Elastic surfaces and Mikic",
        [
            f"![The conductance over the pressure]({FOLDER}/conductance.png)",
            "Dimensionless conductance h_c σ/(κ_s m) over the pressure, with the handbooks' lines. "
            "σ is the rms height, m = ∇h/√π the mean absolute slope of a cut, κ_s the harmonic "
            "mean of the conductivities. Means of the surfaces.",
            "Conductance over Mikic's, and the power law c (√2 p/(E* m))^a that fits best from "
            f"{_FROM_TO}; 95 % intervals, at each pressure alone.",
            f"One law for all three Hurst exponents, {law.prefactor:.2f} (√2 p/(E* m))^"
            f"{law.exponent:.3f}, is within {law.deviation:.0%} of every mean from {_FROM_TO}. "
            "The data bend: at the highest pressures, where gaps close, conductance rises faster.",
        ],
        tables=[handbook_table(ELASTIC)],
    )


def _plastic_section() -> Section:
    def spots(pressure: float) -> str:
        counts = [spots_of_the_correlation(dimension, pressure) for dimension in DIMENSIONS]
        return f"{min(counts):.1f} to {max(counts):.1f}"

    law = common_law(FULL)
    return Section(
        "Fully plastic surfaces and Cooper, Mikic and Yovanovich",
        [
            f"![Ratios to the handbooks]({FOLDER}/ratios.png)",
            "Left: elastic surfaces over Mikic's correlation. Middle: surfaces with a hardness "
            "over CMY's. Right: both over the band of waves. 95 % intervals; grey: ±10 and ±20 %.",
            f"Conductance over CMY's at H/(E*∇h) = {FULL:g}, where "
            f"{_plastic_share(FULL):.0%} or more of the contact is at the hardness, and the power "
            f"law c (p/H)^a that fits best from {_FROM_TO}.",
            f"One law for all three Hurst exponents, {law.prefactor:.2f} (p/H)^{law.exponent:.3f}, "
            f"is within {law.deviation:.0%} of every mean from {_FROM_TO}. It holds for this band "
            "of waves only ([below](#how-wide-the-band-of-waves-is)).",
            f"At p/H = {PRESSURES[0]:g} there are few spots: the correlation's own area and "
            f"conductance are those of {spots(PRESSURES[0])} equal round ones, and those of "
            f"{spots(WINDOW[0])} at {WINDOW[0]:g}, where the verdicts begin.",
        ],
        tables=[handbook_table(FULL)],
    )


def _between_section() -> Section:
    least, most = extremes(over_root_sum, MIXED)
    over_cmy, over_mikic = (
        extremes(ratio, (BETWEEN,))
        for ratio in (lambda one: one.over_yovanovich, lambda one: one.over_mikic)
    )
    return Section(
        "From weak to full plasticity",
        [
            "The conductance under the same p/H over both correlations, with the mean contact "
            "pressure p_c over H that the elastic body would have at p/(E*∇h) = 0.01, and the "
            "share of the contact that is at the hardness, at p/H = 0.01.",
            "In its own limit each correlation overestimates the conductance. Between the limits, "
            f"at H/(E*∇h) = {BETWEEN:g}, both underestimate it: surfaces conduct "
            f"{_spread(over_cmy)} of what CMY's says and {_spread(over_mikic)} of what Mikic's "
            f"says, from {_FROM_TO}.",
            "The second table compares the data with a rule that was found here and has no "
            "derivation: h_c² = h_e² + h_p², with h_e of the elastic body under the same load and "
            f"h_p of the fully plastic one under the same p/H. Conductance over that is "
            f"{least:.2f} to {most:.2f} in the mean from {_FROM_TO}.",
        ],
        tables=[between_table(), root_sum_table()],
    )


def _area_section() -> Section:
    least, most = extremes(over_bearing_area, (FULL,))
    return Section(
        "The plastic limit: area, and Holm's spot",
        [
            f"In the plastic limit the real area is p/H times the nominal one: {least:.3f} to "
            f"{most:.3f} times that from {_FROM_TO} at H/(E*∇h) = {FULL:g}. The area is "
            "never smaller, as no point bears more than H. So the correlation's area is right, and "
            "its error is in how well that area conducts.",
            "Holm's formula puts all load on one round spot. Separate spots conduct better, the "
            "more so the larger the nominal area is: the numbers are for a nominal area with "
            f"{_main_waves()} roll-off waves along its side. Hurst {3 - MIDDLE:.1f}.",
        ],
        tables=[area_table()],
    )


def _scatter_section() -> Section:
    return Section(
        "How far a single surface is off",
        [
            "Standard deviation of single surfaces over the mean, of nominal areas with "
            f"{_main_waves()} roll-off waves along a side. A correlation does not describe it.",
        ],
        tables=[scatter_table()],
    )


def _methods_section() -> Section:
    found, (failed, loads) = heights(), failed_loads()
    bearing = ", ".join(f"{share:.4g} ± {error:.1g}" for _, share, error in found.bearing)
    gaussian = ", ".join(f"{share:g}" for share, _, _ in found.bearing)
    seed = plan().ensembles[0].seed
    unsolved = "All loads were solved" if not failed else f"{failed} loads were not solved"
    return Section(
        "What was computed, and how",
        [
            "Elastic, perfectly plastic contact: pressures from 0 to H, overlap at H becomes a "
            "permanent indentation ([the model](science.md)). Displaced material vanishes: "
            "there is no pile-up, and H is the same everywhere and at every depth. Barber's "
            "identity gives the conductance from the stiffness on unloading of a periodic surface, "
            "h_c = κ_s k_u/(E* A_0), exactly. H is given over E* times each surface's own rms "
            "slope, from differences on its grid, and the same slope is used in m. Slopes of "
            f"surfaces of one ensemble differ by {slope_spread():.0e}. Means over the surfaces at "
            "fixed pressure, read between the loads.",
            "Moduli of the waves are fixed and their phases random; the many waves make the "
            f"heights Gaussian: skewness {found.skewness[0]:+.3f} (standard deviation "
            f"{found.skewness[1]:.3f}), excess kurtosis {found.excess_kurtosis[0]:+.3f} "
            f'({found.excess_kurtosis[1]:.3f}) in the ensembles "main". Above the '
            f"heights that {gaussian} of a Gaussian surface exceed lie {bearing} (standard errors) "
            "of their area.",
            f"{unsolved} of {loads}, each certified below 1e-6; means leave out the others.",
        ],
        tables=[ensembles_table()],
        note=(
            f"To repeat: `make correlations` (these data: version {version()}), about "
            f"{core_seconds() / 60:.0f} min on one core, during other work; it can be interrupted, "
            f"and goes on. Surface i has the seed SeedSequence({seed}, spawn_key=(i,))."
        ),
    )


def _references_section() -> Section:
    return Section(
        "References",
        notes=[
            "B. B. Mikic, Int. J. Heat Mass Transfer 17, 205 (1974).",
            "M. G. Cooper, B. B. Mikic, M. M. Yovanovich, Int. J. Heat Mass Transfer 12, 279 "
            "(1969); M. M. Yovanovich, IEEE Trans. Compon. Packag. Technol. 28, 182 (2005).",
            "R. Holm, *Electric Contacts*, 4th ed. (1967).",
            "J. R. Barber, Proc. R. Soc. A 459, 53 (2003).",
            "M. Paggi and J. R. Barber, Contact conductance of rough surfaces composed of modified "
            "RMD patches, Int. J. Heat Mass Transfer 54, 4664 (2011).",
            "A. Almqvist, F. Sahlin, R. Larsson, S. Glavatskih, Tribol. Int. 40, 574 (2007).",
        ],
    )


def _spread(ends: tuple[float, float]) -> str:
    return f"{ends[0]:.0%} to {ends[1]:.0%}"


def _main_band() -> int:
    return next(width for width, prefix in BANDS.items() if prefix == "main")


def _main_waves() -> int:
    return next(waves for waves, prefix in BOXES.items() if prefix == "main")


def _plastic_share(hardness: float) -> float:
    """Return the smallest mean share of the contact at the hardness in the window."""
    return extremes(lambda one: one.plastic, (hardness,))[0]
