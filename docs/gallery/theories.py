"""
How far are the theories from the numbers?
==========================================

Persson, Bush, Gibson and Thomas, and Greenwood and Williamson predict the contact area from the
spectrum alone. Beside the full model of a periodic surface Persson's area is too small under light
loads, of which Bush, Gibson and Thomas give the limit; summits that do not feel each other are too
soft under heavier ones.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=8 * 6.28, q_high=32 * 6.28)
surface = spectrum.surface(384, rng=1)
pressure = np.geomspace(3e-3, 0.2, 10)  # over E*
curve = rl.press(surface, E_star=1.0, forces=pressure, periodic=True)

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8.4, 3.4), layout="constrained")
left.loglog(pressure, curve.area_fraction_corrected, "ko", label="full model")
right.loglog(pressure, curve.stiffness, "ko", label="full model")
for i, name in enumerate(("persson", "bush-gibson-thomas", "greenwood-williamson")):
    theory = rl.theory(name, surface, 1.0, pressure)
    left.loglog(pressure, theory.area_fraction, color=f"C{i}", label=theory.name)
    if theory.stiffness is not None:
        right.loglog(pressure, theory.stiffness, color=f"C{i}")
left.set(xlabel="pressure $p / E^*$", ylabel="contact area $A/A_0$", ylim=(3e-3, 1.5))
right.set(xlabel="pressure $p / E^*$", ylabel="stiffness for each area $k L / E^*$")
left.legend()
