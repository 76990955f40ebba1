"""
Why does a large surface behave differently from a small one?
=============================================================

A surface as large as one roll-off wavelength follows a power law with α near 1 / (1 + H). One with
many roll-off wavelengths along its side has many contacts far apart, and α grows towards 0.9.
Points are means of three periodic surfaces.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

forces = np.geomspace(1e-3, 0.3, 10)
figure, axes = pyplot.subplots(figsize=(4.8, 3.6), layout="constrained")

for waves in (1, 4, 16):
    q_roll = 2 * np.pi * waves
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=q_roll, q_high=8 * q_roll)
    surfaces = [spectrum.surface(512, rng=i) for i in range(3)]
    curves = [rl.press(each, E_star=1.0, forces=forces, periodic=True) for each in surfaces]
    mean = rl.average([curve.stiffness for curve in curves]).mean
    slope = np.polyfit(np.log(forces[:5]), np.log(mean[:5]), 1)[0]
    axes.loglog(forces, mean, "o-", label=f"{waves}: α = {slope:.2f}")

axes.set(xlabel=r"force $F / (E^* h L)$", ylabel="stiffness $k / (E^* L)$")
axes.legend(title="waves along a side")
