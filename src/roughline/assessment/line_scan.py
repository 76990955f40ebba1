"""A line scan pressed: through the surfaces that it may be cut from, with an interval."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from roughline.comparison.trust import trust_map
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.errors.public import public
from roughline.spectra.isotropic import IsotropicSpectrum
from roughline.spectra.profile import profile_spectrum
from roughline.spectra.scan_bins import ScanBins
from roughline.topography.body import Line
from roughline.topography.settings import as_body

SCAN_LINES = 200
_SPRINGS_A_WAVE = 8
_LEAST_SPRINGS = 2**12


@dataclass(frozen=True, eq=False)
class PressedScan:
    """Reduced lines of surfaces that a line scan may have been cut from.

    Attributes
    ----------
    curve : Curve
        Medians over the lines; of a square with the scan's length as its side.
    low, high : ndarray, shape (loads,)
        95 % interval of the stiffness of one such surface: it holds the uncertainty of the
        spectrum, the scatter of random phases, and the difference of the full model from the
        reduced one. [force / length]
    """

    curve: Curve
    low: Real
    high: Real


@public
def press_scan(
    scan: Line, *, E_star: float, forces: ArrayLike, against: Line | None = None, rng: int = 0
) -> PressedScan:
    """Press a line scan with the reduced model.

    Each of 200 lines belongs to a surface that the scan may be cut from. The spectrum of this
    surface is a self-affine law with deviations from it; both are drawn with the probability that
    the scan gives them. Phases are random. The surface is assumed to be isotropic.

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
    rng : int, optional
        Root of all seeds.

    Raises
    ------
    InputError
        If the line is no profile, has no spectrum, or the forces cannot be used.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0)
    >>> surface = spectrum.surface(256, rng=7)
    >>> scan = rl.Line(surface.heights[0], length=1.0, kind="profile")
    >>> pressed = rl.press_scan(scan, E_star=1.0, forces=[1e-3])
    >>> print(pressed.curve.stiffness.round(2), pressed.low.round(2), pressed.high.round(2))
    [0.21] [0.11] [0.4]
    """
    scans = [each for each in (scan, against) if each is not None]
    springs = max(_LEAST_SPRINGS, _SPRINGS_A_WAVE * scan.heights.size)
    bins = [ScanBins.of(profile_spectrum(each)) for each in scans]
    surfaces = [
        _surfaces(
            bins[which], each.length, np.random.SeedSequence(rng, spawn_key=(SCAN_LINES, which))
        )
        for which, each in enumerate(scans)
    ]
    curves = []
    for i, drawn in enumerate(zip(*surfaces, strict=True)):
        both = drawn[0] if against is None else drawn[0] + drawn[1]
        line = both.line(springs, np.random.SeedSequence(rng, spawn_key=(i,)))
        curves.append(press(replace(line, unit=scan.unit), E_star=E_star, forces=forces))
    median, low, high = _median(curves, scan, rng)
    less, more = _full_over_reduced(median, bins[0])
    return PressedScan(median, low * less, high * more)


def _median(curves: Sequence[Curve], scan: Line, seed: int) -> tuple[Curve, Real, Real]:
    """Medians over the lines, and both ends of the stiffness of one more."""
    stiffness = np.array([curve.stiffness for curve in curves])
    # of so many draws, ranks by Weibull's rule hold another in 95 of 100 cases
    low, high = np.percentile(stiffness, [2.5, 97.5], axis=0, method="weibull")
    first = curves[0]
    median = replace(
        first,
        depth=np.median([curve.depth for curve in curves], axis=0),
        stiffness=np.median(stiffness, axis=0),
        resolved=np.all([curve.resolved for curve in curves], axis=0),
        rms_height=float(np.median([curve.rms_height for curve in curves])),
        settings={
            "roughline_version": first.settings["roughline_version"],
            "model": "reduced",
            "control": "forces",
            "lines": SCAN_LINES,
            "seed": seed,
            "spectrum": "of surfaces that the line scan may be cut from",
            **as_body(scan.settings),
        },
        warnings=(
            "a line scan shows one direction only: the surface is assumed to be isotropic, and a "
            "square whose side is the scan's length",
        ),
    )
    return median, low, high


def _surfaces(
    bins: ScanBins, length: float, rng: np.random.SeedSequence
) -> Iterator[IsotropicSpectrum]:
    """Draw the spectra of surfaces that a scan may be cut from, one for each line."""
    q_low = 2 * math.pi / length
    for power in bins.surfaces(SCAN_LINES, np.random.default_rng(rng)):
        m = np.arange(1.0, power.size + 1)
        yield IsotropicSpectrum(
            q=q_low * m,
            C_2d=power / q_low**2,
            length=length,
            rms_height=math.sqrt(2 * math.pi * float(m @ power)),
            modes=np.zeros(m.size),
            windowed=False,
        )


def _full_over_reduced(curve: Curve, bins: ScanBins) -> tuple[Real, Real]:
    """Factors between which the full model's stiffness is over the reduced one's, by the map.

    For the law that explains the scan best; at the nearest place of the map, for laws and loads
    that are beyond it.
    """
    table = trust_map()
    hurst, roll, _ = bins.laws.values(*bins.laws.best)
    dimension = float(np.clip(3 - hurst, *table.fractal_dimensions[[0, -1]]))
    roll_off = float(np.clip(roll, *table.roll_off_ratios[[0, -1]]))
    loads = np.clip(curve.force_bar, *table.force_bars[[0, -1]])
    differences = [table.at(dimension, load, roll_off) for load in loads]
    low, high = (
        np.array([1 + getattr(each, end) for each in differences]) for end in ("low", "high")
    )
    return np.minimum(low, 1.0), np.maximum(high, 1.0)
