"""The reduced model: a rough line on independent springs."""
