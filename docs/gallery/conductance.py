"""
How well does a joint conduct current?
======================================

The conductance of a rough joint is proportional to its elastic stiffness (Barber). The
materials of both bodies give the resistance, with an interval. The elastic answer is drawn beside
it; it is far off where metals yield.
"""

from matplotlib import pyplot

import roughline as rl

made = rl.SelfAffine(hurst=0.8, length=0.5e-3, rms_height=0.8e-6, q_roll=5e4).surface(128, rng=3)
surface = rl.Surface(made.heights, made.sizes, unit="m")
loads = ["1 N", "3 N", "10 N", "30 N", "60 N"]
result = rl.assess(rl.Question(surface, materials="copper,steel", loads=loads))

force = [float(load.split()[0]) for load in loads]
figure, axes = pyplot.subplots(figsize=(4.8, 3.6), layout="constrained")
with_yield = result.answers["constriction_resistance"]
axes.loglog(force, with_yield.values, "ko-", label="with yield")
axes.fill_between(force, with_yield.low, with_yield.high, color="k", alpha=0.15)
axes.loglog(force, result.elastic["constriction_resistance"].values, "--", label="elastic")
axes.set(xlabel="force [N]", ylabel="constriction resistance [Ω]")
axes.legend()
