"""The state of the view "Explore": what is generated, and how it is pressed."""

from __future__ import annotations

from dataclasses import dataclass, fields

from roughline.lab.controls import VERSION, as_text
from roughline.lab.explore import controls as c
from roughline.units import in_si


@dataclass(frozen=True)
class ExploreState:
    """What is generated and pressed.

    Attributes
    ----------
    D_f : float
        Fractal dimension. [1]
    roll_off, cutoff : float
        Wavelengths, in sides of the surface. [1]
    rms : {"height", "slope"}
        Which of `h` and `slope` counts.
    h, slope : float
        Rms height in sides of the surface, and rms slope. [1]
    seed : int
        Of the phases.
    n : int
        Points along a side.
    boundary : {"free", "periodic"}
        Of the half-space.
    hardness_bar : float or None
        Hardness H / (E* ∇h), over the rms slope on the grid; None if both bodies are elastic. [1]
    F : float
        Dimensionless force F / (E* h L). [1]
    shown : str
        What the second map shows.
    L, E : str
        Side of the surface and contact modulus, with units: what lengths and forces are told in.
    theories : tuple of str
        Drawn beside the curve.
    """

    D_f: float = c.D_F.default
    roll_off: float = c.ROLL_OFF.default
    cutoff: float = c.CUTOFF.default
    rms: str = c.ROUGHNESS.default
    h: float = c.HEIGHT.default
    slope: float = c.SLOPE.default
    seed: int = int(c.SEED.default)
    n: int = int(c.POINTS.default)
    boundary: str = c.BOUNDARY.default
    hardness_bar: float | None = None
    F: float = c.FORCE.default
    shown: str = c.SHOWN.default
    L: str = "1 mm"
    E: str = "110 GPa"
    theories: tuple[str, ...] = ()

    @property
    def length(self) -> float:
        """Side of the surface. [m]"""
        return in_si(self.L, "m", "side of the surface")

    @property
    def E_star(self) -> float:
        """Contact modulus. [Pa]"""
        return in_si(self.E, "Pa", "contact modulus")

    @property
    def periodic(self) -> bool:
        """Whether the surface is repeated."""
        return self.boundary == "periodic"

    @property
    def hurst(self) -> float:
        """H = 3 - D_f. [1]"""
        return round(3 - self.D_f, 12)

    @property
    def shortest(self) -> float:
        """Shortest wave that the grid carries, two spacings, in sides of the surface. [1]"""
        return 2 / self.n

    @property
    def cutoff_used(self) -> float:
        """Shortest wave of the surface, in its sides: the cutoff, or what the grid carries. [1]"""
        return max(self.cutoff, self.shortest)

    def texts(self) -> dict[str, str]:
        """All that is set, as texts by the keys of the controls."""
        return {each.name: _in_address(getattr(self, each.name)) for each in fields(self)}

    def address(self) -> dict[str, str]:
        """What the address says of this state: the version, and what is not the default."""
        default = ExploreState().texts()
        said = {
            key: text
            for key, text in self.texts().items()
            if text != default[key] or key in ("D_f", "F", "n", "seed")
        }
        return {"v": VERSION, **said}


def _in_address(value: object) -> str:
    if isinstance(value, tuple):
        return ",".join(value)
    if value is None:
        return ""
    return as_text(value) if isinstance(value, float) else str(value)
