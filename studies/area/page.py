"""The page on the contact area: every number in it comes from the data."""

from __future__ import annotations

from roughline.report.page import Section, Table, render_markdown
from roughline.statistics.bootstrap import IntervalEstimate
from studies.area.findings import (
    LIGHT,
    MIDDLE,
    common_law,
    findings,
    grid_error,
    main_samples,
    over_law,
)
from studies.area.kappa import (
    AREAS,
    BANDS,
    FINE_BANDS,
    HURSTS,
    LARGE_BANDS,
    Sample,
    data,
    grid_shift,
    kappa,
    kappa_in_cells,
    sample,
    size_shift,
    unsolved_loads,
)
from studies.area.rings import COUNT, POINTS, SHORT_WAVES, rings, version
from studies.judged import findings_table
from studies.reduced_data import version_of

TITLE = "How large is the real contact area?"
FOLDER = "figures/area"
_NAYAKS = (3, 10, 30, 100)


def page() -> str:
    """Return the page as Markdown; its figure lies in a folder beside it."""
    sections = [
        _question(),
        _known(),
        _method(),
        _verdicts(),
        _kappas(),
        _law(),
        _other_spectra(),
        _grid(),
        _size(),
        _repeat(),
        _references(),
    ]
    return render_markdown(TITLE, lead(), sections, FOLDER)


def lead() -> str:
    """Return the answer in a few sentences."""
    law, light = common_law(MIDDLE), [kappa(one, LIGHT).value for one in main_samples()]
    others = [over_law(one).value for one in rings()]
    line = f"{law.at_ten.value:.3f} − {-law.per_decade.value:.3f} log10(α/10)"
    return (
        "The real contact area of rough elastic surfaces is nearly proportional to the force, A = "
        "κ F / (E* ∇h). Theories give κ = 2.507 and 1.596. Here it is computed with every "
        "interaction on surfaces whose shortest waves are resolved, so that κ depends on the "
        f"surface and not on the grid: {min(light):.2f} to {max(light):.2f} at {LIGHT:.1%} in "
        "contact, less under heavier loads. Among self-affine spectra it depends on Nayak's "
        f"parameter α alone: at {MIDDLE:.0%} in contact it is {line}, to "
        f"{law.deviation:.1%}, for Hurst exponents from {min(HURSTS):g} to {max(HURSTS):g}. "
        f"Spectra of two narrow rings of waves lie {min(others):.1%} to {max(others):.1%} above "
        "this line: α says most of what matters, and not all. On "
        f"infinitely fine grids κ would be up to {grid_error(MIDDLE):.1%} higher."
    )


def _question() -> Section:
    return Section(
        "What was asked",
        [
            "Is κ of A = κ F / (E* ∇h) one number for all surfaces, and which? ∇h is the rms "
            "slope. The founding paper quotes the law as its eq. 4. On grids that cut the spectrum "
            "at their own end κ depends on the grid: the shortest waves are not resolved, and "
            "the area in cells grows with the outline of the contact.",
        ],
    )


def _known() -> Section:
    return Section(
        "What is known",
        notes=[
            "Bush, Gibson and Thomas (1975), from summits that do not interact: κ = √(2π) = 2.507 "
            "at light loads.",
            "Persson (2001), from the diffusion of pressure over scales: κ = √(8/π) = 1.596.",
            "Yastrebov, Anciaux and Molinari (2017), from a spectral solver: between the two, and "
            "falling with Nayak's parameter α = m_0 m_4 / m_2², about logarithmically.",
            "Hyun, Pei, Molinari and Robbins (2004), from finite elements: A is linear in F at "
            "small loads, and κ lies between the two theories, nearly the same for all Hurst "
            "exponents. Found here: κ falls with α, on which the Hurst exponent acts through the "
            "band of waves.",
            "Prodanov, Dapp and Müser (2014), with corrections for the grid, the band and the "
            "size: the area depends on p/(E* ∇h), and barely on the Hurst exponent, even under "
            "heavy loads. Found here too, apart from the change of κ with α.",
        ],
    )


