"""Results as JSON, for other programs."""

from __future__ import annotations

import enum
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughline._version import __version__
from roughline.contact.curve import Status
from roughline.topography.body import Body, Surface

if TYPE_CHECKING:
    from roughline.assessment.compared import Compared
    from roughline.assessment.described import Described
    from roughline.assessment.pressed import Pressed
    from roughline.campaign.run import Summary
    from roughline.campaign.store import Store


def to_json(content: Mapping[str, Any]) -> str:
    """Write plain content; NaN and infinities, which JSON has not, become null."""
    return json.dumps(_plain({"roughline_version": __version__, **content}), indent=1)


def of_pressed(pressed: Pressed) -> dict[str, Any]:
    """What pressing gave, in SI units, over the loads that were asked for, in their order."""
    curve = pressed.at_asked
    return {
        "file": pressed.source.file,
        "body": _of_body(pressed.body),
        "E_star": curve.E_star,
        "nominal_area": pressed.area,
        "loads": pressed.headings,
        "curve": {
            name: getattr(curve, name)
            for name in (
                "depth",
                "force",
                "stiffness",
                "area_fraction",
                "area_fraction_corrected",
                "stiffness_error",
                "area_fraction_error",
                "residual",
                "resolved",
            )
        }
        | {"status": [Status(value).name.lower() for value in curve.status]},
        "stiffness_interval": pressed.ends_at_asked(pressed.stiffness_interval),
        "area_fraction_interval": pressed.ends_at_asked(pressed.area_interval),
        "answers": {
            each.symbol: {
                "name": each.name,
                "unit": each.unit,
                "values": each.values,
                "low": each.low,
                "high": each.high,
                "formula": each.formula,
                "validity": each.validity,
                "source": each.source,
            }
            for each in pressed.answers
        },
        "theories": {
            each.name: {
                "pressure": each.pressure,
                "area_fraction": each.area_fraction,
                "stiffness_per_area": each.stiffness,
                "mean_gap": each.mean_gap,
                "validity": each.validity,
            }
            for each in pressed.theories
        },
        "notes": pressed.notes,
        "settings": curve.settings,
        "files": pressed.files,
    }


def of_described(described: Described) -> dict[str, Any]:
    """What a topography is like, in SI units."""
    found, missing = described.roughness, described.missing
    fit = found.fit if found is not None else None
    names = ("rms_height", "rms_slope", "skewness", "kurtosis", "summits", "summit_skewness")
    return {
        "file": described.source.file,
        "in_file": {
            "points": described.measurement.heights.shape,
            "sizes": described.measurement.sizes,
            "unit": described.measurement.unit,
            "kind": described.measurement.kind,
            "channel": described.measurement.channel,
            "channels": described.measurement.channels,
        },
        "missing": {
            "points": missing.count,
            "share": missing.share,
            "where": str(missing),
            "regions": missing.regions,
            "largest_region": missing.largest,
            "at_border": missing.at_border,
            "cells": missing.cells,
        },
        "obstacles": described.obstacles,
        "body": None if described.body is None else _of_body(described.body),
        **{name: getattr(found, name, None) for name in (*names, "isotropy")},
        "self_affine": None
        if fit is None
        else {
            name: getattr(fit, name)
            for name in (
                "hurst",
                "hurst_interval",
                "q_roll",
                "q_roll_interval",
                "q_high",
                "q_high_interval",
                "C_0",
                "rms_interval",
                "scatter",
                "objections",
            )
        },
        "remarks": found.remarks if found is not None else [],
        "notes": described.notes,
        "files": described.files,
    }


def of_compared(compared: Compared) -> dict[str, Any]:
    """Both models of one roughness, dimensionless."""
    result = compared.comparison
    return {
        "what": compared.what,
        "force_bar": result.force_bar,
        "stiffness_full": result.full.mean,
        "stiffness_reduced": result.reduced.mean,
        "difference": result.difference,
        "low": result.low,
        "high": result.high,
        "resolved": result.resolved,
        "tolerance": compared.tolerance,
        "trusted": result.trusted(compared.tolerance),
        "warnings": result.warnings,
        "files": compared.files,
    }


def of_summary(summary: Summary, store: Path) -> dict[str, Any]:
    """What a run of a campaign did."""
    return {
        "store": store,
        "done": summary.done,
        "failed": summary.failed,
        "core_seconds": summary.core_seconds,
        "reasons": summary.reasons,
        "unconverged": summary.unconverged,
    }


def of_status(store: Store) -> dict[str, Any]:
    """What is done of a campaign."""
    names = ("done", "failed", "cases")
    return {
        "store": store.path,
        "ensembles": {
            name: dict(zip(names, store.counts(name), strict=True))
            | {"failures": store.failures(name)}
            for name in store.names
        },
    }


def of_generated(body: Body, file: Path) -> dict[str, Any]:
    """What was generated."""
    return {"body": _of_body(body), "files": [file]}


def _of_body(body: Body) -> dict[str, Any]:
    sizes = body.sizes if isinstance(body, Surface) else [body.length]
    return {
        "points": list(body.heights.shape),
        "sizes": sizes,
        "rms_height": body.rms_height,
        "rms_slope": body.rms_slope,
        "settings": body.settings,
    }


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, enum.Enum):
        return value.name.lower()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
