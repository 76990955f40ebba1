"""What pressing a body gave: its curve with intervals, and what follows from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.computing.notebook import in_notebook, printed
from roughline.computing.summary import summary
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.measures import Measured
from roughline.contact.selection import at_loads, first_fields
from roughline.contact.status import Status
from roughline.engineering.intervals import Ends, Intervals, taken
from roughline.engineering.pressed import Sought
from roughline.engineering.rule import Answer
from roughline.engineering.slip import PartialSlip
from roughline.facts.fact import Fact, WithFacts
from roughline.fluid.flow import Flow, flow
from roughline.margins.larger_surface import LargerSurface
from roughline.measurement.roughness import Roughness, roughness
from roughline.question.kinds import nominal_area
from roughline.question.question import Question
from roughline.question.source import Topography
from roughline.texture.iso import IsoParameters, iso
from roughline.theories.theory_curve import TheoryCurve
from roughline.topography.body import Body, Surface

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False)
class Assessment(WithFacts):
    """What pressing a body gave, and what follows from it.

    Attributes
    ----------
    question : Question
        What was asked.
    topographies : sequence of Topography
        Of the first body and, if that is rough, of the second, prepared. [m]
    body : Surface or Line
        What was pressed: the sum of two surfaces, or the first body. [m]
    curve : Curve
        Its curve, with the forces with which it presses; a load that did not converge is marked.
        One load has its fields, if they were asked for.
    asked : ndarray of int
        Which loads of the curve were asked for, in the order in which they were.
    intervals : Intervals or None
        Of the curve, over its loads: the uncertainty due to the grid, to filled points and to the
        scatter of the hardness, or to a single line scan. None where the grid's error is not known.
    interrupted : bool
        Whether Ctrl-C came before all loads were solved and their errors estimated.
    answers : mapping of str to Answer
        By their keys, such as "contact_stiffness", for the two materials, over the loads that were
        asked for; empty without materials.
    left_out : sequence of Fact
        Which answers there are not, and why.
    elastic : mapping of str to Answer
        The same without yield; empty where nothing yields.
    hardness_scatter : mapping of str to tuple of ndarray
        By the keys of the answers, the least and the largest ratio of each to its value while the
        hardness is varied; the intervals include it. Empty where the hardness is taken as exact.
    measured : mapping of str to Measured
        What answers need from the fields of every load, over the loads of the curve; of the map
        pressed periodically where answers are about the surface that it was cut out of.
    on_filled : ndarray, shape (loads,), or None
        Share of the force that stands on points that were missing and filled, over the loads of the
        curve; None where none was filled, or where it is not known which. [1]
    fields_of_gap : Fields or None
        Of one load, in the contact that `measured` is of; None if they were not asked for, or the
        load was not solved.
    sought : Sought
        What was sought beyond the loads, as far as that was asked for: at which mean pressure the
        gap of the map seals (``closing``), what it takes to draw bodies apart that stick
        (``separation``), how they slip before they slide (``slip``), and what a shear force to and
        fro does (``sheared``).
    theories : sequence of TheoryCurve
        At the mean pressures of the loads that were solved, rising, each once.
    facts : sequence of Fact
        What is worth telling, warnings first: where an assumption breaks, what is suspicious, and
        why there are no intervals; what is left out, what was filled, and how the loads were meant.
    """

    question: Question
    topographies: Sequence[Topography]
    body: Body
    curve: Curve
    asked: Indices
    intervals: Intervals | None = None
    interrupted: bool = False
    answers: Mapping[str, Answer] = field(default_factory=dict)
    left_out: Sequence[Fact] = ()
    elastic: Mapping[str, Answer] = field(default_factory=dict)
    hardness_scatter: Mapping[str, Ends] = field(default_factory=dict)
    larger: LargerSurface | None = None
    measured: Mapping[str, Measured] = field(default_factory=dict)
    on_filled: Real | None = None
    fields_of_gap: Fields | None = None
    sought: Sought = field(default_factory=Sought)
    theories: Sequence[TheoryCurve] = ()
    facts: Sequence[Fact] = ()

    __repr__ = summary
    __str__ = printed
    _repr_html_ = in_notebook

    @property
    def area(self) -> float:
        """Nominal area; of a line scan, the square of its length. [m²]"""
        return nominal_area(self.body)

    @property
    def scale(self) -> float:
        """Force and stiffness of the joint over those of the curve; 1 without a joint."""
        return self.question.loading.scale(self.area)

    @property
    def partial_slip(self) -> PartialSlip | None:
        """At the largest load, if a coefficient of friction was given and that load was solved."""
        return self.sought.slip

    @cached_property
    def roughness(self) -> Roughness | None:
        """Roughness parameters of the body; None for a reduced line, which is no topography."""
        if isinstance(self.body, Surface) or self.body.kind == "profile":
            return roughness(self.body)
        return None

    @cached_property
    def texture(self) -> IsoParameters | None:
        """Parameters of ISO 25178-2 or ISO 21920-2 of the body; None for a reduced line."""
        if isinstance(self.body, Surface) or self.body.kind == "profile":
            return iso(self.body)
        return None

    @property
    def headings(self) -> list[str]:
        """What each load that was asked for is called: as it was typed, or its number."""
        return self.question.loading.names_of_loads(self.asked.tolist())

    @property
    def largest(self) -> int:
        """Which of the loads that were asked for is the largest, by its number among them."""
        named = self.question.loading.forces(self.area) or self.question.loading.heights()
        return int(np.argmax(named)) if named else self.asked.size - 1

    @property
    def fields(self) -> Fields | None:
        """Fields of one load; None if they were not asked for, or the load was not solved."""
        return first_fields(self.curve)

    @cached_property
    def flows(self) -> Sequence[Flow]:
        """What flows through the gap of `fields_of_gap`, for each direction that is asked for.

        There are none without a fluid or without fields.
        """
        fields, sealing = self.fields_of_gap, self.question.sealing
        if fields is None or sealing is None:
            return ()
        through = flow(fields, along=sealing.along, mean_free_path=sealing.free_path)
        return through if isinstance(through, tuple) else (through,)

    @property
    def is_solved(self) -> bool:
        """Whether all loads were solved, but for those under which a fluid lifts the bodies."""
        if self.question.shear is not None and self.sought.sheared is None:
            return False
        return bool((self.curve.converged | (self.curve.status == Status.LIFTED)).all())

    def load_on(self, force: Real) -> Real:
        """Force on a body that presses with some: with what a fluid carries. [N]"""
        sealing = self.question.sealing
        return force if sealing is None else sealing.load_on(force, self.area)

    @property
    def curve_over_loads(self) -> Curve:
        """The curve over forces on the body, of which a fluid may carry a part."""
        return replace(self.curve, force=self.load_on(self.curve.force))

    @property
    def curve_as_asked(self) -> Curve:
        """The curve at the loads that were asked for, in their order, without fields."""
        return at_loads(self.curve, self.asked)

    @property
    def intervals_as_asked(self) -> Intervals | None:
        """Intervals of the curve at the loads that were asked for."""
        return taken(self.intervals, self.asked)

    @property
    def stiffness_interval(self) -> Ends | None:
        """Both ends of the stiffness on further loading, over the loads of the curve. [N / m]"""
        return None if self.intervals is None else self.intervals.stiffness

    @property
    def unloading_interval(self) -> Ends | None:
        """Both ends of the stiffness on unloading, over the loads of the curve. [N / m]"""
        return None if self.intervals is None else self.intervals.unloading

    @property
    def area_interval(self) -> Ends | None:
        """Both ends of the corrected area fraction, over the loads of the curve. [1]"""
        return None if self.intervals is None else self.intervals.area

    def to_dataframe(self) -> pandas.DataFrame:
        """Return the answers as a table of pandas, a row for each load that was asked for.

        Of each answer there is a column with its key, and, where its interval is known, one more
        for each end, "..._low" and "..._high". Without materials there are the quantities of the
        curve. All are in SI units; ``attrs["units"]`` tells them by the columns.
        """
        import pandas  # here because it loads slowly

        if self.answers:
            columns = {key: (each.rows, each.unit) for key, each in self.answers.items()}
        else:
            columns = self._columns_of_curve
        table, units = {}, {}
        for key, (rows, unit) in columns.items():
            for name, row in zip((key, f"{key}_low", f"{key}_high"), rows, strict=False):
                table[name], units[name] = row, unit
        found = pandas.DataFrame(table, index=pandas.Index(self.headings, name="load"))
        found.attrs["units"] = units
        return found

    @property
    def _columns_of_curve(self) -> dict[str, tuple[Real, str]]:
        """Quantities of the curve, or of the joint, with their intervals and units."""
        curve, known = self.curve_as_asked, self.intervals_as_asked
        stiffness, area = (None, None) if known is None else (known.stiffness, known.area)
        columns = {
            "depth": (np.stack([curve.depth]), "m"),
            "force": (self.scale * np.stack([curve.force]), "N"),
            "stiffness": (self.scale * np.stack([curve.stiffness, *(stiffness or ())]), "N/m"),
        }
        if isinstance(curve, SurfaceCurve):
            share = np.stack([curve.area_fraction_corrected, *(area or ())])
            columns["area_fraction_corrected"] = share, "1"
        return columns

    @property
    def settings(self) -> dict[str, Any]:
        """Everything that the numbers depend on, by name."""
        return {"E_star": self.curve.E_star, **self.curve.settings}
