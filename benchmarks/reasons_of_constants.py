"""What chose each constant of the margins, and what those guard that change none of the cases.

A reason is a run, a page that derives or tries a value, or a definition. "Counted by" a run is no
reason: nothing tells that the run chose the value.
"""

_TILES = "[decision 19](decisions/0019-tiles.md)"
_ANSWERS = "[decision 12](decisions/0012-answers.md)"
_FACTORS = "`make grid-error`, [the factors](science.md)"
_STUDENT = "by definition: Student's distribution"
_WINDOW = "by definition: the Hann window"
_DOUBLE = "by definition: rounding of double precision"
_COUNTED = "none found; counted by `make intervals`"
_FIT = "none found; counted by `make coverage-table`"
_SEAL = "none found; counted by `make seal-coverage`"
_LEAK = "none found; counted by `make leak-coverage`"
_PART = "none found; counted by `make part-coverage`"
_SEARCH = "needs none: how the search goes, not where it ends"
_TOLD = "needs none: from where words are said; it moves no number"
_FINER_WAYS = (
    "a path of far more loads lies within, "
    "[on rough bodies](how-to/friction.md#answers-for-two-materials)"
)
_TIME = "needs none: a limit of the time"
_FINE = "`make constants`: doubled, it moves no width by more than"
_DENSE = "none found: how finely values are tried; counted by `make coverage-table`"


def _of(file, **reasons):
    return {f"{file}.py:{name}": reason for name, reason in reasons.items()}


