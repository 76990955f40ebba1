"""Whether a line scan shows that the surface behind it has Gaussian heights, as models assume."""

from __future__ import annotations

import numpy as np

from roughline.assessment.assumptions import broken
from roughline.computing.arrays import Real
from roughline.contact.press import press
from roughline.spectra.coarser_selves import coarser_selves
from roughline.spectra.scan_bins import ScanBins
from roughline.topography.body import Line
from roughline.units import decimal

_LEAST_HEIGHTS = 100
"""Independent heights from which on a scan shows whether its surface has Gaussian ones.

The skewness of so many scatters by sqrt(6 / 100) = 0.25. A skewness of 1, which moves the stiffness
by about as much as the interval is wide, is then told from none nearly always.
"""

_CUTS = 200  # Gaussian cuts that a scan is compared with
_CHANCE = 0.02  # that a Gaussian scan differs from them so much
_NO_MATTER = 0.02  # relative difference of a stiffness that does not matter


def doubts_of(
    scan: Line,
    bins: ScanBins,
    forces: Real,
    *,
    is_known_gaussian: bool,
    rng: np.random.SeedSequence,
) -> list[str]:
    """Say why a surface with Gaussian heights may not stand for that of a scan; empty if it may.

    Forces are over E* times the rms height and the length of the scan. A short scan need not show
    that it is Gaussian if that is known.
    """
    levelled = scan.detrended()
    found = [each.text for each in broken("line scan", levelled)]
    if not found:
        found = _of_stiffness(levelled.heights, bins, forces, rng)
    heights = independent_heights(levelled)
    if not found and not is_known_gaussian and heights < _LEAST_HEIGHTS:
        found = [
            f"the scan has about {decimal(heights, 2)} independent heights, too few to show "
            f"whether those of its surface are Gaussian: {_LEAST_HEIGHTS} are needed, "
            "or rl.press_scan(..., gaussian=True) where that is known"
        ]
    return found


def independent_heights(scan: Line) -> float:
    """Number of independent heights whose skewness scatters like that of a scan."""
    own = next(coarser_selves(scan), None)
    return 0.0 if own is None else own.of_heights.independent(3)


def _of_stiffness(
    heights: Real, bins: ScanBins, forces: Real, rng: np.random.SeedSequence
) -> list[str]:
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
    return [
        "heights are not Gaussian: pressed as independent springs, those of the scan are "
        f"{decimal(ratio, 2)} times as stiff under load {worst + 1} as Gaussian ones of its "
        f"spectrum, and chance allows {decimal(allowed, 2)}"
    ]


def _stiffness_of_springs(heights: Real, forces: Real) -> Real:
    """Stiffness of heights as springs, under forces in units of their own rms height.

    The mean plane is taken away before.
    """
    x = np.linspace(-1, 1, heights.size)
    heights = heights - heights.mean()
    heights = heights - (heights @ x) / (x @ x) * x
    springs = Line(heights / heights.std(), 1.0)
    return press(springs, E_star=1.0, forces=forces).stiffness
