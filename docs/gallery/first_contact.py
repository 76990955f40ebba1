"""
How stiff is a rough contact?
=============================

A random rough surface is pressed against a smooth half-space. The full model gives its stiffness
k = dF/dd with every load, from the first ten cells in contact to saturation of the stiffness.
"""

import roughline as rl

spectrum = rl.SelfAffine(fractal_dimension=2.2, length=1e-3, rms_height=1e-6)
generated = spectrum.surface(n=256, rng=7)
surface = rl.Surface(generated.heights, generated.sizes, unit="m")
rl.plot.topography(surface)

# %%
# E* = 110 GPa is about that of steel on steel. Every load is solved to a relative residual of 1e-6,
# which is computed again for what is returned.

curve = rl.press(surface, E_star=110e9, n_loads=16, fields=True)
rl.plot.curve(curve)
print(curve, f"largest residual {curve.residual.max():.1e}")

# %%
# The contact is made of many small spots. Here it is at a load in the middle.

rl.plot.contact(curve, load=8)
