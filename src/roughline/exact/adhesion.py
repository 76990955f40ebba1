"""Spheres of every range, discs and waves that stick to an elastic half-space.

References
----------
.. [1] D. Maugis, "Adhesion of spheres: the JKR-DMT transition using a Dugdale model", J. Colloid
   Interface Sci. 150, 243-269 (1992), eqs. 6.8 to 6.13.
.. [2] R. S. Bradley, "The cohesive force between solid surfaces and the surface energy of solids",
   Phil. Mag. 13, 853-862 (1932).
.. [3] K. Kendall, "The adhesion and surface energy of elastic solids", J. Phys. D 4, 1186-1195
   (1971).
.. [4] K. L. Johnson, "The adhesion of two elastic bodies with slightly wavy surfaces", Int. J.
   Solids Struct. 32, 423-430 (1995).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi, sqrt

import numpy as np

from roughline.exact import westergaard
from roughline.exact._checks import Real, positive

_SMALLEST_ZONE, _LARGEST_REACH = 1e-7, 1e4  # c / a - 1 between which states are sought
_TRIED_RATIOS = 400  # of c / a, between which the least force is narrowed down


def bradley_pull_off(radius_of_curvature: float, work_of_adhesion: float) -> float:
    """Least force -2 pi w R on a rigid sphere, whatever the law of its pull (Bradley). [force]

    Parameters
    ----------
    radius_of_curvature : float
        R. [length]
    work_of_adhesion : float
        w. [energy / length²]
    """
    positive(radius_of_curvature=radius_of_curvature, work_of_adhesion=work_of_adhesion)
    return -2 * pi * work_of_adhesion * radius_of_curvature


def punch_pull_off(radius: float, work_of_adhesion: float, E_star: float) -> float:
    """Least force -sqrt(8 pi E* w a³) on a flat disc, in the limit of a short range. [force]

    Parameters
    ----------
    radius : float
        a. [length]
    work_of_adhesion : float
        w. [energy / length²]
    E_star : float
        Contact modulus. [pressure]
    """
    positive(radius=radius, work_of_adhesion=work_of_adhesion, E_star=E_star)
    return -sqrt(8 * pi * E_star * work_of_adhesion * radius**3)


def ranged_punch_pull_off(
    radius: float, work_of_adhesion: float, longest: float, E_star: float
) -> float:
    """Least force on a flat disc that is pulled evenly, with w / h_0, up to a range h_0. [force]

    A ring about the disc r < c that still touches bears -sigma_0, as the ring of
    :class:`~roughline.exact.yielding.YieldingDisc` bears H. In the reduction method the line of the
    disc carries E* d for x < c and 2 sigma_0 sqrt(a² - x²) beyond, so the gap at the rim is
    ``d - (2 / pi) (d arcsin(c / a) + (2 sigma_0 / E*) (a - c))``. Where it is h_0, or where nothing
    touches, the disc comes off.

    Parameters
    ----------
    radius : float
        a. [length]
    work_of_adhesion : float
        w. [energy / length²]
    longest : float
        h_0. [length]
    E_star : float
        Contact modulus. [pressure]
    """
    from scipy.optimize import brentq  # here because it loads slowly

    positive(radius=radius, work_of_adhesion=work_of_adhesion, longest=longest, E_star=E_star)
    pull = work_of_adhesion / longest

    def gap_at_rim(c: float) -> float:
        depth = 2 * pull / E_star * sqrt(radius**2 - c**2)
        moved = depth * np.arcsin(c / radius) + 2 * pull / E_star * (radius - c)
        return float(depth - 2 / pi * moved)

    if gap_at_rim(0.0) <= longest:
        return -pi * radius**2 * pull
    c = brentq(lambda c: gap_at_rim(c) - longest, 0.0, radius)
    return -2 * pull * (radius**2 * np.arccos(c / radius) + c * sqrt(radius**2 - c**2))


@dataclass(frozen=True)
class MaugisSphere:
    """Sphere that is pulled evenly, with w / h_0, up to a range h_0 (Maugis).

    Its states are told by m = c / a, the radius of the reach over that of the contact. Forces are
    pi w R and lengths those of JKR times the functions of m and of the transition parameter.

    Attributes
    ----------
    radius_of_curvature : float
        R. [length]
    work_of_adhesion : float
        w. [energy / length²]
    range : float
        h_0. [length]
    E_star : float
        Contact modulus. [pressure]

    Raises
    ------
    ValueError
        If any of them is not positive.
    """

    radius_of_curvature: float
    work_of_adhesion: float
    range: float
    E_star: float

    def __post_init__(self) -> None:
        positive(
            radius_of_curvature=self.radius_of_curvature,
            work_of_adhesion=self.work_of_adhesion,
            range=self.range,
            E_star=self.E_star,
        )

    @property
    def transition(self) -> float:
        """Maugis's lambda = 2 sigma_0 (R / (pi w K²))^(1/3), K = 4 E* / 3. [1]"""
        w, K = self.work_of_adhesion, 4 * self.E_star / 3
        return float(2 * w / self.range * np.cbrt(self.radius_of_curvature / (pi * w * K**2)))

    @property
    def unit_of_radii(self) -> float:
        """(pi w R² / K)^(1/3). [length]"""
        K = 4 * self.E_star / 3
        return float(np.cbrt(pi * self.work_of_adhesion * self.radius_of_curvature**2 / K))

    def radius(self, reach_ratio: float) -> float:
        """Contact radius a where the reach is m times as wide, the root of eq. 6.8. [length]"""
        mu, angle = _reach_terms(reach_ratio)
        square = self.transition / 2 * (mu + (reach_ratio**2 - 2) * angle)
        linear = 4 / 3 * self.transition**2 * (mu * angle - reach_ratio + 1)
        return 2 / (linear + sqrt(linear**2 + 4 * square)) * self.unit_of_radii

    def force(self, reach_ratio: float) -> float:
        """Force, eq. 6.10. [force]"""
        mu, angle = _reach_terms(reach_ratio)
        a = self.radius(reach_ratio) / self.unit_of_radii
        found = a**3 - self.transition * a**2 * (mu + reach_ratio**2 * angle)
        return float(found * pi * self.work_of_adhesion * self.radius_of_curvature)

    def depth(self, reach_ratio: float) -> float:
        """Depth, eq. 6.12. [length]"""
        mu, _ = _reach_terms(reach_ratio)
        a = self.radius(reach_ratio) / self.unit_of_radii
        unit = self.unit_of_radii**2 / self.radius_of_curvature
        return float((a**2 - 4 / 3 * a * self.transition * mu) * unit)

    def pull_off_ratio(self) -> float:
        """Ratio m at which the force is least."""
        from scipy.optimize import minimize_scalar  # here because it loads slowly

        ratios = 1 + np.geomspace(_SMALLEST_ZONE, _LARGEST_REACH, _TRIED_RATIOS)
        least = int(np.argmin([self.force(m) for m in ratios]))
        ends = ratios[max(least - 1, 0)], ratios[min(least + 1, _TRIED_RATIOS - 1)]
        return float(
            minimize_scalar(
                self.force, bounds=ends, method="bounded", options={"xatol": 1e-9 * ends[1]}
            ).x
        )

    @property
    def pull_off_force(self) -> float:
        """Least force. [force]"""
        return self.force(self.pull_off_ratio())

    def at_depth(self, depth: float) -> float:
        """Ratio m on the branch that is stable at a given depth.

        Raises
        ------
        ValueError
            If the sphere has no contact at this depth.
        """
        from scipy.optimize import brentq  # here because it loads slowly

        ratios = 1 + np.geomspace(_SMALLEST_ZONE, _LARGEST_REACH, 4 * _TRIED_RATIOS)
        depths = np.array([self.depth(m) for m in ratios])
        lowest = int(depths.argmin())
        if not depths[lowest] <= depth <= depths[0]:
            raise ValueError(
                f"depth is {depth:g}; from {depths[lowest]:g} to {depths[0]:g} is known"
            )
        return float(brentq(lambda m: self.depth(m) - depth, ratios[0], ratios[lowest]))


