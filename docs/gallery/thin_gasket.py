"""
How thin may a rubber gasket be?
================================

Rubber on a rigid plate seals a rigid, wavy flange. It hardly changes its volume: to give way to a
wave it has to flow sideways, and a thin layer cannot. Points are means of four flanges.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

YOUNG, WAVE, HEIGHT = 5e6, 8e-3, 10e-6  # modulus [Pa]; longest wave and rms height [m]
q = 2 * np.pi / WAVE
spectrum = rl.SelfAffine(hurst=0.8, length=4 * WAVE, rms_height=HEIGHT, q_roll=q, q_high=6 * q)
flanges = [spectrum.surface(64, rng=seed) for seed in range(4)]
thicknesses = WAVE * np.array([0.04, 0.06, 0.1, 0.17, 0.3, 0.5, 1, 2])


def mean_pressure(half_space):
    found = [rl.sealing_pressure(each, half_space=half_space, interval=False) for each in flanges]
    return np.exp(np.mean([np.log(each.value) for each in found]))


figure, axes = pyplot.subplots(figsize=(5, 3.6), layout="constrained")
for nu, mark in ((0.49, "o-"), (0.499, "s-")):
    layers = [rl.Layered(YOUNG, nu, h, np.inf, periodic=True) for h in thicknesses]
    pressures = np.array([mean_pressure(layer) for layer in layers])
    thick = mean_pressure(rl.Homogeneous(layers[0].E_star, periodic=True))
    axes.loglog(thicknesses * 1e3, pressures / 1e3, mark, label=f"ν = {nu}")
    print(f"ν = {nu}, a tenth of the wave: {pressures[2] / thick:.1f} times as much as thick")
axes.axhline(thick / 1e3, color="black", linestyle="--", label="thick rubber")
axes.set(xlabel="thickness of the rubber [mm]", ylabel="sealing pressure [kPa]")
axes.set_xticks([0.3, 1, 3, 10], labels=["0.3", "1", "3", "10"])
axes.set_yticks([20, 50, 100, 300, 1000], labels=["20", "50", "100", "300", "1000"])
over = axes.secondary_xaxis("top", functions=(lambda h: h / 8, lambda x: 8 * x))
over.set(xlabel="thickness over the wave")
over.set_xticks([0.05, 0.1, 0.3, 1], labels=["0.05", "0.1", "0.3", "1"])
axes.legend()
