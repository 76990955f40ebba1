"""
What remains when a load is taken off?
======================================

If a hardness is given, no point bears more: points at the hardness give way and stay indented. On
unloading the contact has more area and stiffness than under the same load on the way up.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

made = rl.SelfAffine(hurst=0.8, length=0.5e-3, rms_height=0.8e-6, q_roll=5e4).surface(128, rng=3)
surface = rl.Surface(made.heights, made.sizes, unit="m")
up = np.linspace(2, 40, 12)
forces = [*up, *up[-2::-1], 0]
curve = rl.press(surface, E_star=70e9, hardness=2e9, forces=forces, fields=True)

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.4), layout="constrained")
rl.plot.curve(curve, "depth", "force", axes=left)
rl.plot.contact(curve, load=11, axes=right)

# %%
# The work done by the load, minus what came back, went into the indentations.

print(f"dissipated: {curve.dissipated_work[-1]:.3g} J of {curve.work[11]:.3g} J")
print(f"permanent indentation: {curve.indentation[-1] * 1e9:.0f} nm at most")
