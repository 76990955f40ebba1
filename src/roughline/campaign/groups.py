"""The group of an ensemble in a store: made, or enlarged, as a plan needs it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from roughline._version import __version__
from roughline.campaign.cost import chunk_shape
from roughline.campaign.layout import (
    CASE_STATUS,
    COORDINATES,
    PENDING,
    Variable,
    variables_of,
)
from roughline.campaign.mending import read_or_none
from roughline.campaign.plan import Ensemble
from roughline.errors import StoreError


def refuse_other_settings(root: Any, ensemble: Ensemble, path: Path) -> None:
    """Refuse a store that holds results under an ensemble's name but with other settings.

    Where nothing was computed under that name yet, its group is removed instead.
    """
    if ensemble.name not in root:
        return
    # of elastic bodies, neither the settings nor what is stored names a hardness
    wanted = {"hardness_bar": None, **json.loads(json.dumps(ensemble.identity()))}
    group = root[ensemble.name]
    stored = group.attrs
    if {key: stored.get(key) for key in wanted} == wanted:
        return
    if CASE_STATUS.name not in group or (group[CASE_STATUS.name][:] == PENDING).all():
        del root[ensemble.name]
        return
    for key, value in wanted.items():
        if stored.get(key) != value:
            raise StoreError(
                f"{path} holds an ensemble {ensemble.name!r} with other settings: its {key} "
                f"is {_short(stored.get(key))}, the plan's is {_short(value)}; rename the "
                "ensemble, or choose another folder"
            )


def prepared_group(root: Any, ensemble: Ensemble) -> Any:
    """Return the group of an ensemble, made or enlarged; nothing that is there changes."""
    if ensemble.name not in root:
        attributes = {
            **json.loads(json.dumps(ensemble.identity())),
            **_descriptions(ensemble),
            "fractal_dimensions": [],
            "failures": {},
        }
        root.create_group(ensemble.name, attributes=attributes)
    group = root[ensemble.name]
    before = list(group.attrs["fractal_dimensions"])
    known = before + [value for value in ensemble.fractal_dimensions if value not in before]
    if known != before:
        group.attrs["fractal_dimensions"] = known
    stored = group[CASE_STATUS.name].shape[1] if CASE_STATUS.name in group else 0
    realisations = max(ensemble.realisations, stored)
    shape = (len(known), realisations, len(ensemble.force_bars))
    chunks = (*chunk_shape(ensemble), len(ensemble.force_bars))
    for variable in (*variables_of(ensemble), CASE_STATUS):
        rank = len(variable.dims)
        _prepared_array(group, variable, shape[:rank], tuple(map(min, chunks, shape[:rank])))
    values = (np.array(known), np.arange(realisations), np.array(ensemble.force_bars))
    for coordinate, value in zip(COORDINATES, values, strict=True):
        array = _prepared_array(group, coordinate, value.shape, value.shape)
        stored_value = read_or_none(array)
        if stored_value is None or not np.array_equal(stored_value, value):
            array[:] = value
    return group


def codecs() -> dict[str, Any]:
    """Return how chunks are compressed, and that they carry checksums."""
    from zarr.codecs import Crc32cCodec, ZstdCodec

    return {"compressors": (ZstdCodec(level=1), Crc32cCodec())}


def _prepared_array(
    group: Any, variable: Variable, shape: tuple[int, ...], chunks: tuple[int, ...]
) -> Any:
    """Return an array of the group, made or enlarged where needed."""
    if variable.name not in group:
        return group.create_array(
            variable.name,
            shape=shape,
            chunks=chunks,
            dtype=variable.dtype,
            fill_value=variable.fill,
            dimension_names=variable.dims,
            attributes={"long_name": variable.meaning, "units": "1"},
            **codecs(),
        )
    array = group[variable.name]
    if array.shape != shape:
        array.resize(shape)
    return array


def _descriptions(ensemble: Ensemble) -> dict[str, Any]:
    """Return what a reader wants to know besides the settings themselves."""
    end = "pi / spacing" if ensemble.cutoff_ratio is None else "cutoff_ratio * 2 pi / L"
    return {
        "roughline_version": __version__,
        "heights": "random phases, fixed moduli, scaled to rms 1; length L = 1, E* = 1",
        "spectrum": f"self-affine from roll_off_ratio * 2 pi / L to {end}, flat below",
    }


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