def _method() -> Section:
    main = [sample("main", band, HURSTS[0]) for band in BANDS]
    counts = ", ".join(f"{one.count}" for one in main)
    unsolved, loads = unsolved_loads()
    return Section(
        "Method",
        notes=[
            "Gaussian isotropic surfaces, flat below q_roll, self-affine from there to q_high = "
            f"{', '.join(map(str, BANDS))} q_roll; Hurst exponents "
            f"{', '.join(f'{hurst:g}' for hurst in HURSTS)}; four roll-off waves along a side; "
            "periodic.",
            "Eight cells for the shortest wave: grids of 128² to 2048² points. "
            f"{counts} surfaces for each Hurst exponent.",
            "∇h is the slope of the spectrum, not of differences on the grid. The area is "
            "corrected for the steps of its outline.",
            "The mean area at nine loads; between two loads ln F is linear in ln A. Intervals are "
            "studentised, from resampled surfaces.",
            f"Every load is certified to 1e-6: {loads - unsolved:,} of {loads:,} were solved"
            + (", the others are left out." if unsolved else "."),
        ],
    )


def verdict_table() -> Table:
    """Return the statements with their verdicts."""
    return findings_table(findings())


def _verdicts() -> Section:
    return Section(
        "Verdicts",
        [
            "Confirmed: the whole interval lies within the tolerance for every spectrum. Refuted: "
            "it lies outside for some. Undecided: otherwise; how many surfaces of each spectrum "
            "would decide is estimated from the scatter, for an unchanged mean. The intervals hold "
            "at 95 % for all spectra of a row together; those of light loads are widened to one "
            "side by the grid's error.",
        ],
        note=f"The lightest loads are those at {LIGHT:.1%} in contact. κ still rises towards "
        "lighter ones, so the limit of vanishing load, to which Bush, Gibson and Thomas's number "
        "refers, is not judged.",
        tables=[verdict_table()],
    )


def _kappas() -> Section:
    header = ("Hurst", "q_high/q_roll", "α", *(f"{level:.1%}" for level in AREAS), "in cells")
    rows = [
        (
            f"{one.hurst:g}",
            f"{one.band}",
            f"{one.nayak:.1f}",
            *(_cell(kappa(one, level)) if _has(one, level) else "-" for level in AREAS),
            f"{kappa_in_cells(one, MIDDLE):.2f}",
        )
        for one in main_samples()
    ]
    return Section(
        "κ over the area and the spectrum",
        [
            f"![κ over the area and over Nayak's parameter]({FOLDER}/kappa.png)",
            "Left: κ over the area in contact, with 95 % intervals at Hurst 0.8. Right: κ at three "
            "areas over Nayak's parameter, with the common lines of all Hurst exponents.",
            f"κ where that share of the area is in contact. The last column is κ at {MIDDLE:.0%} "
            "with the area counted in cells, which depends on the grid.",
        ],
        tables=[Table(header, rows, range(len(header)))],
    )


def _law() -> Section:
    laws = [common_law(level) for level in AREAS[1:]]
    nayaks = (f"α = {each}" for each in _NAYAKS)
    header = ("in contact", "κ at α = 10", "for ten times α", "largest deviation", *nayaks)
    rows = [
        (
            f"{law.level:.0%}",
            _in_thousandths(law.at_ten),
            _in_thousandths(law.per_decade),
            f"{law.deviation:.1%}",
            *(f"{law(each):.2f}" for each in _NAYAKS),
        )
        for law in laws
    ]
    return Section(
        "One law for all",
        [
            "Lines over log α, by least squares over all fifteen spectra, weighted equally: κ = "
            "κ_10 + b log10(α/10), with 95 % intervals from resampled surfaces; the error of the "
            f"grid, by which κ is up to {grid_error(MIDDLE):.1%} higher, is not in them. To use "
            "the lines: take α and ∇h of the surface down to its shortest wave, and the area from "
            "the line; α from 3 to 126 was computed.",
        ],
        tables=[Table(header, rows, range(len(header)))],
    )


def _other_spectra() -> Section:
    header = ("long waves along a side", "α", "κ", "on the line", "κ over it, less 1")
    rows = [
        (
            f"{one.long_waves[0]} to {one.long_waves[1]}",
            f"{one.nayak:.1f}",
            _cell(one.kappa(MIDDLE)),
            f"{common_law(MIDDLE)(one.nayak):.2f}",
            _shift(over_law(one)),
        )
        for one in rings()
    ]
    return Section(
        "Another family of spectra",
        [
            f"κ at {MIDDLE:.0%} in contact of surfaces with the waves of two narrow rings: "
            f"{SHORT_WAVES[0]} to {SHORT_WAVES[1]} waves along a side, and a few long ones, with "
            f"as much slope in one ring as in the other. {COUNT} periodic surfaces of {POINTS}² "
            "points for each, eight cells for the shortest wave. The spectrum beyond α matters by "
            "a few per cent.",
        ],
        tables=[Table(header, rows, range(1, len(header)))],
    )


