"""Elastic and elastic-plastic answers of measured maps beside each other, as a Markdown table.

``python benchmarks/yield_of_maps.py FOLDER [--progress]`` with a folder that holds the files below.
Values are those of `roughline press`, with the hardness of the table; brackets are their intervals.
"""

import argparse
import sys
from pathlib import Path

import roughline as rl
from roughline.report.contact_tables import quantity

CASES = (
    ("di-1.di", "gold,copper", ("1 uN",)),
    ("di-1.di", "steel,steel", ("1 MPa", "10 MPa", "100 MPa")),
    ("al3d-1.al3d", "steel,steel", ("1 MPa", "10 MPa", "100 MPa")),
    ("opd-1.opd", "steel,steel", ("1 MPa", "10 MPa", "100 MPa")),
)
SHOWN = (
    "contact_pressure_over_hardness",
    "contact_area_fraction",
    "unloading_stiffness",
    "constriction_resistance",
)
HEADER = (
    "| map, rms slope | materials | load | $A_p/A$ | $p_c/H$ elastic | with yield "
    "| $A/A_0$ elastic | with yield | $k_u$ elastic | with yield | $R$ elastic | with yield |"
)


def rows(folder, progress):
    """Rows of all cases, one for each load."""
    for name, materials, loads in CASES:
        question = rl.Question(folder / name, materials, loads=loads, grid_error=True, fields=False)
        if progress:
            print(f"{name}, {materials}", file=sys.stderr)
        result = rl.assess(question)
        share = result.answers["plastic_fraction"].values
        for i, load in enumerate(result.headings):
            row = [f"{name}, {result.body.rms_slope:.2g}", materials.replace(",", ", "), load]
            row.append(f"{share[i]:.0%}")
            for key in SHOWN:
                row += [
                    quantity(result.elastic[key], i).split(" (")[0],
                    quantity(result.answers[key], i),
                ]
            yield row


def main():
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--progress", action="store_true")
    arguments = parser.parse_args()
    print(HEADER)
    print("|---" * HEADER.count(" |") + "|")
    for row in rows(arguments.folder, arguments.progress):
        print(f"| {' | '.join(row)} |", flush=True)


if __name__ == "__main__":
    main()
