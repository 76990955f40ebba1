"""Sentences on broken assumptions, and which answers they take down."""

from __future__ import annotations

import numpy as np

import roughline as rl
from benchmarks.made_surfaces import Make, parent_of, piece_of
from roughline.question.assumptions import broken
from told import first_warning


def wavy_map() -> rl.Surface:
    make, rng = Make(points=64, maps=4), np.random.default_rng(1)
    return piece_of(parent_of("waviness of 4 maps", make, rng), make, rng)


def test_a_broken_assumption_stands_above_other_warnings_only_where_answers_rest_on_it():
    body = wavy_map()
    (departure,) = broken("larger surface", body)
    assert departure.assumption == "longer waves"
    with_materials = rl.assess(
        rl.Question(body, materials=("steel", "steel"), loads=["1 MPa"], grid_error=False)
    )
    assert first_warning(with_materials).startswith(departure.text)
    assert "interface stiffness" in first_warning(with_materials).removeprefix(departure.text)
    of_the_map_alone = rl.assess(
        rl.Question(body, E_star="100 GPa", loads=["1 MPa"], grid_error=False)
    )
    assert departure.text not in " ".join(of_the_map_alone.warnings)


def test_a_press_without_materials_fits_no_spectrum(monkeypatch):
    def fitted(body):
        raise AssertionError("no answer to this question rests on the spectrum's law")

    monkeypatch.setattr("roughline.measurement.departures.fitted", fitted)
    result = rl.assess(rl.Question(wavy_map(), E_star="100 GPa", loads=["1 MPa"], grid_error=True))
    assert result.intervals is not None
