"""
Why is this answer not known better?
====================================

Every answer has an interval, and its causes can be asked for: each is a range of the value that it
alone leaves open, and says what would narrow it.
"""

from matplotlib import pyplot

import roughline as rl

made = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=0.5e-6, q_roll=5e4).surface(64, rng=3)
scan = rl.Surface(made.heights, made.sizes, unit="m", is_cut_out=True)
found = rl.assess(rl.Question(scan, materials="steel,copper", loads="20 N"))
names = ("interface_stiffness", "contact_area", "mean_gap")
figure, axes = pyplot.subplots(figsize=(7, 3.4), layout="constrained")

rows = []
for name in names:
    answer = found.answers.get(name)
    for reason in answer.why() if answer else []:
        rows.append(f"{answer.name}: {reason.title}")
        if reason.low is not None and reason.high is not None:
            axes.plot([reason.low, reason.high], [len(rows) - 1] * 2, lw=6, solid_capstyle="butt")
axes.axvline(1.0, color="black", lw=0.8)
axes.set(xscale="log", xlabel="range over the value", yticks=range(len(rows)), yticklabels=rows)
