"""roughline: the contact laboratory for rough surfaces.

The names below load on first use, so that ``import roughline`` costs next to nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from roughline._version import __version__

if TYPE_CHECKING:
    from roughline.averages import average as average
    from roughline.body_file import write as write
    from roughline.characterisation import roughness as roughness
    from roughline.comparison import Comparison as Comparison
    from roughline.comparison import compare as compare
    from roughline.contact import press as press
    from roughline.curve import Curve as Curve
    from roughline.curve import Fields as Fields
    from roughline.curve import Status as Status
    from roughline.errors import ClusterError as ClusterError
    from roughline.errors import ContinuumWarning as ContinuumWarning
    from roughline.errors import ConvergenceError as ConvergenceError
    from roughline.errors import InputError as InputError
    from roughline.errors import Interrupted as Interrupted
    from roughline.errors import RoughlineError as RoughlineError
    from roughline.errors import StoreError as StoreError
    from roughline.errors import UnitError as UnitError
    from roughline.estimates import Estimate as Estimate
    from roughline.estimates import estimate as estimate
    from roughline.fft import set_threads as set_threads
    from roughline.isotropic import isotropic_spectrum as isotropic_spectrum
    from roughline.line_scan import press_scan as press_scan
    from roughline.materials import Material as Material
    from roughline.materials import contact_modulus as contact_modulus
    from roughline.materials import material as material
    from roughline.measured import read as read
    from roughline.power_law import PowerLaw as PowerLaw
    from roughline.power_law import find_window as find_window
    from roughline.power_law import fit_power_law as fit_power_law
    from roughline.preparation import Preparation as Preparation
    from roughline.preparation import prepared as prepared
    from roughline.profile import profile_spectrum as profile_spectrum
    from roughline.scaling import EXACT_PUNCH as EXACT_PUNCH
    from roughline.scaling import PAPER_PUNCH as PAPER_PUNCH
    from roughline.spectra import SelfAffine as SelfAffine
    from roughline.spectral_fit import fit_self_affine as fit_self_affine
    from roughline.theories import theory as theory
    from roughline.topography import Line as Line
    from roughline.topography import Surface as Surface
    from roughline.trust import trust_map as trust_map
    from roughline.two_bodies import facing as facing

_HOMES = {
    "facing": "two_bodies",
    "theory": "theories",
    "press_scan": "line_scan",
    "fit_self_affine": "spectral_fit",
    "profile_spectrum": "profile",
    "isotropic_spectrum": "isotropic",
    "roughness": "characterisation",
    "prepared": "preparation",
    "Preparation": "preparation",
    "material": "materials",
    "contact_modulus": "materials",
    "Material": "materials",
    "Curve": "curve",
    "Fields": "curve",
    "Status": "curve",
    "Comparison": "comparison",
    "compare": "comparison",
    "average": "averages",
    "ClusterError": "errors",
    "ContinuumWarning": "errors",
    "ConvergenceError": "errors",
    "InputError": "errors",
    "Interrupted": "errors",
    "RoughlineError": "errors",
    "StoreError": "errors",
    "UnitError": "errors",
    "Estimate": "estimates",
    "estimate": "estimates",
    "set_threads": "fft",
    "read": "measured",
    "write": "body_file",
    "PowerLaw": "power_law",
    "fit_power_law": "power_law",
    "find_window": "power_law",
    "press": "contact",
    "EXACT_PUNCH": "scaling",
    "PAPER_PUNCH": "scaling",
    "SelfAffine": "spectra",
    "Line": "topography",
    "Surface": "topography",
    "trust_map": "trust",
}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'roughline' has no attribute {name!r}")
    value = getattr(import_module(f"roughline.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
