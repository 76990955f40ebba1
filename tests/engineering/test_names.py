"""Names of materials and fluids: a formula is of one substance, and never of another."""

import pytest

import roughline as rl
from roughline.engineering.described import chemical_formulas
from roughline.engineering.names import find_name

OF_MATERIALS, OF_FLUIDS = chemical_formulas("materials.csv"), chemical_formulas("fluids.csv")
SYMBOLS = {
    "Al": "aluminium",
    "Cu": "copper",
    "Au": "gold",
    "Ni": "nickel",
    "Al2O3": "alumina",
    "SiO2": "fused-silica",
    "Si": "silicon",
    "Ag": "silver",
    "Sn": "tin",
    "Ti": "titanium",
    "W": "tungsten",
    "Zn": "zinc",
    "TiN": "titanium-nitride",
    "H2O": "water",
    "C2H5OH": "ethanol",
    "N2": "nitrogen",
    "O2": "oxygen",
    "Ar": "argon",
    "He": "helium",
    "H2": "hydrogen",
    "CH4": "methane",
    "CO2": "carbon-dioxide",
}
OTHERS = "Fe Pb In Pt Cr C WC SiC SiO TiO2 TiC TiAlN CrN Si3N4 CO NO N2O Ne NH3 C2H6 SF6 CoCr"
TABLES = (("material", OF_MATERIALS), ("fluid", OF_FLUIDS))


def found(typed, what, table):
    """The name that a text is read as, or what is said where it is refused."""
    try:
        return find_name(typed, what, table, "...")
    except rl.InputError as error:
        return str(error)


def test_every_formula_of_the_tables_is_the_one_of_chemistry():
    written = {
        formula: name
        for _, table in TABLES
        for name, several in table.items()
        for formula in several.split()
    }
    assert written == SYMBOLS


@pytest.mark.parametrize(("what", "table"), TABLES)
def test_a_formula_is_its_own_substance_or_is_refused_without_a_hint(what, table):
    for formula in [*SYMBOLS, *OTHERS.split()]:
        name = SYMBOLS.get(formula)
        answer = found(formula, what, table)
        if name in table:
            assert answer == name
        else:
            assert answer.startswith(f'no {what} is called "{formula}". Known are')


@pytest.mark.parametrize(("what", "table"), TABLES)
def test_a_formula_in_other_letters_is_never_another_substance(what, table):
    for formula, name in SYMBOLS.items():
        for typed in (formula.upper(), formula.lower(), " ".join(formula)):
            answer = found(typed, what, table)
            word = typed == "tin"  # a metal, be it also titanium nitride in small letters
            assert answer in (name, *["tin"] * word) or "Known are" in answer or "may be" in answer


@pytest.mark.parametrize(("what", "table"), TABLES)
def test_a_name_in_any_letters_is_itself_or_may_be_two(what, table):
    for name in table:
        words = name.replace("-", " ")
        for typed in (name, name.upper(), name.capitalize(), words.title(), words.upper()):
            answer = found(typed, what, table)
            assert answer == name or (typed == "TIN" and "may be" in answer)


def test_tin_and_titanium_nitride_are_told_apart_by_capitals():
    assert rl.material("TiN 2 um on steel").name == "titanium-nitride 2 µm on steel"
    for typed, name in (
        ("TiN", "titanium-nitride"),
        ("Ti N", "titanium-nitride"),
        ("tin", "tin"),
        ("Tin", "tin"),
        ("Sn", "tin"),
    ):
        assert rl.material(typed).name == name
    for typed in ("TIN", "tIN", "ti n"):
        with pytest.raises(rl.InputError) as refused:
            rl.material(typed)
        assert str(refused.value) == (
            f'the material "{typed}" may be tin or TiN, which is titanium-nitride: '
            'write "tin" or "titanium-nitride"'
        )


@pytest.mark.parametrize("typed", ["TiAlN", "tialn", "In", "in", "Fe", "fe", "silica", "sic"])
def test_no_hint_names_another_substance(typed):
    with pytest.raises(rl.InputError, match=f'no material is called "{typed}". Known are'):
        rl.material(typed)


def test_formulas_are_read_as_they_are_printed():
    assert rl.material("Al₂O₃") == rl.material("alumina")
    assert rl.fluid_of("CO₂ at 60 °C") == rl.fluid_of("co2 at 60 °C")
    hard = rl.material("Cu hardness=1 GPa")
    assert (hard.name, hard.hardness) == ("copper", 1e9)