def _grid() -> Section:
    header = ("Hurst", "q_high/q_roll", *(f"{level:.1%}" for level in AREAS[1:]))
    rows = [
        (
            f"{hurst:g}",
            f"{band}",
            *(_shift(grid_shift(band, hurst, level)) for level in AREAS[1:]),
        )
        for hurst in HURSTS
        for band in FINE_BANDS
    ]
    return Section(
        "The grid",
        [
            "How much higher κ is with 16 cells for the shortest wave than with eight, of the same "
            "surfaces, with 95 % intervals. Verdicts on light loads take twice this difference "
            "as the error of eight cells, as it holds for an error that halves with the spacing. "
            "Wider bands were not pressed on the finer grid and are assigned the error of the "
            "widest band that was: the shortest wave, which decides, has as many cells in all.",
        ],
        tables=[Table(header, rows, range(len(header)))],
    )


def _size() -> Section:
    header = ("Hurst", "q_high/q_roll", *(f"{level:.1%}" for level in AREAS[1:]))
    rows = [
        (
            f"{hurst:g}",
            f"{band}",
            *(_shift(size_shift(band, hurst, level)) for level in AREAS[1:]),
        )
        for hurst in HURSTS
        for band in LARGE_BANDS
    ]
    return Section(
        "The size",
        [
            "How much higher κ is with eight roll-off waves along a side than with four, of other "
            "surfaces of the same spectrum.",
        ],
        tables=[Table(header, rows, range(len(header)))],
    )


def _repeat() -> Section:
    return Section(
        "Data, and how to repeat",
        [
            "The plan, the reduction and the data lie in `studies/area`: areas and statuses of "
            "every surface and load as NetCDF, in single precision. Surface i has the seed "
            "`SeedSequence(2017, spawn_key=(i,))`. `make area` computes everything again, in less "
            "than an hour on two cores, and goes on where it stopped. The data were "
            f"computed with roughline {version_of(data().values())}. `studies/area/rings.py` "
            "presses the surfaces of two rings, in two minutes; theirs were computed with version "
            f"{version()}.",
        ],
    )


def _references() -> Section:
    return Section(
        "References",
        notes=[
            "A. W. Bush, R. D. Gibson and T. R. Thomas, The elastic contact of a rough surface, "
            "Wear 35, 87-111 (1975).",
            "B. N. J. Persson, Theory of rubber friction and contact mechanics, J. Chem. Phys. "
            "115, 3840-3861 (2001).",
            "S. Hyun, L. Pei, J.-F. Molinari and M. O. Robbins, Finite-element analysis of contact "
            "between elastic self-affine surfaces, Phys. Rev. E 70, 026117 (2004).",
            "N. Prodanov, W. B. Dapp and M. H. Müser, On the contact area and mean gap of rough, "
            "elastic contacts: dimensional analysis, numerical corrections, and reference data, "
            "Tribol. Lett. 53, 433-448 (2014).",
            "V. A. Yastrebov, G. Anciaux and J.-F. Molinari, The role of the roughness spectral "
            "breadth in elastic contact of rough surfaces, J. Mech. Phys. Solids 107, 469-493 "
            "(2017).",
        ],
    )


def _has(one: Sample, level: float) -> bool:
    """Whether the loads of a spectrum enclose a share of the area in the mean."""
    return bool(one.area.mean(axis=0)[0] < level < one.area.mean(axis=0)[-1])


def _cell(estimate: IntervalEstimate) -> str:
    return f"{estimate.value:.2f} ({estimate.low:.2f}-{estimate.high:.2f})"


def _in_thousandths(estimate: IntervalEstimate) -> str:
    return f"{estimate.value:.3f} ({estimate.low:.3f} to {estimate.high:.3f})"


def _shift(estimate: IntervalEstimate) -> str:
    return f"{estimate.value:+.1%} ({estimate.low:+.1%} to {estimate.high:+.1%})"