CHOSEN = {
    **_of(
        "margins/filling",
        _SHARE_IN_INTERVALS=_COUNTED,
        _WARNED_SHARE=_TOLD,
        _GRAVE_SHARE=_TOLD,
        _SMALLEST_CHANGE=_TOLD,
    ),
    **_of("margins/grid", _UNSURE_RATIO=_COUNTED),
    **_of(
        "margins/spread",
        _LEAST_OPEN=_DOUBLE,
        _LEAST_OF_FLOOR=_DOUBLE,
        FLOOR=_LEAK,
    ),
    **_of(
        "margins/tiles",
        POINTS_OF_TILES=_TILES,
        POINTS_OF_BORDER=_LEAK,
        _DECAY=_TILES,
    ),
    **_of(
        "contact/grid_error",
        _YIELD_FACTOR=_FACTORS,
        _AREA_FACTOR=_FACTORS,
        _STEEPENING_EXPONENT=_FACTORS,
        _MEASURE_EXPONENT="`make intervals`, [the factors](science.md)",
        _YIELD_SHARE=_FACTORS,
        _GRID_WEIGHTS=_FACTORS,
        _LARGEST_LOADING=f"{_FINE} 1 %",
        _NOISE_GROWTH="by definition: means over two by two points halve white noise",
    ),
    **_of(
        "fluid/one_map",
        _FEWEST_WAVES=_SEAL,
        _EXTRAPOLATION="`make seal-coverage`, half of [its parts](flow.md)",
    ),
    **_of(
        "fluid/reopening",
        _FIRST_SHARES="needs none: where the search begins, not where it ends",
        _FIRST_STEP="needs none: where the search begins, not where it ends",
        _SMALLEST_SHARE=_SEAL,
        _NARROWEST_INTERVAL=_SEAL,
    ),
    **_of(
        "fluid/sealing_pressure",
        _PERCOLATION_PRESSURE="by definition: Persson's area at [the area that seals](sealing.md)",
        _HARDNESS_SHARE="[the area that seals](sealing.md)",
        _FIRST_OF_GUESS="needs none: where the search begins, not where it ends",
        _FIRST_OF_EXPECTED="needs none: where the search begins, not where it ends",
        _PART_OF_GAPS=f"{_FINE} 2 %",
        _RTOL="needs none: a default, which callers give",
    ),
    **_of(
        "fluid/trials",
        _TRIAL_STEP="needs none: where the search begins, not where it ends",
        _MOST_TRIALS="needs none: a limit of the search",
        _LARGEST_SHARE=_SEARCH,
        _LARGEST_REACH=_SEARCH,
        _SURENESS=_SEARCH,
        _LARGEST_STEP="36 maps of the study of sealing: 0.09 keeps 2 %, 0.12 does not",
    ),
    **_of("margins/spread", _PROBE="needs none: any small one shows what moves"),
    **_of(
        "margins/parts",
        _DEVIATIONS_TO_EDGE="`make part-coverage`, [on its parts](how-to/several_maps.md)",
        _SIDE_TOLERANCE=_PART,
        _CHANCE=_PART,
    ),
    **_of("margins/border_of_flow", COUNTED_RATIO=_TOLD, _END_ROUNDING=_DOUBLE),
    **_of("margins/scans", _LEAST_HEIGHTS="by definition: the scatter of a skewness"),
    **_of(
        "margins/scans",
        _CHANCE=_COUNTED,
        _SCAN_LINES=_COUNTED,
        _SPRINGS_A_WAVE=f"{_FINE} 1 %",
        _LEAST_SPRINGS=f"{_FINE} 1 %, and no value by more",
        _CUTS=_COUNTED,
    ),
    **_of("margins/steps", _TIMES=_FINER_WAYS, _WARNED_CHANGE=_TOLD),
    **_of("assessment/facts", _WIDE_RATIO=_TOLD),
    **_of("assessment/part_facts", _ADVISED_MAPS=_TOLD),
    **_of("margins/place", _RTOL=f"{_FINE} 0.1 %"),
    **_of("question/case", _CHEAP=_TIME, HALVED_FROM=_TIME),
    **_of("question/meant", STEEP_SLOPE=_TOLD),
    **_of("measurement/chance", MOST_CELLS=_TIME),
    **_of(
        "question/extrapolation",
        MOST_DOUBLINGS=f"`make interface-stiffness`, {_TILES}",
        _USUAL_DOUBLINGS="by definition: [what is meant](how-to/assumptions.md) without a size",
    ),
    **_of("measurement/coarser_selves", _FEWEST_CELLS=_COUNTED, _DETAIL_REACH=_COUNTED),
    **{
        f"measurement/departures.py:{name}": _COUNTED
        for name in (
            *("_DEPARTURE_CHANCE", "_DRIFT_CHANCE", "_LONG_WAVES_CHANCE", "_LONG_WAVES_SHARE"),
            *("_STEPPED_SHARE", "_LEVEL_SHARE", "_FILLED_SHARE", "_LARGEST_JUMP"),
            *("_LEVELS_BESIDE", "_LEVEL_EXCESS", "_JUMP_SCATTERS", "_STEP_STEEPNESS"),
        )
    },
    **_of(
        "measurement/departures",
        HEIGHT_ROUNDING=_DOUBLE,
        _NO_ROLL_OFF_GRAVITY="needs none: the order of remarks",
        _LEVELLED_GRAVITY="needs none: the order of remarks",
        _MOST_SEARCHED="needs none: a limit of the time",
    ),
    **_of(
        "measurement/fit",
        _CONFIDENCE=_FIT,
        SHORTEST_RANGE=_FIT,
        _LEAST_ISOTROPY=_FIT,
        _CONTRADICTING_DEVIANCE=_FIT,
        _LARGEST_CHANGE="needs none: what [a page](engineering.md) defines as changed",
        _TIP_CURVATURE=_FIT,
        _MOST_SCATTER=_FIT,
    ),
    **{
        f"measurement/gaussian_heights.py:{name}": _COUNTED
        for name in (
            *("_FEWEST_VALUES", "_LARGEST_SKEWNESS", "_LARGEST_EXCESS", "_LARGEST_LACK"),
            *("_HIGHEST_SHARES", "_LARGEST_SLOPE_RATIO", "_SCORE_SHARE", "_FEWEST_CELLS"),
            *("_FEWEST_SLOPES", "_SLOPE_REACH"),
        )
    },
    **{
        f"measurement/homogeneity.py:{name}": _COUNTED
        for name in (
            *("ISOTROPIC_FROM", "_LARGEST_SCATTER", "_TILES_ALONG", "_FEWEST_IN_TILE"),
            *("_STRIP_COUNT", "_LARGEST_CORRELATION", "_LARGEST_DRIFT", "_FEWEST_POINTS"),
        )
    },
    **_of("measurement/homogeneity", _CORRELATED_MODES=_WINDOW),
    **_of("measurement/law_search", IMPOSSIBLE="needs none: beyond all deviances"),
    **{
        f"measurement/law_search.py:{name}": _DENSE
        for name in (
            *("_HURSTS", "_NODES", "_DEVIANCE_MARGIN", "_FEW_NODES", "_FEW_ROLLS"),
            *("_FEW_ENDS", "_FEW_BLURS"),
        )
    },
    **_of("measurement/longer_waves", _PLANE_ROUNDING=_DOUBLE),
    **_of(
        "measurement/longer_waves",
        _FIRST_OWN_DEGREE=_COUNTED,
        _DEGREE_COUNT=_COUNTED,
        _LOWEST_WAVENUMBER=_COUNTED,
    ),
    **_of(
        "measurement/map_rings",
        _CORRELATED_MODES=_FIT,
        _ROLLS_PER_DECADE=_DENSE,
        _END_STEP=_DENSE,
    ),
    **_of(
        "measurement/means",
        FEWEST_MEANS=_FIT,
        _LAW_DEVIATION=_ANSWERS,
        _BINS_PER_DECADE=_ANSWERS,
        _POWER_FLOOR=_DOUBLE,
        _FARTHEST_MEAN="by definition: what a window leaks is below double precision",
        _LEAKAGE_FACTOR=_FIT,
    ),
    **_of(
        "measurement/response",
        _TRIED_BLURS=_DENSE,
        _TRIED_NOISES=_DENSE,
        _AS_PIXELS="by definition: means over pixels blur by 1 / sqrt(12) = 0.29",
        _FAINTEST=_DOUBLE,
        _REACHES=_DENSE,
        _LARGEST_FOLDED_BLUR=_FIT,
        _BLUR_STEP=_DENSE,
        _KNOWN_WITHIN=_FIT,
        _DIRECTIONS=f"{_FINE} 0.5 %",
        _IMAGE_PLACES=f"{_FINE} 0.5 %",
    ),
    **_of(
        "measurement/scan_bins",
        _POWER_FLOOR=_DOUBLE,
        _SAME_WAVENUMBER=_DOUBLE,
        _CORRELATED_MODES=_WINDOW,
        _BIN_DECAY="by definition: between H = 0 and H = 1",
    ),
    **_of(
        "statistics/bootstrap",
        ROUNDS="none found; counted by `make bootstrap-coverage`",
        _FEWEST_FREEDOM="none found; counted by `make bootstrap-coverage`",
        _ERROR_ROUNDING=_DOUBLE,
    ),
    **_of("statistics/places", _SCATTER_ROUNDING=_DOUBLE, _AGREEMENT_CHANCE=_PART),
}

