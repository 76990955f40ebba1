"""Bodies that creep: contacts that grow follow from elastic ones, by the correspondence principle.

With K the compliance of the body at once, pressures p displace it by u = K p_e with
p_e = int J(t - s) dp(s). So p_e and the gap are those of an elastic body, as long as no point that
touched comes off again and no p_e falls: where there is a gap, there never was a pressure [1]_. In
return p = int R(t - s) dp_e(s), which is positive then.

References
----------
.. [1] E. H. Lee and J. R. M. Radok, "The contact problem for viscoelastic bodies", J. Appl. Mech.
   27, 438-444 (1960); K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §6.5.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Indices, Real
from roughline.computing.notebook import in_notebook
from roughline.computing.summary import summary
from roughline.contact.arguments import LARGEST_NUMBER, checked_half_space
from roughline.contact.curve import Curve, LineCurve, SurfaceCurve
from roughline.contact.curve_files import checked_name, write_curve
from roughline.contact.loads import checked_numbers, comes_nearer
from roughline.contact.press import press
from roughline.contact.quantities import QUANTITIES, Quantity
from roughline.contact.selection import at_loads, loads_with_fields
from roughline.creep.creep import Creep, memory_of_strain, memory_of_stress
from roughline.creep.fading_memory import FadingMemory
from roughline.errors import InputError
from roughline.errors.checks import between, refuse
from roughline.errors.public import public_names
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.topography.body import Body
from roughline.topography.profile import Profile

if TYPE_CHECKING:
    import xarray

_LOAD_ROUNDING = 1e-9  # of elastic forces and depths, by which they may seem to fall
_PRESSURE_ROUNDING = 1e-6  # of the force, by which they may seem to fall: that of a press
_COMPARED_LOADS = 9  # at which pressures on layers are compared
_LIGHTEST_LOAD = 1e-3  # of the largest of these loads, where they rise from zero
_MOST_DEPTHS = 2000  # between which the force on a moving body is integrated
_HALVED_FROM = 0.1  # of the largest error of an interval of depths; others are halved too

_of_times = partial(Quantity, dims=("time",))
_DECLARED = (
    *(QUANTITIES[name] for name in ("force", "depth", "area_fraction", "area_fraction_corrected")),
    _of_times(
        "instantaneous_stiffness",
        "k",
        "force/length",
        "stiffness of a further load that is fast beside all relaxation times",
        long_name="stiffness dF/dd of a fast load",
    ),
    _of_times(
        "elastic_force",
        "F_e",
        "force",
        "force of the same contact of an elastic body with the modulus at once",
        long_name="force of the same contact of an elastic body",
    ),
    _of_times(
        "force_error",
        "",
        "force",
        "bound of the error of `force` by what lies between the depths that were pressed",
        long_name="bound of the error of force",
    ),
)
"""What a file of contacts over time holds."""


@dataclass(frozen=True, eq=False)
class CreepCurve:
    """Contact quantities over time, of a body on one that creeps.

    Attributes
    ----------
    time : ndarray, shape (times,)
        When. Of a constant force or depth it counts from the step. [time]
    force : ndarray, shape (times,)
        Total force, compression positive. [force]
    depth : ndarray, shape (times,)
        Approach since first touch of the highest point. [length]
    instantaneous_stiffness : ndarray, shape (times,)
        Exact dF/dd of a further load that is fast beside all relaxation times: that of the contact
        with the modulus E_0. A slow one meets less. [force / length]
    area_fraction, area_fraction_corrected : ndarray, shape (times,), or None
        Real over nominal contact area, as in :class:`SurfaceCurve`; None for a line.
    force_error : ndarray, shape (times,)
        Bound of the error of `force` where the depth moves, as the force between the depths that
        were pressed is known by its slopes; the tolerance of each press, 1e-6, comes on top. It is
        zero where force or depth is constant, or where the force is given. [force]
    elastic : SurfaceCurve or LineCurve
        The same contacts of an elastic body with the modulus E_0: of the same depth, area, gap and
        displacement, under another force.
    creep : Creep
        How the modulus relaxes.
    """

    time: Real
    force: Real
    depth: Real
    instantaneous_stiffness: Real
    area_fraction: Real | None
    area_fraction_corrected: Real | None
    force_error: Real
    elastic: SurfaceCurve | LineCurve = field(repr=False)
    creep: Creep = field(repr=False)

    __repr__ = summary
    _repr_html_ = in_notebook

    @property
    def warnings(self) -> Sequence[str]:
        """What a user of the numbers must know, of the elastic contacts."""
        return self.elastic.warnings

    @property
    def elastic_force(self) -> Real:
        """Force under which an elastic body of the modulus E_0 has the same contact. [force]"""
        return self.elastic.force

    def to_dataset(self) -> xarray.Dataset:
        """Return the curve as an xarray Dataset over the time, units in attrs.

        ``curve.to_dataset().area_fraction.plot(xscale="log")`` shows the area over the time.
        """
        import xarray  # here because it loads slowly

        variables: dict[str, Any] = {
            each.name: ("time", getattr(self, each.name), each.attributes(self.elastic.unit))
            for each in _DECLARED
            if getattr(self, each.name) is not None
        }
        attrs = {
            **self.elastic.to_dataset().attrs,
            "creep_shares": self.creep.shares,
            "creep_times": self.creep.times,
        }
        when = {"time": ("time", self.time, {"long_name": "time"})}
        return xarray.Dataset(variables, when, attrs)

    def write(self, path: str | Path) -> None:
        """Write the curve to a file.

        Parameters
        ----------
        path : str or Path
            Name of the file; an existing file is replaced. ".nc": NetCDF, with settings. ".csv":
            only a table, with a row for each time and units in its header.

        Raises
        ------
        InputError
            If the name ends in neither ".nc" nor ".csv".
        StoreError
            If the file cannot be written.
        """
        name = checked_name(path)
        write_curve(self.to_dataset(), name)


@public_names
def press_creep(
    body: Body | Profile,
    creep: Creep,
    *,
    times: ArrayLike,
    force: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    half_space: HalfSpace,
    rtol: float = 1e-3,
) -> CreepCurve:
    """Press a body into one that creeps, under a force or to a depth over time.

    While a contact grows or stays, it is that of an elastic body under another force, the
    correspondence principle of growing contact [1]_. Under a force F(t) this is
    F_e = int J(t - s) dF(s); at a depth d(t) the force is F = int R(t - s) dF_e(d(s)). What makes
    the contact recede is refused. The rough body is rigid, or far stiffer than the one that creeps,
    and the bodies only push: an elastic contact does not tell those of bodies that yield or stick.

    Parameters
    ----------
    body : Surface, Line or Profile
        The rough body, or one of revolution. [length]
    creep : Creep
        How the modulus relaxes.
    times : array_like, shape (times,)
        When the contact is wanted, rising. [time]
    force, depth : float or array_like, shape (times,)
        One of them. A number is applied at time zero and held. Values at the times are a history:
        the first is applied at the first time, and it is straight from time to time. A force may
        fall as long as the contact does not recede. [force] or [length]
    half_space : HalfSpace
        What the body is pressed into, with its moduli at once: :class:`~roughline.Homogeneous`,
        with E_0 / (1 - nu²), or one on a rigid base such as :class:`~roughline.Layered`, whose
        layers all creep alike.
    rtol : float, optional
        How well the force is known where the depth moves: more depths are pressed between those
        given until bounds of the force are so close, over the force.

    Returns
    -------
    CreepCurve
        Force, depth, stiffness and area over the times, and the elastic curve.

    Raises
    ------
    InputError
        If the contact would recede, or an argument cannot be used.
    ConvergenceError
        If a contact was not solved; it carries the elastic curve.

    References
    ----------
    .. [1] E. H. Lee and J. R. M. Radok, "The contact problem for viscoelastic bodies", J. Appl.
       Mech. 27, 438-444 (1960); K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §6.5.

    Examples
    --------
    >>> import roughline as rl
    >>> surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    >>> rubber = rl.Creep(shares=[0.3, 0.4], times=[1.0, 100.0])
    >>> body = rl.Homogeneous(E_star=1.0)
    >>> curve = rl.press_creep(surface, rubber, times=[0, 1, 1e4], force=1e-3, half_space=body)
    >>> print(curve.depth.round(4), curve.area_fraction_corrected.round(4))
    [0.0093 0.0101 0.0161] [0.0069 0.0078 0.017 ]

    At a constant depth the contact stays, and the force relaxes:

    >>> curve = rl.press_creep(surface, rubber, times=[0, 1, 1e4], depth=0.01, half_space=body)
    >>> print((curve.force / curve.force[0]).round(3))
    [1.    0.806 0.3  ]
    """
    if not isinstance(creep, Creep):
        refuse("creep", creep, "rl.Creep(shares, times) is needed")
    half_space = checked_half_space(half_space)
    _refuse_elastic_parts(half_space)
    rtol = between("rtol", rtol, 1e-6, 0.1, "a tolerance from 1e-6 to 0.1 is needed")
    history = _given_history(times, force, depth)
    pressed = partial(_pressed, body, half_space)
    if history.control == "force":
        loads = _growing_loads(history, memory_of_stress(creep))
        elastic = pressed("forces", loads[history.asked])
        force, error = history.values[history.asked], np.zeros(elastic.force.size)
    else:
        history = _rising(history)
        elastic = pressed("depths", history.values[history.asked])
        loads = elastic.force
        force, error = _relaxed(history, memory_of_strain(creep), elastic, pressed, rtol)
    if not isinstance(half_space, Homogeneous):
        _refuse_falling_pressures(loads, pressed)
    return CreepCurve(
        time=history.times[history.asked],
        force=force,
        depth=elastic.depth,
        instantaneous_stiffness=elastic.stiffness,
        area_fraction=elastic.area_fraction,
        area_fraction_corrected=elastic.area_fraction_corrected,
        force_error=error,
        elastic=elastic,
        creep=creep,
    )


@dataclass(frozen=True, eq=False)
class _LoadHistory:
    """Force or depth over time, straight between times, after a step from zero at the first."""

    control: Literal["force", "depth"]
    times: Real
    values: Real
    asked: slice  # of these times


def _given_history(times: Any, force: Any, depth: Any) -> _LoadHistory:
    """Return what is given of force and depth."""
    if (force is None) == (depth is None):
        count = "neither force nor depth" if force is None else "both force and depth"
        raise InputError(f"{count} given; give one of the two, a number or values at the times")
    times = _checked("times", times)
    if (falls := np.flatnonzero(np.diff(times) <= 0)).size:
        i = falls[0]
        raise InputError(
            f"are {times[i]:g} and then {times[i + 1]:g}; give times that rise, each once", "times"
        )
    name: Literal["force", "depth"] = "depth" if force is None else "force"
    given = depth if force is None else force
    values = _checked(name, given)
    if (values < 0).any() or not values.any():
        raise InputError(
            f"{_numbered(name, given, values, int(values.argmin()))}; compression counts positive: "
            "give positive numbers, and zero only before touch"
        )
    if np.ndim(given) > 0:
        if values.size != times.size:
            raise InputError(
                f"has {values.size} values at {times.size} times; give one number that is held "
                "from time zero on, or a value for each time",
                name,
            )
        return _LoadHistory(name, times, values, slice(0, None))
    if times[0] < 0:
        raise InputError(
            f"start at {times[0]:g}; a number is held from time zero on: give times from 0 on, or "
            f"{name} as values at the times",
            "times",
        )
    first = int(times[0] > 0)
    times = np.append(np.zeros(first), times)
    return _LoadHistory(name, times, np.full(times.size, values[0]), slice(first, None))


def _checked(name: str, given: Any) -> Real:
    """Return numbers in a row that can be computed with."""
    values = checked_numbers(name, given)
    wrong = ~(np.abs(values) <= LARGEST_NUMBER)
    if wrong.any():
        raise InputError(
            f"{_numbered(name, given, values, int(wrong.argmax()))}; finite numbers of at most "
            f"{LARGEST_NUMBER:g} are needed"
        )
    return values


def _numbered(name: str, given: Any, values: Real, i: int) -> str:
    """Say which of the values of an argument is which number."""
    return f"{name}{f'[{i}]' if np.ndim(given) else ''} is {values[i]:g}"


def _refuse_elastic_parts(half_space: HalfSpace) -> None:
    """Refuse half-spaces of which a part may not creep as the others do."""
    if not isinstance(half_space, Homogeneous) and not half_space.has_base:
        refuse(
            "half_space",
            half_space,
            "all that gives way has to creep alike: give rl.Homogeneous, or layers on a "
            "rigid base (base_young=math.inf), as one far stiffer than they are nearly is. An "
            "elastic base, or a second body, does not creep as they do",
        )


def _growing_loads(history: _LoadHistory, memory: FadingMemory) -> Real:
    """Return the forces of the same contacts of an elastic body; refuse that they fall.

    Their slopes between two times are sums of exponentials, whose zeros are all found.
    """
    times, values = history.times, history.values
    remembered = memory.remembered(times, values)
    turns = [times]
    for i, length in enumerate(np.diff(times).tolist()):
        rate = float(values[i + 1] - values[i]) / length
        if rate < 0 or (remembered[i] < 0).any():
            slope = memory.slope_of_superposed(rate, remembered[i])
            turns.append(times[i] + np.array(slope.zeros(length)))
    at = np.unique(np.concatenate(turns))
    loads = memory.superposed(at, np.interp(at, times, values))
    falls = loads < (1 - _LOAD_ROUNDING) * np.maximum.accumulate(loads)
    if falls.any():
        last = int(loads[: falls.argmax()].argmax())
        raise InputError(
            f"falls so fast that the contact recedes from time {at[last]:.4g} on, when it is that "
            f"of an elastic force of {loads[last]:.4g}; contacts that recede are not covered: let "
            "the force fall later or more slowly, or end the times there",
            "force",
        )
    return loads[np.searchsorted(at, times)]


def _rising(history: _LoadHistory) -> _LoadHistory:
    """Return a history of depths that rise or stay; refuse one that falls by more than rounding."""
    depth = history.values
    falls = np.flatnonzero(np.diff(depth) < -_LOAD_ROUNDING * depth.max())
    if falls.size:
        i = falls[0]
        raise InputError(
            f"falls from {depth[i]:.4g} to {depth[i + 1]:.4g} after time {history.times[i]:.4g}, "
            "from where on the contact recedes; contacts that recede are not covered: give depths "
            "that rise or stay, or end the times there",
            "depth",
        )
    return replace(history, values=np.maximum.accumulate(depth))


def _pressed(
    body: Body | Profile, half_space: HalfSpace, control: str, loads: Real, *, fields: bool = False
) -> SurfaceCurve | LineCurve:
    """Press elastic bodies under forces or to depths, of which the first may be zero."""
    touching, given = loads > 0, loads
    if not touching.all():  # a press takes zero as its last load only
        given = np.append(loads[touching], 0.0)
    depths, forces = (given if control == name else None for name in ("depths", "forces"))
    curve = press(body, half_space=half_space, depths=depths, forces=forces, fields=fields)
    if given is loads:
        return curve
    curve = at_loads(curve, np.where(touching, np.cumsum(touching) - 1, -1))
    return replace(curve, on_approach=comes_nearer(curve.depth))


def _relaxed(
    history: _LoadHistory,
    memory: FadingMemory,
    elastic: Curve,
    pressed: Callable[..., Curve],
    rtol: float,
) -> tuple[Real, Real]:
    """Return the force at the times of a history of depths, and a bound of its error.

    As contacts grow, the elastic force F_e(d) rises ever faster. So between two depths it lies
    below the chord and above both tangents. What was applied later has relaxed less, so that
    int R(t - s) dF_e is larger the later F_e grows, and these are bounds of it. Of a parabola the
    chord is twice as far off as the tangents. More depths are pressed where the bounds are farthest
    apart.
    """
    asked = history.times[history.asked]
    reached = _Reached.of(elastic)
    while True:
        trajectory = _Trajectory.of(history, reached)
        low = memory.superposed(trajectory.times, trajectory.force)[
            np.searchsorted(trajectory.times, asked)
        ]
        times, loads = trajectory.tangents
        high = memory.superposed(times, loads)[np.searchsorted(times, asked)]
        force, error = low / 3 + 2 * high / 3, 2 / 3 * np.maximum(high - low, 0.0)
        if (error <= rtol * force).all():
            return force, error
        rising, parts = trajectory.uncertainties(memory)
        parts /= force[np.searchsorted(asked, trajectory.times[rising + 1])]
        wide = rising[parts > _HALVED_FROM * parts.max()]
        finer = reached.with_curve(
            pressed("depths", (trajectory.depth[wide] + trajectory.depth[wide + 1]) / 2)
        )
        if not reached.depth.size < finer.depth.size <= _MOST_DEPTHS:
            return force, error
        reached = finer


@dataclass(frozen=True, eq=False)
class _Reached:
    """Rising depths with the elastic force and stiffness there."""

    depth: Real
    force: Real
    stiffness: Real

    @classmethod
    def of(cls, curve: Curve) -> _Reached:
        """Start from a curve."""
        return cls(*np.empty((3, 0))).with_curve(curve)

    def with_curve(self, curve: Curve) -> _Reached:
        """Add the depths of a curve."""
        depth, places = np.unique(np.append(self.depth, curve.depth), return_index=True)
        force, stiffness = (
            np.append(*each)[places]
            for each in ((self.force, curve.force), (self.stiffness, curve.stiffness))
        )
        return _Reached(depth, force, stiffness)


@dataclass(frozen=True, eq=False)
class _Trajectory:
    """The way of a body through depths, with the elastic force and stiffness on it."""

    times: Real
    depth: Real
    force: Real
    stiffness: Real

    @classmethod
    def of(cls, history: _LoadHistory, reached: _Reached) -> _Trajectory:
        """Lead a body along its history through all depths that were pressed."""
        depths = np.setdiff1d(reached.depth, history.values)
        times = np.append(history.times, np.interp(depths, history.values, history.times))
        order = np.argsort(times)
        depth = np.append(history.values, depths)[order]
        at = np.searchsorted(reached.depth, depth)
        return cls(times[order], depth, reached.force[at], reached.stiffness[at])

    @cached_property
    def _kinks(self) -> tuple[Indices, Real, Real]:
        """Intervals in which the depth rises, with time and force where their tangents meet."""
        rising = np.flatnonzero(np.diff(self.depth) > 0)
        step, slow, fast = (np.diff(each)[rising] for each in (self.depth, self.times, self.force))
        before, after = self.stiffness[rising], self.stiffness[rising + 1]
        with np.errstate(invalid="ignore", divide="ignore"):
            share = np.where(np.isinf(after), 1.0, (after - fast / step) / (after - before))
        share = np.where(np.isfinite(share), np.clip(share, 0.0, 1.0), 0.5)
        rise = np.minimum(before * step, fast) * share
        return rising, self.times[rising] + share * slow, self.force[rising] + rise

    @property
    def tangents(self) -> tuple[Real, Real]:
        """Times and forces of the tangents, where they meet."""
        rising, times, force = self._kinks
        return np.insert(self.times, rising + 1, times), np.insert(self.force, rising + 1, force)

    def uncertainties(self, memory: FadingMemory) -> tuple[Indices, Real]:
        """Intervals in which the depth rises, and how far their bounds are apart as they end."""
        rising, kinks, at_kinks = self._kinks
        start, end = self.times[rising], self.times[rising + 1]
        first, last = self.force[rising], self.force[rising + 1]
        early = (at_kinks - first) * memory.mean(end - kinks, end - start)
        late = (last - at_kinks) * memory.mean(0.0 * end, end - kinks)
        return rising, early + late - (last - first) * memory.mean(0.0 * end, end - start)


def _refuse_falling_pressures(loads: Real, pressed: Callable[..., Curve]) -> None:
    """Refuse loads under which a point of a layered body bears less than under lower ones.

    On a homogeneous body no pressure falls, as it is that of a rigid punch in every step. A stiff
    layer bends.
    """
    lowest, highest = max(loads[0], _LIGHTEST_LOAD * loads[-1]), loads[-1]
    if highest <= (1 + _LOAD_ROUNDING) * lowest:
        return
    loads = np.geomspace(lowest, highest, _COMPARED_LOADS)
    curve = pressed("forces", loads, fields=True)
    pressures = [each.pressure for _, each in loads_with_fields(curve)]
    for i, (before, after) in enumerate(pairwise(pressures)):
        if np.maximum(before - after, 0.0).sum() > _PRESSURE_ROUNDING * after.sum():
            raise InputError(
                f"takes pressure off some points while its elastic force rises from {loads[i]:.4g} "
                f"to {loads[i + 1]:.4g}, as a stiff layer bends over a soft one; contacts that "
                "recede are not covered: leave the layer out, or press without creep",
                "half_space",
            )
