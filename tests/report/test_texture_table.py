"""The parameters of surface texture in a report."""

from types import SimpleNamespace

import numpy as np
import pytest

import roughline as rl
from roughline.report.contact_report import _texture
from roughline.report.texture_table import texture_table


def in_metres(heights):
    return rl.Surface(1e-6 * heights, (1e-3, 1e-3), "m", is_cut_out=True)


@pytest.fixture
def found():
    return rl.iso(in_metres(np.random.default_rng(1).normal(size=(32, 32))))


def test_a_report_has_them_behind_a_fold(found):
    (section,) = _texture(SimpleNamespace(texture=found))
    assert section.behind == "parameters of ISO 25178-2:2021 of what was pressed"
    assert "Filters: F: none, S: none, L: none" in section.paragraphs[0].replace(
        "filters", "Filters"
    )
    (table,) = section.tables
    assert [row[0] for row in table.rows] == list(found.values)
    assert _texture(SimpleNamespace(texture=None)) == []


def test_densities_are_per_square_millimetre_and_curvatures_per_millimetre(found):
    rows = {row[0]: row[1] for row in texture_table(found)[1]}
    assert rows["Spd"] == f"{1e-6 * found.Spd:.4g} /mm²"
    value, unit = rows["Spc"].split()
    assert float(value) == pytest.approx(1e-3 * found.Spc, rel=1e-3)
    assert unit == "/mm"
    assert rows["Sz"].endswith(" µm")
    assert rows["Smrk1"].endswith(" %")