def _reach_terms(reach_ratio: float) -> tuple[float, float]:
    """Return sqrt(m² - 1) and its arc tangent."""
    if not 1 < reach_ratio < inf:
        raise ValueError(f"reach_ratio is {reach_ratio}; a finite number above 1 is needed")
    mu = sqrt((reach_ratio - 1) * (reach_ratio + 1))
    return mu, float(np.arctan(mu))


def wave_mean_pressure(
    half_width: Real,
    amplitude: float,
    wavelength: float,
    work_of_adhesion: float,
    E_star: float,
) -> Real:
    """Mean pressure of a wave that sticks, in the limit of a short range (Johnson). [pressure]

    ``p* (sin²(pi a / lambda) - alpha sqrt(tan(pi a / lambda)))`` with p* the pressure of full
    contact and ``alpha² = 2 w lambda / (pi² E* Delta²)``.

    Parameters
    ----------
    half_width : ndarray
        a of the contact, below lambda / 2. [length]
    amplitude, wavelength : float
        Delta and lambda of Delta cos(2 pi x / lambda). [length]
    work_of_adhesion : float
        w. [energy / length²]
    E_star : float
        Contact modulus. [pressure]
    """
    positive(work_of_adhesion=work_of_adhesion)
    pushed = westergaard.mean_pressure(half_width, amplitude, wavelength, E_star)
    full = westergaard.full_contact_pressure(amplitude, wavelength, E_star)
    alpha = np.sqrt(2 * work_of_adhesion * wavelength / (pi**2 * E_star * amplitude**2))
    return pushed - full * alpha * np.sqrt(np.tan(pi * half_width / wavelength))
