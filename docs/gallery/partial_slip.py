"""
When does a joint begin to slide?
=================================

Under a tangential force the border of every spot slips first. How the tangential force
grows from sticking to sliding follows from the normal load curve alone (Ciavarella, Jäger).
"""

from matplotlib import pyplot

import roughline as rl

made = rl.SelfAffine(hurst=0.8, length=0.5e-3, rms_height=0.8e-6, q_roll=5e4).surface(128, rng=3)
surface = rl.Surface(made.heights, made.sizes, unit="m")
figure, axes = pyplot.subplots(figsize=(4.8, 3.6), layout="constrained")

for load in ("5 N", "10 N", "20 N"):
    question = rl.Question(surface, materials="steel,steel", loads=load, ask=rl.Friction(0.3))
    slip = rl.assess(question).partial_slip
    axes.plot(slip.displacement * 1e9, slip.force, label=f"normal force {load}")

axes.set(xlabel="slip displacement [nm]", ylabel="tangential force [N]")
axes.legend(title="friction 0.3")
