"""Spectrum of a body and the law that fits it, computed once for each body."""

from __future__ import annotations

from weakref import WeakKeyDictionary

from roughline.errors import InputError
from roughline.spectra.fit import SelfAffineFit, fit_self_affine
from roughline.spectra.isotropic import IsotropicSpectrum, isotropic_spectrum
from roughline.spectra.profile import ProfileSpectrum, profile_spectrum
from roughline.topography.body import Body, Surface

Fitted = tuple[IsotropicSpectrum | ProfileSpectrum, SelfAffineFit | InputError]

_KNOWN: WeakKeyDictionary[Body, Fitted] = WeakKeyDictionary()


def fitted(body: Body) -> Fitted:
    """Return the spectrum of a body, and the law that fits it or why there is none.

    Raises
    ------
    InputError
        If it has no spectrum.
    """
    if body not in _KNOWN:
        spectrum = isotropic_spectrum(body) if isinstance(body, Surface) else profile_spectrum(body)
        fit: SelfAffineFit | InputError
        try:
            fit = fit_self_affine(spectrum)
        except InputError as error:
            fit = error
        _KNOWN[body] = spectrum, fit
    return _KNOWN[body]
