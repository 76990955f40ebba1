"""
What does a line scan tell of a contact?
========================================

A stylus gives one straight cut. From the scan's spectrum follow those of surfaces that it may be
cut from, and reduced lines of these are pressed. The interval covers what one scan cannot show of a
surface whose heights are Gaussian. This scan is too short to show that they are, so it is told.
"""

import numpy as np

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=1.0, q_roll=3 * 6.28)
surface = spectrum.surface(512, rng=2)
scan = rl.Line(surface.heights[:, 100], length=1.0, kind="profile")
rl.plot.spectrum(scan)

# %%
# The answer is compared with the full model of the whole surface.

forces = np.geomspace(1e-3, 1, 10)
pressed = rl.press_scan(scan, E_star=1.0, forces=forces, gaussian=True)
axes = rl.plot.curve(pressed.curve)
axes.plot([], [], "ko", label="the scan")
axes.fill_between(forces, pressed.low, pressed.high, alpha=0.2, label="95 % interval of the scan")
full = rl.press(surface, E_star=1.0, forces=forces)
axes.loglog(forces, full.stiffness, "r-", label="the surface itself, full model")
axes.legend()
