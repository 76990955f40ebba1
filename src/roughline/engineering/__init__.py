"""Materials, formulas and the answers that follow from a curve."""

import roughline.engineering.rules  # noqa: F401  # adds them
