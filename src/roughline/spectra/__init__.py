"""Spectra: self-affine laws, bodies made of them, spectra of bodies and their moments."""
