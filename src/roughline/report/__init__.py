"""Figures, tables and pages drawn from results."""
