"""A line scan pressed: through the surface's spectrum to reduced lines, with an interval."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline.contact import press
from roughline.curve import Curve
from roughline.profile import profile_spectrum
from roughline.topography import Line

Real = NDArray[np.float64]

LINES = 200
_SPRINGS_A_WAVE = 8
_LEAST_SPRINGS = 2**12


@dataclass(frozen=True, eq=False)
class PressedScan:
    """Reduced lines of surfaces that a line scan may have been cut from.

    Attributes
    ----------
    curve : Curve
        Means over the lines; of a square with the scan's length as its side.
    low, high : ndarray, shape (loads,)
        95 % interval of the stiffness of one such surface: what the scan leaves open of the
        spectrum, and what random phases do. [force / length]
    """

    curve: Curve
    low: Real
    high: Real


def press_scan(
    scan: Line, *, E_star: float, forces: ArrayLike, against: Line | None = None, rng: int = 0
) -> PressedScan:
    """Press a line scan with the reduced model.

    The scan's spectrum is turned into the surface's by Abel inversion, which assumes that the
    surface is alike in all directions. Each of 200 lines has random phases and a spectrum that
    another scan of the same surface might have had.

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
        add. Waves that it does not carry are taken to be none. [length]
    rng : int, optional
        Root of all seeds.

    Raises
    ------
    InputError
        If the line is no profile, has no spectrum, or the forces cannot be used.
    """
    spectra = [profile_spectrum(each) for each in (scan, against) if each is not None]
    springs = max(_LEAST_SPRINGS, _SPRINGS_A_WAVE * scan.heights.size)
    curves = []
    for i in range(LINES):
        seed = np.random.SeedSequence(rng, spawn_key=(i,))
        drawn = [  # phases know nothing of amplitudes, and one body nothing of the other
            spectrum.drawn(np.random.SeedSequence(rng, spawn_key=(i, 1 + which))).surface()
            for which, spectrum in enumerate(spectra)
        ]
        both = drawn[0] if against is None else drawn[0] + drawn[1]
        line = both.line(springs, seed)
        curves.append(press(replace(line, unit=scan.unit), E_star=E_star, forces=forces))
    stiffness = np.array([curve.stiffness for curve in curves])
    low, high = np.percentile(stiffness, [2.5, 97.5], axis=0)
    first = curves[0]
    mean = replace(
        first,
        depth=np.mean([curve.depth for curve in curves], axis=0),
        stiffness=stiffness.mean(axis=0),
        resolved=np.all([curve.resolved for curve in curves], axis=0),
        rms_height=math.hypot(*(spectrum.rms_height for spectrum in spectra)),
        settings={
            "roughline_version": first.settings["roughline_version"],
            "model": "reduced",
            "control": "forces",
            "lines": LINES,
            "seed": rng,
            "spectrum": "Abel inversion of the line scan's",
            **scan.settings_as_body(),
        },
        warnings=(
            "a line scan shows one direction: a surface alike in all directions, and as large as "
            "the square of the scan's length, is assumed",
        ),
    )
    return PressedScan(mean, low, high)
