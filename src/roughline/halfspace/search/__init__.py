"""How the contact under a load is found, and how it answers a change of load."""
