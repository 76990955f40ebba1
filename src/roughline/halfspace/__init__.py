"""The full model: the elastic half-space under a rough indenter, with every interaction."""
