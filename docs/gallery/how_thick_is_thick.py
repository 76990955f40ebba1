"""
How thick must a coating be to hide what is below?
==================================================

A wave of pressure reaches as deep as it is long. So a coating hides its base once it is as thick as
the longest waves of the roughness, here a quarter of the side. On a stiffer base a thin one bears
the same force on less area, and the joint is stiffer.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=3)
force = 2e-3
alone = rl.press(surface, E_star=1 / (1 - 0.3**2), periodic=True, forces=[force])
figure, axes = pyplot.subplots(figsize=(5, 3.6), layout="constrained")
thicknesses = np.geomspace(0.01, 1.0, 7)

for base in (0.2, 5.0):
    curves = []
    for thickness in thicknesses:
        body = rl.Layered(1.0, 0.3, thickness, base, 0.3, periodic=True)
        curves.append(rl.press(surface, half_space=body, forces=[force]))
    for name, style in (("stiffness", "-"), ("area_fraction_corrected", "--")):
        ratio = [getattr(each, name)[0] / getattr(alone, name)[0] for each in curves]
        label = f"{name.split('_')[0]}, base {base:g} times as stiff"
        axes.loglog(thicknesses, ratio, style, label=label)

axes.set(xlabel="thickness / side", ylabel="over that of the coating alone")
axes.set_yticks([0.6, 0.8, 1, 1.5, 2], labels=["0.6", "0.8", "1", "1.5", "2"])
axes.set_yticks([], minor=True)
axes.legend(fontsize="small")
