"""
How large is the real contact area, and how far is the grid off?
================================================================

Counting whole cells along the outline of a contact overstates its area. The area is corrected for
this, and with ``grid_error=True`` the surface is pressed on coarser grids too, which shows how far
stiffness and area may be off.
"""

from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_roll=4 * 6.28, q_high=32 * 6.28)
surface = spectrum.surface(256, rng=1)
curve = rl.press(surface, E_star=1.0, forces=[0.003, 0.01, 0.03, 0.1, 0.3, 1], grid_error=True)
axes = rl.plot.area(curve)

# %%
# The interval of a value v runs from v / (1 + e / v) to v + e, with the estimated error e.

value, error = curve.area_fraction_corrected, curve.area_fraction_error
axes.vlines(curve.force, value / (1 + error / value), value + error, color="tab:red")
for force, share, of_area, k, of_k in zip(
    curve.force, value, error, curve.stiffness, curve.stiffness_error, strict=True
):
    print(f"F = {force:g}: area {share:.3%} ± {of_area / share:.0%}, k {k:.3g} ± {of_k / k:.1%}")
pyplot.show()
