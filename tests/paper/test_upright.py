"""The gallery of the paper shows its surfaces as other maps are shown: y downwards."""

import xarray
from mpl_toolkits.mplot3d import Axes3D

from roughline.paper.figures import body_figure
from seen import is_upright, lay_of_45_degrees, seen


def test_bodies_of_the_gallery_are_upright(monkeypatch):
    heights = 1e6 * lay_of_45_degrees().heights
    of_surface = ("fractal_dimension", "x", "y")
    gallery = xarray.Dataset(
        {
            "heights": (of_surface, heights[None]),
            "contact": (of_surface, heights[None] > 1),
            "displacement": (of_surface, heights[None]),
            "line_heights": (("fractal_dimension", "s"), heights[:1]),
        },
        {"fractal_dimension": [2.4]},
    )
    given = []
    monkeypatch.setattr(Axes3D, "plot_surface", lambda axes, *points, **look: given.append(points))
    _, _, contact, deflection, *_ = body_figure(gallery, 0).axes
    assert is_upright(seen(contact), heights > 1)
    assert is_upright(seen(deflection), heights)
    ((x, y, z),) = given
    block = z > 2.4
    assert x[block].max() < x.max() / 4
    assert y[block].min() > 3 / 4 * y.min()  # at the back, where the picture from above has its top
