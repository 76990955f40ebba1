"""The rules of this package, a group of answers a file, in the order of pages."""

from roughline.engineering.rule import rules
from roughline.engineering.rules.acoustic import ACOUSTIC
from roughline.engineering.rules.contact import CONTACT
from roughline.engineering.rules.electrical import ELECTRICAL
from roughline.engineering.rules.mechanical import MECHANICAL
from roughline.engineering.rules.thermal import THERMAL

for _rule in (*MECHANICAL, *CONTACT, *ELECTRICAL, *THERMAL, *ACOUSTIC):
    rules.add(_rule)