GUARDS = {
    **_of("margins/filling", _SHARE_IN_INTERVALS="maps whose filled points bear much of the force"),
    **_of("margins/grid", _UNSURE_RATIO="a stiffness near full contact, of which little is known"),
    **_of(
        "margins/spread",
        _PROBE="values that are zero to rounding",
        _LEAST_OPEN="full contact, whose share has no logit",
        _LEAST_OF_FLOOR="what is sealed, to rounding",
    ),
    **_of("margins/tiles", POINTS_OF_BORDER="the time of large maps with a fluid"),
    **_of("contact/terraces", _SMALLEST_SHARE="few points that are in line by chance"),
    **_of(
        "fluid/sealing_pressure",
        _FIRST_OF_GUESS="the number of presses",
        _RTOL="who gives no tolerance",
        _RTOL_FACTOR="cells that loads solved less well would decide",
    ),
    **_of("fluid/reopening", _FIRST_SHARES="the number of presses"),
    **_of(
        "fluid/trials",
        _MOST_TRIALS="bodies that never seal",
        _LARGEST_REACH="searches whose first loads are far from the crossing",
        _LARGEST_SHARE="bodies that seal only where all of them bears the hardness",
    ),
    **_of(
        "margins/parts",
        _SIDE_TOLERANCE="maps of different lenses, whose long waves differ",
        _CHANCE="parts with waves longer than a map, near what chance allows",
    ),
    **_of(
        "margins/border_of_flow",
        COUNTED_RATIO="borders that move a flow little",
        _END_ROUNDING="ends that are equal to rounding",
    ),
    **_of(
        "margins/filling",
        _WARNED_SHARE="maps whose filled points bear some of the force",
        _GRAVE_SHARE="maps whose filled points bear most of the force",
    ),
    **_of("margins/larger_surface", _PUNCH_MATTERS="pieces alone, pressed nearly into a punch"),
    **_of(
        "margins/scans",
        _CUTS="scans near what chance allows",
        _CHANCE="scans near what chance allows",
        _NO_MATTER="long scans, where chance allows less than matters",
    ),
    **_of(
        "margins/steps",
        _TIMES="coupled bodies that are sheared",
        _WARNED_CHANGE="coupled bodies whose slip hangs on how the way is cut",
    ),
    **_of(
        "question/case",
        HALVED_FROM="the time of maps of more than a million points",
        _CHEAP="the time of large maps under many loads",
    ),
    **_of("measurement/chance", MOST_CELLS="the time of maps of more than 512 points a side"),
    **_of(
        "measurement/departures",
        _LARGEST_JUMP="smooth maps, where jumps that do not matter are beyond chance",
        _NO_ROLL_OFF_GRAVITY="the order of remarks",
        _LEVELLED_GRAVITY="the order of remarks",
        _FEWEST_POINTS="maps of a few rows",
        _MOST_SEARCHED="the time of maps of more than 1024 points a side",
        HEIGHT_ROUNDING="heights that are equal to rounding",
        _LEVELS_BESIDE="heights in steps, whose levels are full",
        _LEVEL_EXCESS="heights in steps, whose levels are full",
        _STEP_STEEPNESS="grooves, ridges and edges between tool marks, which are no jumps",
    ),
    **_of(
        "measurement/fit",
        _CONTRADICTING_DEVIANCE="instruments that are told nearly right",
    ),
    **_of("measurement/gaussian_heights", _LARGEST_SKEWNESS="large maps that are slightly skewed"),
    **_of(
        "measurement/homogeneity",
        _LARGEST_SCATTER="large maps whose places differ slightly",
        _SLOPE_FLOOR="places that are flat, whose slope has no logarithm",
        _FEWEST_IN_TILE="maps of few waves",
        _LARGEST_CORRELATION="strips that all rise or fall together",
        _FEWEST_POINTS="maps of a few rows",
    ),
    **_of(
        "measurement/law_search",
        IMPOSSIBLE="laws that end before their roll-off",
        _FEW_ENDS="the time of the first search",
        _FEW_BLURS="the time of the first search",
    ),
    **_of(
        "measurement/longer_waves",
        _LOWEST_WAVENUMBER="laws without a roll-off on maps that lie on longer waves",
        _HIGHEST_WAVENUMBER="laws of low exponents, whose short waves leave a trace",
        _PLANE_ROUNDING="maps that were levelled before",
    ),
    **_of(
        "measurement/means",
        FEWEST_MEANS="maps and scans of few points",
        _POWER_FLOOR="spectra that end in rounding",
        _FARTHEST_MEAN="the time of long scans",
    ),
    **_of(
        "measurement/response",
        _FAINTEST="blurs of many pixels that are told",
    ),
    **_of(
        "measurement/scan_bins",
        _POWER_FLOOR="laws that have ended, whose power has no logarithm",
        _SMALLEST_REST="instruments that take nearly all of a scan's waves",
        _SAME_WAVENUMBER="wavenumbers that are equal to rounding",
        _LINE_LENGTH="the Gaussian cuts that a scan is compared with",
        _TABLED_WAVES="the Gaussian cuts that a scan is compared with",
    ),
    **_of(
        "statistics/bootstrap",
        _FEWEST_FREEDOM="ensembles of fewer than six curves",
        _ERROR_ROUNDING="curves that are all the same",
    ),
    **_of("statistics/places", _SCATTER_ROUNDING="maps that are all the same"),
}
