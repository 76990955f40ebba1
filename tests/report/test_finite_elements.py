"""Tables for finite elements, read back by readers that know the formats and take nothing else."""

import re
from dataclasses import replace

import numpy as np
import pytest
from attrs import evolve

import roughline as rl
from roughline.contact.status import Status

PAIR = "steel resistivity=1.4e-7 ohm m, copper resistivity=1.7e-8 ohm m"
LOADS = ["1 MPa", "10 MPa", "3 MPa", "30 MPa"]
SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4)


@pytest.fixture(scope="module")
def surface():
    return replace(SPECTRUM.surface(64, rng=3), unit="m")


@pytest.fixture(scope="module")
def pressed(surface):
    return rl.assess(rl.Question(surface, PAIR, loads=LOADS, periodic=True))


def read_csv(text):
    """Columns of a table by their headings, after lines of comments."""
    lines = text.splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    assert all(len(row) == len(rows[0]) for row in rows)
    values = np.array([[float(each) for each in row] for row in rows[1:]]).T
    return dict(zip(rows[0], values, strict=True))


def read_keywords(text):
    """Keywords of an input deck with their parameters, and the data lines below each."""
    found = []
    for line in text.splitlines():
        assert line.isascii()
        assert len(line) <= 132
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            keyword, *parameters = (part.strip() for part in line[1:].split(","))
            found.append((keyword.upper(), [each.upper() for each in parameters], []))
        else:
            parts = [part.strip() for part in line.split(",")]
            assert len(parts) == (1 if "PRESSURE-OVERCLOSURE=LINEAR" in found[-1][1] else 2)
            assert all(len(part) <= 20 for part in parts)  # CalculiX reads no more
            found[-1][2].append([float(part) for part in parts])
    return [(keyword, parameters, np.array(data)) for keyword, parameters, data in found]


def read_moose(text):
    """Functions of an input file for MOOSE by their names, with their parameters."""
    lines = [line.strip() for line in text.splitlines() if not line.startswith("#")]
    assert lines[0] == "[Functions]"
    assert lines[-1] == "[]"
    functions, name = {}, None
    for line in lines[1:-1]:
        if opened := re.fullmatch(r"\[(\w+)\]", line):
            assert name is None
            name = opened[1]
            functions[name] = {}
        elif line == "[]":
            name = None
        else:
            key, value = re.fullmatch(r"(\w+) = ('[^']*'|\w+)", line).groups()
            functions[name][key] = value
    assert name is None
    for each in functions.values():
        assert each["type"] == "PiecewiseLinear"
        assert each["axis"] == "x"  # a material gives its one variable in this place
        for key in "xy":
            each[key] = np.array(each[key].strip("'").split(), float)
        assert each["x"].size == each["y"].size
        assert (np.diff(each["x"]) > 0).all()
    return functions


def exact(pressed):
    """Pressure, overclosure, stiffness, thermal and electrical conductance, as they rise."""
    order = np.argsort(pressed.curve_as_asked.force)
    curve, area = pressed.curve_as_asked, pressed.area
    columns = [curve.force / area, curve.depth, curve.stiffness / area]
    if pressed.answers:
        columns.append(pressed.answers["thermal_conductance_per_area"].values)
        resistance = pressed.answers["constriction_resistance"].values
        columns.append(1 / (resistance * area * pressed.scale))
    return [np.insert(each[order], 0, 0.0) for each in columns]


CLOSE = 1e-8  # ten digits are written


def test_a_plain_table_has_every_column_with_its_interval(pressed, tmp_path):
    file = rl.export_table(pressed, tmp_path / "joint.csv")
    text = file.read_text()
    found = read_csv(text)
    names = ["pressure [Pa]", "overclosure [m]", "stiffness [Pa/m]"]
    names += ["thermal_conductance [W/(m^2 K)]", "electrical_conductance [S/m^2]"]
    for name, values in zip(names, exact(pressed), strict=True):
        assert found[name] == pytest.approx(values, rel=CLOSE)
        assert (np.diff(found[name]) > 0).all()
        if name not in names[:2]:
            start, _, unit = name.partition(" ")
            low, high = found[f"{start}_low {unit}"], found[f"{start}_high {unit}"]
            assert (low <= values * (1 + CLOSE)).all()
            assert (values <= high * (1 + CLOSE)).all()
    gap = found["mean_gap [m]"]
    heights = pressed.body.heights
    assert gap[0] == pytest.approx(heights.max() - heights.mean(), rel=CLOSE)
    assert (np.diff(gap) < 0).all()
    # steel and copper yield: the same joint is stiffer on unloading
    unloading = found["unloading_stiffness [Pa/m]"]
    assert (unloading[1:] > found["stiffness [Pa/m]"][1:]).all()
    assert f"roughline {rl.__version__}" in text
    assert "The loading branch" in text
    assert "E_star" in text


