"""The result of pressing a body: depth, force, stiffness and real contact area over the loads."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Mask, Real
from roughline.computing.notebook import in_notebook
from roughline.contact import scaling
from roughline.contact.arguments import checked_count
from roughline.contact.curve_files import checked_name, write_curve
from roughline.contact.fields import Fields, Indentation, KeptFields
from roughline.contact.measures import Measured
from roughline.contact.quantities import IN_FILES, OVER_LOADS, Quantity, unit_of
from roughline.contact.status import Status
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.halfspace.laws.yielding import Yielding
from roughline.topography.body import Surface, with_heights
from roughline.units import in_words

if TYPE_CHECKING:
    import xarray

_STATUS_FLAGS: dict[str, Any] = {
    "flag_values": [int(status) for status in Status],
    "flag_meanings": " ".join(status.name.lower() for status in Status),
}
"""Attributes of the status in files, which say what its numbers mean."""


@dataclass(frozen=True, eq=False)
class Curve:
    """Contact quantities over the loads of one body.

    Attributes
    ----------
    depth : ndarray, shape (loads,)
        Approach since first touch of the highest point. [length]
    force : ndarray, shape (loads,)
        Total force, compression positive. [force]
    stiffness : ndarray, shape (loads,)
        Exact k = dF/dd on further loading: points at the hardness carry no additional load. Of a
        profile 2 E* a, with the contact radius a. [force / length]
    area_fraction : ndarray, shape (loads,), or None
        Real over nominal contact area: the share of the points that touch, which are those whose
        pressure is above zero, unless bodies stick. Of a profile the contact is a disc. None for a
        line: the contact area of the reduced model does not predict that of the surface.
    area_fraction_corrected : ndarray, shape (loads,), or None
        The same, less the area that whole cells add along the outline of the contact
        (Yastrebov, Anciaux and Molinari 2017). Under a summit this is a few per cent. On a plateau,
        where pressure and gap rise at the outline, nothing is subtracted.
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
    convolutions : ndarray of int, shape (loads,), or None
        Convolutions that each load took, including its stiffness but not first guesses; zero
        where an equal load had been solved before. None for a line.
    area_fraction_most : ndarray, shape (loads,), or None
        Upper bound of the area fraction on finer grids: `area_fraction_corrected` plus the whole
        correction, as it would be if all of the outline lay under summits.
    stiffness_error, unloading_stiffness_error, area_fraction_error : ndarray or None
        Estimated discretisation errors of `stiffness`, `unloading_stiffness` and
        `area_fraction_corrected`, of shape (loads,), if asked for; a value v with error e lies
        between v / (1 + e / v) and v + e.
    unloading_stiffness : ndarray, shape (loads,), or None
        Exact k = dF/dd on unloading, when all of the contact springs back elastically; without
        a hardness it is `stiffness`. This and the next four are None for a line.
        [force / length]
    plastic_fraction : ndarray, shape (loads,), or None
        Share of the contact that is at the hardness. [1]
    indentation : ndarray, shape (loads,), or None
        Largest permanent indentation of the surface so far. [length]
    work, dissipated_work : ndarray, shape (loads,), or None
        Work done by the load since first touch, less the work returned on unloading; and the
        part of it dissipated. Indentations dissipate the hardness times their volume. Bodies that
        stick dissipate where they jump: their work is the integral of the force over the depths, by
        cubics between the loads, and what is not stored is dissipated. Of a profile it is what the
        edge of the contact gives up, whatever the loads; a force that pulls it off counts as held
        from there on. [energy]
    pulling_fraction : ndarray, shape (loads,), or None
        Area across whose gap bodies pull each other over the nominal area; points count by their
        share of the largest pull. [1]
    on_approach : ndarray of bool, shape (loads,), or None
        Whether the bodies came nearer from the load before. Where they stick, this is the branch.
    pull_off_force, pull_off_depth : float
        Largest pull of bodies that stick, negative, and its depth: of depths on retreat, the least
        force that a larger one follows; of forces that pull more than the contact bears, that at
        which it comes off, to the tolerance. Of a profile it is that of the way between the loads.
        NaN where there is none, and where the grid does not resolve the pull. [force] and [length]
    pull_off_force_error : float
        Estimated discretisation error of `pull_off_force`, if asked for. [force]
    border_share : ndarray, shape (loads,), or None
        Share of the force that is carried near borders at which the surface ends; None for a line.
    residual_of : sequence of str
        What the largest residual of each load is of, such as "the gap within the contact". Empty
        for a line.
    warnings : sequence of str
        What a user of the numbers must know; empty if there is nothing to say.
    measured : mapping of str to Measured
        Measures that were asked for, by their names, each with ``values`` over the loads, and with
        ``low`` and ``high`` if discretisation errors were asked for.
    fields : sequence of Fields
        One for each load if asked for, else empty; None for a load that did not converge, and for
        one whose fields were not asked for.
    surface : Surface or None
        The untouched surface; None for a line or a profile.
    dents : sequence of Indentation
        Permanent indentations after each load, for :meth:`surface_after`; None where the surface
        is not indented. Empty without a hardness.
    law : ContactLaw or None
        What pressures and gaps obey; None for a line, and for a profile that does not stick.
    control : {"forces", "depths"}
        What was prescribed.
    """

    depth: Real
    force: Real
    stiffness: Real
    area_fraction: Real | None
    area_fraction_corrected: Real | None
    status: NDArray[np.int8]
    resolved: Mask
    residual: Real
    half_space: HalfSpace
    rms_height: float
    length: float
    unit: str | None
    settings: Mapping[str, str | int | float]
    convolutions: NDArray[np.int64] | None = None
    area_fraction_most: Real | None = None
    stiffness_error: Real | None = None
    unloading_stiffness_error: Real | None = None
    area_fraction_error: Real | None = None
    unloading_stiffness: Real | None = None
    plastic_fraction: Real | None = None
    indentation: Real | None = None
    work: Real | None = None
    dissipated_work: Real | None = None
    pulling_fraction: Real | None = None
    on_approach: Mask | None = None
    pull_off_force: float = math.nan
    pull_off_depth: float = math.nan
    pull_off_force_error: float = math.nan
    border_share: Real | None = field(default=None, repr=False)
    residual_of: Sequence[str] = field(default=(), repr=False)
    warnings: Sequence[str] = ()
    measured: Mapping[str, Measured] = field(default_factory=dict, repr=False)
    fields: Sequence[Fields | None] = field(default=(), repr=False)
    surface: Surface | None = field(default=None, repr=False)
    dents: Sequence[Indentation | None] = field(default=(), repr=False)
    law: ContactLaw | None = field(default=None, repr=False)
    control: Literal["forces", "depths"] = field(default="forces", repr=False)

    _repr_html_ = in_notebook

    def __post_init__(self) -> None:
        object.__setattr__(self, "fields", KeptFields(self.fields))

    def __repr__(self) -> str:
        count, solved = self.status.size, self.converged
        loads = f"{count} load{'' if count == 1 else 's'}"
        if not solved.any():
            return f"<Curve: {loads}, none solved>"
        unit = unit_of("force", "m") if self.unit == "m" else None
        low, high = (in_words(float(end(self.force[solved])), unit) for end in (np.min, np.max))
        missing = "" if solved.all() else f", {count - int(solved.sum())} of them not solved"
        return f"<Curve: {loads}, force {low} to {high}{missing}>"

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
        punch = 1.0 if self.area_fraction is None else scaling.PAPER_PUNCH
        return scaling.stiffness_bar(self.stiffness, self.E_star, self.length, punch)

    @property
    def converged(self) -> Mask:
        """Whether each load was solved to the tolerance."""
        return self.status == Status.CONVERGED

    def surface_after(self, load: int) -> Surface:
        """Return the surface with the permanent indentations that a load left.

        Parameters
        ----------
        load : int
            Number of the load, from 0; negative ones count from the last.

        Raises
        ------
        InputError
            If there is no such load, it was not solved, or the body is no surface.
        """
        load = checked_count("load", load)
        if self.surface is None:
            raise InputError(
                "this curve has no surface: the reduced model of a line or a profile has no yield"
            )
        count = self.status.size
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

    def to_dataset(self) -> xarray.Dataset:
        """Return the curve as an xarray Dataset over the loads, units in attrs.

        The prescribed quantity, force or depth, is the coordinate, so that
        ``curve.to_dataset().stiffness.plot()`` shows stiffness over it. Fields, if they were kept,
        are included over this coordinate, "x" and "y". Where they were kept of some loads only,
        the dimension "field_load" takes its place, with the numbers of these loads from 0:
        ``data.stiffness[data.field_load]`` are their stiffnesses.
        """
        import xarray  # here because it loads slowly

        variables: dict[str, Any] = {}
        for quantity in IN_FILES:
            values = self._values(quantity)
            if values is not None:
                flags = _STATUS_FLAGS if quantity.name == "status" else {}
                attributes = quantity.attributes(self.unit) | flags
                dims = quantity.dims
                if dims != OVER_LOADS and self._fields_are_of_some:
                    dims = ("field_load", *dims[1:])
                variables[quantity.name] = (dims, values, attributes)
        for name, each in self.measured.items():
            attributes = each.quantity.attributes(self.unit)
            for end, values in zip(("", "_low", "_high"), each.rows, strict=False):
                variables[name + end] = (OVER_LOADS, values, attributes)
        if self._fields_are_of_some:
            meaning = {"long_name": "number, from 0, of a load whose fields were kept"}
            variables["field_load"] = ("field_load", self._with_fields, meaning)
        attrs = {
            "E_star": self.E_star,
            "E_star_units": unit_of("pressure", self.unit),
            "rms_height": self.rms_height,
            "length": self.length,
            "length_units": unit_of("length", self.unit),
            **self.settings,
        }
        if not math.isnan(self.pull_off_force):
            attrs |= {"pull_off_force": self.pull_off_force, "pull_off_depth": self.pull_off_depth}
        if not math.isnan(self.pull_off_force_error):
            attrs["pull_off_force_error"] = self.pull_off_force_error
        if self.warnings:
            attrs["warnings"] = "; ".join(self.warnings)
        return xarray.Dataset(variables, attrs=attrs).swap_dims(load=self.control.removesuffix("s"))

    def _values(self, quantity: Quantity) -> NDArray[Any] | None:
        """Return a quantity as files hold it, or None if this curve does not have it."""
        if not quantity.is_left_by("none" if self.law is None else self.law.memory):
            return None
        if quantity.dims == OVER_LOADS:
            values: NDArray[Any] | None = getattr(self, quantity.name)
            if values is not None and values.dtype == bool:
                return values.astype(np.int8)  # NetCDF has no booleans
            return values
        kept = [fields for fields in self.fields if fields is not None]
        if not kept:
            return None
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
