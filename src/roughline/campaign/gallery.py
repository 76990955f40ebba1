"""Single bodies of both models to look at: computed by one worker, kept beside the ensembles."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughline._version import __version__
from roughline.campaign.batch import Results, check_version
from roughline.campaign.layout import GALLERY, GALLERY_DONE, codecs
from roughline.campaign.plan import Gallery
from roughline.campaign.store import read_or_none
from roughline.computing import fft
from roughline.computing.cores import available_cores
from roughline.contact.press import press
from roughline.errors import StoreError
from roughline.spectra.self_affine import SelfAffine

_DIMENSIONS = {
    "heights": ("fractal_dimension", "x", "y"),
    "contact": ("fractal_dimension", "x", "y"),
    "displacement": ("fractal_dimension", "x", "y"),
    "line_heights": ("fractal_dimension", "s"),
    "line_depth": ("fractal_dimension",),
}


def evaluate_gallery(gallery: Gallery, threads: int, version: str) -> Results:
    """Press one surface and one line for each fractal dimension; keep what the figures show."""
    check_version(version)
    fft.set_threads(min(threads, available_cores()))
    bodies = [bodies_of(gallery, dimension) for dimension in gallery.fractal_dimensions]
    return {name: np.array([body[name] for body in bodies]) for name in _DIMENSIONS}


def bodies_of(gallery: Gallery, fractal_dimension: float) -> dict[str, NDArray[Any]]:
    """Press the surface and the line of one fractal dimension.

    Arrays are over h: heights, contact and displacement of shape (n, n), line_heights, line_depth.
    """
    spectrum = SelfAffine(fractal_dimension=fractal_dimension, rms_height=1.0)
    surface = spectrum.surface(gallery.n, gallery.seed)
    line = spectrum.line(gallery.n_line, gallery.seed)
    fields = press(surface, E_star=1.0, forces=[gallery.force_bar], fields=True).fields[0]
    assert fields is not None
    return {
        "heights": surface.heights,
        "contact": fields.contact,
        "displacement": fields.displacement,
        "line_heights": line.heights,
        "line_depth": press(line, E_star=1.0, forces=[gallery.force_bar]).depth[0],
    }


def write_gallery(root: Any, gallery: Gallery, results: Results) -> None:
    """Write the gallery into the root group of a store, and mark it done."""
    group = root.require_group(GALLERY)
    group.attrs.update(_settings(gallery))
    coordinate = np.array(gallery.fractal_dimensions)
    for name, values in {**results, "fractal_dimension": coordinate}.items():
        group.create_array(
            name,
            data=values,
            dimension_names=_DIMENSIONS.get(name, ("fractal_dimension",)),
            overwrite=True,
            **codecs(),
        )
    root.attrs[GALLERY_DONE] = True


def gallery_is_whole(root: Any, gallery: Gallery, path: Path) -> bool:
    """Whether all of a gallery that was marked done is there and can be read.

    One of other fractal dimensions is not: they are drawn instead, as a study grows by them.
    """
    group = root[GALLERY]
    wanted = json.loads(json.dumps(_settings(gallery)))
    differ = [key for key in wanted if group.attrs.get(key) != wanted[key]]
    if differ == ["fractal_dimensions"]:
        return False
    if differ:
        raise StoreError(f"{path} holds a gallery with other settings; choose another folder")
    return all(read_or_none(group[name]) is not None for name in _DIMENSIONS)


def _settings(gallery: Gallery) -> dict[str, Any]:
    return {
        "n": gallery.n,
        "n_line": gallery.n_line,
        "force_bar": gallery.force_bar,
        "seed": gallery.seed,
        "fractal_dimensions": list(gallery.fractal_dimensions),
        "roughline_version": __version__,
    }
