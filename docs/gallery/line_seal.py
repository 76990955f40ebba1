"""
How does a line seal differ from a patch?
=========================================

A seal repeats along its line and ends across it. Its neighbours along the line are pressed as well,
so that each length is softer than a piece alone. Repeated both ways, it would be far stiffer: even
pressure displaces nothing there.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0)
made = spectrum.surface(64, rng=5)
across = np.linspace(-0.5, 0.5, 64)
surface = rl.Surface(made.heights - 0.2 * across**2, made.sizes)  # a round bead along x
forces = np.geomspace(1e-4, 3e-2, 8)
figure, axes = pyplot.subplots(figsize=(5, 3.6), layout="constrained")

for repeats, label in ((False, "free"), ("x", "repeated along its line"), (True, "both ways")):
    curve = rl.press(surface, E_star=1.0, periodic=repeats, forces=forces)
    axes.loglog(curve.force, curve.stiffness, ".-", label=label)

axes.set(xlabel="force / (E* L²)", ylabel="stiffness / (E* L)")
axes.legend()
