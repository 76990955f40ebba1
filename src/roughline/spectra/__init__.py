"""Spectra: self-affine laws, synthesis, measured spectra, fits, roughness parameters."""
