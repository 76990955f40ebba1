"""A bulk material: its properties for contact stiffness, conductance and ultrasound."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from roughline.errors import InputError, UnitWarning
from roughline.errors.earlier import refuse_part
from roughline.errors.public import public
from roughline.halfspace.elasticity.half_space import HalfSpace, Periodic
from roughline.halfspace.elasticity.homogeneous import Homogeneous

_SOFTEST = 1e3  # Young's modulus that solids have at least, but for the softest gels [Pa]


@public
@dataclass(frozen=True)
class Material:
    """An isotropic bulk material at room temperature.

    Parameters
    ----------
    name : str
        Name of the material.
    E : float
        Young's modulus; infinite for a rigid body. [Pa]
    nu : float
        Poisson's ratio, -1 to 0.5. [1]
    hardness : float, optional
        Indentation hardness of the surface. [Pa]
    resistivity : float, optional
        Electrical resistivity. [ohm m]
    conductivity : float, optional
        Thermal conductivity. [W / (m K)]
    density : float, optional
        Mass density. [kg / m³]
    source : str, optional
        Where the values come from.
    hardness_factor : float, optional
        Factor by which the hardness H is uncertain: it lies between H / factor and H * factor.
        Hardnesses of the table are uncertain, as hardness varies with heat treatment, cold work
        and depth; a given one is taken as exact. [1]
    layer_E, layer_hardness : str, optional
        What layers of it have instead, such as "100 to 760 GPa", where the value is of something
        else: of bulk crystals, of annealed metal, or of one film. Empty where that is not known,
        or the value is given.

    Raises
    ------
    InputError
        If a value is outside its range.

    Warns
    -----
    UnitWarning
        If E is below 1 kPa, as it is where GPa or MPa were taken for its unit.
    """

    name: str
    E: float
    nu: float
    hardness: float | None = None
    resistivity: float | None = None
    conductivity: float | None = None
    density: float | None = None
    source: str = "given by the user"
    hardness_factor: float = 1.0
    layer_E: str = ""
    layer_hardness: str = ""

    def __post_init__(self) -> None:
        if not self.E > 0:
            raise InputError(f"E of {self.name} is {self.E}; a positive modulus is needed")
        if self.E < _SOFTEST:
            warnings.warn(
                f"E of {self.name} is {self.E:g} Pa, softer than the softest gels: check its unit, "
                'such as E=210e9, or rl.material("E=210 GPa nu=0.3")',
                UnitWarning,
                stacklevel=4,
            )
        if not -1 < self.nu <= 0.5:
            raise InputError(f"nu of {self.name} is {self.nu}; allowed is -1 to 0.5")
        for name in ("hardness", "resistivity", "conductivity", "density"):
            value = getattr(self, name)
            if value is not None and not 0 < value < math.inf:
                raise InputError(
                    f"{name} of {self.name} is {value}; a positive, finite number is needed"
                )

        if not 1 <= self.hardness_factor < math.inf:
            raise InputError(
                f"hardness_factor of {self.name} is {self.hardness_factor}; 1 or more is needed"
            )

    if not TYPE_CHECKING:  # checkers know what there is

        def __getattr__(self, name):
            refuse_part("material", name, type(self).__name__)

    @property
    def surface(self) -> Material:
        """What lies at the surface: the material itself."""
        return self

    @property
    def materials(self) -> tuple[Material]:
        """The material itself."""
        return (self,)

    @property
    def thicknesses(self) -> tuple[float, ...]:
        """None, as there is no layer. [m]"""
        return ()

    def half_space(self, *, periodic: Periodic = False) -> HalfSpace:
        """Return a body of it, pressed by a rigid one; a rigid body is none."""
        return Homogeneous(self.E / (1 - self.nu**2), periodic)

    def with_hardness(self, hardness: float) -> Material:
        """Return the same with a hardness that is known exactly [Pa]; a rigid body has none."""
        if math.isinf(self.E):
            return self
        source = f"{self.source}; hardness given"
        return replace(
            self, hardness=hardness, hardness_factor=1.0, layer_hardness="", source=source
        )

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + nu)). [Pa]"""
        return self.E / (2 * (1 + self.nu))

    @property
    def carries_sound(self) -> bool:
        """Whether longitudinal waves have a finite speed: not in rigid or incompressible bodies."""
        return not math.isinf(self.E) and self.nu != 0.5

    @property
    def impedance(self) -> float | None:
        """Acoustic impedance of longitudinal waves, density times their speed. [kg / (m² s)]

        None without a density, and for a rigid or an incompressible material.
        """
        if self.density is None or not self.carries_sound:
            return None
        nu = self.nu
        return math.sqrt(self.density * self.E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)))