def test_calculix_takes_a_table_and_a_line_with_conductance_over_pressure(pressed, tmp_path):
    text = rl.export_table(pressed, f"calculix:{tmp_path / 'joint.inp'}").read_text()
    keywords = read_keywords(text)
    assert [each[:2] for each in keywords[:5]] == [
        ("SURFACE INTERACTION", ["NAME=ROUGH_JOINT"]),
        ("SURFACE BEHAVIOR", ["PRESSURE-OVERCLOSURE=TABULAR"]),
        ("SURFACE INTERACTION", ["NAME=ROUGH_JOINT_WITH_HEAT"]),
        ("SURFACE BEHAVIOR", ["PRESSURE-OVERCLOSURE=LINEAR"]),
        ("GAP CONDUCTANCE", []),
    ]
    pressure, overclosure, _, heat, _ = exact(pressed)
    table, slope, conductance = (keywords[i][2] for i in (1, 3, 4))
    assert table == pytest.approx(np.stack([pressure, overclosure], axis=1), rel=CLOSE)
    assert (np.diff(table, axis=0) > 0).all()
    assert slope == pytest.approx(pressure[-1] / overclosure[-1], rel=CLOSE)
    assert conductance == pytest.approx(np.stack([heat, pressure], axis=1), rel=CLOSE)


def read_comments(text):
    """The comments of an input deck as one line."""
    lines = [line for line in text.splitlines() if line.startswith("**")]
    return " ".join(line.strip("* ") for line in lines)


def test_an_exponential_law_for_calculix_is_as_near_as_it_says(surface, tmp_path):
    loads = [f"{each} MPa" for each in (0.3, 3, 10, 15, 20, 30)]
    question = rl.Question(surface, PAIR, loads=loads, periodic=True, elastic=True)
    text = rl.export_table(rl.assess(question), f"calculix:{tmp_path / 'joint.inp'}").read_text()
    keywords = read_keywords(text)
    assert [each[:2] for each in keywords[5:]] == [
        ("SURFACE INTERACTION", ["NAME=ROUGH_JOINT_EXPONENTIAL"]),
        ("SURFACE BEHAVIOR", ["PRESSURE-OVERCLOSURE=EXPONENTIAL"]),
        ("GAP CONDUCTANCE", []),
    ]
    assert (keywords[7][2] == keywords[4][2]).all()
    ((clearance, p_0),) = keywords[6][2]
    pressure, overclosure = keywords[1][2][1:].T
    ratio = p_0 * 100 ** (overclosure / clearance) / pressure  # a hundredth of p_0 at -clearance
    told = read_comments(text)
    lightest, error = re.search(r"loads from (\S+) to 3.0000e\+07 Pa, to (\S+) %", told).groups()
    met = pressure >= float(lightest) * (1 - 1e-4)
    assert 3 <= met.sum() < pressure.size
    assert 100 * abs(ratio[met] - 1).max() == pytest.approx(float(error), rel=0.05)
    assert float(error) <= 5
    assert f"its pressure is {ratio[0]:.2g} times that of the table" in told
    assert ratio[0] > 1.05


@pytest.mark.parametrize(
    ("loads", "why"),
    [
        (["1 MPa", "10 MPa"], "it takes 3 loads"),
        (["0.1 MPa", "1 MPa", "10 MPa"], "its pressure would be off by up to [0-9]+ %, and 5 %"),
    ],
)
def test_no_exponential_law_is_written_where_none_is_near(surface, tmp_path, loads, why):
    pressed = rl.assess(rl.Question(surface, E_star=1e11, loads=loads, periodic=True))
    text = rl.export_table(pressed, f"calculix:{tmp_path / 'joint.inp'}").read_text()
    assert "EXPONENTIAL\n" not in text
    assert re.search(f"There is no ROUGH_JOINT_EXPONENTIAL, .*: .*{why}", read_comments(text))


def test_without_heat_an_exponential_law_is_of_the_pressure_alone(surface, tmp_path):
    loads = [f"{each} MPa" for each in (10, 15, 20)]
    pressed = rl.assess(rl.Question(surface, E_star=1e11, loads=loads, periodic=True))
    text = rl.export_table(pressed, f"calculix:{tmp_path / 'joint.inp'}").read_text()
    assert [each[0] for each in read_keywords(text)] == [
        "SURFACE INTERACTION",
        "SURFACE BEHAVIOR",
    ] * 2
    assert "At the lightest load" not in text


