"""A line scan pressed: through the surfaces that it may be cut from, with an interval."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from roughline._version import __version__
from roughline.comparison.median_ratio import median_ratio
from roughline.comparison.trust import trust_map
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.engineering.formulas import ELASTIC_UP_TO
from roughline.errors.checks import flag
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.measurement.coarser_selves import coarser_selves
from roughline.measurement.scan_bins import ScanBins
from roughline.question.assumptions import broken
from roughline.question.question import Question
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.profile import profile_spectrum
from roughline.topography.body import Body, Line
from roughline.topography.settings import as_body

_SCAN_LINES = 200  # lines that are pressed, each of a surface that the scan may be cut from
_SPRINGS_A_WAVE = 8  # springs of a line for each height of the scan
_LEAST_SPRINGS = 2**12  # of a line, however short the scan is

_LEAST_HEIGHTS = 100
"""Independent heights from which on a scan shows whether its surface has Gaussian ones.

The skewness of so many scatters by sqrt(6 / 100) = 0.25. A skewness of 1, which moves the stiffness
by about as much as the interval is wide, is then told from none nearly always.
"""

_CUTS = 200  # Gaussian cuts that a scan is compared with
_CHANCE = 0.02  # that a Gaussian scan differs from them so much
_NO_MATTER = 0.02  # relative difference of a stiffness that does not matter


ONE_SCAN = ("scan", "what one line does not show of its surface", "a map")
"""Name, title and remedy of what leaves answers of a scan open."""


def limits_of_line(question: Question, body: Body) -> list[Fact]:
    """Say that the model of a line has no area, and up to which slopes it stands for metals.

    That is grave of a scan that is so steep that they yield.
    """
    pair = question.pair
    if pair is None or not isinstance(body, Line):
        return []
    found = [Fact("no_area_of_line")]
    if pair.hardness is not None:
        most = 2 * ELASTIC_UP_TO * pair.hardness / pair.E_star
        slope = body.rms_slope if body.kind == "profile" else None
        kind = "line_without_yield" if slope is None or slope <= most else "line_is_too_steep"
        ratios = {"limit": ELASTIC_UP_TO, "ratio": 2 * ELASTIC_UP_TO}
        found.append(Fact(kind, **ratios, most=most, slope=slope))
    return found


@dataclass(frozen=True, eq=False)
class PressedScan:
    """Reduced lines of surfaces that a line scan may have been cut from.

    Attributes
    ----------
    curve : Curve
        Medians over the lines; of a square with the scan's length as its side. Its stiffness is
        that of the lines times the ratio of both models' middles on Gaussian surfaces. Its warnings
        say why there is no interval.
    low, high : ndarray, shape (loads,)
        95 % interval of the stiffness of one such surface: it holds the uncertainty of the
        spectrum, the scatter of random phases, and the difference of the full model from the
        reduced one. NaN where the scan does not show that heights are Gaussian. [force / length]
    """

    curve: Curve
    low: Real
    high: Real


@public
def press_scan(
    scan: Line,
    *,
    E_star: float,
    forces: ArrayLike,
    against: Line | None = None,
    gaussian: bool = False,
    rng: int = 0,
) -> PressedScan:
    """Press a line scan with the reduced model.

    Each of 200 lines belongs to a surface that the scan may be cut from. The spectrum of this
    surface is a self-affine law with deviations from it; both are drawn with the probability that
    the scan gives them. Phases are random. The surface is assumed to be isotropic and alike
    everywhere, and its heights Gaussian: on others the stiffness may be off by a factor of several.
    So there is no interval where the scan shows other heights, or is too short to show which it
    has. What lies beside the scan, it cannot show.

    Parameters
    ----------
    scan : Line
        Of kind "profile". [length]
    E_star : float
        Contact modulus. [pressure]
    forces : array_like, shape (loads,)
        Rising total forces on a square whose side is the scan's length. [force]
    against : Line, optional
        Scan of the second body, of kind "profile" and from another, independent surface; spectra
        add. Waves that it does not resolve are taken to have no amplitude. [length]
    gaussian : bool, optional
        Whether the heights of the surfaces are known to be Gaussian. A scan that is too short to
        show it then has an interval too; one that shows the contrary has none.
    rng : int, optional
        Root of all seeds.

    Raises
    ------
    InputError
        If the line is no profile, has no spectrum, or the forces cannot be used.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=250.0)
    >>> surface = spectrum.surface(512, rng=7)
    >>> scan = rl.Line(surface.heights[0], length=1.0, kind="profile")
    >>> pressed = rl.press_scan(scan, E_star=1.0, forces=[1e-3])
    >>> print(pressed.curve.stiffness.round(2), pressed.low.round(2), pressed.high.round(2))
    [0.23] [0.14] [0.28]
    """
    gaussian = flag("gaussian", gaussian)
    scans = [each for each in (scan, against) if each is not None]
    bins = [ScanBins.of(profile_spectrum(each)) for each in scans]
    curves = _pressed(scans, bins, E_star, forces, rng)
    curve, low, high = _surface_stiffness(_median(curves, scan, rng), curves, bins[0])
    doubts = []
    for which, each in enumerate(scans):
        seed = np.random.SeedSequence(rng, spawn_key=(_SCAN_LINES, which, 1))
        found = _gaussian_doubt(
            each, bins[which], curve.force_bar, is_known_gaussian=gaussian, rng=seed
        )
        if len(scans) > 1:
            name = ("first", "second")[which]
            found = [fact.within(Fact("on_body", fact=fact, which=name)) for fact in found]
        doubts += found
    if doubts:
        doubted = [Fact("line_stands_for_surface", fact=doubt).grave() for doubt in doubts]
        curve = replace(curve, facts=(*doubted, *curve.facts))
        low, high = (np.full(curve.stiffness.size, math.nan) for _ in range(2))
    return PressedScan(curve, low, high)


def _pressed(
    scans: Sequence[Line], bins: Sequence[ScanBins], E_star: float, forces: ArrayLike, seed: int
) -> list[Curve]:
    """Press reduced lines of surfaces that the scans may be cut from."""
    springs = max(_LEAST_SPRINGS, _SPRINGS_A_WAVE * scans[0].heights.size)
    surfaces = [
        _surfaces(
            bins[which], each.length, np.random.SeedSequence(seed, spawn_key=(_SCAN_LINES, which))
        )
        for which, each in enumerate(scans)
    ]
    curves = []
    for i, drawn in enumerate(zip(*surfaces, strict=True)):
        both = drawn[0] if len(drawn) == 1 else drawn[0] + drawn[1]
        line = both.line(springs, np.random.SeedSequence(seed, spawn_key=(i,)))
        curves.append(press(replace(line, unit=scans[0].unit), E_star=E_star, forces=forces))
    return curves


def _median(curves: Sequence[Curve], scan: Line, seed: int) -> Curve:
    """Medians over the lines, as they are."""
    first = curves[0]
    return replace(
        first,
        depth=np.median([curve.depth for curve in curves], axis=0),
        stiffness=np.median([curve.stiffness for curve in curves], axis=0),
        resolved=np.all([curve.resolved for curve in curves], axis=0),
        rms_height=float(np.median([curve.rms_height for curve in curves])),
        settings={
            "roughline_version": __version__,
            "model": "reduced",
            "control": "forces",
            "lines": _SCAN_LINES,
            "seed": seed,
            "spectrum": "of surfaces that the line scan may be cut from",
            **as_body(scan.settings),
        },
        facts=(Fact("one_line_only"),),
    )


def _surface_stiffness(
    median: Curve, curves: Sequence[Curve], bins: ScanBins
) -> tuple[Curve, Real, Real]:
    """The stiffness that the full model is expected to have, and both ends of its interval."""
    difference, less, more = _full_over_reduced(median, bins)
    # of so many draws, ranks by Weibull's rule hold another in 95 of 100 cases
    stiffness = np.array([curve.stiffness for curve in curves])
    low, high = np.percentile(stiffness, [2.5, 97.5], axis=0, method="weibull")
    return replace(median, stiffness=median.stiffness * difference), low * less, high * more


def _surfaces(
    bins: ScanBins, length: float, rng: np.random.SeedSequence
) -> Iterator[IsotropicSpectrum]:
    """Draw the spectra of surfaces that a scan may be cut from, one for each line."""
    q_low = 2 * math.pi / length
    for power in bins.surfaces(_SCAN_LINES, np.random.default_rng(rng)):
        m = np.arange(1.0, power.size + 1)
        yield IsotropicSpectrum(
            q=q_low * m,
            C_2d=power / q_low**2,
            length=length,
            rms_height=math.sqrt(2 * math.pi * float(m @ power)),
            modes=np.zeros(m.size),
            windowed=False,
        )


def _full_over_reduced(curve: Curve, bins: ScanBins) -> tuple[Real, Real, Real]:
    """The full model's stiffness over the reduced one's, and both ends of its interval.

    For the law that explains the scan best. The ratio is that of single Gaussian surfaces in the
    middle, and the interval that of the map of trust. Where the law or a load is beyond the map,
    both are those of the nearest place, and the interval reaches to equal models.
    """
    table = trust_map()
    hurst, roll, *_ = bins.laws.at(*bins.laws.best)
    dimension = float(np.clip(3 - hurst, *table.fractal_dimensions[[0, -1]]))
    roll_off = float(np.clip(roll, *table.roll_off_ratios[[0, -1]]))
    loads = np.clip(curve.force_bar, *table.force_bars[[0, -1]])
    differences = [table.at(dimension, load, roll_off) for load in loads]
    value = median_ratio(3 - hurst, curve.force_bar, roll)
    low, high = (
        np.array([1 + getattr(each, name) for each in differences]) for name in ("low", "high")
    )
    is_beyond = (loads != curve.force_bar) | (dimension != 3 - hurst) | (roll > roll_off)
    low = np.where(is_beyond, np.minimum(low, 1.0), low)
    high = np.where(is_beyond, np.maximum(high, 1.0), high)
    return value, low, high


def _gaussian_doubt(
    scan: Line,
    bins: ScanBins,
    forces: Real,
    *,
    is_known_gaussian: bool,
    rng: np.random.SeedSequence,
) -> list[Fact]:
    """Say why a surface with Gaussian heights may not stand for that of a scan; empty if it may.

    Forces are over E* times the rms height and the length of the scan. A short scan need not show
    that it is Gaussian if that is known.
    """
    levelled = scan.detrended()
    found = [each.fact for each in broken("line scan", levelled)]
    if not found:
        found = _stiffness_doubt(levelled.heights, bins, forces, rng)
    heights = independent_heights(levelled)
    if not found and not is_known_gaussian and heights < _LEAST_HEIGHTS:
        found = [Fact("few_heights", heights=heights, needed=_LEAST_HEIGHTS)]
    return found


def independent_heights(scan: Line) -> float:
    """Number of independent heights whose skewness scatters like that of a scan."""
    own = next(coarser_selves(scan), None)
    return 0.0 if own is None else own.heights_chance.independent(3)


def _stiffness_doubt(
    heights: Real, bins: ScanBins, forces: Real, rng: np.random.SeedSequence
) -> list[Fact]:
    """Compare a scan with Gaussian cuts of its spectrum, each pressed as independent springs.

    Such springs stand for no surface, but feel the distribution of heights alone, at the same
    loads.
    """
    drawn = bins.drawn_cuts(heights.size, _CUTS, np.random.default_rng(rng))
    cuts = np.log([_stiffness_of_springs(cut, forces) for cut in drawn])
    own = np.log(_stiffness_of_springs(heights, forces))
    middle = np.median(cuts, axis=0)
    spread = np.maximum(cuts.std(axis=0), _NO_MATTER)
    off = np.abs(own - middle) / spread
    by_chance = float(np.quantile(np.abs((cuts - middle) / spread).max(axis=1), 1 - _CHANCE))
    worst = int(np.argmax(off))
    if off[worst] <= by_chance:
        return []
    ratio = float(np.exp(own - middle)[worst])
    allowed = float(np.exp(np.sign(own - middle)[worst] * by_chance * spread[worst]))
    return [Fact("stiff_heights", ratio=ratio, allowed=allowed, load=worst + 1)]


def _stiffness_of_springs(heights: Real, forces: Real) -> Real:
    """Stiffness of heights as springs, under forces in units of their own rms height.

    The mean plane is taken away before.
    """
    x = np.linspace(-1, 1, heights.size)
    heights = heights - heights.mean()
    heights = heights - (heights @ x) / (x @ x) * x
    springs = Line(heights / heights.std(), 1.0)
    return press(springs, E_star=1.0, forces=forces).stiffness
