"""
Where does the fluid go through a contact?
==========================================

Two rough bodies touch in patches, and a fluid finds its way between them. As the load grows, the
patches join and close one channel after the other, until the last one carries all of the flow.
"""

from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.8, length=1e-4, rms_height=0.5e-6, q_roll=2.5e5, q_high=4e6)
made = spectrum.surface(256, rng=4)
surface = rl.Surface(made.heights, made.sizes, unit="m")
pressures = [1e9, 6e9]  # mean over the nominal area [Pa]
forces = [pressure * 1e-8 for pressure in pressures]
curve = rl.press(surface, E_star=110e9, forces=forces, periodic=True, fields=True)

figure, axes = pyplot.subplots(1, 2, figsize=(9.4, 4), layout="constrained")
flows = [rl.flow(fields) for fields in curve.fields]
for flow, panel in zip(flows, axes, strict=True):
    rl.plot.flow(flow, unit="m", axes=panel)

# %%
# Every flow comes with its balance: what flows in flows out, and carries the power that is lost.

for flow, area in zip(flows, curve.area_fraction_corrected, strict=True):
    print(
        f"{100 * area:.0f}% in contact: u_h = {flow.hydraulic_aperture * 1e9:.0f} nm, "
        f"{100 * flow.largest_share:.0f}% in one channel, balanced to {flow.imbalance:.0e}"
    )
