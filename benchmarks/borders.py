"""How often heights tell a piece from a periodic body: the table of docs/decisions/0018-borders.md.

Hurst exponents are from 0.2 to 1. Two in five of the surfaces have no roll-off; the others have it
at half of the side, at 16 cells or at 8. Tilts rise by 0.5 to 3 rms heights along a side.
"""

import numpy as np

import roughline as rl
from roughline.topography.borders import decided

MADE = {8: 1200, 16: 1200, 32: 1200, 64: 1200, 128: 1000, 256: 300}  # points a side, how many


def heights(n, longer, hurst, roll, rng):
    """Heights of a surface that is some pieces of n points long."""
    spectrum = rl.SelfAffine(
        hurst=hurst, length=longer, C_0=1.0, q_roll=2 * np.pi * roll * (1 + 1e-12)
    )
    return spectrum.surface(longer * n, int(rng.integers(2**31)), "gaussian").heights


def bodies(n, rng):
    """Return a body of each kind, by its name."""
    hurst, roll = rng.uniform(0.2, 1), max(1.0, rng.choice([1.0, 1.0, 2.0, n / 16, n / 8]))
    whole, larger = heights(n, 1, hurst, roll, rng), heights(n, 2, hurst, roll, rng)
    i, j = rng.integers(0, n, 2)
    piece = larger[i : i + n, j : j + n]
    tilt = rng.choice([-1, 1]) * rng.uniform(0.5, 3) * whole.std() * np.linspace(0, 1, n)
    return {
        "periodic map": rl.Surface(whole, (1.0, 1.0)),
        "piece of a map": rl.Surface(piece, (1.0, 1.0)),
        "tilted periodic map": rl.Surface(whole + tilt[:, np.newaxis], (1.0, 1.0)),
        "periodic line": rl.Line(whole[0], 1.0),
        "piece of a line": rl.Line(piece[0], 1.0),
    }


def main():
    rng = np.random.default_rng(7)
    for n, made in MADE.items():
        kinds = [bodies(n, rng) for _ in range(made)]
        if n == min(MADE):
            print("| points a side | bodies of each kind |", " | ".join(kinds[0]), "|")
            print("|---" * (2 + len(kinds[0])) + "|")
        cells = []
        for name in kinds[0]:
            is_piece = not name.startswith("periodic")
            wrong = [body for body in (each[name] for each in kinds) if body.is_cut_out != is_piece]
            unsaid = [body for body in wrong if not decided(body).are_unclear]
            shares = [f"{100 * len(each) / made:.1f} %" for each in (wrong, unsaid)]
            cells.append(f"{shares[0]} ({shares[1]})")
        print(f"| {n} | {made} |", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main()
