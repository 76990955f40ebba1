"""
Free or periodic half-space?
============================

A free surface is a whole specimen: nothing beyond its border carries load, and in full contact it
is a flat punch. A periodic surface repeats without end: depth and stiffness are those of the
interface alone, and the stiffness grows without limit.
"""

from matplotlib import pyplot

import roughline as rl

surface = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=4 * 6.28).surface(256, rng=3)
figure, axes = pyplot.subplots(figsize=(4.8, 3.6), layout="constrained")

for periodic, label in ((False, "free"), (True, "periodic")):
    curve = rl.press(surface, E_star=1.0, n_loads=16, periodic=periodic)
    axes.loglog(curve.force_bar, curve.stiffness / curve.length, "o-", label=label)

axes.axhline(rl.EXACT_PUNCH, color="0.5", linestyle=":", label="flat square punch")
axes.set(xlabel=r"force $\bar F$", ylabel="stiffness $k / (E^* L)$")
axes.legend()
