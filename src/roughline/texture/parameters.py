"""The parameters of ISO 25178-2 and ISO 21920-2, each declared once.

Tables, JSON, the notebook and the handbook read what is declared here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

LEAST_HILL = 0.05
"""Height of the least hill that counts, over the maximum height (Wolf pruning). [1]"""

DECAYED = 0.2
"""Value of the autocorrelation down to which the autocorrelation length reaches. [1]"""

PEAKS, PITS = 0.10, 0.80
"""Material ratios between which the core of the volume parameters lies. [1]"""

_UNITS = {
    "length": "{}",
    "1/length": "1/{}",
    "1/length²": "1/{}²",
    "1": "1",
    "%": "%",
    "°": "°",
}
"""Units by dimension; lengths stand in the brackets."""

AREAL, PROFILE = "ISO 25178-2:2021", "ISO 21920-2:2021"


@dataclass(frozen=True)
class Parameter:
    """One parameter of surface texture."""

    name: str  # its symbol in the standard, and the name of its value
    dimension: str  # "length", "1/length", "1/length²", "1", "%" or "°"
    meaning: str  # what it is, in a few words
    standard: str
    clause: str  # of the standard
    group: str  # what it tells of the surface
    formerly: str = ""  # its symbol in the edition before, where that was another

    def unit_in(self, length_unit: str | None) -> str:
        """Return the unit where lengths have this one; where it is not known, "length"."""
        return _UNITS[self.dimension].format(length_unit or "length")


def _declare(standard: str, group: str, *rows: tuple[str, ...]) -> list[Parameter]:
    """Declare the parameters of a group: name, dimension, clause, meaning, perhaps former name."""
    return [
        Parameter(name, dimension, meaning, standard, clause, group, *former)
        for name, dimension, clause, meaning, *former in rows
    ]


_SURFACE_PARAMETERS = (
    *_declare(
        AREAL,
        "heights",
        ("Sq", "length", "4.2.2", "root mean square height"),
        ("Ssk", "1", "4.2.3", "skewness; 0 for Gaussian heights"),
        ("Sku", "1", "4.2.4", "kurtosis; 3 for Gaussian heights"),
        ("Sp", "length", "4.2.5", "maximum peak height above the mean plane"),
        ("Sv", "length", "4.2.6", "maximum pit depth below the mean plane"),
        ("Sz", "length", "4.2.7", "maximum height, Sp + Sv"),
        ("Sa", "length", "4.2.8", "arithmetic mean height"),
    ),
    *_declare(
        AREAL,
        "waves",
        ("Sal", "length", "4.3.2", f"least lag at which the autocorrelation is {DECAYED}"),
        ("Str", "1", "4.3.3", "least over largest such lag of all directions"),
        ("Std", "°", "4.3.4", "direction of the strongest waves, across the lay"),
    ),
    *_declare(
        AREAL,
        "slopes",
        ("Sdq", "1", "4.4.2", "root mean square gradient, from forward differences"),
        ("Sdr", "%", "4.4.3", "developed interfacial area over the nominal one, less 1"),
    ),
    *_declare(
        AREAL,
        "material ratio",
        ("Sk", "length", "4.5.4", "core height"),
        ("Spk", "length", "4.5.4", "reduced peak height"),
        ("Svk", "length", "4.5.4", "reduced pit depth"),
        ("Smrk1", "%", "4.5.4", "material ratio where hills pass into the core", "Smr1"),
        ("Smrk2", "%", "4.5.4", "material ratio where the core passes into dales", "Smr2"),
        ("Vmp", "length", "4.5", f"material volume of the peaks, above {PEAKS:.0%}, over the area"),
        ("Vmc", "length", "4.5", f"material volume of the core, {PEAKS:.0%} to {PITS:.0%}"),
        ("Vvc", "length", "4.5", f"void volume of the core, {PEAKS:.0%} to {PITS:.0%}"),
        ("Vvv", "length", "4.5", f"void volume of the pits, below {PITS:.0%}"),
    ),
    *_declare(
        AREAL,
        "peaks",
        ("Spd", "1/length²", "5.8.2", f"density of peaks higher than {LEAST_HILL:.0%} of Sz"),
        ("Spc", "1/length", "5.8.4", "arithmetic mean of their curvatures"),
    ),
)

_PROFILE_PARAMETERS = (
    *_declare(
        PROFILE,
        "heights",
        ("Ra", "length", "4.2.2", "arithmetic mean height"),
        ("Rq", "length", "4.2.3", "root mean square height"),
        ("Rsk", "1", "4.2.4", "skewness; 0 for Gaussian heights"),
        ("Rku", "1", "4.2.5", "kurtosis; 3 for Gaussian heights"),
        ("Rt", "length", "4.2.6", "total height over the evaluation length"),
        ("Rp", "length", "5.1", "mean over the sections of their largest peak height"),
        ("Rv", "length", "5.1", "mean over the sections of their largest pit depth"),
        ("Rz", "length", "5.1", "mean over the sections of their height, Rp + Rv"),
    ),
    *_declare(
        PROFILE,
        "slopes and spacings",
        ("RSm", "length", "5", "mean spacing of profile elements, a hill with a dale"),
        ("Rdq", "1", "4.4.2", "root mean square gradient, from forward differences"),
        ("Rdr", "%", "4.4.6", "developed length over the evaluation length, less 1"),
    ),
    *_declare(
        PROFILE,
        "material ratio",
        ("Rk", "length", "4.5.3", "core height"),
        ("Rpk", "length", "4.5.3", "reduced peak height"),
        ("Rvk", "length", "4.5.3", "reduced pit depth"),
        ("Rmrk1", "%", "4.5.3", "material ratio where hills pass into the core", "Mr1"),
        ("Rmrk2", "%", "4.5.3", "material ratio where the core passes into dales", "Mr2"),
    ),
)

SURFACE_PARAMETERS: Mapping[str, Parameter] = {each.name: each for each in _SURFACE_PARAMETERS}
"""Parameters of a surface by name, in the order in which people read them."""

PROFILE_PARAMETERS: Mapping[str, Parameter] = {each.name: each for each in _PROFILE_PARAMETERS}
"""Parameters of a profile by name, in the order in which people read them."""
