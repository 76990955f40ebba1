"""Results as JSON, for other programs."""

from __future__ import annotations

import enum
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roughline._version import __version__
from roughline.contact.quantities import IN_JSON, SLIDING_QUANTITIES
from roughline.contact.status import Status
from roughline.facts.fact import Fact
from roughline.report.texture_table import texture_json
from roughline.topography.body import Body, side_lengths

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.assessment.part import PartAssessment
    from roughline.comparison.compared import ModelComparison
    from roughline.contact.measures import Measured
    from roughline.engineering.slip import ShearCycles
    from roughline.measurement.fit import SelfAffineFit
    from roughline.question.description import Description


def to_json(content: Mapping[str, Any]) -> str:
    """Write plain content; NaN and infinities, which JSON does not have, become null."""
    return json.dumps(plain({"roughline_version": __version__, **content}), indent=1)


def assessment_json(assessment: Assessment, files: Sequence[Path] = ()) -> dict[str, Any]:
    """What pressing gave, in SI units, over the loads that were asked for, in their order.

    Of a joint the answers are the joint's; the curve and its intervals are those of the map, under
    the map's part of the load. Forces of the curve are those with which the bodies press, without
    what a fluid carries. Answers are listed by their symbols; the key of each is that of
    :attr:`Assessment.answers`.
    """
    intervals = assessment.intervals_as_asked
    pair = assessment.question.pair
    question, curve = assessment.question, assessment.curve_as_asked
    return {
        "file": (question.reading.name or question.body)
        if isinstance(question.body, Path)
        else None,
        "body": _body_json(assessment.body),
        "materials": pair and [pair.first.name, pair.second.name],
        "E_star": curve.E_star,
        "nominal_area": assessment.area,
        "joint_area": question.joint,
        "loads": assessment.headings,
        "curve": {
            "of": "map" if question.joint is not None else "body",
            **{
                quantity.name: getattr(curve, quantity.name, None)  # of a line, not all
                for quantity in IN_JSON
                if quantity.is_left_by("none" if curve.law is None else curve.law.memory)
            },
            "status": [Status(value).name.lower() for value in curve.status],
        },
        "intervals_of": "map" if question.joint is not None else "body",
        "stiffness_interval": intervals and intervals.stiffness,
        "unloading_stiffness_interval": intervals and intervals.unloading,
        "area_fraction_interval": intervals and intervals.area,
        "measures": {
            name: {"unit": each.quantity.unit_in("m"), **_measured_json(each, assessment)}
            for name, each in assessment.measured.items()
        },
        **({} if assessment.on_filled is None else {"force_on_filled": assessment.on_filled}),
        "answers_of": "joint" if question.joint is not None else "body",
        "answers": _answers_json(assessment),
        "theories": {
            each.name: {
                "pressure": each.pressure,
                "area_fraction": each.area_fraction,
                "stiffness_per_area": each.stiffness,
                "mean_gap": each.mean_gap,
                "validity": each.validity,
            }
            for each in assessment.theories
        },
        "notes": assessment.remarks,
        "facts": list(map(_fact_json, assessment.facts)),
        "settings": curve.settings,
        "files": list(files),
        **_friction_json(assessment),
    }


def _friction_json(assessment: Assessment) -> dict[str, Any]:
    """Partial slip and the path of a shear force, as far as they are asked for."""
    question, slip, found = assessment.question, assessment.partial_slip, dict[str, Any]()
    if question.friction is not None:
        found["partial_slip"] = None if slip is None else vars(slip)
    if question.shear is not None:
        found["sheared"] = _sheared_json(assessment.sought.sheared)
    return found


def _sheared_json(sheared: ShearCycles | None) -> dict[str, Any] | None:
    """The path of a shear force, on the body that was pressed, and its last cycle."""
    if sheared is None:
        return None
    path = {
        each.name: getattr(sheared.curve, each.name)
        for each in SLIDING_QUANTITIES
        if "x" not in each.dims
    }
    closed = sheared.closed_form
    return {
        "friction": sheared.friction,
        "loads_of_a_cycle": sheared.per_cycle,
        "cycles": sheared.cycles,
        "force": sheared.curve.force,
        **path,
        "energy_of_cycles": sheared.energies,
        "closed_form": None if closed is None else vars(closed),
    }


def _fact_json(fact: Fact) -> dict[str, Any]:
    """A fact by its kind, with its numbers and its words."""
    return {
        "kind": fact.kind,
        "weight": fact.weight,
        "about": fact.about,
        "answers": fact.of,
        "numbers": {name: _number_json(each) for name, each in fact.numbers.items()},
        "in_short": fact.in_short,
        "in_full": str(fact),
    }


