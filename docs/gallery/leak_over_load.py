"""
How far may a seal be unloaded before it leaks?
===============================================

Metal that yields is dented by the largest load, and dents stay. On the way up it leaks less than
an elastic contact, and seals earlier; on the way down it stays sealed long after.
"""

import numpy as np

import roughline as rl

spectrum = rl.SelfAffine(hurst=0.8, length=1e-4, rms_height=0.2e-6, q_roll=2.5e5, q_high=2e6)
pressures = np.geomspace(0.1e9, 2.8e9, 20)  # mean over the nominal area [Pa]
there_and_back = [*pressures, *pressures[-2::-1]]

aperture = rl.hydraulic_aperture("x")
curves, kinds = [], []
for kind, hardness in (("elastic", None), ("yielding at 5 GPa", 5e9)):
    for seed in (1, 2, 3):
        made = spectrum.surface(128, rng=seed)
        surface = rl.Surface(made.heights, made.sizes, unit="m")
        forces = np.multiply(there_and_back if hardness else pressures, 1e-8)
        how = {"E_star": 110e9, "hardness": hardness, "periodic": True, "measures": [aperture]}
        curves.append(rl.press(surface, forces=forces, **how))
        kinds.append(kind)

# %%
# The theories know the spectrum alone, and elastic bodies.

fine = np.geomspace(pressures[0], pressures[-1], 60)
names = "critical-junction", "bruggeman"
theories = [rl.theory(name, spectrum.lattice(128), 110e9, fine) for name in names]
rl.plot.hydraulic_aperture(curves, theories, labels=kinds)
