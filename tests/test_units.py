"""Quantities with units: read as engineers write them, written with prefixes."""

import pytest

import roughline as rl
from roughline import units
from roughline.units import engineering, in_si, metres_per


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("110 GPa", "Pa", 110e9),
        ("110GPa", "Pa", 110e9),
        ("0.5 mm", "m", 5e-4),
        ("2 µm", "m", 2e-6),
        ("2um", "m", 2e-6),
        ("1 mil", "m", 25.4e-6),
        ("40 mils", "m", 1.016e-3),
        ("2 mil^2", "m^2", 2 * 25.4e-6**2),
        ("1e3 N/mm^2", "Pa", 1e9),
        ("2 kN", "N", 2000.0),
        ("-3 N", "N", -3.0),
    ],
)
def test_quantities_become_si(text, unit, value):
    assert in_si(text, unit, "it") == pytest.approx(value)


@pytest.mark.parametrize(
    "text", ["5 N", "abc", "", "GPa", "5 GPa 3", "9**9**9 Pa", "1/0 Pa", "5 GPaa", "5 Pa*" * 50]
)
def test_senseless_quantities_are_refused(text):
    with pytest.raises(rl.UnitError, match="modulus is .* such as"):
        in_si(text, "Pa", "modulus")
    with pytest.raises(rl.UnitError, match="without a unit; give one"):
        in_si("5", "Pa", "modulus")


def test_units_are_written_with_prefixes():
    assert engineering(1.2344e-6, "m") == "1.234 µm"


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (1 - 2e-16, "N", "1 N"),  # what rounds to a thousand has the next prefix
        (999.96, "N", "1 kN"),
        (1e-9, "m", "1 nm"),
        (1e-3, "m", "1 mm"),
        (0.0, "m", "0 m"),
        (-2.5e-3, "ohm", "-2.5 mΩ"),
        (4.713e-12, "m²", "4.713 µm²"),  # the prefix of an area counts twice
        (1.3e-13, "m²", "0.13 µm²"),
        (2.1e-9, "m²", "2100 µm²"),
        (1.499e5, "W/(m² K)", "149.9 kW/(m² K)"),
        (1.3e14, "N/m³", "130 GPa/mm"),
    ],
)
def test_prefixes(value, unit, text):
    assert engineering(value, unit) == text


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("200 W/(m K)", "W/m/K", 200),
        ("200 W m-1 K-1", "W/m/K", 200),
        ("200 W/(m·K)", "W/m/K", 200),
        ("2 N/mm2", "Pa", 2e6),
        ("2 N/mm²", "Pa", 2e6),
        ("2 N/mm^2", "Pa", 2e6),
        ("7860 kg/m3", "kg/m**3", 7860),
        ("2e6 m^-1", "1/m", 2e6),
        ("0.3 mN", "N", 0.0003),  # and not 0.00029999999999999997
        ("10000 mN", "N", 10.0),
        ("0.7 um", "m", 0.7e-6),
    ],
)
def test_units_are_read_as_engineers_write_them(text, unit, value):
    assert in_si(text, unit, "it") == value


@pytest.mark.parametrize("prefix", ["", *"afpnuµμmckMGTPE"])
@pytest.mark.parametrize(
    "unit", ["m", "s", "g", "K", "mol", "N", "Pa", "bar", "J", "W", "Hz", "ohm"]
)
def test_plain_units_are_those_of_the_registry(prefix, unit):
    registry = units._registry()
    ten, powers = units._plain(prefix + unit)
    expected = registry.Quantity(10.0**ten, "")
    for each, power in powers.items():
        expected *= registry.Quantity(1.0, each) ** power
    assert (registry.Quantity(1.0, prefix + unit) / expected).to("").magnitude == pytest.approx(1)


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("2 cm^2", "m^2"),
        ("2 mm**2", "m^2"),
        ("2 N/mm²", "Pa"),
        ("1 bar", "Pa"),
        ("50 mJ/m^2", "J/m**2"),
        ("50 mN / m", "J/m**2"),
        ("400 W m-1 K-1", "W/m/K"),
        ("40 mPa s", "Pa*s"),
        ("29 g/mol", "kg/mol"),
        ("7.86 g/cm³", "kg/m**3"),
        ("2 1/µm", "1/m"),
    ],
)
def test_products_of_plain_units_are_those_of_the_registry(text, unit, monkeypatch):
    value = in_si(text, unit, "it")
    monkeypatch.setattr(units, "_plain", lambda written: None)
    assert in_si(text, unit, "it") == value


@pytest.mark.parametrize("text", ["0,33 GPa", "1,000 GPa"])
def test_a_comma_in_a_number_is_blamed(text):
    number = text.split()[0]
    with pytest.raises(rl.UnitError, match=f'comma in "{number}"; numbers take a decimal point'):
        in_si(text, "Pa", "modulus")
    assert metres_per("um") == metres_per("µm") == pytest.approx(1e-6)