def test_abaqus_takes_both_conductances_over_pressure(pressed, tmp_path):
    text = rl.export_table(pressed, f"Abaqus:{tmp_path / 'joint.inp'}").read_text()
    keywords = read_keywords(text)
    assert [each[:2] for each in keywords] == [
        ("SURFACE INTERACTION", ["NAME=ROUGH_JOINT"]),
        ("SURFACE BEHAVIOR", ["PRESSURE-OVERCLOSURE=TABULAR"]),
        ("GAP CONDUCTANCE", ["PRESSURE"]),
        ("GAP ELECTRICAL CONDUCTANCE", ["PRESSURE"]),
    ]
    pressure, overclosure, _, heat, current = exact(pressed)
    tables = [each[2].T for each in keywords[1:]]
    assert tables[0] == pytest.approx(np.array([pressure, overclosure]), rel=CLOSE)
    assert tables[0][:, 0].tolist() == [0, 0]
    assert tables[1] == pytest.approx(np.array([heat, pressure]), rel=CLOSE)
    assert tables[2] == pytest.approx(np.array([current, pressure]), rel=CLOSE)


def test_moose_takes_functions_of_x(pressed, tmp_path):
    functions = read_moose(rl.export_table(pressed, tmp_path / "joint.i").read_text())
    pressure, overclosure, stiffness, heat, current = exact(pressed)
    for name, x, y in (
        ("contact_pressure_over_overclosure", overclosure, pressure),
        ("contact_stiffness", pressure, stiffness),
        ("thermal_contact_conductance", pressure, heat),
        ("electrical_contact_conductance", pressure, current),
    ):
        found = functions.pop(name)
        assert found["x"] == pytest.approx(x, rel=CLOSE)
        assert found["y"] == pytest.approx(y, rel=CLOSE)
    assert not functions


def test_the_stiffness_is_the_slope_of_pressure_over_overclosure(surface, tmp_path):
    loads = [f"{10 * 1.02**i} MPa" for i in (-1, 0, 1)]
    pressed = rl.assess(rl.Question(surface, E_star=1e11, loads=loads, periodic=True))
    found = read_csv(rl.export_table(pressed, tmp_path / "joint.csv").read_text())
    pressure, overclosure = found["pressure [Pa]"], found["overclosure [m]"]
    slope = (pressure[3] - pressure[1]) / (overclosure[3] - overclosure[1])
    assert found["stiffness [Pa/m]"][2] == pytest.approx(slope, rel=5e-3)


def test_a_joint_of_any_area_has_the_table_of_its_map(surface, tmp_path):
    elastic = rl.Question(surface, PAIR, loads=LOADS[:2], periodic=True, elastic=True)
    alone = exact(rl.assess(elastic))
    joint = rl.assess(evolve(elastic, periodic=False, ask=rl.Joint("2 cm^2")))
    found = read_csv(rl.export_table(joint, tmp_path / "joint.csv").read_text())
    for values, wanted in zip(list(found.values())[:2], alone[:2], strict=True):
        assert values == pytest.approx(wanted, rel=1e-5)
    assert found["thermal_conductance [W/(m^2 K)]"] == pytest.approx(alone[3], rel=1e-5)
    assert found["electrical_conductance [S/m^2]"] == pytest.approx(alone[4], rel=1e-5)
    assert "unloading goes back the same way" in (tmp_path / "joint.csv").read_text().replace(
        "\n# ", " "
    )


@pytest.mark.parametrize("program", ["csv", "calculix", "abaqus", "moose"])
def test_without_materials_there_are_no_conductances_and_it_says_so(surface, tmp_path, program):
    pressed = rl.assess(rl.Question(surface, E_star=1e11, loads=LOADS[:2], periodic=True))
    text = rl.export_table(pressed, f"{program}:{tmp_path / 'joint'}").read_text()
    told = " ".join(line.lstrip("*# ") for line in text.splitlines())
    assert "conductances are not known" in told
    data = "".join(line for line in text.splitlines() if not line.startswith(("#", "**")))
    assert "onductance" not in data
    assert "GAP" not in data.upper()


def test_a_load_that_was_not_solved_is_left_out_and_named(pressed, tmp_path):
    status = pressed.curve.status.copy()
    status[2] = Status.MAX_ITERATIONS  # the third that rises
    partly = replace(pressed, curve=replace(pressed.curve, status=status))
    text = rl.export_table(partly, tmp_path / "joint.csv").read_text()
    assert read_csv(text)["pressure [Pa]"] == pytest.approx([0, 1e6, 3e6, 3e7], rel=1e-6)
    assert "not solved: 10 MPa." in text.replace("\n# ", " ")


def test_unloading_is_no_part_of_the_table(surface, tmp_path):
    history = rl.Question(
        surface, PAIR, loads=["1 MPa", "10 MPa", "4 MPa"], periodic=True, history=True
    )
    text = rl.export_table(rl.assess(history), tmp_path / "joint.csv").read_text()
    assert read_csv(text)["pressure [Pa]"] == pytest.approx([0, 1e6, 1e7], rel=1e-6)
    assert "after larger loads, or again: 1 of the loads" in text.replace("\n# ", " ")


