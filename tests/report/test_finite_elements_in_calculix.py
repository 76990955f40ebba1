"""What CalculiX makes of the tables that are written for it; skipped where it is not installed."""

import re
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl

WANTED = "CalculiX (ccx) is not installed; Debian: apt-get install calculix-ccx"
pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason=WANTED)

SIDE, YOUNG = 1e-3, 1e11  # of two cubes of one element each [m], [Pa]
LOADS = ["0.3 MPa", "3 MPa", "10 MPa", "20 MPa", "30 MPa"]
CLOSINGS = (0.1e-6, 0.2e-6, 0.4e-6, 0.8e-6, 1.5e-6)  # of their outer faces [m]
CONVERGED = 1e-3  # relative: CalculiX ends its iterations at residual forces of 0.5 %


@pytest.fixture(scope="module")
def pressed():
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4)
    surface = replace(spectrum.surface(32, rng=7), unit="m")
    return rl.assess(
        rl.Question(surface, "steel, copper", loads=LOADS, periodic=True, elastic=True)
    )


def cube(first, height):
    """Nodes of a cube that begins at this height."""
    corners = ((0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE))
    places = [(x, y, z) for z in (height, height + SIDE) for x, y in corners]
    return [f"{first + i}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(places)]


MORTARS = ("MORTAR", "LINMORTAR")  # which know statics alone


def two_cubes(joint, name, kind):
    """Two cubes that are pressed together, step by step, and heated from above."""
    is_heated = kind not in MORTARS
    procedure = "COUPLED TEMPERATURE-DISPLACEMENT,STEADY STATE" if is_heated else "STATIC"
    heated = """*INITIAL CONDITIONS,TYPE=TEMPERATURE
ALL, 0
*BOUNDARY
BOTTOM, 11, 11, 0
TOP, 11, 11, 1
"""
    deck = f"""*NODE,NSET=ALL
{chr(10).join(cube(1, 0.0) + cube(11, SIDE))}
*ELEMENT,TYPE=C3D8,ELSET=LOW
1, 1,2,3,4,5,6,7,8
*ELEMENT,TYPE=C3D8,ELSET=HIGH
2, 11,12,13,14,15,16,17,18
*NSET,NSET=BOTTOM
1,2,3,4
*NSET,NSET=TOP
15,16,17,18
*SURFACE,NAME=MASTER,TYPE=ELEMENT
1,S2
*SURFACE,NAME=SLAVE,TYPE=ELEMENT
2,S1
*MATERIAL,NAME=METAL
*ELASTIC
{YOUNG:g}, 0
*CONDUCTIVITY
400
*EXPANSION
0
*SOLID SECTION,ELSET=LOW,MATERIAL=METAL
*SOLID SECTION,ELSET=HIGH,MATERIAL=METAL
{joint.strip()}
*CONTACT PAIR,INTERACTION={name},TYPE={kind}
SLAVE,MASTER
{heated if is_heated else ""}*BOUNDARY
ALL, 1, 2
BOTTOM, 3, 3
"""
    for closing in CLOSINGS:
        deck += f"""*STEP,NLGEOM
*{procedure}
1, 1
*BOUNDARY
TOP, 3, 3, {-closing}
*NODE PRINT,NSET=ALL
{"U, NT" if is_heated else "U"}
*NODE PRINT,NSET=BOTTOM,TOTALS=ONLY
{"RF, RFL" if is_heated else "RF"}
*END STEP
"""
    return deck


def solved(folder, deck):
    """Overclosure [m], pressure [Pa] and conductance [W/(m² K)] of the joint after each step."""
    (folder / "cubes.inp").write_text(deck)
    run = subprocess.run(["ccx", "cubes"], cwd=folder, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout[-2000:]
    found = {"displacements": [], "temperatures": [], "total force": [], "total heat": []}
    rows = None
    for line in (folder / "cubes.dat").read_text().splitlines():
        if kind := re.match(r" ([a-z]+(?: force| heat)?)", line):
            rows = found[kind[1]]
            rows.append([])
        elif line.strip():
            words = re.sub(r"(\d)([+-]\d{3})\b", r"\1e\2", line).split()  # Fortran leaves out the e
            rows[-1].append([float(each) for each in words])
    closing, force = (np.array(found[each]) for each in ("displacements", "total force"))
    low, high = slice(4, 8), slice(8, 12)  # the nodes of either face
    overclosure = closing[:, low, 3].mean(1) - closing[:, high, 3].mean(1)
    pressure = force[:, 0, 2] / SIDE**2
    if not found["total heat"]:
        return overclosure, pressure, None
    cold, heat = (np.array(found[each]) for each in ("temperatures", "total heat"))
    drop = cold[:, high, 1].mean(1) - cold[:, low, 1].mean(1)
    return overclosure, pressure, np.abs(heat[:, 0, 0]) / SIDE**2 / drop


def table_of(pressed, folder):
    """The plain table, and that for CalculiX."""
    plain = rl.export_table(pressed, folder / "joint.csv")
    rows = [line.split(",") for line in plain.read_text().splitlines() if line[0] != "#"]
    columns = dict(zip(rows[0], np.array(rows[1:], float).T, strict=True))
    return columns, rl.export_table(pressed, f"calculix:{folder / 'joint.inp'}").read_text()


def pressures_of(columns, overclosure):
    return np.interp(overclosure, columns["overclosure [m]"], columns["pressure [Pa]"])


def conductances_of(columns, pressure):
    heat = columns["thermal_conductance [W/(m^2 K)]"]
    return np.interp(pressure, columns["pressure [Pa]"], heat)


@pytest.mark.parametrize("kind", ["NODE TO SURFACE", *MORTARS])
def test_the_pressure_over_the_overclosure_is_that_of_the_table(pressed, tmp_path, kind):
    columns, joint = table_of(pressed, tmp_path)
    overclosure, pressure, _ = solved(tmp_path, two_cubes(joint, "ROUGH_JOINT", kind))
    assert pressure == pytest.approx(pressures_of(columns, overclosure), rel=CONVERGED)
    assert overclosure + 2 * SIDE * pressure / YOUNG == pytest.approx(CLOSINGS, rel=CONVERGED)


@pytest.mark.parametrize("kind", ["NODE TO SURFACE", *MORTARS])
def test_beyond_the_table_mortars_prolong_it_and_nodes_keep_its_end(
    pressed, tmp_path, kind, monkeypatch
):
    columns, joint = table_of(pressed, tmp_path)
    monkeypatch.setattr(f"{__name__}.CLOSINGS", (1e-6, 2e-6, 3e-6))
    overclosure, pressure, _ = solved(tmp_path, two_cubes(joint, "ROUGH_JOINT", kind))
    d, p = columns["overclosure [m]"][-2:], columns["pressure [Pa]"][-2:]
    assert overclosure[-1] > 1.2 * d[1]
    beyond = (p[1] - p[0]) / (d[1] - d[0]) * (overclosure[-1] - d[1]) if kind in MORTARS else 0.0
    assert pressure[-1] == pytest.approx(p[1] + beyond, rel=CONVERGED)


def test_the_conductance_over_the_pressure_is_that_of_the_table(pressed, tmp_path):
    columns, joint = table_of(pressed, tmp_path)
    _, pressure, conductance = solved(
        tmp_path, two_cubes(joint, "ROUGH_JOINT_WITH_HEAT", "SURFACE TO SURFACE")
    )
    assert conductance == pytest.approx(conductances_of(columns, pressure), rel=CONVERGED)
    assert (np.diff(conductance) > 0).all()


@pytest.mark.parametrize("kind", ["NODE TO SURFACE", "SURFACE TO SURFACE"])
def test_an_exponential_law_gives_pressure_and_heat_in_both_penalty_types(pressed, tmp_path, kind):
    columns, joint = table_of(pressed, tmp_path)
    line = re.search(r"EXPONENTIAL\n(\S+), (\S+)\n", joint)
    clearance, p_0 = map(float, line.groups())
    deck = two_cubes(joint, "ROUGH_JOINT_EXPONENTIAL", kind)
    overclosure, pressure, conductance = solved(tmp_path, deck)
    law = p_0 * 100 ** (overclosure / clearance)
    assert pressure == pytest.approx(law, rel=CONVERGED)
    assert conductance == pytest.approx(conductances_of(columns, pressure), rel=CONVERGED)


def test_what_the_types_make_of_the_other_interactions_is_what_the_file_says(pressed, tmp_path):
    columns, joint = table_of(pressed, tmp_path)
    by_nodes = two_cubes(joint, "ROUGH_JOINT_WITH_HEAT", "NODE TO SURFACE")
    last = columns["thermal_conductance [W/(m^2 K)]"][-1]
    assert solved(tmp_path, by_nodes)[2] == pytest.approx(last, rel=CONVERGED)
    of_surfaces = two_cubes(joint, "ROUGH_JOINT", "SURFACE TO SURFACE")
    assert not solved(tmp_path, of_surfaces)[1].any()
    assert (solved(tmp_path, two_cubes(joint, "ROUGH_JOINT", "NODE TO SURFACE"))[2] < 1).all()
