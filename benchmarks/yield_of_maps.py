"""Elastic and elastic-plastic answers of measured maps beside each other.

``make yield-of-maps MAPS=folder`` takes a folder that holds the files below, of the test data of
SurfaceTopography, and writes a part of ``docs/engineering.md``.
"""

import argparse
from pathlib import Path

from page import Page

import roughline as rl
from roughline.report.answers import quantity

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
COLUMNS = (
    *("map, rms slope", "materials", "load", "$A_p/A$", "$p_c/H$ elastic", "$p_c/H$ with yield"),
    *("$A/A_0$ elastic", "$A/A_0$ with yield", "$k_u$ elastic", "$k_u$ with yield"),
    *("$R$ elastic", "$R$ with yield"),
)


def rows(folder, name, materials, loads):
    question = rl.Question(folder / name, materials, loads=loads, grid_error=True, fields=False)
    result = rl.assess(question)
    share = result.answers["plastic_fraction"].values
    for i, load in enumerate(result.headings):
        row = [f"{name}, {result.body.rms_slope:.2g}", materials.replace(",", ", "), load]
        row.append(f"{share[i]:.0%}")
        for key in SHOWN:
            elastic = quantity(result.elastic[key], i).split(" (")[0]
            row += [elastic, quantity(result.answers[key], i)]
        yield row


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    page = Page("yield-of-maps", "engineering.md", "yield-of-maps")
    page.say(
        "Values and intervals of `roughline press` for measured maps, with the hardness of the "
        "table of materials: di-1 is an atomic force microscope's map of 0.5 µm, al3d-1 and opd-1 "
        "are optical maps of some 0.1 mm. Elastic values have no interval here: that of the grid "
        "would not cover what yield changes."
    )
    page.table(*COLUMNS, at_most=4)
    for case in CASES:
        for row in rows(folder, *case):
            page.row(*row)
    page.save()


if __name__ == "__main__":
    main()
