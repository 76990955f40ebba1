"""
Which exponent, and how sure is it?
===================================

Stiffness follows a power law of the force, with α = 1 / (1 + H) expected for self-affine
roughness of Hurst exponent H. One surface is a single sample; the mean of many has an interval.
"""

import numpy as np

import roughline as rl

forces = np.geomspace(1e-4, 1e-1, 16)  # F / (E* h L)
spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
lines = [spectrum.line(n=2**16, rng=i) for i in range(60)]
stiffness = [rl.press(line, E_star=1.0, forces=forces).stiffness_bar for line in lines]

law = rl.fit_power_law(forces, stiffness, window=(1e-4, 1e-2))
rl.plot.power_law(forces, stiffness, law)
print(f"α = {law.exponent:.3f}, expected {1 / 1.8:.3f}")

# %%
# The exponent depends on the window. The longest window in which a power law is not rejected:

print(rl.find_window(forces, stiffness))
