"""Files to bodies in metres: instruments' files, arrays, and files that roughline wrote."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from roughline.errors import InputError
from roughline.errors.checks import shortened
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.facts.fact import Fact, own_words
from roughline.topography.body import Body, Surface, point_spacings, side_lengths
from roughline.topography.crop import Crop
from roughline.topography.files.archives import (
    refuse_empty_datasets,
    refuse_hollow,
    refuse_points,
)
from roughline.topography.files.cf_netcdf import read_netcdf
from roughline.topography.files.curves import curve_in
from roughline.topography.files.gsf import read_gsf
from roughline.topography.files.gwy import read_gwy
from roughline.topography.files.heights_in_text import read_text
from roughline.topography.files.instrument import read_instrument
from roughline.topography.files.measurement import Measurement, Sizes
from roughline.topography.files.netcdf import read_body_file
from roughline.topography.files.nms import read_nms
from roughline.topography.files.sdf import read_sdf
from roughline.topography.files.smd import read_smd
from roughline.topography.files.sur import read_sur
from roughline.topography.files.tiff import read_tiff
from roughline.topography.files.tmd import read_tmd
from roughline.topography.files.x3p import read_x3p
from roughline.topography.missing import USUALLY_FILLED, Filler, Missing
from roughline.topography.scan_lines import line_jump_warning
from roughline.topography.settings import MEASURED
from roughline.topography.trend import Trend, refuse_unknown_trend

_RMS_RANGE = (1e-12, 1e-3)  # of roughness [m]
_SIDES = (1e-8, 1.0)  # that instruments measure [m]
_NPY = b"\x93NUMPY"
_NO_SIDE = 1e-100  # in any unit, nor its reciprocal
_LARGEST_PIXEL = 1e-3  # of an optical instrument [m]
_LEAST_SLOPE = 1e-6  # an rms slope below which no surface is known
_BY_ROUGHLINE: tuple[Callable[[Path, int | str | None, str], Measurement | None], ...] = (
    read_sdf,
    read_smd,
    read_gsf,
    read_x3p,
    read_gwy,
    read_sur,
    read_tmd,
    read_nms,
    read_netcdf,
    read_tiff,
    read_text,
)
"""Readers of formats that are read here, each None for a file that has another format."""


@public
def read(
    path: str | Path,
    unit: str | None = None,
    *,
    channel: int | str | None = None,
    sizes: Sizes | None = None,
    missing: Missing = USUALLY_FILLED,
    trend: Trend = "tilt",
    crop: Crop | None = None,
) -> Body:
    """Read a surface or a line from a file, in metres.

    A measured line scan is returned as a Line of kind "profile"; one with uneven spacing is
    interpolated linearly to as many evenly spaced points. Points that the instrument could not
    measure are filled, and the tilt of its stage is removed, but for what its file calls periodic;
    the settings of the result record both, and who read the file. Heights in files that roughline
    wrote are not changed.

    Parameters
    ----------
    path : str or Path
        The file.
    unit : str, optional
        Unit of all lengths in a file that states none, such as "nm" or "um".
    channel : int or str, optional
        Number, from 0, or name of the channel; default: the file's first one of heights.
    sizes : float, str, or sequence of them, optional
        Length of a line, or both sides (Lx, Ly), for a file that states no sizes; one of them
        makes a square of a square array. Numbers are in `unit` if that is given, like everything
        else in the file, and in metres if not; texts have units of their own, "1 mm, 0.5 mm".
    missing : Missing, optional
        How missing points are filled, how many may be, and whether masked ones count as missing;
        default: up to a tenth is filled by the smoothest surface, and masked ones are used.
    trend : {"tilt", "none", "mean", "curvature"}, optional
        Least-squares polynomial that is removed from what an instrument measured.
    crop : tuple of float, optional
        The piece to read, (x0, x1, y0, y1) of a map or (x0, x1) of a line, from 0 along each side.
        Missing points are counted and filled, and the trend is removed, in the piece alone. [m]

    Returns
    -------
    Surface or Line
        In metres.

    Raises
    ------
    UnitError
        If the file states no unit and `unit` is not given, or if both give one.
    InputError
        If the file does not exist, has an unknown format, is damaged, or lacks points or sizes.

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> heights = 1e-6 * np.random.default_rng(7).standard_normal((32, 32))
    >>> rl.write(rl.Surface(heights, sizes=(1e-3, 1e-3), unit="m", is_cut_out=True), "map.nc")
    >>> rl.read("map.nc").shape
    (32, 32)
    """
    refuse_unknown_trend(trend)
    content = measurement(path, channel).with_mask(missing.mask)
    if crop is not None:
        content, sizes = content.piece(crop, unit, sizes), None
    return content.body(unit, sizes, Filler(missing, trend), trend, in_place=True)


def measurement(
    path: str | Path, channel: int | str | None = None, name: str | None = None
) -> Measurement:
    """Read the heights of a file, even if a unit, sizes or points are missing for a body."""
    path = Path(path)
    if not os.path.isfile(path):  # noqa: PTH113 - of a name that no file can have, Path raises
        what = "is a folder" if os.path.isdir(path) else "does not exist"  # noqa: PTH112
        raise InputError(f"{name or shortened(str(path))} {what}; give a file with a topography")
    name = name or path.name
    if path.stat().st_size == 0:
        raise InputError(f"{name} is empty: export it again")
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # heights beyond all numbers are missing
            return _measurement(path, channel, name)
    except (MemoryError, OverflowError) as error:
        raise InputError(
            f"{name} declares more than memory can hold; if it should not, it is damaged: export "
            "it again, or crop it with the instrument's software"
        ) from error


def _measurement(path: Path, channel: int | str | None, name: str) -> Measurement:
    """Read a file that exists; sides that no map has are refused, whoever read them."""
    measured = _as_line_scan(_by_first_reader(path, channel, name))
    sides = () if measured.by_roughline else measured.sizes or ()
    if not all(_NO_SIDE < side < 1 / _NO_SIDE for side in sides):
        stated = " x ".join(f"{side:.6g}" for side in sides)
        raise InputError(
            f"{name} states sides of {stated} {measured.unit or ''}; sides are lengths above 0: "
            "export it again, or write the heights as NPY or text and give the sizes"
        )
    return measured


def _by_first_reader(path: Path, channel: int | str | None, name: str) -> Measurement:
    """Read a file by the first of the readers that knows it."""
    measured = None
    if path.suffix == ".nc":
        refuse_empty_datasets(path, name)
        measured = read_body_file(path, name)
    if measured is None and curve_in(path):
        raise InputError(
            f"{name} holds a curve that roughline wrote, and no topography: `roughline info` shows "
            "it, and xarray.open_dataset opens it"
        )
    if measured is None:
        measured = _read_array(path, name)
    for reader in _BY_ROUGHLINE:
        if measured is None:
            measured = reader(path, channel, name)
    if measured is None:
        refuse_hollow(path, name)
        return read_instrument(path, channel, name)
    if channel is not None and not measured.channels:
        raise InputError(f"{name} has one channel only; leave {called('channel')} out")
    return measured


def _as_line_scan(measured: Measurement) -> Measurement:
    """What a file holds; one row or one column of a map is a line scan."""
    shape = measured.heights.shape
    if measured.by_roughline or len(shape) != 2 or min(shape) > 1:
        return measured
    along = int(np.argmax(shape))
    return replace(
        measured,
        kind="profile",
        heights=measured.heights.ravel(),
        sizes=None if measured.sizes is None else (measured.sizes[along],),
        masked=None if measured.masked is None else measured.masked.ravel(),
    )


def _read_array(path: Path, name: str) -> Measurement | None:
    """Read an array in NumPy's format, x along the first axis; None if it has another format."""
    with path.open("rb") as file:
        if file.read(len(_NPY)) != _NPY:
            return None
    try:
        with np.errstate(over="ignore"):  # of points that no file can hold
            stored = np.load(path, mmap_mode="r", allow_pickle=False)
        if stored.ndim not in (1, 2) or not np.can_cast(stored.dtype, np.float64, "same_kind"):
            raise ValueError(f"{stored.ndim} dimensions of type {stored.dtype}")
    except MemoryError:
        raise
    except Exception as error:  # of a damaged file NumPy raises errors of any type
        # its first sentence; what follows may advise to load what is not safe
        reason = shortened(str(error).partition(". ")[0]) or type(error).__name__
        raise InputError(
            f"{name} holds no array of real heights ({reason}): save one or two dimensions"
        ) from error
    refuse_points(stored.shape, path, name)
    return Measurement(
        file=name,
        heights=np.array(stored, dtype=np.float64),
        unit=None,
        sizes=None,
        kind="surface" if stored.ndim == 2 else "profile",
        format="NPY",
        settings={"origin": MEASURED, "file": name},
    )


