"""Materials, formulas and the answers that follow from a curve."""
