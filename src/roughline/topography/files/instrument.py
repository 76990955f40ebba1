"""Files of instruments, through SurfaceTopography's readers."""

from __future__ import annotations

import logging
import math
import re
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from roughline.errors import InputError, RoughlineError
from roughline.errors.checks import shortened
from roughline.errors.words import called
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.channels import Channel, find_channel, listed
from roughline.topography.files.formats import FORMATS
from roughline.topography.files.measurement import Measurement
from roughline.topography.files.text import READ_AS_TEXT, has_other_bytes
from roughline.topography.provenance import Instrument
from roughline.topography.settings import MEASURED

_READ_HERE = (
    "gwy",
    "nms",
    "sur",
    "x3p",
)  # formats of SurfaceTopography that have readers of our own
_WITHOUT_MARK = ("hgt", *_READ_HERE)  # that start like any other file, or are read here
_TEXT_FORMATS = ("asc", "matrix", "xyz")  # its formats of text, which take any lines for remarks
_WITHOUT_UNITS = ("h5", "mat", "npz")  # of any arrays, which have names and nothing else
_NO_HEIGHTS = re.compile(
    r"thumbnail|preview|error|phase|amplitude|intensity|mask|quality|image|valid|flag|weight|"
    r"colou?r|rgb|deflection|current|voltage|(^|/)[xy](_?coord\w*|_?pos\w*)?$",
    re.IGNORECASE,
)
_OPTICAL = ("al3d", "datx", "lext", "metropro", "opd", "opdx", "plu", "plux", "vk", "zon")
"""Formats of optical instruments alone, whose heights are means over pixels."""

_ADVISED = ("X3P", "SDF", "SUR", "GWY")  # formats to export to
_TEXT_SUFFIXES = (".txt", ".csv", ".dat", ".asc", ".xyz", ".tsv", ".prn")
_BYTES_PER_POINT = 24  # raw heights, scaled heights and their mask


def read_instrument(path: Path, channel: int | str | None, name: str) -> Measurement:
    """Read the heights of an instrument's file, and what it states of them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ImportWarning)  # MPI is absent, and not needed
        from SurfaceTopography.Exceptions import ReadFileError  # here because it loads slowly
        from SurfaceTopography.IO import open_topography

    try:
        opened = partial(open_topography, str(path), format=_marked_format(path))
        with silence(), opened() as reader:
            _refuse_guessed_format(reader, path)
            first = reader._default_channel_index
            channels = _channels(reader, by_name=channel is None)
            chosen = reader.channels[find_channel(channels, channel, name, first)]
            advice = "crop it with the instrument's software"
            refuse_points(chosen.nb_grid_pts, path, name, _BYTES_PER_POINT, advice)
            _refuse_long_arrays(reader, chosen, name)
            found = _read_measurement(reader, chosen, name)
            return found if channel is not None else replace(found, doubts=_choice(reader, chosen))
    except (RoughlineError, MemoryError):
        raise
    except ReadFileError as error:
        allowed = f"; {READ_AS_TEXT}" if path.suffix.lower() in _TEXT_SUFFIXES else ""
        others = [each for each in _ADVISED if path.suffix.lower() != f".{each.lower()}"]
        raise InputError(
            f"{name} is damaged or of a type that is not known{allowed}: export it again, or to "
            f"another format such as {', '.join(others[:-1])} or {others[-1]}"
        ) from error
    except Exception as error:  # of a damaged file the readers raise errors of any type
        first_line = shortened((str(error).strip() or "no reason given").splitlines()[0])
        raise InputError(
            f"{name} cannot be read ({type(error).__name__}: {first_line}): export it again"
        ) from error


def _marked_format(path: Path) -> str | None:
    """The format whose mark the file starts with: damaged, it is read as no other one."""
    from SurfaceTopography.IO import MAGIC_BUFFER_SIZE, MagicMatch, readers

    with path.open("rb") as file:
        start = file.read(MAGIC_BUFFER_SIZE)
    marked = [each.format() for each in readers if each.can_read(start) == MagicMatch.YES]
    return marked[0] if len(marked) == 1 else None


def _refuse_long_arrays(reader: Any, channel: Any, name: str) -> None:
    """Refuse a file of Mountains whose arrays, as it declares them, are longer than its map."""
    if reader.format() != "mnt":
        return
    arrays = reader._arrays[channel.index]
    longest = _BYTES_PER_POINT * math.prod(n + 2 for n in channel.nb_grid_pts)  # with a border
    for array in (arrays["heights"], arrays["mask"]):
        declared = int.from_bytes(array["data"]["_raw"][:8], "little") if array else 0
        if declared > longest:
            raise InputError(
                f"{name} declares {declared / 1e6:.3g} MB for "
                f"{' x '.join(map(str, channel.nb_grid_pts))} points: export it again"
            )


def _refuse_guessed_format(reader: Any, path: Path) -> None:
    """Refuse a format that any bytes have, unless the name of the file says that it is the one."""
    from SurfaceTopography.Exceptions import CannotDetectFileFormat

    extensions = [f".{each.lower()}" for each in reader.file_extensions() or ()]
    if reader.format() in _WITHOUT_MARK and path.suffix.lower() not in extensions:
        raise CannotDetectFileFormat("no format has a mark that is at the start of the file")
    if reader.format() in _TEXT_FORMATS and has_other_bytes(path):
        raise CannotDetectFileFormat("text has no such bytes")


@contextmanager
def silence() -> Iterator[None]:
    """Keep messages of the readers off the terminal; some print damaged files in full."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings(), redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)