def suspicions(body: Body) -> list[Fact]:
    """List properties of a measured body that suggest a wrong unit, a wrong file or a slip."""
    text = body.provenance.doubts_of_file
    doubts = [own_words(text).grave()] if text else []
    rms, slope = body.rms_height, body.rms_slope
    if rms > _RMS_RANGE[1] or 0 < rms < _RMS_RANGE[0]:
        doubts.append(Fact("odd_rms_height", rms=rms))
    if rms == 0:
        doubts.append(Fact("flat"))
    if slope > 1:
        doubts.append(Fact("odd_slope", slope=slope, is_small=False))
    doubts += _doubts_of_sides(body)
    if isinstance(body, Surface) and max(body.spacing) > 2 * min(body.spacing):
        doubts.append(Fact("odd_pixels", spacing=body.spacing))
    if jumps := line_jump_warning(body):
        doubts.append(jumps)
    return doubts


def _doubts_of_sides(body: Body) -> list[Fact]:
    """What suggests a wrong unit of the sides, of which a rough surface shows nothing itself."""
    doubts = []
    sides, spacings = side_lengths(body), point_spacings(body)
    if max(sides) > _SIDES[1] or min(sides) < _SIDES[0]:
        doubts.append(Fact("odd_sides", sides=sides, are_pixels=False))
    if body.provenance.instrument.pixels == "means" and max(spacings) > _LARGEST_PIXEL:
        doubts.append(Fact("odd_sides", sides=spacings, are_pixels=True))
    if 0 < body.rms_slope < _LEAST_SLOPE:
        doubts.append(Fact("odd_slope", slope=body.rms_slope, is_small=True))
    return doubts
