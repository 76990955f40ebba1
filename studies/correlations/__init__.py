"""The study of the handbooks' correlations of contact conductance."""
