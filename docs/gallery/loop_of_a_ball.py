"""
How much does a ball dissipate that is shaken sideways?
=======================================================

Under a shear that goes back and forth, the rim of a ball's contact slips, and force over slide is
a loop (Mindlin and Deresiewicz). Its area is what a cycle dissipates. Where the normal force rises
and falls with the shear, or against it, the loop is narrower, and its middle moves.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

radii = np.linspace(0, 1e-3, 101)
ball = rl.Profile(radii, -(radii**2) / (2 * 5e-3), unit="m")
steel = rl.Homogeneous(115e9, poisson=0.3)  # two equal bodies
friction, force = rl.Friction(0.3), 20.0  # [N]
figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.4), layout="constrained")

for share in (0.3, 0.6, 0.9):
    shear = [x for x, _ in rl.cycle(share * 0.3 * force, cycles=1)]
    forces = [force] * len(shear)
    curve = rl.press(ball, half_space=steel, friction=friction, forces=forces, shear_forces=shear)
    lost = curve.dissipated[-32:].sum() * 1e9
    label = f"up to {share:g} $\\mu F$: {lost:.0f} nJ a cycle"
    left.plot(curve.slide[:, 0] * 1e6, curve.shear_force[:, 0], ".-", label=label)

for swing, label in ((0, "constant force"), (5, "force in phase"), (-5, "opposite phase")):
    shear = np.array([x for x, _ in rl.cycle(3.0, cycles=2)])
    forces = force + swing * shear / 3
    curve = rl.press(ball, half_space=steel, friction=friction, forces=forces, shear_forces=shear)
    right.plot(curve.slide[-33:, 0] * 1e6, curve.shear_force[-33:, 0], ".-", label=label)
for axes in (left, right):
    axes.set(xlabel="slide [µm]", ylabel="shear force [N]")
    axes.legend(fontsize="small")
