"""Line contacts: their depths by quadrature of the pressure under a logarithm, and their slopes."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from roughline.exact import lines

QUADRATURE = 1e-8


def displaced(pressure, a, y, E_star, datum):
    """Displacement at a place by a pressure on both sides of the middle, its edges apart."""

    def of_angle(t):  # s = a sin(t): roots at the edges are smooth so
        s = a * math.sin(t)
        return float(pressure(np.array(s))) * math.log(datum / abs(y - s)) * a * math.cos(t)

    middle = math.asin(y / a)
    parts = [
        quad(of_angle, *ends, epsabs=1e-12, limit=400)[0]
        for ends in ((-math.pi / 2, middle), (middle, math.pi / 2))
    ]
    return 2 / (math.pi * E_star) * sum(parts)


def test_a_cylinder_is_that_of_its_pressure():
    body = lines.Cylinder(radius=10.0, force=0.3, E_star=2.0, datum=4.0)
    a = body.half_width
    total = quad(lambda y: float(body.pressure(np.array(y))), -a, a)[0]
    assert total == pytest.approx(body.force, rel=QUADRATURE)
    for y in (0.0, 0.3 * a, 0.8 * a):
        found = displaced(body.pressure, a, y, 2.0, 4.0) + y**2 / (2 * body.radius)
        assert found == pytest.approx(body.depth, rel=QUADRATURE)
    assert body.pressure(np.array([1.01 * a]))[0] == 0
    step = 1e-5 * body.force
    above, below = (lines.Cylinder(10.0, body.force + each, 2.0, 4.0) for each in (step, -step))
    slope = 2 * step / (above.depth - below.depth)
    assert body.stiffness == pytest.approx(slope, rel=1e-8)


def test_a_flat_strip_is_that_of_its_pressure():
    a, force = 0.7, 0.3
    depth = force / lines.strip_stiffness(2.0, a, 4.0)
    for y in (0.0, 0.2, 0.6):
        found = displaced(lambda s: lines.strip_pressure(force, a, s), a, y, 2.0, 4.0)
        assert found == pytest.approx(depth, rel=1e-7)
    assert lines.strip_pressure(force, a, np.array([0.71]))[0] == 0


@pytest.mark.parametrize("name", ["radius", "force", "E_star", "datum"])
def test_what_is_not_positive_is_refused(name):
    with pytest.raises(ValueError, match=name):
        lines.Cylinder(**({"radius": 1.0, "force": 1.0, "E_star": 1.0, "datum": 1.0} | {name: 0.0}))
