"""Both models on the same roughness, and the map of where the reduced one holds."""
