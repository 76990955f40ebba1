"""How the displacements under given pressures are computed."""
