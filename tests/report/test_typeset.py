"""Symbols in the texts of pages."""

import pytest

from roughline.report.typeset import typeset

SET = [
    ("k_i and E*_l", "k<sub>i</sub> and E*<sub>l</sub>"),
    ("A_p/A of q_r/q_0", "A<sub>p</sub>/A of q<sub>r</sub>/q<sub>0</sub>"),
    ("k̄_u over F̄^α", "k̄<sub>u</sub> over F̄<sup>α</sup>"),
    ("2^20 and 1e-05", "2<sup>20</sup> and 1·10<sup>−5</sup>"),
    ("2e+04 times", "2·10<sup>4</sup> times"),
    ("my_file.nc, part_1.nc, a_1.nc", "my_file.nc, part_1.nc, a_1.nc"),
    ("E_star= of 5e93a1", "E_star= of 5e93a1"),
    ("<b> & E_0", "&lt;b&gt; &amp; E<sub>0</sub>"),
]


@pytest.mark.parametrize(("text", "shown"), SET)
def test_symbols_are_set_and_names_are_left(text, shown):
    assert typeset(text) == shown
