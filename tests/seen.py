"""Pictures as they are seen: points of the screen, from the top downwards."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

import roughline as rl

_ALIKE = 0.5  # least correlation of a picture with what it shows; cividis and black marks have .9


def lay_of_45_degrees(n=32, unit=None):
    """A map whose ridges rise to the right, with a block at its first point alone.

    But for noise heights at (i, j) and (i + 1, j - 1) are equal: one to the right is one up.
    """
    i, j = np.indices((n, n))
    noise = np.random.default_rng(7).normal(scale=0.2, size=(n, n))
    heights = np.cos(2 * np.pi * 3 * (i + j) / n) + noise
    heights[: n // 6, : n // 6] = 2.5
    return rl.Surface(1e-6 * heights, (1e-3, 1e-3), unit)


def seen(axes):
    """Brightness of what is inside axes, shape (rows, columns), rows from the top downwards."""
    canvas = FigureCanvasAgg(axes.figure)
    canvas.draw()
    points = np.asarray(canvas.buffer_rgba())
    box = axes.get_window_extent()
    top, bottom = (points.shape[0] - round(y) for y in (box.y1, box.y0))
    return points[top + 2 : bottom - 2, round(box.x0) + 2 : round(box.x1) - 2, :3].mean(axis=-1)


def is_upright(picture, values):
    """Whether values[:, 0] is the top row of a picture, from the left, and not another one."""
    places = (np.arange(n) * m // n for n, m in zip(picture.shape, values.T.shape, strict=True))
    expected = values.T[np.ix_(*places)].astype(float)
    ways = (expected, expected[::-1], expected[:, ::-1], expected[::-1, ::-1])
    alike = [abs(np.corrcoef(picture.ravel(), each.ravel())[0, 1]) for each in ways]
    return alike[0] > _ALIKE and alike[0] == max(alike) and alike.count(alike[0]) == 1
