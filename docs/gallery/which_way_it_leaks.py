"""
Which way does a ground surface leak?
=====================================

What repeats both ways is a cell of something larger, and its permeance is a tensor: one number
for each direction of the fall of pressure. Along the grooves of grinding more flows than across.
"""

import numpy as np
from matplotlib import pyplot

import roughline as rl

axes = pyplot.figure(figsize=(4.6, 4.2), layout="constrained").add_subplot(projection="polar")
angles = np.linspace(0, 2 * np.pi, 181)
way = np.array([np.cos(angles), np.sin(angles)])
rough = rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=40.0).surface(64, rng=5).heights

for stretch in (1, 2, 4):
    waves = np.fft.fft2(rough)
    qx, qy = np.meshgrid(np.fft.fftfreq(64), np.fft.fftfreq(64), indexing="ij")
    lay = np.exp(-((30 * qx * (stretch - 1)) ** 2) / 2)  # takes short waves along x away
    heights = np.fft.ifft2(waves * lay).real
    gap = np.clip(1.2 - heights / heights.std(), 0, None)  # two plates; what overlaps is closed
    flow = rl.flow(gap, sizes=(1.0, 1.0), sides="periodic")
    permeance = np.einsum("ik,ij,jk->k", way, flow.tensor, way)
    axes.plot(angles, permeance / np.trace(flow.tensor) * 2, label=f"grooves × {stretch}")

axes.set_rticks([0.5, 1.0, 1.5])
axes.figure.legend(loc="outside lower center", ncols=3, fontsize="small")
axes.set_title("permeance over its mean, by direction", fontsize="medium")
