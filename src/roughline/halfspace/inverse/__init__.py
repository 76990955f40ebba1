"""How the operator is inverted, roughly."""
