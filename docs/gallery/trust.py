"""
Where may the reduced model be trusted?
=======================================

The map that comes with the package gives the difference between the two models over load, fractal
dimension and roll-off, each place from 20 surfaces and 200 lines.
"""

from matplotlib import pyplot

import roughline as rl

figure, panels = pyplot.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
for axes, roll_off in zip(panels, (1, 4), strict=True):
    rl.plot.trust_map(roll_off_ratio=roll_off, axes=axes)

# %%
# For a surface of your own, the map gives the difference with its interval and a verdict.

for fractal_dimension in (2.1, 2.5, 2.9):
    found = rl.trust_map().at(fractal_dimension=fractal_dimension, force_bar=0.02)
    print(f"D_f = {fractal_dimension}: {found}, within 10 %: {found.verdict(0.1).value}")