def _number_json(number: Any) -> Any:
    """A number of a fact, or facts that it is made of."""
    if isinstance(number, tuple):
        return list(map(_number_json, number))
    return _fact_json(number) if isinstance(number, Fact) else number


def _measured_json(measured: Measured, assessment: Assessment) -> dict[str, Any]:
    """A measure over the loads that were asked for."""
    return {
        "symbol": measured.quantity.symbol,
        "meaning": measured.quantity.meaning,
        **dict(zip(("values", "low", "high"), measured.rows[:, assessment.asked], strict=False)),
    }


def _answers_json(assessment: Assessment) -> dict[str, Any]:
    """The answers by their symbols."""
    return {
        each.symbol: {
            "key": each.key,
            "name": each.name,
            "unit": each.unit,
            "values": each.values,
            "low": each.low,
            "high": each.high,
            "formula": each.formula,
            "validity": each.validity,
            "source": each.source,
            "if_elastic": (elastic := assessment.elastic.get(each.key)) and elastic.values,
            "margins": list(map(vars, each.margins)),
        }
        for each in assessment.answers.values()
    }


def part_json(part: PartAssessment, files: Sequence[Path] = ()) -> dict[str, Any]:
    """What several maps gave, in SI units, over the loads that were asked for.

    Answers are listed by their symbols; each map has the same content as a single one.
    """
    return {
        "loads": part.headings,
        "joint_area": part.question.joint,
        "part": {
            each.symbol: {
                "key": each.key,
                "name": each.name,
                "unit": each.unit,
                "mean": each.mean,
                "scatter": each.scatter,
                "low": each.low,
                "high": each.high,
                "maps": each.count,
                "if_elastic": (elastic := part.elastic.get(each.key)) and elastic.mean,
            }
            for each in part.answers.values()
        },
        "maps": {
            name: assessment_json(each)
            for name, each in zip(part.names, part.assessments, strict=True)
        },
        "refused": part.refused,
        "not_pressed": part.left,
        "notes": part.remarks,
        "facts": list(map(_fact_json, part.facts)),
        "files": list(files),
    }


def description_json(description: Description, files: Sequence[Path] = ()) -> dict[str, Any]:
    """What a topography is like, in SI units."""
    parameters, missing = description.roughness, description.missing
    content = description.measurement
    fit = parameters.fit if parameters is not None else None
    names = ("rms_height", "rms_slope", "skewness", "kurtosis", "summits", "summit_skewness")
    return {
        "file": description.file,
        "in_file": {
            "points": content.heights.shape,
            "sizes": content.sizes,
            "unit": content.unit,
            "kind": content.kind,
            "channel": content.channel,
            "channels": content.channels,
            "format": content.format,
            "reader": content.read_by,
            "corrected": content.corrected,
            "doubts": content.doubts,
            "masked_share": None if content.masked is None else content.masked.mean(),
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
        "obstacles": description.obstacles,
        "body": None if description.body is None else _body_json(description.body),
        **{name: getattr(parameters, name, None) for name in (*names, "isotropy")},
        "self_affine": None if fit is None else _fit_json(fit),
        "remarks": parameters.remarks if parameters is not None else [],
        **({} if description.texture is None else {"iso": texture_json(description.texture)}),
        "notes": description.remarks,
        "files": list(files),
    }


def _fit_json(fit: SelfAffineFit) -> dict[str, Any]:
    """A self-affine law; where it is refused, null but for what is off it, and why."""
    values = ("hurst", "q_roll", "q_high", "corner", "blur", "q_tail", "C_0")
    intervals = ("hurst_interval", "q_roll_interval", "q_high_interval")
    return {
        **{name: None if fit.objections else getattr(fit, name) for name in values},
        **{name: getattr(fit, name) for name in (*intervals, "blur_interval", "rms_interval")},
        "scatter": fit.scatter,
        "objections": fit.objections,
    }


def comparison_json(compared: ModelComparison, files: Sequence[Path] = ()) -> dict[str, Any]:
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
        "files": list(files),
    }


def generated_json(body: Body, file: Path) -> dict[str, Any]:
    """What was generated."""
    return {"body": _body_json(body), "files": [file]}


def _body_json(body: Body) -> dict[str, Any]:
    sizes = side_lengths(body)
    return {
        "points": list(body.heights.shape),
        "sizes": sizes,
        "rms_height": body.rms_height,
        "rms_slope": body.rms_slope,
        "settings": body.settings,
    }


_PLAIN = (str, int, bool, type(None))  # what JSON holds as it is; subclasses may mean more


def plain(value: Any) -> Any:
    """Return a value as JSON can hold it; NaN and infinities become null."""
    if type(value) in _PLAIN:
        return value
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray) and value.dtype.kind == "f" and np.isfinite(value).all():
        return value.tolist()
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, enum.Enum):
        return value.name.lower()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
