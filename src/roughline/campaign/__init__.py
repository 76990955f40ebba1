"""Ensembles: what to compute, computing it, keeping it."""
