"""The result of pressing a body: depth, force, stiffness and real contact area over the loads."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Mask, Real
from roughline.computing.notebook import in_notebook
from roughline.contact import scaling
from roughline.contact.arguments import checked_count
from roughline.contact.curve_files import checked_name, write_curve
from roughline.contact.fields import Fields, Indentation, KeptFields
from roughline.contact.measures import Measured
from roughline.contact.quantities import IN_FILES, OVER_LOADS, Quantity, unit_name
from roughline.contact.status import Status
from roughline.errors import InputError
from roughline.facts.fact import Fact
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.jkr import JKR
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.halfspace.laws.yielding import Yielding
from roughline.reduction.revolution import LoadControl
from roughline.topography.body import Surface, with_heights
from roughline.units import in_words

if TYPE_CHECKING:
    import xarray

_STATUS_FLAGS: dict[str, Any] = {
    "flag_values": [int(status) for status in Status],
    "flag_meanings": " ".join(status.name.lower() for status in Status),
}
"""Attributes of the status in files, which say what its numbers mean."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Curve:
    """What both models tell of a body over its loads; pressed, it is one of the two kinds.

    A :class:`~roughline.Surface` gives a :class:`~roughline.SurfaceCurve`, a
    :class:`~roughline.Line` or a :class:`~roughline.Profile` a :class:`~roughline.LineCurve`.

    Attributes
    ----------
    depth : ndarray, shape (loads,)
        Approach since first touch of the highest point. [length]
    force : ndarray, shape (loads,)
        Total force, compression positive. [force]
    stiffness : ndarray, shape (loads,)
        Exact k = dF/dd on further loading. [force / length]
    status : ndarray of int8, shape (loads,)
        A :class:`Status` for each load; where a load did not converge, the other values are NaN.
    resolved : ndarray of bool, shape (loads,)
        Whether at least ten springs or cells, or radii of a profile, are in contact; with fewer,
        the grid decides the stiffness.
    residual : ndarray, shape (loads,)
        Largest residual of the returned solution, each relative to its scale as :func:`press`
        defines them; NaN where nothing was solved. [1]
    half_space : HalfSpace
        What the body was pressed into.
    rms_height : float
        Root-mean-square height of the body. [length]
    length : float
        sqrt(A_0) of a surface or a profile, length of a line. [length]
    unit : str or None
        Unit of lengths ("m": forces are in newtons, stiffness in N/m).
    settings : mapping
        How it was computed: version, tolerance, boundary, and the settings of the body.
    facts : sequence of Fact
        What a user of the numbers must know; empty if there is nothing to say.
    pull_off_force, pull_off_depth : float
        Largest pull of bodies that stick, negative, and its depth; NaN where there is none.
        [force] and [length]
    law : ContactLaw or None
        What pressures and gaps obey; None where the springs of a line only push.
    on_approach : ndarray of bool, shape (loads,)
        Whether the bodies came nearer from the load before. Where they stick, this is the branch.
    control : {"forces", "depths"}
        What was prescribed.
    """

    depth: Real
    force: Real
    stiffness: Real
    status: NDArray[np.int8]
    resolved: Mask
    residual: Real
    half_space: HalfSpace
    rms_height: float
    length: float
    unit: str | None
    settings: Mapping[str, str | int | float]
    facts: Sequence[Fact] = ()
    pull_off_force: float = math.nan
    pull_off_depth: float = math.nan
    law: ContactLaw | None = field(repr=False)
    on_approach: Mask
    control: LoadControl = field(repr=False)

    _repr_html_ = in_notebook

    def __repr__(self) -> str:
        count, solved, kind = self.status.size, self.converged, type(self).__name__
        loads = f"{count} load{'' if count == 1 else 's'}"
        if not solved.any():
            return f"<{kind}: {loads}, none solved>"
        unit = unit_name("force", "m") if self.unit == "m" else None
        low, high = (in_words(float(end(self.force[solved])), unit) for end in (np.min, np.max))
        missing = "" if solved.all() else f", {count - int(solved.sum())} of them not solved"
        return f"<{kind}: {loads}, force {low} to {high}{missing}>"

    @property
    def E_star(self) -> float:
        """Contact modulus. [pressure]"""
        return self.half_space.E_star

    @property
    def hardness(self) -> float | None:
        """Largest pressure that a point of the surface bears; None if it is elastic. [pressure]"""
        return self.law.hardness if isinstance(self.law, Yielding) else None

    @property
    def assumption(self) -> str:
        """What the bodies are taken to be: by their law, without which they only push."""
        return (self.law or Unilateral()).assumption

    @property
    def force_bar(self) -> Real:
        """Dimensionless force F / (E* h L), the paper's eq. 2. [1]

        Raises
        ------
        InputError
            If the heights are constant, so that h = 0.
        """
        if self.rms_height == 0:
            raise InputError(
                "the heights are constant, so their rms h is 0 and F / (E* h L) has no meaning: "
                "use force instead of force_bar"
            )
        return scaling.force_bar(self.force, self.E_star, self.rms_height, self.length)

    @property
    def stiffness_bar(self) -> Real:
        """Dimensionless stiffness of eq. 1, k / (1.1419 E* L); of a line k / (E* L). [1]"""
        return scaling.stiffness_bar(self.stiffness, self.E_star, self.length, self._punch)

    @property
    def _punch(self) -> float:
        """Stiffness k / (E* L) of a flat punch in full contact."""
        return scaling.PAPER_PUNCH

    @property
    def converged(self) -> Mask:
        """Whether each load was solved to the tolerance."""
        return self.status == Status.CONVERGED

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a user of the numbers must know, in words."""
        return tuple(map(str, self.facts))

    def to_dataset(self) -> xarray.Dataset:
        """Return the curve as an xarray Dataset over the loads, units in attrs.

        The prescribed quantity, force or depth, is the coordinate, so that
        ``curve.to_dataset().stiffness.plot()`` shows stiffness over it. Fields, if they were kept,
        are included over this coordinate, "x" and "y". Where they were kept of some loads only,
        the dimension "field_load" takes its place, with the numbers of these loads from 0:
        ``data.stiffness[data.field_load]`` are their stiffnesses.
        """
        import xarray  # here because it loads slowly

        attrs = self._attributes()
        if self.warnings:
            attrs["warnings"] = "; ".join(self.warnings)
        data = xarray.Dataset(self._variables(), attrs=attrs)
        return data.swap_dims(load=self.control.removesuffix("s"))

    def _attributes(self) -> dict[str, Any]:
        """Return what its file tells beside the quantities."""
        attrs = {
            "E_star": self.E_star,
            "E_star_units": unit_name("pressure", self.unit),
            "rms_height": self.rms_height,
            "length": self.length,
            "length_units": unit_name("length", self.unit),
            **self.settings,
        }
        if not math.isnan(self.pull_off_force):
            attrs |= {"pull_off_force": self.pull_off_force, "pull_off_depth": self.pull_off_depth}
        return attrs

    def _variables(self) -> dict[str, Any]:
        """Return the variables of its file by name: dimensions, values and attributes."""
        variables: dict[str, Any] = {}
        memory = "none" if self.law is None else self.law.memory
        for quantity in IN_FILES:
            values = self._values(quantity) if quantity.is_left_by(memory) else None
            if values is not None:
                flags = _STATUS_FLAGS if quantity.name == "status" else {}
                attributes = quantity.attributes(self.unit) | flags
                variables[quantity.name] = (quantity.dims, values, attributes)
        return variables

    def _values(self, quantity: Quantity) -> NDArray[Any] | None:
        """Return a quantity as files hold it, or None if this curve does not have it."""
        if quantity.dims != OVER_LOADS:
            return None
        values: NDArray[Any] | None = getattr(self, quantity.name, None)
        if values is not None and values.dtype == bool:
            return values.astype(np.int8)  # NetCDF has no booleans
        return values

    def write(self, path: str | Path) -> None:
        """Write the curve to a file.

        Parameters
        ----------
        path : str or Path
            Name of the file; an existing file is replaced. ".nc": NetCDF, with settings and
            fields. ".csv": only a table, with a row for each load and units in its header.

        Raises
        ------
        InputError
            If the name ends in neither ".nc" nor ".csv".
        StoreError
            If the file cannot be written.
        """
        name = checked_name(path)
        write_curve(self.to_dataset(), name)


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class SurfaceCurve(Curve):
    """Contact quantities of a surface over its loads, by the full model.

    Depth, force, status and all else that both models tell are those of
    :class:`~roughline.Curve`.

    Attributes
    ----------
    stiffness : ndarray, shape (loads,)
        Exact k = dF/dd on further loading: points at the hardness carry no additional load.
        [force / length]
    unloading_stiffness : ndarray, shape (loads,)
        Exact k = dF/dd on unloading, when all of the contact springs back elastically; without
        a hardness it is `stiffness`. [force / length]
    area_fraction : ndarray, shape (loads,)
        Real over nominal contact area: the share of the points that touch, which are those whose
        pressure is above zero, unless bodies stick. [1]
    area_fraction_corrected : ndarray, shape (loads,)
        The same, less the area that whole cells add along the outline of the contact
        (Yastrebov, Anciaux and Molinari 2017). Under a summit this is a few per cent. On a plateau,
        where pressure and gap rise at the outline, nothing is subtracted. [1]
    area_fraction_most : ndarray, shape (loads,)
        Upper bound of the area fraction on finer grids: `area_fraction_corrected` plus the whole
        correction, as it would be if all of the outline lay under summits. [1]
    stiffness_error, unloading_stiffness_error, area_fraction_error : ndarray or None
        Estimated discretisation errors of `stiffness`, `unloading_stiffness` and
        `area_fraction_corrected`, of shape (loads,); None unless asked for. A value v with error e
        lies between v / (1 + e / v) and v + e.
    plastic_fraction : ndarray, shape (loads,)
        Share of the contact that is at the hardness. [1]
    indentation : ndarray, shape (loads,)
        Largest permanent indentation of the surface so far. [length]
    work, dissipated_work : ndarray, shape (loads,)
        Work done by the load since first touch, less the work returned on unloading; and the
        part of it dissipated. Indentations dissipate the hardness times their volume. Bodies that
        stick dissipate where they jump: their work is the integral of the force over the depths, by
        cubics between the loads, and what is not stored is dissipated. [energy]
    pulling_fraction : ndarray, shape (loads,)
        Area across whose gap bodies pull each other over the nominal area; points count by their
        share of the largest pull. [1]
    pull_off_force, pull_off_depth : float
        Largest pull of bodies that stick, negative, and its depth: of depths on retreat, the least
        force that a larger one follows; of forces that pull more than the contact bears, that at
        which it comes off, to the tolerance. NaN where there is none, and where the grid does not
        resolve the pull. [force] and [length]
    pull_off_force_error : float
        Estimated discretisation error of `pull_off_force`; NaN unless asked for. [force]
    largest_pressure : ndarray, shape (loads,)
        Largest contact pressure: a body of no smaller hardness does not yield. [pressure]
    border_share : ndarray, shape (loads,)
        Share of the force that is carried near borders at which the surface ends. [1]
    convolutions : ndarray of int, shape (loads,)
        Convolutions that each load took, including its stiffness but not first guesses; zero
        where an equal load had been solved before.
    residual_of : sequence of str
        What the largest residual of each load is of, such as "the gap within the contact".
    measured : mapping of str to Measured
        Measures that were asked for, by their names, each with ``values`` over the loads, and with
        ``low`` and ``high`` if discretisation errors were asked for.
    fields : sequence of Fields
        One for each load if asked for, else empty; None for a load that did not converge, and for
        one whose fields were not asked for.
    surface : Surface
        The untouched surface.
    dents : sequence of Indentation
        Permanent indentations after each load, for :meth:`surface_after`; None where the surface
        is not indented. Empty without a hardness.
    law : ContactLaw
        What pressures and gaps obey.
    """

    unloading_stiffness: Real
    area_fraction: Real
    area_fraction_corrected: Real
    area_fraction_most: Real
    stiffness_error: Real | None = None
    unloading_stiffness_error: Real | None = None
    area_fraction_error: Real | None = None
    plastic_fraction: Real
    indentation: Real
    work: Real
    dissipated_work: Real
    pulling_fraction: Real
    pull_off_force_error: float = math.nan
    largest_pressure: Real = field(repr=False)
    border_share: Real = field(repr=False)
    convolutions: NDArray[np.int64]
    residual_of: Sequence[str] = field(repr=False)
    measured: Mapping[str, Measured] = field(default_factory=dict, repr=False)
    fields: Sequence[Fields | None] = field(default=(), repr=False)
    surface: Surface = field(repr=False)
    dents: Sequence[Indentation | None] = field(default=(), repr=False)
    law: ContactLaw = field(repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "fields", KeptFields(self.fields))

    def surface_after(self, load: int) -> Surface:
        """Return the surface with the permanent indentations that a load left.

        Parameters
        ----------
        load : int
            Number of the load, from 0; negative ones count from the last.

        Raises
        ------
        InputError
            If there is no such load, or it was not solved.
        """
        load, count = checked_count("load", load), self.status.size
        if not -count <= load < count:
            raise InputError(f"load is {load}; the curve has loads 0 to {count - 1}")
        if not self.converged[load]:
            raise InputError(
                f"load {load} was not solved ({Status(self.status[load]).reason}), so the surface "
                "after it is not known"
            )
        dents = self.dents[load] if self.dents else None
        if dents is None:
            return self.surface
        heights = self.surface.heights.copy()
        heights.flat[dents.nodes] -= dents.depth
        return with_heights(self.surface, heights, indented_by_force=float(self.force[load]))

    def _attributes(self) -> dict[str, Any]:
        attrs = super()._attributes()
        if not math.isnan(self.pull_off_force_error):
            attrs["pull_off_force_error"] = self.pull_off_force_error
        return attrs

    def _variables(self) -> dict[str, Any]:
        variables = super()._variables()
        for name, each in self.measured.items():
            attributes = each.quantity.attributes(self.unit)
            for end, values in zip(("", "_low", "_high"), each.rows, strict=False):
                variables[name + end] = (OVER_LOADS, values, attributes)
        if not self._fields_are_of_some:
            return variables
        for name, (dims, *rest) in variables.items():
            if dims != OVER_LOADS:
                variables[name] = (("field_load", *dims[1:]), *rest)
        meaning = {"long_name": "number, from 0, of a load whose fields were kept"}
        return variables | {"field_load": ("field_load", self._with_fields, meaning)}

    def _values(self, quantity: Quantity) -> NDArray[Any] | None:
        kept = [fields for fields in self.fields if fields is not None]
        if quantity.dims == OVER_LOADS or not kept:
            return super()._values(quantity)
        values = np.array([getattr(fields, quantity.attribute) for fields in kept], float)
        if self._fields_are_of_some:
            return values
        over_loads = np.full((len(self.fields), *values.shape[1:]), np.nan)
        over_loads[self._with_fields] = values
        return over_loads

    @property
    def _with_fields(self) -> list[int]:
        """The numbers of the loads whose fields were kept."""
        return [i for i, fields in enumerate(self.fields) if fields is not None]

    @property
    def _fields_are_of_some(self) -> bool:
        """Whether the fields of some solved loads were kept, and of others not."""
        return 0 < len(self._with_fields) < int(self.converged.sum())


class _NotOfLinesError(InputError, AttributeError):
    """A line is asked for what a surface has; ``hasattr`` finds that it is not there."""


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class LineCurve(Curve):
    """Contact quantities of a line or a profile over its loads, by the reduced model.

    Depth, force, status and all else that both models tell are those of
    :class:`~roughline.Curve`. The springs have no fields, and the contact area of a line does not
    predict that of its surface.

    Attributes
    ----------
    stiffness : ndarray, shape (loads,)
        Exact k = dF/dd; of a profile 2 E* a, with the contact radius a. [force / length]
    area_fraction : ndarray, shape (loads,), or None
        Contact over nominal area of a profile, whose contact is a disc; None for a line. [1]
    work, dissipated_work : ndarray, shape (loads,), or None
        Work done by the load since first touch, less the work returned, of a profile that sticks;
        and the part of it that the edge of the contact gives up, whatever the loads. A force that
        pulls it off counts as held from there on. None where nothing sticks. [energy]
    pull_off_force, pull_off_depth : float
        Largest pull of a profile on the way between the loads, negative, and its depth; NaN where
        there is none. [force] and [length]
    law : JKR or None
        How a profile sticks; None where bodies only push.
    """

    area_fraction: Real | None = None
    work: Real | None = None
    dissipated_work: Real | None = None
    law: JKR | None = field(default=None, repr=False)

    if not TYPE_CHECKING:  # checkers know what there is

        def __getattr__(self, name):
            if name in SurfaceCurve.__dataclass_fields__ or hasattr(SurfaceCurve, name):
                raise _NotOfLinesError(
                    f"a LineCurve has no {name}, which the reduced model does not give: press a "
                    "Surface"
                )
            raise AttributeError(f"'LineCurve' object has no attribute {name!r}")

    @property
    def area_fraction_corrected(self) -> Real | None:
        """The area fraction itself: no cells overstate a disc. [1]"""
        return self.area_fraction

    @property
    def _punch(self) -> float:
        return scaling.PAPER_PUNCH if self.area_fraction is not None else 1.0
