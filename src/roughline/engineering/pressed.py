"""What answers are worked out from: a pressed body, two materials, and the area that is meant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.measures import Measured
from roughline.contact.separation import Separation
from roughline.contact.status import Status
from roughline.engineering.attraction import Attraction
from roughline.engineering.intervals import Ends, Intervals
from roughline.engineering.pair import MaterialPair
from roughline.engineering.sealing import Closing, Fluid
from roughline.engineering.slip import PartialSlip, ShearCycles
from roughline.facts.fact import Fact


@dataclass(frozen=True, eq=False)
class InterfaceStiffness:
    """Stiffness of the interface alone, without that of the bodies around it."""

    values: Real  # (loads,) [N / m]
    ends: Ends | None  # of its interval; None where it is not known [N / m]
    place: Fact  # which interface it is
    formula: str  # how it was found
    warned_from: float = 0.0
    """Share of 1 / k_u that it leaves to the bodies, from which a warning says which it is. [1]"""

    @property
    def rows(self) -> Real:
        """Values, and both ends where they are known, (1 or 3, loads). [N / m]"""
        return np.stack([self.values, *(self.ends or ())])

    @property
    def without_interval(self) -> InterfaceStiffness:
        """Stiffness without its interval."""
        return replace(self, ends=None)


@dataclass(frozen=True, eq=False)
class Sought:
    """What was sought beyond the loads, as far as that was asked for."""

    closing: Closing | None = None  # at which pressure the gap seals, and down to which it does
    separation: Separation | None = None  # what it takes to draw bodies apart that stick
    slip: PartialSlip | None = None  # of the largest load, before the bodies slide
    sheared: ShearCycles | None = None  # what a shear force to and fro does


@dataclass(frozen=True, eq=False)
class Pressed:
    """A pressed body as rules see it. Quantities "in rows" have shape (1 or 3, loads).

    The rows are the values and, where they are known, both ends of their interval. With a joint,
    all quantities are those of the joint, of which the body is a map under the same mean pressure.

    Attributes
    ----------
    curve : Curve
        Of the body, in SI units, with the contact modulus of the pair.
    area : float
        Nominal area of the body. [m²]
    pair : MaterialPair
        The materials.
    joint : float, optional
        Nominal area of the joint. [m²]
    interface : Interface, optional
        Of a free surface, of one that was cut out of a larger one, or of a joint. Without it, as
        for a periodic surface, the contact is the interface.
    rms_height, rms_slope : float, optional
        Of the sum of both surfaces. [m], [1]
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    intervals : Intervals, optional
        Of the curve.
    hardest : float, optional
        The hardest that the softer body may be; None where no hardness is taken. [Pa]
    has_depths : bool, optional
        Whether depths were given, so that forces depend on the hardness.
    measured : mapping of str to Measured
        What rules need from the fields of every load, with what the grid and filled points leave
        open: of the map in a periodic half-space where it was cut out of a larger surface.
    is_repeated : bool, optional
        Whether these are of a periodic contact.
    place : Fact, optional
        Which surface the intervals of measures are of; None for that of the map alone.
    sealing : Fluid, optional
        What is asked of a fluid in the gap.
    load_on_body : ndarray, shape (loads,), optional
        Force on the body, of which a fluid carries what the body does not press with; known of
        loads under which the fluid lifts it, too. Default: the force of the curve. [N]
    attraction : Attraction, optional
        How the bodies attract each other; None if they only push.
    sought : Sought, optional
        What was sought beyond the loads.
    fields : Fields, optional
        Of one load: the largest, or one that shows the contact well.
    """

    curve: Curve
    area: float
    pair: MaterialPair
    joint: float | None = None
    interface: InterfaceStiffness | None = None
    rms_height: float | None = None
    rms_slope: float | None = None
    frequency: float | None = None
    intervals: Intervals | None = None
    hardest: float | None = None
    has_depths: bool = False
    measured: Mapping[str, Measured] = field(default_factory=dict)
    is_repeated: bool = False
    place: Fact | None = None
    sealing: Fluid | None = None
    load_on_body: Real | None = None
    attraction: Attraction | None = None
    sought: Sought = field(default_factory=Sought)
    fields: Fields | None = None

    @property
    def nominal_area(self) -> float:
        """Nominal area A_0 that the answers are of. [m²]"""
        return self.area if self.joint is None else self.joint

    @property
    def scale(self) -> float:
        """How many times larger the joint is than the body; 1 without one."""
        return self.nominal_area / self.area

    @property
    def known(self) -> Mask:
        """Loads that were solved, and under which the interface's stiffness is known, (loads,)."""
        return self.curve.converged & ~np.isnan(self.interface_stiffness[0])

    @property
    def force(self) -> Real:
        """Force with which the bodies press, (loads,). [N]"""
        return self.curve.force * self.scale

    @property
    def pressure(self) -> Real:
        """Mean pressure over the nominal area with which the bodies press, (loads,). [Pa]"""
        return self.curve.force / self.area

    @property
    def load(self) -> Real:
        """Normal force F: what the bodies press with, and what a fluid carries, (loads,). [N]"""
        on_body = self.curve.force if self.load_on_body is None else self.load_on_body
        return on_body * self.scale

    @property
    def load_pressure(self) -> Real:
        """Mean pressure p of the load over the nominal area, (loads,). [Pa]"""
        on_body = self.curve.force if self.load_on_body is None else self.load_on_body
        return on_body / self.area

    @property
    def lifted(self) -> Mask:
        """Loads under which a fluid lifts the bodies apart, (loads,)."""
        return self.curve.status == Status.LIFTED

    @property
    def loading(self) -> Real:
        """Contact stiffness on further loading, in rows. [N / m]"""
        ends = self.intervals.stiffness if self.intervals else ()
        return np.stack([self.curve.stiffness, *ends]) * self.scale

    @property
    def unloading(self) -> Real:
        """Contact stiffness on unloading k_u, in rows; of a line, which has no yield, k. [N / m]"""
        if not isinstance(self.curve, SurfaceCurve):
            return self.loading
        ends = self.intervals.unloading if self.intervals else ()
        return np.stack([self.curve.unloading_stiffness, *ends]) * self.scale

    @property
    def interface_stiffness(self) -> Real:
        """Stiffness of the interface alone k_i, on unloading, in rows. [N / m]"""
        return self.unloading if self.interface is None else self.interface.rows * self.scale

    @property
    def interface_note(self) -> str:
        """Says which interface is meant, after a semicolon; nothing where there is but one."""
        return "" if self.interface is None else f"; k_i {self.interface.place}"

    @property
    def area_fraction(self) -> Real | None:
        """Corrected contact area fraction, in rows; None where the model has no area. [1]"""
        if not isinstance(self.curve, SurfaceCurve):
            return None
        ends = self.intervals.area if self.intervals else None
        return np.stack([self.curve.area_fraction_corrected, *(ends or ())])

    def by_hardness_alone(self, values: Real) -> Real:
        """Values that the hardness enters by their formula, and nothing else leaves open, in rows.

        They stand without an interval where all others do, and where the hardness does not scatter.
        """
        scatters = self.hardest is not None and self.hardest != self.curve.hardness
        return np.stack([values] * 3) if scatters and self.intervals is not None else values

    def measure(self, name: str) -> Real | None:
        """A measure by its name, in rows; None where it was not taken, as of a line."""
        found = self.measured.get(name)
        return None if found is None else found.rows

    @property
    def hardness(self) -> float | None:
        """Hardness of the softer body, whether points may yield or not; None if unknown. [Pa]"""
        return self.curve.hardness or self.pair.hardness

    @property
    def may_yield(self) -> bool:
        """Whether points that reach the hardness yield."""
        return self.curve.hardness is not None

    @property
    def tells_unloading(self) -> bool:
        """Whether the stiffness on unloading has a name of its own.

        It has where points may yield, and for elastic bodies that are compared with such.
        """
        return self.may_yield or self.hardest is not None

    @property
    def yielded(self) -> SurfaceCurve | None:
        """The curve, where points may yield; None where bodies are elastic."""
        return self.curve if self.may_yield and isinstance(self.curve, SurfaceCurve) else None

    @property
    def yields(self) -> bool:
        """Whether some of the contact is at the hardness, under any load."""
        return yields(self.curve)

    @property
    def symbols(self) -> dict[str, str]:
        """What k_u and k_i are called here.

        Where nothing is known of yield, all of the contact springs back on further loading as well,
        and k stands for k_u; of a joint, k_i does; of a periodic surface k_u, or k, stands for k_i.
        """
        contact = "k_u" if self.tells_unloading else "k"
        if self.joint is not None:
            contact = "k_i"
        return {"k_u": contact, "k_i": contact if self.interface is None else "k_i"}


def yields(curve: Curve) -> bool:
    """Whether some of the contact of a curve is at the hardness, under any load."""
    if not isinstance(curve, SurfaceCurve):
        return False
    return bool(np.nan_to_num(curve.plastic_fraction).any())
