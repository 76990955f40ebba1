"""Pictures of bodies, spectra, contacts and curves, in the style of the reports.

Every function draws on the axes of matplotlib that it is given, or on those of a new figure, and
returns them::

    import roughline as rl

    curve = rl.press(surface, E_star=1.0, n_loads=20, fields=True)
    rl.plot.curve(curve)
    rl.plot.contact(curve).figure.savefig("contact.pdf")
"""

from roughline.plot.bodies import contact, pressure, topography
from roughline.plot.curves import area, curve
from roughline.plot.distributions import distribution, patches
from roughline.plot.exponents import exponents
from roughline.plot.flows import flow
from roughline.plot.leaks import hydraulic_aperture
from roughline.plot.models import comparison, difference, trust_map
from roughline.plot.spectra import power_law, spectrum

__all__ = [
    "area",
    "comparison",
    "contact",
    "curve",
    "difference",
    "distribution",
    "exponents",
    "flow",
    "hydraulic_aperture",
    "patches",
    "power_law",
    "pressure",
    "spectrum",
    "topography",
    "trust_map",
]
