"""The study of averages and windows: which exponents each choice shows, on the same data."""
