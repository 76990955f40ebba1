"""The paper's study as a plan."""

from roughline.paper.plan import paper_plan


def test_the_quick_scale_takes_minutes():
    lines, matched, surfaces = paper_plan("quick").ensembles
    assert (lines.n, lines.realisations, len(lines.fractal_dimensions)) == (2**16, 100, 21)
    assert (surfaces.n, surfaces.realisations) == (256, 10)
    assert matched.cutoff_ratio == surfaces.n / 2
    assert matched.force_bars == surfaces.force_bars
    assert {2.0, 2.2, 2.4, 2.6, 2.8, 3.0} <= set(lines.fractal_dimensions)


def test_the_full_scale_is_the_papers():
    lines, _, surfaces = paper_plan("full").ensembles
    assert (surfaces.n, surfaces.realisations) == (2048, 60)
    assert (lines.n, lines.realisations, len(lines.fractal_dimensions)) == (2**20, 500, 101)
    assert surfaces.fractal_dimensions == (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)
    assert {2.0, 2.2, 2.4, 2.6, 2.8, 3.0} <= set(lines.fractal_dimensions)
