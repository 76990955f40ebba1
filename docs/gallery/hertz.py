"""
Is Hertz's solution met?
========================

A paraboloid with tip radius R has the force F = 4/3 E* √R d^(3/2) and the contact radius
a = √(R d) at the depth d. The full model is compared with it.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

n, R = 256, 1.0
x = (np.arange(n) + 0.5) / n - 0.5
heights = -(x[:, None] ** 2 + x[None, :] ** 2) / (2 * R)
depths = np.geomspace(0.001, 0.1, 12)
curve = rl.press(rl.Surface(heights, (1.0, 1.0)), E_star=1.0, depths=depths)

# %%
# The stiffness dF/dd, exact for the contact on the grid, is compared with Hertz's 2 E* a.

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
left.loglog(depths, 4 / 3 * np.sqrt(R) * depths**1.5, "k", label="Hertz")
left.loglog(depths, curve.force, "o", label="roughline")
left.set(xlabel="depth $d / R$", ylabel="force $F / (E^* R^2)$")
left.legend()
right.semilogx(depths, curve.stiffness / (2 * np.sqrt(R * depths)) - 1, "o-")
right.semilogx(depths, curve.force / (4 / 3 * np.sqrt(R) * depths**1.5) - 1, "s-")
right.set(xlabel="depth $d / R$", ylabel="full model / Hertz - 1")
right.legend(["stiffness", "force"])
