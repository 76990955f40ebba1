"""
Do both models give the same stiffness?
=======================================

The reduced model presses a rough line on independent springs, exactly and in milliseconds. The full
model presses a surface whose points all interact. ``rl.compare`` presses both with the same waves.
"""

from matplotlib import pyplot

import roughline as rl

spectrum = rl.SelfAffine(fractal_dimension=2.2, rms_height=1.0)
compared = rl.compare(spectrum, n=128, surfaces=12)

figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
rl.plot.comparison(compared, axes=left)
rl.plot.difference(compared, tolerance=0.1, axes=right)

# %%
# A verdict on each load: the whole interval lies within the tolerance (confirmed) or outside
# (refuted), or neither (undecided).

for force, difference in zip(compared.force_bar[::3], compared.differences()[::3], strict=True):
    print(f"F̄ = {force:.2g}: {difference}, {difference.verdict(0.1).value}")
