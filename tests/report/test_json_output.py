"""What is told of an assessment in JSON."""

import roughline as rl
from roughline.contact.quantities import IN_JSON
from roughline.report.json_output import assessment_json


def test_of_a_line_what_its_model_does_not_give_is_null():
    line = rl.SelfAffine(hurst=0.8, rms_height=1e-6, length=1e-3).line(256, 7)
    reduced = rl.Line(line.heights, line.length, "m")
    curve = assessment_json(rl.assess(rl.Question(reduced, E_star="1 GPa", loads="1 N")))["curve"]
    given = {name for name, values in curve.items() if values is not None}
    assert given == {"of", *(each.name for each in IN_JSON if each.of_lines)}
    assert {"stiffness_error", "area_fraction"} <= {*curve} - given
