"""
How does a rubber's real contact area grow in time?
===================================================

Rubber under a constant force creeps, and its contact grows over as many decades of time as its
modulus relaxes. A light one follows the compliance, the dashed lines. Held at a constant depth,
as a seal is, the contact stays and the force relaxes.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

made = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2e-6, q_roll=2e4).surface(128, rng=3)
surface = rl.Surface(made.heights, made.sizes, unit="m")
rubber = rl.Creep(shares=[0.1] * 8, times=10.0 ** np.arange(-2, 6))  # [s]
half_space = rl.Homogeneous(40e6 / (1 - 0.49**2), periodic=True)  # at once [Pa]
times = np.geomspace(1e-3, 1e6, 28)  # [s]

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.4), layout="constrained")
for force in (0.1, 0.3, 1.0):
    curve = rl.press_creep(surface, rubber, times=times, force=force, half_space=half_space)
    (drawn,) = left.loglog(curve.time, curve.area_fraction_corrected, "o-", label=f"{force} N held")
    as_compliance = curve.area_fraction_corrected[0] * rubber.compliance(times)
    left.loglog(times, as_compliance, "--", color=drawn.get_color(), linewidth=0.8)
    depth = curve.depth[0]
    curve = rl.press_creep(surface, rubber, times=times, depth=depth, half_space=half_space)
    right.loglog(curve.time, curve.force, "o-", label=f"{curve.depth[0] * 1e6:.1f} µm held")
left.set(xlabel="time [s]", ylabel="real contact area $A/A_0$", ylim=(0.012, 1.3))
right.set(xlabel="time [s]", ylabel="force [N]")
left.plot([], [], "k--", linewidth=0.8, label="as the compliance")
left.legend(loc="lower right")
right.legend(loc="lower left")
