"""
How do I get from a file to numbers for a report?
=================================================

A map of heights is read, its tilt is removed, and it is pressed with the load and the materials of
the joint. The file is made up here; ``rl.read`` knows some forty formats of instruments.
"""

import tempfile
from pathlib import Path

import numpy as np

import roughline as rl

made = rl.SelfAffine(hurst=0.75, length=0.4e-3, rms_height=0.5e-6, q_roll=5e4).surface(200, rng=5)
tilted = made.heights * 1e6 + np.linspace(0, 3, 200)[:, None]  # µm
scan = Path(tempfile.mkdtemp()) / "scan.txt"
np.savetxt(scan, tilted)

reading = rl.Reading(unit="um", sizes=(400, 400))
question = rl.Question(scan, materials="steel,copper", loads=["2 N", "20 N"], reading=reading)
result = rl.assess(question)

rl.plot.topography(result.body)

# %%
# Every answer has its value, its interval, its formula and its source.

for key in ("contact_stiffness", "contact_area_fraction", "constriction_resistance"):
    answer = result.answers[key]
    for load, value, low, high in zip(
        result.headings, answer.values, answer.low, answer.high, strict=True
    ):
        print(f"{load:6} {answer.name}: {value:.4g} ({low:.4g} to {high:.4g}) {answer.unit}")
