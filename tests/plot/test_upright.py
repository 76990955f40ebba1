"""Maps are drawn as instruments' software shows them: the first row at the top, y downwards."""

import base64
import io

import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.figure import Figure

import roughline as rl
from roughline.computing.notebook import in_notebook
from seen import is_upright, lay_of_45_degrees, seen


@pytest.fixture
def axes():
    return Figure().subplots()


@pytest.fixture(scope="module")
def curve():
    return rl.press(lay_of_45_degrees(), E_star=1.0, forces=[4e-10], periodic=True, fields=True)


def test_a_lay_of_45_degrees_rises_to_the_right(axes):
    surface = lay_of_45_degrees()
    rl.plot.topography(surface, axes)
    picture = seen(axes)
    assert is_upright(picture, surface.heights)
    rows, columns = picture.shape
    brightest = picture[: rows // 8, : columns // 8].mean()  # the block, upper left
    assert brightest > picture[-rows // 8 :, : columns // 8].mean() + 20
    down, right = np.gradient(picture[rows // 4 :, columns // 4 :])
    assert (down * right).sum() > 0  # what is equal lies up and to the right


def test_y_counts_downwards_from_the_top(axes):
    rl.plot.topography(lay_of_45_degrees(), axes)
    assert axes.get_ylim() == pytest.approx((1e-3, 0))
    assert axes.get_xlim() == pytest.approx((0, 1e-3))


def test_contacts_are_upright(curve, axes):
    fields = curve.fields[0]
    assert 0.05 < fields.contact.mean() < 0.95
    rl.plot.contact(curve, 0, axes)
    assert is_upright(seen(axes), fields.contact)


def test_pressures_are_upright(curve, axes):
    rl.plot.pressure(curve, 0, axes)
    fields = curve.fields[0]
    assert is_upright(seen(axes), np.where(fields.contact, fields.pressure, 0))


@pytest.mark.parametrize("along", ["x", "y"])
def test_flows_are_upright(along, axes):
    gap = np.full((24, 24), 0.2)
    gap[:12, 5], gap[14:, 16], gap[2:9, 9:20] = 1.0, 1.0, 0.0
    flow = rl.flow(gap, (1.0, 1.0), along=along)
    rl.plot.flow(flow, axes=axes)
    picture = seen(axes)
    open_gap = gap > 0
    assert is_upright(picture, open_gap)


@pytest.mark.parametrize("row", [2, 20])
def test_the_arrow_at_a_constriction_comes_from_within_the_picture(row, axes):
    gap = np.zeros((24, 24))
    gap[:, row] = 1.0
    gap[11:13, row] = 0.2
    rl.plot.flow(rl.flow(gap, (1.0, 1.0)), axes=axes)
    (arrow,) = (each for each in axes.texts if not each.get_text())
    assert np.sign(arrow.get_position()[1]) == (-1 if row == 2 else 1)


def test_a_notebook_shows_a_map_upright():
    surface = lay_of_45_degrees()
    page = in_notebook(surface)
    data = page.split("base64,")[1].split('"')[0]
    picture = pyplot.imread(io.BytesIO(base64.b64decode(data)))
    rows, columns = np.nonzero(picture[..., 3] > 0)
    inside = picture[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1, :3]
    assert is_upright(inside.mean(axis=-1), surface.heights)
