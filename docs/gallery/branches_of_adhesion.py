"""
What do bodies do that stick?
=============================

They jump together on the way in, and hold each other on the way out. The area between the branches
is the work that a cycle costs.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.8, length=1e-6, rms_height=2e-9, q_roll=2.5e7, q_high=2e8)
made = spectrum.surface(128, rng=4)
surface = rl.Surface(made.heights, made.sizes, unit="m")

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.4), layout="constrained")
for w in (0.005, 0.02, 0.05):  # J/m²
    law = rl.Dugdale(work_of_adhesion=w, range=2e-9)
    curve = rl.press(surface, E_star=2e9, law=law, n_loads=80, fields=True)
    left.plot(curve.depth * 1e9, curve.force * 1e9, label=f"w = {w * 1e3:.0f} mJ/m²")
    print(
        f"w = {w * 1e3:2.0f} mJ/m²: pull-off {-curve.pull_off_force * 1e9:5.1f} nN, "
        f"dissipated {curve.dissipated_work[-1] / (w * surface.area):.2f} w A"
    )
left.set(xlabel="depth (nm)", ylabel="force (nN)", xlim=(-8, None))
left.axhline(0, color="0.7", lw=0.8, zorder=0)
left.legend(frameon=False)

# %%
# Where they touch (dark), and where they pull across a gap (light), at the largest pull.

least = int(np.nanargmin(curve.force))
fields = curve.fields[least]
right.imshow((fields.contact + 0.4 * fields.pulling).T, origin="lower", cmap="Blues", vmin=0)
right.set(xticks=[], yticks=[], title=f"F = {curve.force[least] * 1e9:.1f} nN")
pyplot.show()
