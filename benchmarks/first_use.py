"""What a user does first, with what is installed and nothing of this folder: ``make dist``."""

import tempfile
from pathlib import Path

import roughline as rl


def main():
    made = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=3e4).surface(64, rng=1)
    surface = rl.Surface(made.heights, made.sizes, unit="m")
    curve = rl.press(surface, E_star=110e9, n_loads=5, fields=True)
    assert curve.converged.all()
    with tempfile.TemporaryDirectory() as folder:
        rl.write(surface, Path(folder) / "surface.nc")
        curve.write(Path(folder) / "curve.nc")
        rl.plot.contact(curve).figure.savefig(Path(folder) / "contact.png")
        question = rl.Question(Path(folder) / "surface.nc", "steel,copper", loads="10 N")
        answer = rl.assess(question).answers["contact_stiffness"]
    print(surface, curve, f"k = {answer.values[0]:.4g} {answer.unit}", rl.trust_map(), sep="\n")


if __name__ == "__main__":
    main()
