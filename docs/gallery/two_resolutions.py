"""
What does a finer grid change?
==============================

The same seed on more points is the same surface with more detail. The new short waves hardly
change the stiffness, but they change the real contact area.
"""

from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(fractal_dimension=2.3, rms_height=1.0)
forces = [0.003, 0.01, 0.03, 0.1, 0.3]
figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.2), layout="constrained")

for n in (64, 128, 256, 512):
    curve = rl.press(spectrum.surface(n, rng=4), E_star=1.0, forces=forces)
    left.loglog(curve.force_bar, curve.stiffness_bar, "o-", label=f"{n}²")
    right.loglog(curve.force_bar, curve.area_fraction_corrected, "o-", label=f"{n}²")

left.set(xlabel=r"force $\bar F$", ylabel=r"stiffness $\bar k$")
right.set(xlabel=r"force $\bar F$", ylabel="contact area $A/A_0$")
left.legend()
