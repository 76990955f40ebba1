"""Criteria of stickiness: whether rough bodies stick, from the spectrum of their roughness.

References
----------
.. [1] B. N. J. Persson and E. Tosatti, "The effect of surface roughness on the adhesion of elastic
   solids", J. Chem. Phys. 115, 5597-5610 (2001).
.. [2] L. Pastewka and M. O. Robbins, "Contact between rough surfaces and a criterion for
   macroscopic adhesion", PNAS 111, 3298-3303 (2014), eq. 10.
.. [3] J. M. Monti, A. Sanner and L. Pastewka, "Distribution of gaps and adhesive interaction
   between contacting rough surfaces", Tribol. Lett. 69, 80 (2021).
.. [4] S. Dalvi, A. Gujrati, S. R. Khanal, L. Pastewka, A. Dhinojwala and T. D. B. Jacobs, "Linking
   energy loss in soft adhesion to surface roughness", PNAS 116, 25484-25490 (2019).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from scipy import special

from roughline.errors.checks import positive
from roughline.errors.public import public
from roughline.spectra.moments import (
    SurfaceOrSpectrum,
    bands,
    continuum_note,
    refuse_no_roughness,
)


@dataclass(frozen=True)
class Criterion:
    """What one criterion says.

    Attributes
    ----------
    name, source : str
        Its authors, and where they state it.
    number : float
        What it compares with 1: the bodies stick where it is smaller. [1]
    validity : str
        Where it holds.
    """

    name: str
    source: str
    number: float
    validity: str

    @property
    def sticky(self) -> bool:
        """Whether the bodies stick, as this criterion has it."""
        return self.number < 1


@dataclass(frozen=True)
class Stickiness:
    """What criteria say of the stickiness of a roughness.

    Attributes
    ----------
    conformal_energy : float
        Elastic energy of full contact over the nominal area, U_el / A_0. [energy / length²]
    roughened_area : float
        Area of the rough surface over the nominal area, A_true / A_0. [1]
    apparent_work_of_adhesion : float
        Work w A_true / A_0 - U_el / A_0 that full contact yields; it does not come about where this
        is negative. [energy / length²]
    criteria : tuple of Criterion
        Those of Persson and Tosatti, of Pastewka and Robbins, and of Dalvi and others.
    """

    conformal_energy: float
    roughened_area: float
    apparent_work_of_adhesion: float
    criteria: tuple[Criterion, Criterion, Criterion]


@public
def stickiness(
    roughness: SurfaceOrSpectrum,
    E_star: float,
    work_of_adhesion: float,
    range: float,  # noqa: A002 as the laws of adhesion call it
) -> Stickiness:
    """Ask three criteria whether a roughness sticks.

    Two compare energies. Full contact stores ``U_el / A_0 = (E* / 4) sum of |q| |h_q|²`` and sets
    free w [1]_, or w A_true / A_0 where the area is counted that the roughness has [3]_. One
    compares forces at the edges of small contacts: bodies stick where
    ``(h' E* r / (2 w)) (h'² / (h'' r))^(2/3) < 1`` with the rms slope h', the rms curvature h'',
    which is half the Laplacian, and the range r [2]_.

    Parameters
    ----------
    roughness : Surface, LatticeSpectrum, IsotropicSpectrum, ContinuumSpectrum or SelfAffine
        What :func:`~roughline.theory` takes. [length]
    E_star : float
        Contact modulus. [pressure]
    work_of_adhesion : float
        w, the work to separate a unit of area of smooth bodies. [energy / length²]
    range : float
        r, the length across which the bodies pull each other. [length]

    Returns
    -------
    Stickiness
        Three criteria, each with its number, source and validity, and the energies.

    Raises
    ------
    InputError
        If a number is not positive and finite, the surface is flat, or the spectrum has no upper
        end.

    References
    ----------
    .. [1] B. N. J. Persson and E. Tosatti, J. Chem. Phys. 115, 5597 (2001).
    .. [2] L. Pastewka and M. O. Robbins, PNAS 111, 3298 (2014), eq. 10, with the numbers 2 for the
       area at a load and 4 h' / h'' for the diameter of contacts.
    .. [3] S. Dalvi and others, PNAS 116, 25484 (2019).

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> found = rl.stickiness(surface, E_star=1.0, work_of_adhesion=1e-3, range=1e-3)
    >>> for criterion in found.criteria:
    ...     print(criterion.name, round(criterion.number, 2), criterion.sticky)
    Persson and Tosatti 0.87 True
    Pastewka and Robbins 0.93 True
    Dalvi and others 0.8 True
    """
    refuse_no_roughness(roughness)
    positive("E_star", E_star, "a positive, finite contact modulus is needed")
    positive("work_of_adhesion", work_of_adhesion, "a positive, finite work of adhesion is needed")
    positive("range", range, "a positive, finite length is needed")
    waves = bands(roughness)
    energy = E_star / 4 * float((waves.q * waves.power).sum())
    slope = math.sqrt(float((waves.q**2 * waves.power).sum()))
    curvature = math.sqrt(float((waves.q**4 * waves.power).sum())) / 2
    area = _roughened_area(slope)
    criteria = (
        _persson_tosatti(energy / work_of_adhesion),
        _pastewka_robbins(slope, curvature, E_star / work_of_adhesion, range),
        _dalvi(energy / (work_of_adhesion * area)),
    )
    remark = continuum_note(roughness)
    first, second, third = (replace(each, validity=each.validity + remark) for each in criteria)
    return Stickiness(energy, area, work_of_adhesion * area - energy, (first, second, third))


def _persson_tosatti(number: float) -> Criterion:
    """Energy of full contact over the work of adhesion."""
    return Criterion(
        "Persson and Tosatti",
        "J. Chem. Phys. 115, 5597 (2001)",
        number,
        "full contact, where its elastic energy is below w; bodies that fail may still stick where "
        "they touch in part; the energy goes with the longest waves for Hurst exponents above 1/2, "
        "with the shortest below",
    )


def _pastewka_robbins(
    slope: float, curvature: float, stiffness_over_work: float, reach: float
) -> Criterion:
    """Repulsion within small contacts over the pull about their edges."""
    number = slope * stiffness_over_work * reach / 2 * (slope**2 / (curvature * reach)) ** (2 / 3)
    widest = 16 / 3 * slope**2 / curvature  # gap as far from a contact as it is wide [3]
    return Criterion(
        "Pastewka and Robbins",
        "PNAS 111, 3298 (2014), eq. 10",
        number,
        "isotropic random surfaces, small contact areas that the pull changes little, and ranges "
        f"below 0.1 g, g = 16 h'² / (3 h''); here the range is {reach / widest:.2g} g; the number "
        "goes with the shortest waves, as q_high^(1 - 5 H / 3)",
    )


def _dalvi(number: float) -> Criterion:
    """Energy of full contact over the work of adhesion on the area of the roughness."""
    return Criterion(
        "Dalvi and others",
        "PNAS 116, 25484 (2019)",
        number,
        "full contact of a soft body that comes nearer, where its elastic energy is below w on the "
        "area of the roughness, which is that of Gaussian surfaces; bodies that part do so with "
        "more work",
    )


def _roughened_area(slope: float) -> float:
    """Mean of sqrt(1 + |grad h|²) over gradients of which both components are Gaussian."""
    return 1 + math.sqrt(math.pi) / 2 * slope * float(special.erfcx(1 / slope))
