"""
How stiff is a surface in full contact?
=======================================

A rough square of side L that touches everywhere is a flat square punch. Its stiffness is
1.1523 E* L; the literature has 1.1419 E* L as well, which is 0.9 % low.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

n = 2 ** np.arange(4, 9)
curves = [rl.press(rl.Surface(np.zeros((k, k)), (1.0, 1.0)), E_star=1.0, depths=[1.0]) for k in n]
stiffness = np.array([curve.stiffness[0] for curve in curves])

# %%
# Cells of uniform pressure represent the singular pressure at the border badly, so the error falls
# only like one over the number of points along a side.

figure, axes = pyplot.subplots(figsize=(4.5, 3.2), layout="constrained")
axes.loglog(n, 1 - stiffness / rl.EXACT_PUNCH, "o-", label=f"to {rl.EXACT_PUNCH:.5f}")
axes.loglog(n, np.abs(1 - stiffness / rl.PAPER_PUNCH), "s--", label=f"to {rl.PAPER_PUNCH}")
axes.set(xlabel="points along a side", ylabel="relative difference of $k / (E^* L)$")
axes.minorticks_off()
axes.set_xticks(n, labels=n)
axes.legend()
print(f"finest grid {stiffness[-1]:.4f}, exact {rl.EXACT_PUNCH:.4f}")
