"""Symbols in the texts of pages."""

import re

import pytest

import roughline as rl
from roughline.report.typeset import formula_in_symbols, typeset

SET = [
    ("k_i and E*_l", "k<sub>i</sub> and E*<sub>l</sub>"),
    ("A_p/A of q_r/q_0", "A<sub>p</sub>/A of q<sub>r</sub>/q<sub>0</sub>"),
    ("k̄_u over F̄^α", "k̄<sub>u</sub> over F̄<sup>α</sup>"),
    ("2^20 and 1e-05", "2<sup>20</sup> and 1·10<sup>−5</sup>"),
    ("2e+04 times", "2·10<sup>4</sup> times"),
    ("my_file.nc, part_1.nc, a_1.nc", "my_file.nc, part_1.nc, a_1.nc"),
    ("E_star= of 5e93a1", "E_star= of 5e93a1"),
    ("<b> & E_0", "&lt;b&gt; &amp; E<sub>0</sub>"),
    ("phi_p, rho_c, m_dot of pi sigma_0²", "φ<sub>p</sub>, ρ<sub>c</sub>, ṁ of pi σ<sub>0</sub>²"),
    ("h_Mikic at u^(1/3)", "h<sub>Mikic</sub> at u<sup>1/3</sup>"),
]


@pytest.mark.parametrize(("text", "shown"), SET)
def test_symbols_are_set_and_names_are_left(text, shown):
    assert typeset(text) == shown


FORMULAS = [
    ("kappa_s k_i / (E* A_0)", "κ<sub>s</sub> k<sub>i</sub> / (E* A<sub>0</sub>)"),
    ("u_h³ (P1² - P2²) / eta", "u<sub>h</sub>³ (P<sub>1</sub>² − P<sub>2</sub>²) / η"),
    ("pi a_H² = F / H", "π a<sub>H</sub>² = F / H"),
    ("(12 eta Q)^(1/3)", "(12 η Q)<sup>1/3</sup>"),
    ("sqrt(2) p/(E* m))^0.94", "√(2) p/(E* m))<sup>0.94</sup>"),
    ("(2 - nu1)/(4 G1)", "(2 − ν<sub>1</sub>)/(4 G<sub>1</sub>)"),
    ("A_0 / sum(t / E_c)", "A<sub>0</sub> / Σ(t / E<sub>c</sub>)"),
    ("|z1 - z2 + i omega z1|", "|z<sub>1</sub> − z<sub>2</sub> + i ω z<sub>1</sub>|"),
    ("share of the nominal area, by bisection", "share of the nominal area, by bisection"),
]


@pytest.mark.parametrize(("formula", "shown"), FORMULAS)
def test_formulas_are_set_in_their_symbols(formula, shown):
    assert typeset(formula_in_symbols(formula)) == shown


NAMES = re.compile(r"\b(?:eta|kappa|mu|nu|omega|phi|pi|rho|sigma|sqrt)\b|_|\^")


@pytest.mark.parametrize("rule", [*rl.rules], ids=lambda rule: rule.key)
def test_no_formula_of_an_answer_is_left_in_letters_of_a_keyboard(rule):
    assert not NAMES.search(typeset(formula_in_symbols(rule.formula)))
    assert not NAMES.search(typeset(rule.symbol))
