"""Tables of an assessment: the loads that are wanted, and which of them carry a star."""

import roughline as rl
from roughline.report.contact_tables import answer_table, star_is_shown
from roughline.report.terminal import print_assessment

PAIR = ("steel", "copper")


def test_no_star_is_explained_that_is_not_shown(rough, capsys):
    pressed = rl.assess(rl.Question(rough, PAIR, loads="10 N", whole_curve=True))
    assert not pressed.curve.resolved.all()  # lighter loads of a report's figure
    print_assessment(pressed, long_curves_by="", many_answers_by="")
    assert "fewer than ten points in contact" not in capsys.readouterr().out
    assert not star_is_shown(pressed)


def test_a_table_has_the_loads_that_are_wanted(rough):
    pressed = rl.assess(rl.Question(rough, PAIR, loads=["30 N", "10 N", "20 N"]))
    header, rows = answer_table(pressed, slice(1, 3))
    assert header == ["", "10 N", "20 N"]
    assert rows[0] == ["normal force F", "10 N", "20 N"]
