"""Draws the figures of the paper beside this file: ``make paper-figures``, in a minute or two."""

from pathlib import Path

import numpy as np
from matplotlib import pyplot
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

import roughline as rl

FOLDER = Path(__file__).parent
FORCE, COEFFICIENT = 0.02, 0.3  # [E* L²], of the contact with friction


def models() -> Figure:
    """Stiffness of both models, and what differences of neighbouring loads make of it."""
    spectrum = rl.SelfAffine(fractal_dimension=2.2, rms_height=1.0)
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
    rl.plot.comparison(rl.compare(spectrum, n=128, surfaces=12), axes=left)
    curve = rl.press(spectrum.surface(256, rng=7), E_star=1.0, n_loads=40)
    middles = np.sqrt(curve.stiffness[1:] * curve.stiffness[:-1])
    ratios = np.diff(curve.force) / np.diff(curve.depth) / middles
    right.semilogx(curve.force_bar[1:], 100 * (ratios - 1), ".-")
    right.set(xlabel=r"$F/(E^* h L)$", ylabel=r"$\Delta F/\Delta d$ over $dF/dd$, less 1 [%]")
    return figure


def friction() -> Figure:
    """Shear force over slide of a rough contact, and where it sticks at the end of the cycle."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(64, rng=7)
    shear = rl.cycle(0.7 * COEFFICIENT * FORCE, cycles=1)
    curve = rl.press(
        surface,
        half_space=rl.Homogeneous(1.0, poisson=0.3),
        friction=rl.Friction(COEFFICIENT),
        forces=[FORCE] * len(shear),
        shear_forces=shear,
        fields=[len(shear) - 1],
    )
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
    shares = curve.shear_force[:, 0] / (COEFFICIENT * FORCE)
    left.plot(curve.slide[:, 0] / curve.depth[0], shares, ".-")
    left.set(xlabel="slide / depth", ylabel=r"$Q/(\mu F)$")
    last = curve.fields[len(shear) - 1]
    right.imshow(
        np.where(last.contact, 1 + last.stick, 0).T,
        origin="lower",
        cmap=ListedColormap(["white", "tab:orange", "tab:blue"]),
    )
    right.set(xticks=[], yticks=[], title="orange slips, blue sticks")
    return figure


if __name__ == "__main__":
    models().savefig(FOLDER / "models.png", dpi=150)
    friction().savefig(FOLDER / "friction.png", dpi=150)
