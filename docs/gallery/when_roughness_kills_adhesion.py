"""
When does roughness kill adhesion?
==================================

The full model draws one rough surface apart, at growing heights. Criteria say from its spectrum
alone where sticking ends.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughline as rl

WORK, RANGE = 1e-4, 3e-3  # of bodies whose side and E* are 1
law = rl.Dugdale(work_of_adhesion=WORK, range=RANGE)
spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=8 * np.pi, q_high=32 * np.pi)
surface = spectrum.surface(128, rng=7)
heights = np.geomspace(2e-3, 1.6e-2, 7)
pulls, numbers = [], []
for height in heights:
    body = surface.scaled(height)
    mean = body.heights.max() - body.heights.mean()
    apart = np.linspace(0.98 * mean, -mean - 4 * RANGE, 40)
    curve = rl.press(body, E_star=1.0, law=law, depths=[-RANGE, 0.5 * mean, *apart], periodic=True)
    pulls.append(-curve.pull_off_force / (law.largest_pull * body.area))
    numbers.append([each.number for each in rl.stickiness(body, 1.0, WORK, RANGE).criteria])

criteria = rl.stickiness(surface, 1.0, WORK, RANGE).criteria
figure, axes = plt.subplots(layout="constrained")
axes.loglog(heights, pulls, "o-", color="black", label="full model")
for i, each in enumerate(criteria):
    number = [one[i] for one in numbers]
    ends = np.exp(np.interp(0.0, np.log(number), np.log(heights)))
    axes.axvline(ends, color=f"C{i}", linestyle=(3 * i, (3, 6)), label=f"{each.name}: sticky below")
axes.set(xlabel="rms height", ylabel=r"pull-off pressure / ($w/h_0$)")
axes.legend()
