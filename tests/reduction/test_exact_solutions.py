"""The reduced model against bodies of revolution, whose MDR line it must solve exactly."""

import numpy as np
import pytest

import roughline as rl
from roughline.exact import indenters


@pytest.mark.parametrize("n", [1.0, 2.0, 4.0])
def test_the_line_of_a_body_of_revolution_gives_its_force_and_stiffness(n, judged):
    body = indenters.PowerLawIndenter(n, 0.5, E_star=3.0)
    depths = np.array([body.depth(a) for a in (0.1, 0.25, 0.4)])
    errors = []
    sizes = (2**9, 2**11, 2**13)
    for points in sizes:
        x = (np.arange(points) + 0.5) / points - 0.5
        line = rl.Line(-body.stretch * 0.5 * np.abs(x) ** n, length=1.0)
        # depth counts from the highest spring, half a spacing off the axis
        curve = rl.press(line, E_star=3.0, depths=depths + line.heights.max())
        expected = np.array([[body.force(d), body.stiffness(d)] for d in depths]).T
        found = np.array([curve.force, curve.stiffness])
        errors.append(np.abs(found / expected - 1).max(axis=1))
    force_errors, stiffness_errors = np.array(errors).T
    solution = {1.0: "cone", 2.0: "ball (Hertz)", 4.0: "body of revolution, fourth power"}[n]
    for points, force_error, stiffness_error in zip(
        sizes, force_errors, stiffness_errors, strict=True
    ):
        judged(solution, "force", points, force_error)
        judged(solution, "stiffness", points, stiffness_error)
    assert (force_errors < 20 / np.array(sizes) ** 2).all()  # second order
    assert (stiffness_errors < 10 / np.array(sizes)).all()  # whole springs: first order
