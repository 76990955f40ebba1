"""TIFF as heights: floats and counts of 16 bits or more, with the scale that ImageJ or tags state.

Of TIFF that programs of microscopes write, SurfaceTopography reads JPK and LEXT.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError, RoughlineError
from roughline.errors.checks import shortened
from roughline.errors.words import called
from roughline.topography.files.archives import refuse_hollow, refuse_points
from roughline.topography.files.cf_variables import is_length
from roughline.topography.files.channels import Channel, find_channel, listed
from roughline.topography.files.instrument import silence
from roughline.topography.files.measurement import Measurement
from roughline.topography.settings import MEASURED
from roughline.units import metres_per

_MARKS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_JPK_TAG = 0x8000  # the first tag of its own
_LEXT_MARK = "TiffTagDescData"
_PROGRAMS = {
    **{34118: "Zeiss SEM", 34680: "FEI SEM", 34682: "FEI SEM", 50431: "Tescan SEM"},
    **{50433: "Park Systems", 50434: "Park Systems", 50435: "Park Systems"},
}
"""Tags of programs whose files hold pictures, or heights in a layout that is not read."""

_LINEAR, _NOT_CALIBRATED = "0", "20"  # functions of ImageJ from counts to values
_LONGEST_SIGN = 3  # letters; longer units are words, however they are capitalised
_NODATA = 42113  # GDAL's tag of the mark of missing points
_GREY, _LEAST_BITS = 1, 16  # white is the largest number; a picture of 256 shades is no map
_PRINTED = 2400 / 25.4e-3  # pixels; coarser ones are those of a printer, not of a specimen [1/m]
_METRES = {2: 25.4e-3, 3: 1e-2}  # in the unit of the resolution
_PATTERNS = {1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0)}
_PATTERNS |= {5: (0, 0, 1), 6: (1, 0, 1), 7: (1, 1, 1), 8: (0, 1, 1)}
"""Of the tag of orientation: whether x and y run backwards and, before that, are exchanged."""


def read_tiff(path: Path, channel: int | str | None, name: str) -> Measurement | None:
    """Read heights from TIFF; None if the file has another format, or one of a microscope."""
    with path.open("rb") as file:
        if file.read(4) not in _MARKS:
            return None
    import tifffile  # here because it loads slowly

    try:
        with silence(), tifffile.TiffFile(path) as file:
            refuse_hollow(path, name)
            if _is_of_a_microscope(file):
                return None
            return _read_measurement(file, path, channel, name)
    except (RoughlineError, MemoryError):
        raise
    except Exception as error:  # of a damaged file the reader raises errors of any type
        first_line = shortened((str(error).strip() or "no reason given").splitlines()[0])
        raise InputError(
            f"{name} is damaged TIFF, or packed in a way that is not read "
            f"({type(error).__name__}: {first_line}): save it again, not packed"
        ) from error


def _is_of_a_microscope(file: Any) -> bool:
    """Whether the file is one of JPK or LEXT."""
    return any(_JPK_TAG in page.tags or _LEXT_MARK in page.description for page in file.pages)


def _read_measurement(file: Any, path: Path, channel: int | str | None, name: str) -> Measurement:
    pages = list(file.pages)
    _refuse_programs(pages, name)
    channels = [Channel("image", _why_none(page)) for page in pages]
    page = pages[_chosen(channels, channel, name)]
    stated = _imagej(pages[0].description)
    if len(pages) < int(stated.get("images", "1")):
        raise InputError(f"{name} is a stack of {stated['images']} images: save one of them")
    refuse_points(page.shape, path, name)
    rows, unit = _read_heights(page, stated, name)
    backwards_x, backwards_y, is_exchanged = _PATTERNS[int(page.tags.valueof(274, 1))]
    heights = rows if is_exchanged else rows.T
    for axis, is_backwards in enumerate((backwards_x, backwards_y)):
        heights = np.flip(heights, axis) if is_backwards else heights
    pixels = _pixels(page, stated)
    if pixels is not None and is_exchanged:
        pixels = pixels[1], pixels[0], pixels[2]
    return Measurement(
        file=name,
        heights=heights,
        unit=unit,
        **_scale(heights.shape, pixels, unit),
        kind="surface",
        channels=listed(channels),
        settings={"origin": MEASURED, "file": name},
        format="TIFF",
    )


def _refuse_programs(pages: list[Any], name: str) -> None:
    """Refuse files of programs that keep pictures, or heights in a layout of their own."""
    for page in pages:
        for tag, program in _PROGRAMS.items():
            if tag in page.tags:
                raise InputError(
                    f"{name} is TIFF of {program}, whose layout is not read: export the heights "
                    "from its program, or from Gwyddion, as GSF, GWY or X3P"
                )


def _why_none(page: Any) -> str:
    """Why an image holds no heights; empty if it does."""
    if page.dtype is None or page.dtype.kind not in "iuf" or page.bitspersample < _LEAST_BITS:
        return f"{page.bitspersample} bits for each point"
    if page.photometric != _GREY or page.samplesperpixel != 1:
        return "a picture in colours, or from white to black"
    return "a preview" if page.subfiletype & 1 else ""


def _chosen(channels: list[Channel], channel: int | str | None, name: str) -> int:
    """The number of the image that is asked for, or of the only one with heights."""
    if channel is not None:
        return find_channel(channels, channel, name)
    found = [i for i, each in enumerate(channels) if not each.why_none]
    if not found:
        reason = channels[0].why_none if channels else "no image"
        raise InputError(
            f"{name} is a picture and holds no heights ({reason}): save the heights as numbers, as "
            "floats or counts of 16 bits, not as they look"
        )
    if len(found) > 1:
        raise InputError(
            f"{name} has {len(found)} images that may be heights: choose one by its number, such "
            f"as {called('channel', str(found[0]))}"
        )
    return found[0]


def _imagej(description: str) -> dict[str, str]:
    """What ImageJ states of an image, by key; empty for other programs."""
    if not description.startswith("ImageJ="):
        return {}
    pairs = (line.partition("=") for line in description.splitlines())
    return {key.strip(): value.strip() for key, _, value in pairs}


def _read_heights(page: Any, stated: dict[str, str], name: str) -> tuple[Real, str | None]:
    """Rows of heights, and their unit if it is known."""
    raw = page.asarray()
    rows = raw.astype(np.float64)
    if _NODATA in page.tags:
        rows[raw == raw.dtype.type(float(page.tags[_NODATA].value))] = np.nan
    function = stated.get("cf", _NOT_CALIBRATED)
    if function == _NOT_CALIBRATED:
        return rows, None
    if function != _LINEAR:
        raise InputError(
            f"{name} has values that ImageJ calibrates by a curve: apply it there, and save the "
            "result as floats"
        )
    rows *= float(stated["c1"])
    rows += float(stated["c0"])
    return rows, _length(stated.get("vunit", ""))


def _length(unit: str) -> str | None:
    """A unit of length that ImageJ states, its µ written in plain letters; None if it is none."""
    unit = re.sub(r"\\u00b5", "µ", unit, flags=re.IGNORECASE)
    unit = unit.lower() if len(unit) > _LONGEST_SIGN else unit
    return unit if is_length(unit) else None


def _pixels(page: Any, stated: dict[str, str]) -> tuple[float, float, str] | None:
    """The sides of a pixel and their unit; None where they are those of a printer, or unknown."""
    x, y = (float(each) for each in page.resolution)
    if not {282, 283} <= {tag.code for tag in page.tags} or not (0 < x < np.inf and 0 < y < np.inf):
        return None
    if "unit" in stated:
        unit = _length(stated["unit"])
        return (1 / x, 1 / y, unit) if unit and "yunit" not in stated else None
    metres = _METRES.get(int(page.resolutionunit))
    if metres is None or min(x, y) / metres <= _PRINTED:
        return None
    return metres / x, metres / y, "m"


def _scale(
    shape: tuple[int, ...], pixels: tuple[float, float, str] | None, unit: str | None
) -> dict[str, Any]:
    """Sides as a measurement has them: in the unit of the heights, where that is known."""
    if pixels is None:
        return {"sizes": None}
    dx, dy, unit_of_sides = pixels
    factor = metres_per(unit_of_sides) / metres_per(unit) if unit else 1.0
    sizes = (factor * shape[0] * dx, factor * shape[1] * dy)
    return {"sizes": sizes, "unit_of_sides": None if unit else unit_of_sides}
