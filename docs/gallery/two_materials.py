"""
Does a normal load alone make two materials slip?
=================================================

Under pressure a soft body is drawn inwards by more than a hard one. Friction holds both together
(Spence), so that shear stands in the contact without any shear force, and its rim slips outwards.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

x = (np.arange(48) + 0.5) / 48 - 0.5
ball = rl.Surface(-(x[:, None] ** 2 + x**2) / 2, sizes=(1.0, 1.0))  # radius 1
figure, axes = pyplot.subplots(figsize=(5, 3.6), layout="constrained")

for beta in (0.0, 0.1, 2 / 7):  # 2/7: a rigid ball on a body with a Poisson's ratio of 0.3
    curve = rl.press(
        ball,
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=beta),
        friction=rl.Friction(0.3),
        forces=[0.005, 0.01, 0.015, 0.02],
        shear_forces=[0.0] * 4,
        fields=[3],
    )
    middle = curve.fields[3].shear[:, 24, 0]
    label = f"β = {beta:.2g}: {100 * curve.stick_fraction[3]:.0f} % of the contact sticks"
    axes.plot(x, middle, ".-", label=label)

axes.set(xlabel="x / radius", ylabel="shear along x, over E*")
axes.legend(fontsize="small")
