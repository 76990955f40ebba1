"""Labels of logarithmic axes."""

from itertools import pairwise

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from roughline.plot.style import label_decades, new_figure, save, styled


@pytest.mark.parametrize("decades", [0.2, 0.35, 0.5, 0.8, 0.95, 1.1, 1.5, 1.9, 2.5, 4.0])
@pytest.mark.parametrize("begin", [1.0, 1.3, 2.2, 3.4, 7.1])
def test_labels_of_a_narrow_logarithmic_axis_do_not_overlap(begin, decades):
    low, high = begin, begin * 10**decades
    with styled():
        figure = new_figure(2.4, 2.6)
        axes = figure.subplots()
        axes.set_xscale("log")
        axes.set_xlim(low, high)
        label_decades(axes)
        FigureCanvasAgg(figure).draw()
        ticks = [*axes.xaxis.get_major_ticks(), *axes.xaxis.get_minor_ticks()]
        shown = {each.get_loc(): each.label1 for each in ticks if low <= each.get_loc() <= high}
        boxes = [shown[at].get_window_extent() for at in sorted(shown) if shown[at].get_text()]
    assert boxes
    assert all(left.x1 < right.x0 for left, right in pairwise(boxes))


def test_a_figure_is_laid_out_alike_in_both_files(tmp_path, monkeypatch):
    places, write = [], Figure.savefig

    def written(figure, path, **how):
        write(figure, path, **how)
        places.append(figure.axes[0].get_position().bounds)

    monkeypatch.setattr(Figure, "savefig", written)
    with styled():
        figure = new_figure(2.4, 2.6)
        axes = figure.subplots()
        before = axes.get_position().bounds
        axes.set(xlabel="force", ylabel="stiffness", title="of a surface")
        save(figure, tmp_path, "curve")
    in_png, in_pdf = places
    assert in_png == in_pdf != before
