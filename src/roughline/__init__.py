"""roughline: the contact laboratory for rough surfaces.

The names below load on first use, so that ``import roughline`` costs next to nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from roughline._version import __version__

if TYPE_CHECKING:
    from roughline import plot as plot
    from roughline.assessment.assess import assess_body as assess_body
    from roughline.assessment.assess_part import assess as assess
    from roughline.assessment.assess_part import assess_part as assess_part
    from roughline.assessment.assessment import Assessment as Assessment
    from roughline.assessment.line_scan import press_scan as press_scan
    from roughline.assessment.part import PartAssessment as PartAssessment
    from roughline.assessment.question import Question as Question
    from roughline.assessment.reading import Reading as Reading
    from roughline.comparison.models import Comparison as Comparison
    from roughline.comparison.models import compare as compare
    from roughline.comparison.trust import trust_map as trust_map
    from roughline.computing.fft import set_threads as set_threads
    from roughline.contact.curve import Curve as Curve
    from roughline.contact.estimates import Estimate as Estimate
    from roughline.contact.estimates import estimate as estimate
    from roughline.contact.fields import Fields as Fields
    from roughline.contact.press import press as press
    from roughline.contact.scaling import EXACT_PUNCH as EXACT_PUNCH
    from roughline.contact.scaling import PAPER_PUNCH as PAPER_PUNCH
    from roughline.contact.status import Status as Status
    from roughline.engineering.materials import Material as Material
    from roughline.engineering.materials import material as material
    from roughline.engineering.pair import contact_modulus as contact_modulus
    from roughline.engineering.rule import Rule as Rule
    from roughline.engineering.rule import rules as rules
    from roughline.errors import ClusterError as ClusterError
    from roughline.errors import ContinuumWarning as ContinuumWarning
    from roughline.errors import ConvergenceError as ConvergenceError
    from roughline.errors import InputError as InputError
    from roughline.errors import Interrupted as Interrupted
    from roughline.errors import PreparationWarning as PreparationWarning
    from roughline.errors import RoughlineError as RoughlineError
    from roughline.errors import StoreError as StoreError
    from roughline.errors import UnitError as UnitError
    from roughline.files.netcdf import write as write
    from roughline.files.read import read as read
    from roughline.halfspace.elasticity.half_space import HalfSpace as HalfSpace
    from roughline.halfspace.elasticity.homogeneous import Homogeneous as Homogeneous
    from roughline.halfspace.laws.law import ContactLaw as ContactLaw
    from roughline.halfspace.laws.unilateral import Unilateral as Unilateral
    from roughline.halfspace.laws.yielding import Yielding as Yielding
    from roughline.spectra.fit import fit_self_affine as fit_self_affine
    from roughline.spectra.isotropic import isotropic_spectrum as isotropic_spectrum
    from roughline.spectra.profile import profile_spectrum as profile_spectrum
    from roughline.spectra.roughness import roughness as roughness
    from roughline.spectra.self_affine import SelfAffine as SelfAffine
    from roughline.statistics.averages import average as average
    from roughline.statistics.averages import relative_difference as relative_difference
    from roughline.statistics.power_law import PowerLaw as PowerLaw
    from roughline.statistics.power_law import fit_power_law as fit_power_law
    from roughline.statistics.window import find_window as find_window
    from roughline.theories.theory import theory as theory
    from roughline.topography.body import Line as Line
    from roughline.topography.body import Surface as Surface
    from roughline.topography.preparation import Preparation as Preparation
    from roughline.topography.preparation import prepared as prepared
    from roughline.topography.two_bodies import facing as facing

_HOMES = {
    "assess": "assessment.assess_part",
    "assess_body": "assessment.assess",
    "assess_part": "assessment.assess_part",
    "Assessment": "assessment.assessment",
    "PartAssessment": "assessment.part",
    "Question": "assessment.question",
    "Reading": "assessment.reading",
    "facing": "topography.two_bodies",
    "theory": "theories.theory",
    "press_scan": "assessment.line_scan",
    "fit_self_affine": "spectra.fit",
    "profile_spectrum": "spectra.profile",
    "isotropic_spectrum": "spectra.isotropic",
    "roughness": "spectra.roughness",
    "prepared": "topography.preparation",
    "Preparation": "topography.preparation",
    "material": "engineering.materials",
    "contact_modulus": "engineering.pair",
    "Material": "engineering.materials",
    "Rule": "engineering.rule",
    "rules": "engineering.rule",
    "Curve": "contact.curve",
    "Fields": "contact.curve",
    "Status": "contact.status",
    "Comparison": "comparison.models",
    "compare": "comparison.models",
    "average": "statistics.averages",
    "relative_difference": "statistics.averages",
    "ClusterError": "errors",
    "ContinuumWarning": "errors",
    "PreparationWarning": "errors",
    "ConvergenceError": "errors",
    "InputError": "errors",
    "Interrupted": "errors",
    "RoughlineError": "errors",
    "StoreError": "errors",
    "UnitError": "errors",
    "Estimate": "contact.estimates",
    "estimate": "contact.estimates",
    "set_threads": "computing.fft",
    "read": "files.read",
    "write": "files.netcdf",
    "HalfSpace": "halfspace.elasticity.half_space",
    "Homogeneous": "halfspace.elasticity.homogeneous",
    "PowerLaw": "statistics.power_law",
    "fit_power_law": "statistics.power_law",
    "find_window": "statistics.window",
    "press": "contact.press",
    "ContactLaw": "halfspace.laws.law",
    "Unilateral": "halfspace.laws.unilateral",
    "Yielding": "halfspace.laws.yielding",
    "EXACT_PUNCH": "contact.scaling",
    "PAPER_PUNCH": "contact.scaling",
    "SelfAffine": "spectra.self_affine",
    "Line": "topography.body",
    "Surface": "topography.body",
    "trust_map": "comparison.trust",
}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> Any:
    if name == "plot":
        return import_module("roughline.plot")
    if name not in _HOMES:
        raise AttributeError(f"module 'roughline' has no attribute {name!r}")
    value = getattr(import_module(f"roughline.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "plot"])
