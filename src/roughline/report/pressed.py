"""One pressed file: from its path, two materials and loads to answers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roughline.answers import Answer, Interface, answers, elastic_warnings, saturated_stiffness
from roughline.characterisation import ALIKE, isotropy
from roughline.contact import press
from roughline.curve import Curve, Status
from roughline.errors import InputError
from roughline.estimates import estimate
from roughline.interface import plasticity_index
from roughline.isotropic import isotropic_spectrum
from roughline.line_scan import press_scan
from roughline.materials import Material
from roughline.measured import read, suspicions
from roughline.missing import Filling, Missing
from roughline.preparation import Preparation, prepared
from roughline.quantities import engineering, in_si, load_in_newtons
from roughline.report.folder import make_folder
from roughline.theories import TheoryCurve, moments, theory
from roughline.topography import Body, Line, Surface
from roughline.two_bodies import facing

Real = NDArray[np.float64]
Announce = Callable[[str], None]
Progress = Callable[[int, int], None]

_LARGE = 2**20  # points from which on the cost is told
_LIGHTEST = 1e-3  # of the largest load, where a report's curve begins
_CURVE_LOADS = 16  # of a report's curve
DEFAULT_LOADS = 20
_COARSENED_FROM = 64  # points a side from which on a report estimates the grid's error


@dataclass(frozen=True)
class Source:
    """A file, and what is needed to read it; as for :func:`roughline.read`."""

    file: Path
    unit: str | None = None
    channel: str | None = None
    sizes: tuple[float, ...] | None = None
    missing: Filling = "harmonic"
    most_missing: float = 0.1

    def read(self, missing: Filling | None = None) -> Body:
        """Read it, with points filled as stated or by another method."""
        return read(
            self.file,
            self.unit,
            channel=self.channel,
            sizes=self.sizes,
            missing=missing or self.missing,
            most_missing=self.most_missing,
        )


@dataclass(frozen=True)
class Loading:
    """What a body is pressed with; quantities as texts with units.

    Parameters
    ----------
    loads : sequence of str
        Total forces or mean pressures, such as "10 N" or "2 MPa".
    depths : sequence of str
        Depths, such as "200 nm", instead.
    count : int, optional
        Number of loads from first touch to saturation, instead.
    """

    loads: Sequence[str] = ()
    depths: Sequence[str] = ()
    count: int | None = None

    def forces(self, area: float) -> list[float] | None:
        """Total forces on a nominal area, rising. [N]"""
        found = sorted({load_in_newtons(text, area) for text in self.loads})
        for force in found:
            if not 0 < force < np.inf:
                raise InputError(f"a load of {force:g} N is given; give positive ones")
        return found or None

    def heights(self) -> list[float] | None:
        """Depths, rising. [m]"""
        return sorted({in_si(text, "m", "depth") for text in self.depths}) or None


@dataclass(frozen=True, eq=False)
class Pressed:
    """What pressing a file gave.

    Attributes
    ----------
    source : Source
        The file.
    body : Surface or Line
        What was pressed, in metres: prepared, and the sum of both where there are two.
    curve : Curve
        Its curve; a load that did not converge is marked.
    asked : ndarray of int
        Which loads of the curve were asked for.
    pair : Interface or None
        The materials.
    answers : list of Answer
        For the materials, over the loads of the curve.
    theories : list of TheoryCurve
        At the same mean pressures.
    notes : list of str
        How the loads were meant, what was filled, what is suspicious, where an assumption breaks.
    files : list of Path
        What was written.
    """

    source: Source
    body: Body
    curve: Curve
    asked: NDArray[np.intp]
    pair: Interface | None = None
    answers: list[Answer] = field(default_factory=list)
    theories: list[TheoryCurve] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)

    @property
    def area(self) -> float:
        """Nominal area; of a line scan, the square of its length. [m²]"""
        return nominal_area(self.body)


def nominal_area(body: Body) -> float:
    """Nominal area of a body; of a line, the square of its length. [m²]"""
    return body.area if isinstance(body, Surface) else body.length**2


def press_file(
    source: Source,
    loading: Loading,
    *,
    E_star: float | None = None,
    materials: tuple[Material, Material] | None = None,
    against: Source | None = None,
    preparation: Preparation | None = None,
    periodic: bool = False,
    grid_error: bool = False,
    frequency: float | None = None,
    theories: Sequence[str] = (),
    whole_curve: bool = False,
    out: Path | None = None,
    announce: Announce,
    progress: Progress | None = None,
) -> Pressed:
    """Read a file, prepare it, press it and work out what follows.

    Parameters
    ----------
    source : Source
        The topography.
    loading : Loading
        Loads.
    E_star : float, optional
        Contact modulus, unless materials are given. [Pa]
    materials : tuple of Material, optional
        Of both bodies.
    against : Source, optional
        Topography of the second body; without it, that one is smooth.
    preparation : Preparation, optional
        Of each topography; default: the tilt of measured ones is removed.
    periodic, grid_error
        As for :func:`roughline.press`.
    frequency : float, optional
        Of an ultrasonic wave. [Hz]
    theories : sequence of str
        As for :func:`roughline.theories.theory`.
    whole_curve : bool
        Whether loads from a thousandth of the largest one on are added, for figures.
    out : Path, optional
        Folder that will be written to.
    announce : callable
        Told what a large run will cost, before it starts.
    progress : callable, optional
        Called with (loads done, loads in all).

    Raises
    ------
    InputError
        If the question does not fit together.
    """
    if (E_star is None) == (materials is None):
        raise InputError("give either a contact modulus (--modulus) or two materials (--materials)")
    pair = Interface(*materials) if materials else None
    modulus = pair.E_star if pair else E_star
    assert modulus is not None
    body, second = _bodies(source, against, preparation)
    if whole_curve and isinstance(body, Surface) and min(body.shape) >= _COARSENED_FROM:
        grid_error, body = True, _trimmed(body)
    if out is not None:
        make_folder(out)  # a folder that cannot be written is said before the work, not after
    asked = loading.forces(nominal_area(body)) or []
    notes = _notes_on_loads(loading, body) + notes_on_body(body)
    errors: tuple[Real | None, Real | None]
    if isinstance(body, Line) and body.kind == "profile":
        if periodic or grid_error or loading.depths:
            raise InputError(
                "periodic, grid_error and depths belong to a surface; a line scan is pressed by "
                "loads, through its spectrum"
            )
        forces = asked or _default_forces(body, modulus, loading.count or DEFAULT_LOADS)
        forces = _with_curve(forces) if whole_curve else forces
        scan = press_scan(body, E_star=modulus, forces=forces, against=second)
        curve, errors = scan.curve, ((scan.high - scan.low) / 2, None)
    else:
        forces = _with_curve(asked) if whole_curve and asked else asked
        wish = _Wish(modulus, forces, loading.heights() or [], loading.count, periodic, grid_error)
        if isinstance(body, Surface) and body.heights.size >= _LARGE:
            cost = estimate(body.shape, wish.count, periodic=periodic)
            announce(f"{body.shape[0]} x {body.shape[1]} points, {wish.count} loads: {cost}")
        shown = forces.index(asked[-1]) if asked else 3 * wish.count // 4
        curve = wish.press(body, [shown] if out is not None else False, progress)
        errors = curve.stiffness_error, curve.area_fraction_error
        if body.settings.get("missing_points") and isinstance(body, Surface):
            other = prepared(source.read(Missing(source.missing).other), preparation)
            assert isinstance(other, Surface)
            if other.shape != body.shape:
                other = _trimmed(other)
            moved, changes = _moved(curve, wish.press(other, False, progress))
            notes.append(f"filled by {Missing(source.missing).other} instead: {moved}")
            errors = _combined(errors[0], changes[0]), _combined(errors[1], changes[1])
    indices = [i for i, f in enumerate(curve.force) if not asked or np.isclose(f, asked).any()]
    result = Pressed(source, body, curve, np.array(indices), pair, notes=[*notes, *curve.warnings])
    return _answered(result, modulus, periodic, frequency, theories, errors)


@dataclass(frozen=True)
class _Wish:
    """Loads and settings, for the body and for the same body filled otherwise."""

    E_star: float
    forces: list[float]
    depths: list[float]
    n_loads: int | None
    periodic: bool
    grid_error: bool

    @property
    def count(self) -> int:
        """Number of loads."""
        return len(self.forces) or len(self.depths) or self.n_loads or 0

    def press(self, body: Body, fields: list[int] | bool, progress: Progress | None) -> Curve:
        """Press a body; loads that fail are marked."""
        return press(
            body,
            E_star=self.E_star,
            n_loads=self.n_loads,
            forces=self.forces or None,
            depths=self.depths or None,
            periodic=self.periodic,
            fields=fields if isinstance(body, Surface) else False,
            grid_error=self.grid_error,
            throw=False,
            progress=progress,
        )


def _bodies(
    source: Source, against: Source | None, preparation: Preparation | None
) -> tuple[Body, Line | None]:
    """The body to press, the sum of two surfaces; of two line scans both."""
    first = prepared(source.read(), preparation)
    if against is None:
        return first, None
    second = prepared(against.read(), preparation)
    if isinstance(first, Surface) and isinstance(second, Surface):
        return facing(first, second), None
    if (
        isinstance(first, Line)
        and isinstance(second, Line)
        and first.kind == second.kind == "profile"
    ):
        return first, second
    raise InputError("two rough bodies must both be surfaces, or both line scans")


def _trimmed(surface: Surface) -> Surface:
    """The surface without the last rows and columns that cannot be coarsened twice."""
    nx, ny = (n - n % 4 for n in surface.shape)
    return surface if (nx, ny) == surface.shape else surface.cropped((0, nx), (0, ny))


def _answered(
    pressed: Pressed,
    E_star: float,
    periodic: bool,
    frequency: float | None,
    theories: Sequence[str],
    errors: tuple[Real | None, Real | None],
) -> Pressed:
    """Add theories, answers and what the answers warn of."""
    body, curve = pressed.body, pressed.curve
    found = None
    notes = pressed.notes
    if isinstance(body, Surface) and min(body.shape) >= 8 and body.rms_height > 0:
        alike = isotropy(body)
        if theories and alike < ALIKE:
            notes = [
                *notes,
                f"theories assume equal directions; slopes differ, least {alike:.2f} "
                "of the largest",
            ]
        spectrum = isotropic_spectrum(body)
        found = moments(spectrum)
        lines = [theory(name, spectrum, E_star, curve.force / body.area) for name in theories]
    else:
        if theories:
            raise InputError("theories are evaluated for a rough surface of 8 x 8 points or more")
        lines = []
    if pressed.pair is None:
        return replace(pressed, theories=lines, notes=notes)
    saturated = None
    if isinstance(body, Line):
        saturated = E_star * body.length
    elif not periodic:
        saturated = saturated_stiffness(body, E_star)
    given = answers(
        curve,
        pressed.area,
        pressed.pair,
        saturated=saturated,
        rms_height=body.rms_height,
        rms_slope=found.rms_slope if found else None,
        frequency=frequency,
        stiffness_error=errors[0],
        area_error=errors[1],
    )
    index = None
    if found is not None and pressed.pair.hardness is not None:
        index = plasticity_index(
            E_star, pressed.pair.hardness, (found.summit_deviation, found.summit_radius)
        )
    notes = [*notes, *elastic_warnings(given, index)]
    if frequency is not None and pressed.pair.both("impedance") is None:
        notes.append("no reflection: the density of both materials is needed")
    return replace(pressed, answers=given, theories=lines, notes=notes)


def _notes_on_loads(loading: Loading, body: Body) -> list[str]:
    """Say how loads were meant."""
    area = nominal_area(body)
    if isinstance(body, Surface):
        nominal = f"the nominal area, {' x '.join(engineering(s, 'm') for s in body.sizes)}"
    else:
        nominal = f"the square of the line's length, {engineering(body.length, 'm')}"
    return [
        f"load {text}: {engineering(load_in_newtons(text, area), 'N')} in all, "
        f"{engineering(load_in_newtons(text, area) / area, 'Pa')} over {nominal}"
        for text in loading.loads
    ]


def notes_on_body(body: Body) -> list[str]:
    """Say what was filled, what spikes there are, and what is suspicious."""
    notes = []
    if body.settings.get("missing_points"):
        count, share = body.settings["missing_points"], float(body.settings["missing_share"])
        notes.append(f"{count} missing points ({share:.2%}) filled: {body.settings['filled']}")
    if body.settings.get("outliers_kept"):
        notes.append(
            f"{body.settings['outliers_kept']} spikes kept; the highest point decides where touch "
            "is, so see whether they are real, or remove them"
        )
    if body.settings.get("outliers_removed"):
        notes.append(f"{body.settings['outliers_removed']} spikes removed and filled")
    return notes + suspicions(body)


def _default_forces(line: Line, E_star: float, count: int) -> list[float]:
    scale = E_star * line.rms_height * line.length
    return (scale * np.geomspace(1e-3, 3, count)).tolist()


def _with_curve(asked: list[float]) -> list[float]:
    """Loads for a curve up to the largest, those asked for among them."""
    curve = np.geomspace(_LIGHTEST * asked[-1], asked[-1], _CURVE_LOADS)
    apart = [f for f in curve if not np.isclose(f, asked, rtol=0.02).any()]
    return sorted({*asked, *apart})


def _moved(curve: Curve, other: Curve) -> tuple[str, tuple[Real, Real]]:
    """How far another filling moves the answers."""
    assert curve.area_fraction_corrected is not None
    assert other.area_fraction_corrected is not None
    stiffness = np.abs(other.stiffness - curve.stiffness)
    area = np.abs(other.area_fraction_corrected - curve.area_fraction_corrected)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = [
            float(np.nanmax(stiffness / curve.stiffness, initial=0.0)),
            float(np.nanmax(area / curve.area_fraction_corrected, initial=0.0)),
        ]
    return f"stiffness moves by up to {shares[0]:.2%}, area by {shares[1]:.2%}", (stiffness, area)


def _combined(first: Real | None, second: Real) -> Real:
    return second if first is None else np.hypot(first, second)


def curve_table(curve: Curve) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of a curve in SI units; a star marks loads that the grid decides."""
    header = ["load", "depth", "force", "stiffness k"]
    if curve.area_fraction is not None:
        header += ["contact area", "corrected"]
    rows = []
    for i in range(curve.depth.size):
        mark = "" if curve.resolved[i] else " *"
        if not curve.converged[i]:
            rows.append(
                [str(i + 1), "-", "-", Status(curve.status[i]).reason, "-", "-"][: len(header)]
            )
            continue
        row = [
            f"{i + 1}{mark}",
            engineering(curve.depth[i], "m"),
            engineering(curve.force[i], "N"),
            engineering(curve.stiffness[i], "N/m"),
        ]
        if curve.stiffness_error is not None:
            row[-1] += f" ± {curve.stiffness_error[i] / curve.stiffness[i]:.1%}"
        if curve.area_fraction is not None and curve.area_fraction_corrected is not None:
            row += [f"{curve.area_fraction[i]:.3%}", f"{curve.area_fraction_corrected[i]:.3%}"]
        if curve.area_fraction_error is not None:
            row[-1] += f" ± {curve.area_fraction_error[i]:.3%}"
        rows.append(row)
    return header, rows


def answer_table(pressed: Pressed) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of the answers at the loads that were asked for."""
    header = ["", *(f"load {n + 1}" for n in range(pressed.asked.size)), "formula"]
    rows = []
    for each in pressed.answers:
        row = [f"{each.name} {each.symbol}"]
        for i in pressed.asked:
            row.append(quantity(each, int(i)))
        rows.append([*row, each.formula])
    return header, rows


def quantity(answer: Answer, i: int) -> str:
    """Write one value of an answer, with its error where that is known."""
    value = float(answer.values[i])
    if not np.isfinite(value):
        return "not solved" if np.isnan(value) else "infinite"
    shown = f"{value:.4g}" if answer.unit == "1" else f"{value:.4g} {answer.unit}"
    if answer.unit in ("N", "m", "Pa", "N/m", "ohm"):
        shown = engineering(value, answer.unit)
    if answer.error is not None and np.isfinite(answer.error[i]) and value:
        shown += f" ± {abs(float(answer.error[i]) / value):.1%}"
    return shown
