"""Reports show maps as instruments' software does: the first row at the top, y downwards."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

import roughline as rl
from roughline.question.description import describe
from roughline.report.contact_figures import draw_filled
from roughline.report.description_figures import write_description
from roughline.report.description_table import print_description
from roughline.report.part_report import heights_figure
from seen import is_upright, lay_of_45_degrees, seen


@pytest.fixture(scope="module")
def holed(tmp_path_factory):
    """A description of a map with a hole in its upper right corner, and its heights."""
    heights = lay_of_45_degrees().heights.copy()
    heights[22:, :7] = np.nan
    path = tmp_path_factory.mktemp("holed") / "map.npy"
    np.save(path, heights)
    return describe(path, rl.Reading(unit="m", sizes=(1e-3,))), heights


def test_figures_of_a_file_are_upright(holed, tmp_path, monkeypatch):
    description, heights = holed
    kept = []
    monkeypatch.setattr(
        "roughline.report.description_figures.save",
        lambda figure, folder, name: kept.append(figure) or [],
    )
    write_description(description, tmp_path)
    of_file, *_ = kept
    left, right, *_ = of_file.axes
    assert is_upright(seen(right), np.isnan(heights))
    white = seen(left) > 250  # but for ticks
    rows, columns = (n // 8 for n in white.shape)
    assert white[:rows, -columns:].mean() > 0.9
    assert white[-rows:, -columns:].mean() < 0.1


def test_missing_points_in_characters_are_upright(holed, capsys):
    print_description(holed[0])
    printed = capsys.readouterr().out.splitlines()
    first = next(i for i, line in enumerate(printed) if "y downwards" in line)
    drawn = [line.strip() for line in printed[first + 1 :] if set(line.strip()) <= set(".+#")]
    assert drawn[0].startswith("...")
    assert drawn[0].endswith("###")
    assert set(drawn[-1]) == {"."}


def test_filled_points_are_marked_where_the_picture_has_them():
    marks = np.zeros((32, 32))
    marks[4:8, 20:30] = 1
    surface = lay_of_45_degrees(unit="m")
    part = SimpleNamespace(filled_region=rl.Surface(marks, surface.sizes, "m"))
    axes = Figure().subplots()
    rl.plot.topography(surface, axes)
    before = axes.axis()
    draw_filled(axes, SimpleNamespace(body=surface, topographies=[part]))
    assert axes.axis() == before
    outline = np.concatenate([path.vertices for path in axes.collections[-1].get_paths()])
    assert outline[:, 1].mean() / before[2] == pytest.approx(25 / 32, abs=0.5 / 32)


def test_maps_of_a_part_are_upright():
    surface = lay_of_45_degrees(unit="m")
    part = SimpleNamespace(assessments=[SimpleNamespace(body=surface)], names=["lay"])
    assert is_upright(seen(heights_figure(part).axes[0]), surface.heights)