def test_overclosures_that_calculix_does_not_tell_apart_are_left_out(surface, tmp_path):
    small = rl.Surface(1e-3 * surface.heights, surface.sizes, "m")
    loads = ["1 kPa", "1.001 kPa", "10 kPa"]
    pressed = rl.assess(rl.Question(small, E_star=1e11, loads=loads, periodic=True))
    text = rl.export_table(pressed, f"calculix:{tmp_path / 'joint.inp'}").read_text()
    table = read_keywords(text)[1][2]
    assert (np.diff(table[:, 1]) > 1e-10).all()
    assert table[:, 0] == pytest.approx([0, 1e3, 1e4], rel=1e-6)
    assert "1 of the overclosures are left out" in text
    whole = rl.export_table(pressed, f"abaqus:{tmp_path / 'joint.inp'}").read_text()
    assert read_keywords(whole)[1][2].shape == (4, 2)


def test_full_contact_is_said_and_has_no_lines_of_infinity(surface, tmp_path):
    smooth = rl.Surface(1e-3 * surface.heights, surface.sizes, "m")
    loads = ["1 MPa", "10 GPa", "20 GPa"]
    question = rl.Question(smooth, PAIR, loads=loads, periodic=True, elastic=True)
    text = rl.export_table(rl.assess(question), f"abaqus:{tmp_path / 'joint.inp'}").read_text()
    assert "In full contact from 1.0000e+10 Pa on" in text
    tables = [each[2] for each in read_keywords(text)[1:]]
    assert all(np.isfinite(each).all() for each in tables)
    assert (np.diff(tables[0][:, 1]) > 0).all()
    assert [len(each) for each in tables[1:]] == [2, 2]
    plain = read_csv(rl.export_table(rl.assess(question), tmp_path / "joint.csv").read_text())
    assert np.isinf(plain["stiffness [Pa/m]"]).tolist() == [False, False, True, True]


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("joint.inp", "which program is to read it"),
        ("joint", "which program is to read it"),
        ("abacus:joint.inp", "did you mean abaqus:joint.inp"),
        ("ansys:joint.inp", "known programs are csv, calculix, abaqus, moose$"),
        ("abaqus:", "a file in a folder that exists is needed"),
        ("abaqus:no/joint.inp", "a file in a folder that exists is needed"),
        ("no/joint.csv", "a file in a folder that exists is needed"),
        ("csv:.", "a file in a folder that exists is needed"),
    ],
)
def test_a_table_that_cannot_be_is_refused(pressed, table, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(rl.InputError, match=message) as refused:
        rl.export_table(pressed, table)
    assert refused.value.argument == "table"


def test_what_has_no_interface_of_its_own_is_refused(surface, tmp_path):
    table = tmp_path / "joint.csv"
    free = rl.assess(rl.Question(surface, E_star=1e11, loads=LOADS[:2]))
    with pytest.raises(rl.InputError, match=r"press the map periodically \(periodic=True\)"):
        rl.export_table(free, table)
    single = rl.assess(rl.Question(surface, E_star=1e11, loads="1 MPa", periodic=True))
    with pytest.raises(rl.InputError, match="needs two loads or more"):
        rl.export_table(single, table)
    assert not table.exists()


def test_on_the_command_line_it_is_refused_before_the_work(rough, invoke, tmp_path, monkeypatch):
    monkeypatch.setattr("roughline.assessment.assess.assess_body", None)
    two = ("press", rough, "--modulus", "1 GPa", "--load", "1 MPa", "--load", "2 MPa")
    for options, message in (
        (("--export-table", "joint.inp", "--periodic"), '--export-table is "joint.inp"; which'),
        (("--export-table", "moos:joint.i", "--periodic"), "did you mean moose:joint.i"),
        (("--export-table", "no/joint.csv", "--periodic"), "a folder that exists"),
        (("--export-table", "joint.csv"), "periodically (--periodic), or for a joint"),
    ):
        code, out, errors = invoke(*two, *options)
        assert (code, out) == (2, "")
        assert message in errors
        assert errors.count("\n") == 1
    code, _, errors = invoke(*two[:-2], "--periodic", "--export-table", "joint.csv")
    assert code == 2
    assert "--export-table needs two loads or more; give --load again" in errors


def test_the_command_writes_it_and_names_it(rough, invoke, tmp_path):
    table = tmp_path / "joint.inp"
    loads = ("--load", "1 MPa", "--load", "2 MPa", "--periodic")
    code, out, errors = invoke(
        "press", rough, "--modulus", "100 GPa", *loads, "--export-table", f"abaqus:{table}"
    )
    assert code == 0, errors
    assert table.name in out
    assert read_keywords(table.read_text())[1][2].shape == (3, 2)
