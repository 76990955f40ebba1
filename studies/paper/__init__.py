"""The study behind the page "The paper, recomputed" and the map of trust."""
