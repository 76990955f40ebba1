"""
Where does a rough joint slip before it slides?
===============================================

Every spot slips from its border inwards, and small spots slip as a whole, long before the joint
slides. Back and forth, force over slide makes a loop, whose area is what friction dissipates.
"""

import numpy as np
from matplotlib import pyplot
from matplotlib.colors import ListedColormap

import roughline as rl

surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
force, friction = 0.02, 0.3
shear = rl.cycle(0.7 * friction * force, cycles=1, per_cycle=16)
curve = rl.press(
    surface,
    half_space=rl.Homogeneous(1.0, poisson=0.3),
    friction=rl.Friction(friction),
    forces=[force] * len(shear),
    shear_forces=shear,
    fields=[4],
)
figure, (loop, panel) = pyplot.subplots(1, 2, figsize=(8, 3.6), layout="constrained")
loop.plot(1e3 * curve.slide[:, 0], curve.shear_force[:, 0] / (friction * force), ".-")
loop.set(xlabel="slide / side, times 1000", ylabel="shear force / most that friction bears")
contact = curve.fields[4]
states = np.where(contact.contact, 1 + contact.stick, 0)
panel.imshow(states.T, origin="lower", cmap=ListedColormap(["white", "tab:orange", "tab:blue"]))
panel.set(xticks=[], yticks=[], title="orange slips, blue sticks")
