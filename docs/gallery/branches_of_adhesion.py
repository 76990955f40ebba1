"""
What do bodies do that stick?
=============================

They jump together on the way in, and hold each other on the way out. The area between the branches
is the work that a cycle costs. Maps are dark where the bodies touch, and light where they pull each
other across a gap.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.8, length=1e-6, rms_height=4e-9, q_roll=2.5e7, q_high=5e7)
made = spectrum.surface(128, rng=4)
surface = rl.Surface(made.heights, made.sizes, unit="m")
law = rl.Dugdale(work_of_adhesion=0.05, range=6e-9)  # J/m², m
curve = rl.press(surface, E_star=0.2e9, law=law, n_loads=80, fields=True)

figure, axes = pyplot.subplots(1, 3, figsize=(9, 3), layout="constrained")
nearer = curve.on_approach
for branch, name in ((nearer, "on approach"), (~nearer, "on retreat")):
    axes[0].plot(curve.depth[branch] * 1e9, curve.force[branch] * 1e6, label=name)
axes[0].set(xlabel="depth [nm]", ylabel="force [µN]", xlim=(-40, None))
axes[0].legend(frameon=False, loc="center left")
depth = curve.depth[np.nanargmin(curve.force)]
for branch, axis, name in ((nearer, axes[1], "approach"), (~nearer, axes[2], "retreat")):
    load = np.flatnonzero(branch)[np.abs(curve.depth[branch] - depth).argmin()]
    fields = curve.fields[load]
    shown = fields.contact + 0.4 * fields.pulling
    axis.imshow(shown.T, cmap="Blues", vmin=0, vmax=1)
    axis.set(xticks=[], yticks=[], title=f"{curve.depth[load] * 1e9:.1f} nm, {name}")

# %%
# What the cycle costs, over the work of adhesion on all of the nominal area.

print(f"{curve.dissipated_work[-1] / (law.work_of_adhesion * surface.area):.2f} w A")