def _channels(reader: Any, *, by_name: bool = True) -> list[Channel]:
    """The channels of a file, which of them hold heights, and what tells those of one name.

    Names alone tell arrays that have no units; whoever chooses one knows better.
    """
    names = [each.name or "" for each in reader.channels]
    return [
        Channel(
            name,
            _why_no_heights(each, by_name and reader.format() in _WITHOUT_UNITS),
            _direction(each) if names.count(name) > 1 else "",
        )
        for name, each in zip(names, reader.channels, strict=True)
    ]


def _choice(reader: Any, chosen: Any) -> tuple[str, ...]:
    """A doubt where a file has several arrays, and nothing in it says which one holds heights."""
    if reader.format() not in _WITHOUT_UNITS:
        return ()
    possible = [each.name for each in _channels(reader) if not each.why_none]
    if len(possible) < 2:
        return ()
    return (
        f"it holds {len(possible)} arrays that may be heights ({shortened(', '.join(possible))}), "
        f"of which {chosen.name!r} is read: {called('channel')} chooses",
    )


def _why_no_heights(channel: Any, by_name: bool) -> str:
    """Why a channel holds no heights; empty if it does."""
    if not channel.is_height_channel or (isinstance(channel.unit, tuple) and not channel.unit[1]):
        return f"a channel of {channel.unit if isinstance(channel.unit, str) else 'other numbers'}"
    if by_name and _NO_HEIGHTS.search(channel.name or ""):
        return f"by its name; {called('channel')} takes it nevertheless"
    return ""


def _direction(channel: Any) -> str:
    """The direction and the pass in which a scan of an AFM was recorded, as far as it is stated."""
    stated = channel.info.get("raw_metadata")
    if not isinstance(stated, Mapping):
        return ""
    directions = (str(stated.get(key, "")).lower() for key in ("line direction", "scan line"))
    return ", ".join(filter(None, directions))


def _read_measurement(reader: Any, channel: Any, file: str) -> Measurement:
    unit = channel.unit[0] if isinstance(channel.unit, tuple) else channel.unit
    stated = channel.physical_sizes is not None
    unit_of_sides = channel.info.get("raw_metadata", {}).get("xunit") if stated else None
    topography = reader.topography(
        channel_index=channel.index,
        # the reader requires a unit and sizes; where the file states none, any will do
        **({} if unit else {"unit": unit_of_sides or "m"}),
        **({} if stated else {"physical_sizes": tuple(map(float, channel.nb_grid_pts))}),
    )
    known = next((each for each in FORMATS if each.reader == reader.format()), None)
    uneven = topography.dim == 1 and not topography.is_uniform
    measured = Measurement(
        file=file,
        heights=topography.heights(),
        unit=unit or None,
        unit_of_sides=None if unit else unit_of_sides,
        sizes=tuple(map(float, topography.physical_sizes)) if stated else None,
        kind="surface" if topography.dim == 2 else "profile",
        format=reader.name() if known is None else known.name,
        reader=f"SurfaceTopography {version('SurfaceTopography')}",
        channel=channel.name or "",
        channels=listed(_channels(reader)),
        positions=np.asarray(topography.positions(), dtype=np.float64) if uneven else None,
        settings={
            "origin": MEASURED,
            "file": file,
            "channel": channel.name or "",
        },
    )
    return measured.with_instrument(Instrument("means" if reader.format() in _OPTICAL else None))
