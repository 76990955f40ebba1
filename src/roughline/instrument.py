"""Files of instruments, through SurfaceTopography's readers."""

from __future__ import annotations

import logging
import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from roughline.errors import InputError, RoughlineError
from roughline.memory import refuse_beyond_memory
from roughline.missing import Missing
from roughline.quantities import given_sizes, metres_per_file_unit
from roughline.topography import MEASURED, Body, Line, Surface

_BYTES_PER_POINT = 24  # raw, scaled and masked


def read_instrument(
    path: Path,
    unit: str | None,
    channel: int | str | None,
    sizes: float | tuple[float, ...] | None,
    missing: Missing,
) -> Body:
    """Read a body from an instrument's file, in metres.

    Parameters
    ----------
    path, unit, channel, sizes
        As for :func:`roughline.read`.
    missing : Missing
        How missing points are filled.

    Raises
    ------
    InputError
        If the file is damaged, of a type that is not known, or does not say enough.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ImportWarning)  # it says that MPI is absent; so be it
        from SurfaceTopography.Exceptions import ReadFileError  # here because it loads slowly
        from SurfaceTopography.IO import open_topography

    try:
        with _silence(), open_topography(str(path)) as reader:
            chosen = _channel_of(reader, channel, path)
            refuse_beyond_memory(
                _BYTES_PER_POINT * math.prod(chosen.nb_grid_pts),
                f"reading the {' x '.join(map(str, chosen.nb_grid_pts))} points of {path.name}",
                "crop it with the instrument's software",
            )
            stated = chosen.unit[0] if isinstance(chosen.unit, tuple) else chosen.unit
            factor = metres_per_file_unit(path.name, stated, unit)
            extent = _sizes_in_file_units(chosen, sizes, factor, path)
            topography = reader.topography(
                channel_index=chosen.index,
                **({} if stated else {"unit": "m"}),
                **({"physical_sizes": extent} if chosen.physical_sizes is None else {}),
            )
            return _body_of(topography, factor, path, stated or str(unit), chosen.name, missing)
    except (RoughlineError, MemoryError):
        raise
    except ReadFileError as error:
        raise InputError(
            f"{path.name} is damaged or of a type that is not known ({type(error).__name__}): "
            "export it again, or to another format such as X3P, SDF, SUR or GWY"
        ) from error
    except Exception as error:  # the readers raise whatever a damaged file leads them to
        first_line = (str(error).strip() or "no reason given").splitlines()[0][:120]
        raise InputError(
            f"{path.name} cannot be read ({type(error).__name__}: {first_line}): export it again"
        ) from error


@contextmanager
def _silence() -> Iterator[None]:
    """Keep off the terminal what readers say of damaged files; some print them whole."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings(), redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)


def _channel_of(reader: Any, wanted: int | str | None, path: Path) -> Any:
    """Find a channel of heights by number or name."""
    channels = reader.channels
    listed = ", ".join(f"{i} {each.name!r}" for i, each in enumerate(channels))
    if wanted is None:
        return reader.default_channel
    text = str(wanted)
    if text.isdigit() and int(text) < len(channels):
        chosen = channels[int(text)]
    else:
        named = [each for each in channels if each.name.lower() == text.lower()]
        if not named:
            raise InputError(f"{path.name} has no channel {text!r}; it has {listed}")
        if len(named) > 1:
            raise InputError(
                f"{path.name} has {len(named)} channels {text!r}: choose by number, of {listed}"
            )
        chosen = named[0]
    if not chosen.is_height_channel or (isinstance(chosen.unit, tuple) and not chosen.unit[1]):
        raise InputError(f"channel {text!r} of {path.name} holds no heights; it has {listed}")
    return chosen


def _sizes_in_file_units(
    channel: Any, given: float | tuple[float, ...] | None, factor: float, path: Path
) -> tuple[float, ...] | None:
    if channel.physical_sizes is not None:
        if given is not None:
            raise InputError(f"{path.name} states its sizes; leave them out")
        return None
    return tuple(size / factor for size in given_sizes(path.name, channel.nb_grid_pts, given))


def _body_of(
    topography: Any, factor: float, path: Path, unit: str, channel: str, missing: Missing
) -> Body:
    settings: dict[str, str | int | float] = {
        "origin": MEASURED,
        "file": path.name,
        "file_unit": unit,
        "channel": channel,
    }
    heights, found = missing.completed(topography.heights(), path.name)
    settings |= found
    if factor != 1:
        heights = np.multiply(heights, factor, out=heights if heights.flags.writeable else None)
    sizes = tuple(factor * float(size) for size in topography.physical_sizes)
    if topography.dim == 2:
        return Surface(heights, (sizes[0], sizes[1]), "m", settings)
    if not topography.is_uniform:
        positions = np.asarray(topography.positions(), dtype=np.float64) * factor
        steps = np.diff(positions)
        even = np.linspace(positions[0], positions[-1], positions.size)
        heights = np.interp(even, positions, heights)
        settings["resampled"] = (
            f"linear, to even spacing; it was {steps.min():.3g} to {steps.max():.3g} m"
        )
    return Line(heights, sizes[0], "m", settings, "profile")
