"""
Does a normal load alone make two materials slip?
=================================================

Under pressure a soft body is drawn inwards by more than a hard one. Friction holds both together
(Spence), so that shear stands in the contact without any shear force, and only its rim slips.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

x = (np.arange(48) + 0.5) / 48 - 0.5
ball = rl.Surface(-(x[:, None] ** 2 + x**2) / 2, sizes=(1.0, 1.0))  # radius 1
forces = 0.02 * (np.arange(1, 9) / 8) ** 3  # the radius of the contact grows evenly
figure, axes = pyplot.subplots(figsize=(5, 3.6), layout="constrained")

for beta in (0.0, 0.1, 2 / 7):  # 2/7: a rigid ball on a body with a Poisson's ratio of 0.3
    curve = rl.press(
        ball,
        half_space=rl.Homogeneous(1.0, poisson=0.3, beta=beta),
        friction=rl.Friction(0.3),
        forces=forces,
        shear_forces=[0.0] * 8,
        fields=[7],
    )
    middle = curve.fields[7].shear[:, 24, 0]
    label = f"β = {beta:.2g}: {100 * curve.stick_fraction[7]:.0f} % of the contact sticks"
    axes.plot(x, middle, ".-", label=label)

axes.set(xlabel="x / radius", ylabel="shear along x, over E*", ylim=(-0.06, 0.03))
axes.legend(fontsize="small", loc="lower right")
