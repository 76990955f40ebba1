"""
How are two rough bodies pressed?
=================================

Gap and elastic contact depend on nothing but the sum of the heights of both bodies. ``rl.facing``
turns one of them over, fits it to the grid of the other and adds the heights.
"""

from matplotlib import pyplot

import roughline as rl

fine = rl.SelfAffine(hurst=0.6, rms_height=0.5, q_roll=8 * 6.28).surface(256, rng=1)
coarse = rl.SelfAffine(hurst=0.9, rms_height=1.0).surface(256, rng=2)
both = rl.facing(fine, coarse)

figure, panels = pyplot.subplots(1, 3, figsize=(10, 3), layout="constrained")
for axes, body, name in zip(panels, (fine, coarse, both), ("fine", "coarse", "sum"), strict=True):
    rl.plot.topography(body, axes=axes)
    axes.set_title(name)

# %%
# The rougher body alone would be stiffer: the fine one takes up part of the approach.

figure, axes = pyplot.subplots(figsize=(4.8, 3.6), layout="constrained")
for body, name in ((coarse, "coarse against smooth"), (both, "coarse against fine")):
    curve = rl.press(body, E_star=1.0, n_loads=12)
    axes.loglog(curve.force, curve.stiffness, "o-", label=name)
axes.set(xlabel="force $F / (E^* L^2)$", ylabel="stiffness $k / (E^* L)$")
axes.legend()
