"""The rules by which answers are worked out: a group of answers a file, in the order of pages."""

import copyreg

from roughline.engineering.rule import Rule, Rules
from roughline.engineering.rules.acoustic import ACOUSTIC
from roughline.engineering.rules.adhesion import ADHESION
from roughline.engineering.rules.contact import CONTACT
from roughline.engineering.rules.electrical import ELECTRICAL
from roughline.engineering.rules.friction import FRICTION
from roughline.engineering.rules.mechanical import MECHANICAL
from roughline.engineering.rules.sealing import SEALING
from roughline.engineering.rules.thermal import THERMAL

_FAMILIES = (MECHANICAL, CONTACT, ADHESION, FRICTION, ELECTRICAL, THERMAL, SEALING, ACOUSTIC)

rules = Rules([rule for group in _FAMILIES for rule in group])
"""By which all answers are worked out; more can be added."""


def _find_rule(key: str) -> Rule:
    """A rule, found by its key in another process: the functions of a rule cannot be written."""
    return rules[key]


copyreg.pickle(Rule, lambda rule: (_find_rule, (rule.key,)))
