"""
How much of an ultrasonic wave does a joint reflect?
====================================================

On a wave that is long enough a joint acts as a spring. Its stiffness per area decides how much is
reflected; the reflection falls as the joint is loaded.
"""

from matplotlib import pyplot

import roughline as rl

made = rl.SelfAffine(hurst=0.8, length=0.5e-3, rms_height=0.4e-6, q_roll=5e4).surface(128, rng=3)
surface = rl.Surface(made.heights, made.sizes, unit="m")
loads = ["1 MPa", "3 MPa", "10 MPa", "30 MPa", "100 MPa"]
figure, axes = pyplot.subplots(figsize=(4.8, 3.6), layout="constrained")

for frequency in ("2 MHz", "5 MHz", "10 MHz"):
    question = rl.Question(
        surface, materials="steel,steel", loads=loads, ask=rl.Ultrasound(frequency), periodic=True
    )
    reflection = rl.assess(question).answers["reflection"]
    pressure = [float(load.split()[0]) for load in loads]
    axes.semilogx(pressure, reflection.values, "o-", label=frequency)
    axes.fill_between(pressure, reflection.low, reflection.high, alpha=0.15)

axes.set(xlabel="mean pressure [MPa]", ylabel="reflection $|r|$", ylim=(0, 1))
axes.legend()
